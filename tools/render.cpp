// SPDX-License-Identifier: Apache-2.0
// mms render: its options, and whether they make sense.
#include "tools/render.h"

#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "renderer/environments.h"
#include "tools/commands.h"

namespace mms::tools {

namespace {

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

/// Reads a number above 0; leaves `value` alone where the option is not given.
std::optional<Error> read_positive(const char* option, const std::string& text, double& value,
                                   const char* hint) {
  if (text.empty()) return std::nullopt;
  const auto n = number<double>(text);
  if (!n || !(*n > 0) || !std::isfinite(*n))
    return Error{option, fmt::format("`{}` is not a number above 0", text), hint};
  value = *n;
  return std::nullopt;
}

/// When to end: `--samples N` or `A:B`, `--time`, `--error`. The last two are waited for with as
/// many samples as it takes, unless told otherwise.
std::optional<Error> read_limits(RenderRequest& r) {
  constexpr int kMost = 1 << 24;
  constexpr const char* kHint =
      "samples for each pixel: 16 for a glance, 256 for a clean picture; 0:64 or 64:128 for a part";
  if (auto e = read_positive("--time", r.time, r.seconds, "seconds of rendering, as in --time 60"))
    return e;
  if (auto e = read_positive("--error", r.error, r.error_limit,
                             "the error to reach, where 1 is display white: 0.01 is clean"))
    return e;
  if (r.samples.empty()) {
    r.end_sample = r.seconds > 0 || r.error_limit > 0 ? kMost : 64;
    return std::nullopt;
  }
  const std::size_t colon = r.samples.find(':');
  if (colon == std::string::npos)
    return read("--samples", r.samples, 1, kMost, r.end_sample, kHint);
  if (auto e = read("--samples", r.samples.substr(0, colon), 0, kMost - 1, r.first_sample, kHint))
    return e;
  return read("--samples", r.samples.substr(colon + 1), r.first_sample + 1, kMost, r.end_sample,
              kHint);
}

std::optional<Error> read_numbers(RenderRequest& r) {
  if (auto e = read_size(r)) return e;
  if (auto e = read_limits(r)) return e;
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
  if (!r.checkpoint.empty()) {
    const auto seconds = number<double>(r.checkpoint);
    if (!seconds || !(*seconds >= 0) || !std::isfinite(*seconds))
      return Error{"--checkpoint", fmt::format("`{}` is not a number of seconds", r.checkpoint),
                   "how much work may be lost at most; 0 is never"};
    r.checkpoint_seconds = *seconds;
  }
  if (!r.turntable.empty())
    if (auto e = read("--turntable", r.turntable, 1, 9999, r.frames,
                      "how many pictures make one turn, as in --turntable 48"))
      return e;
  if ((!r.sweeps.empty()) + (r.frames > 0) + r.watch > 1)
    return Error{"mms render", "one of --sweep, --turntable and --watch at a time",
                 "leave the others out"};
  return read_picture_options(r);
}

Exit render(RenderRequest request) {
  if (const auto error = read_numbers(request)) return fail(Exit::Usage, *error, request);
  // A picture that is watched is another one each time; else a script is one, however many show it.
  if (!request.watch) request.said = std::make_shared<std::set<std::string>>();
  return render_pictures(request);
}

void add_render_options(Verb& verb, RenderRequest& r) {
  std::vector<std::string_view> environments;
  for (const renderer::NamedEnvironment& e : renderer::kEnvironments)
    environments.push_back(e.name);
  verb.add(
      {"-o,--output", &r.output, "PATH",
       "Picture (.png, .exr), exact sums (.film), a folder for each NAME.png, or a sheet of all"});
  verb.add({"--samples", &r.samples, "N|A:B", "Samples for each pixel [64], or their numbers"});
  verb.add({"--time", &r.time, "SECONDS", "End after so long"});
  verb.add({"--error", &r.error, "E",
            "End when the estimated error is no larger, with more samples where they do more; 1 is "
            "white"});
  verb.add({"--filter",
            &r.filter,
            "NAME",
            "box, gaussian or blackman-harris [blackman-harris]",
            {"box", "gaussian", "blackman-harris"}});
  verb.add({"--size", &r.size, "WxH", "Width and height in pixels [512x512]"});
  verb.add(
      {"--scene", &r.scene, "NAME|FILE", "A built-in scene, or a scene file (.json) [sphere]"});
  verb.add(
      {"--environment", &r.environment, "NAME|FILE",
       fmt::format("In place of the scene's: {}, or a picture of it all (.exr, .hdr, .png ...)",
                   fmt::join(environments, ", "))});
  verb.add({"--surface", &r.surface, "NAME", "Surface that the test object wears"});
  verb.add({"--volume", &r.volume, "NAME", "Volume that fills the test object"});
  verb.add({"--max-depth", &r.max_depth, "N", "Scattering events of a path [64]"});
  verb.add({"--seed", &r.seed, "N", "Same seed, same picture, bit for bit [0]"});
  verb.add({"--threads", &r.threads, "N", "Threads; 0 is all of the machine [0]"});
  verb.add({"--report", &r.report, "", "Print the counters of the render too"});
  verb.add({"--estimator",
            &r.estimator,
            "NAME",
            "For comparison: clustered, unweighted, single or four [clustered]",
            {"clustered", "unweighted", "single", "four"}});
  verb.add({"--sampler",
            &r.sampler,
            "NAME",
            "For comparison: niederreiter, sobol, random or unscrambled [niederreiter]",
            {"niederreiter", "sobol", "random", "unscrambled"}});
  verb.add({"--checkpoint", &r.checkpoint, "SECONDS",
            "Keep what is there in PATH.film so often; 0 is never [60]"});
  verb.add({"--sweep", &r.sweeps, "PARAM=A:B:N",
            "A sheet of N pictures with captions, a param from A to B; a second one goes down"});
  verb.add({"--turntable", &r.turntable, "N", "N pictures NAME.000.png ... of one turn"});
  verb.add({"--watch", &r.watch, "",
            "Render again whenever a file of the picture changes, until Ctrl-C"});
  verb.add({"--resume", &r.resume, "", "Go on from PATH.film, if it is there"});
}

}  // namespace

Verb render_verb() {
  auto request = std::make_shared<RenderRequest>();
  Verb verb{"render",
            "Render scripts to pictures of a test object",
            "Ctrl-C stops, writes what is there, and ends with code 130; --resume goes on from "
            "there, to the\n"
            "bits of a render that was not stopped. With --error or --time these end by what is "
            "there too: a film\n"
            "of --samples 20 keeps its 20, where a render from the start may end with fewer.\n\n"
            "Examples:\n"
            "  mms render marble.mms\n  mms render marble.mms -o marble.exr --samples 256\n"
            "  mms render marble.mms --error 0.01 --time 60\n"
            "  mms render examples/*.mms -o out/ --size 256x256\n"
            "  mms render marble.mms --watch\n"
            "  mms render a.mms b.mms -o sheet.png\n"
            "  mms render metal.mms --sweep roughness=0:1:6 --size 256x256 -o sweep.png\n"
            "  mms render openpbr --sweep specular_roughness=0:1:6 --sweep base_metalness=0:1:3\n"
            "  mms render marble.mms --turntable 48 -o turn/\n"
            "  mms render --set scale=8 --surface marble marble.mms --report",
            {},
            [request] { return render(*request); }};
  add_files(verb, *request, "Scripts, a picture of each");
  add_render_options(verb, *request);
  add_picture_options(verb, *request);
  add_script_options(verb, *request);
  add_format_option(verb, *request);
  return verb;
}

}  // namespace mms::tools
