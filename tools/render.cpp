// SPDX-License-Identifier: Apache-2.0
// mms render: its options, and whether they make sense.
#include "tools/render.h"

#include <charconv>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "tools/commands.h"

namespace mms::tools {

namespace {

template <class T>
std::optional<T> number(const std::string& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Reads a whole number of [low, high] from an option.
std::optional<Error> read(const char* option, const std::string& text, int low, int high,
                          int& value, const char* hint) {
  const auto n = number<long long>(text);
  if (!n) return Error{option, fmt::format("`{}` is not a whole number", text), hint};
  if (*n < low || *n > high)
    return Error{option, fmt::format("{} is not in [{}, {}]", *n, low, high), hint};
  value = static_cast<int>(*n);
  return std::nullopt;
}

std::optional<Error> read_size(RenderRequest& r) {
  constexpr const char* kHint = "write width x height in pixels, as in --size 512x512";
  const std::size_t x = r.size.find('x');
  if (x == std::string::npos)
    return Error{"--size", fmt::format("`{}` is not a size", r.size), kHint};
  if (auto e = read("--size", r.size.substr(0, x), 1, 32768, r.width, kHint)) return e;
  return read("--size", r.size.substr(x + 1), 1, 32768, r.height, kHint);
}

std::optional<Error> read_numbers(RenderRequest& r) {
  if (auto e = read_size(r)) return e;
  if (auto e = read("--samples", r.samples, 1, 1 << 24, r.sample_count,
                    "samples for each pixel: 16 for a glance, 256 for a clean picture"))
    return e;
  if (auto e = read("--threads", r.threads, 0, 4096, r.thread_count,
                    "0 takes as many threads as the machine has"))
    return e;
  if (auto e = read("--max-depth", r.max_depth, 1, 1 << 20, r.depth,
                    "how often a path may scatter; 64 is the default"))
    return e;
  const auto seed = number<std::uint64_t>(r.seed);
  if (!seed)
    return Error{"--seed", fmt::format("`{}` is not a seed", r.seed), "any whole number from 0 up"};
  r.seed_number = *seed;
  const auto stops = number<double>(r.exposure);
  if (!stops || !(*stops >= -64 && *stops <= 64))
    return Error{"--exposure", fmt::format("`{}` is not a number of stops", r.exposure),
                 "each stop doubles the brightness; from -64 to 64"};
  r.stops = *stops;
  return std::nullopt;
}

Exit render(RenderRequest request) {
  if (const auto error = read_numbers(request)) return fail(Exit::Usage, *error, request);
  return render_pictures(request);
}

void add_picture_options(CLI::App& verb, RenderRequest& r) {
  verb.add_option("-o,--output", r.output,
                  "Picture (.png or .exr), or a folder for NAME.png of each script")
      ->type_name("PATH");
  verb.add_option("--samples", r.samples, "Samples for each pixel [64]")->type_name("N");
  verb.add_option("--size", r.size, "Width and height in pixels [512x512]")->type_name("WxH");
  verb.add_option("--scene", r.scene, "A built-in scene, or a scene file (.json) [sphere]")
      ->type_name("NAME|FILE");
  verb.add_option("--surface", r.surface, "Surface that the test object wears")->type_name("NAME");
  verb.add_option("--volume", r.volume, "Volume that fills the test object")->type_name("NAME");
  verb.add_option("--exposure", r.exposure, "Stops that brighten a .png [0]")->type_name("STOPS");
  verb.add_option("--max-depth", r.max_depth, "Scattering events of a path [64]")->type_name("N");
  verb.add_option("--seed", r.seed, "Same seed, same picture, bit for bit [0]")->type_name("N");
  verb.add_option("--threads", r.threads, "Threads; 0 is all of the machine [0]")->type_name("N");
}

}  // namespace

void add_render(CLI::App& command, Exit& exit) {
  CLI::App* verb = command.add_subcommand("render", "Render scripts to pictures of a test object");
  auto request = std::make_shared<RenderRequest>();
  verb->add_option("FILE", request->files, "Scripts, a picture of each; - is standard input")
      ->required()
      ->type_name("");
  add_picture_options(*verb, *request);
  verb->add_flag("--report", request->report, "Print the counters of the render too");
  verb->add_flag("--quiet", request->quiet, "Print errors only");
  add_script_options(*verb, *request);
  add_format_option(*verb, *request);
  verb->footer(
      "Ctrl-C stops, writes what is there, and ends with code 130.\n\nExamples:\n"
      "  mms render marble.mms\n  mms render marble.mms -o marble.exr --samples 256\n"
      "  mms render examples/*.mms -o out/ --size 256x256\n"
      "  mms render --param scale=8 --surface marble marble.mms --report");
  verb->callback([request, &exit] { exit = render(*request); });
}

}  // namespace mms::tools
