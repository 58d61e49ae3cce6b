// SPDX-License-Identifier: Apache-2.0
#include "tools/render_job.h"

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "api/library.h"
#include "base/hash.h"
#include "renderer/film.h"
#include "tools/output.h"
#include "vm/serialise.h"

namespace mms::tools {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The one global: a signal handler can reach nothing else.
std::atomic<bool> stop{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void on_interrupt(int signal) {
  stop = true;
  std::signal(signal, SIG_DFL);  // a second Ctrl-C ends at once
}

/// The surface that the test object wears: asked for, or the only one, or the one named like the
/// script, or the first, and then a note says so. Empty: whatever the scene says.
std::string choose_surface(const RenderRequest& request, const std::string& file,
                           const vm::Program& program) {
  if (!request.surface.empty()) return request.surface;
  std::vector<std::string> names;
  for (const vm::Descriptor& d : program.descriptors)
    if (d.form == vm::DescriptorForm::Surface) names.push_back(d.name);
  if (names.empty()) return "";
  for (const std::string& name : names)
    if (name == stem(file)) return name;
  if (names.size() > 1 && !request.quiet && is_news("surfaces of " + file, request))
    fmt::print(stderr, "note: {}: {} surfaces; rendering `{}` (--surface takes another: {})\n",
               file, names.size(), names[0], fmt::join(names.begin() + 1, names.end(), ", "));
  return names[0];
}

/// A number for what a file holds; 0 where it cannot be read.
std::uint64_t content_hash(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::vector<char> piece(1 << 20);
  std::uint64_t hash = 0;
  while (in.read(piece.data(), std::streamsize(piece.size())), in.gcount() > 0)
    hash = hash_bytes({piece.data(), std::size_t(in.gcount())}, hash);
  return hash;
}

/// A number for the linked program and what its images and tables hold, the same wherever its
/// files are.
std::uint64_t script_hash(const vm::Program& program) {
  vm::Package package{program, {}, {}};
  for (std::string& name : package.program.sources) name.clear();
  for (vm::ProgramImage& image : package.program.images) {
    std::uint64_t held = 0;
    for (const std::string& file : image.image ? image.image->files() : std::vector<std::string>())
      held = hash_combine(held, content_hash(file));
    image.use.file = fmt::format("{:x}", held);
  }
  const std::vector<std::byte> bytes = vm::save(package, api::standard_library().builtins);
  return hash_bytes({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Json to_json(const std::string& script, const std::string& path, const renderer::Report& r) {
  Json faults = Json::array();
  for (const renderer::FaultCount& f : r.faults)
    faults.push_back({{"where", f.where}, {"cause", f.cause}, {"lanes", f.lanes}});
  Json gains = Json::array();
  for (const renderer::GainCount& g : r.gains)
    gains.push_back({{"where", g.where},
                     {"descriptor", g.descriptor},
                     {"points", g.points},
                     {"of", g.of},
                     {"most", g.most}});
  Json json{{"script", script},
            {"picture", path},
            {"samples", r.samples},
            {"mean_samples", r.mean_samples},
            {"seconds", r.seconds},
            {"error", r.rmse},
            {"threads", r.threads},
            {"paths", r.paths},
            {"rays", r.rays},
            {"shadow_rays", r.shadow_rays},
            {"script_runs", r.script_runs},
            {"script_points", r.script_points},
            {"batch_fill", r.batch_fill},
            {"pass_runs", r.pass_runs},
            {"emission_runs", r.emission_runs},
            {"medium_runs", r.medium_runs},
            {"media_steps", r.media_steps},
            {"medium_samples", r.medium_samples},
            {"denser_samples", r.denser_samples},
            {"dropped_nan", r.dropped.nan},
            {"dropped_infinite", r.dropped.infinite},
            {"dropped_overflow", r.dropped.overflow},
            {"cut_samples", r.cut},
            {"fault_lanes", r.fault_lanes},
            {"faults", faults},
            {"gains", gains},
            {"stopped", r.stopped}};
  if (!tells_error(std::uint32_t(r.samples))) json.erase("error");
  return json;
}

/// "1 sample was", "2 samples were".
std::string were(std::uint64_t samples) {
  return counted(samples, "sample") + (samples == 1 ? " was" : " were");
}

/// Light that could not be added, or that the stated error does not know.
void warn_of_samples(const std::string& script, const renderer::Report& r) {
  const renderer::Dropped& d = r.dropped;
  std::vector<std::string> left_out;
  if (d.nan + d.infinite > 0)
    left_out.push_back(fmt::format("{} not finite", were(d.nan + d.infinite)));
  if (d.overflow > 0)
    left_out.push_back(fmt::format("{} too bright ({:.2g} times white is the most)",
                                   were(d.overflow), renderer::kLargestSample));
  if (!left_out.empty())
    fmt::print(stderr, "warning: {}: {} and {} left out; the first: pixel ({}, {}), sample {}\n",
               script, fmt::join(left_out, ", "), d.count() == 1 ? "was" : "were", d.first_x,
               d.first_y, d.first_sample);
  if (r.cut > 0)
    fmt::print(
        stderr,
        "warning: {}: {} brighter than {:.2g} times white; the stated error takes no sample to "
        "be brighter than that, so it may be too small\n",
        script, were(r.cut), renderer::kLargestForVariance);
}

}  // namespace

std::string stem(const std::string& file) {
  return file == "-" ? "stdin" : fs::path(file).stem().string();
}

bool interrupted() { return stop; }

void catch_interrupts() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);  // what batch systems send
}

std::optional<RenderScript> compile_script(const RenderRequest& request, const std::string& file,
                                           Exit& exit) {
  auto linked = compile_files({file}, request, exit);
  if (!linked) return {};
  if (linked->program.descriptors.empty()) {
    exit = fail(Exit::Script,
                {file, "nothing to render: no surface and no volume",
                 "add one: surface \"plain\" bsdf = matte(0.5); end"},
                request);
    return {};
  }
  auto program = std::make_shared<const Compiled>(std::move(*linked));
  const vm::Program& p = program->program;
  return RenderScript{program, choose_surface(request, file, p), script_hash(p)};
}

std::vector<std::string> files_of_scene(const std::string& scene) {
  std::vector<std::string> files{scene};
  std::error_code ignored;
  if (!fs::is_regular_file(scene, ignored)) return files;
  std::ifstream in(scene);
  const Json json = Json::parse(in, nullptr, false, true);
  // No recursion: a text may nest deeper than the stack.
  std::vector<const Json*> left{&json};
  while (!left.empty()) {
    const Json& part = *left.back();
    left.pop_back();
    if (part.is_string())
      files.push_back((fs::path(scene).parent_path() / part.get<std::string>()).string());
    if (part.is_structured())
      for (const Json& inner : part) left.push_back(&inner);
  }
  return files;
}

namespace {

/// What a picture of `script` is made from besides it, as far as it is named.
std::vector<std::string> named_files(const RenderRequest& request, const RenderScript& script) {
  std::vector<std::string> all = files_of_scene(request.scene);
  all.insert(all.end(), script.linked->dependencies.begin(), script.linked->dependencies.end());
  all.push_back(request.environment);
  return all;
}

}  // namespace

std::vector<std::string> inputs_of(const RenderRequest& request, const RenderScript& script) {
  std::vector<std::string> all = named_files(request, script);
  all.insert(all.end(), request.files.begin(), request.files.end());
  return all;
}

Exit exit_of(const Error& error) {
  switch (error.cause) {
    case Error::Cause::File:
      return Exit::File;
    case Error::Cause::Name:
      return Exit::Usage;
    case Error::Cause::Budget:
      return Exit::Budget;
    case Error::Cause::Content:
      break;
  }
  return Exit::Script;
}

std::optional<RenderJob> set_scene(const RenderRequest& request, const RenderScript& script,
                                   Exit& exit) {
  const renderer::SceneSource source{request.scene, script.surface, request.volume, request.turn,
                                     request.environment};
  auto scene = renderer::load_scene(script.linked->program, source);
  if (!scene) {
    exit = fail(exit_of(scene.error()), scene.error(), request);
    return {};
  }
  const bool tested = !scene->surface().empty() || !scene->volume().empty();
  const char* const asked = !request.surface.empty()  ? "--surface"
                            : !request.volume.empty() ? "--volume"
                            : request.frames > 0      ? "--turntable"
                                                      : nullptr;
  if (!tested && asked) {
    exit = fail(Exit::Usage,
                {asked, fmt::format("is for the object under test, and {} has none", request.scene),
                 "mark one in it: \"test\": true"},
                request);
    return {};
  }
  return RenderJob{script, std::move(*scene)};
}

std::optional<RenderJob> prepare(const RenderRequest& request, const std::string& file,
                                 Exit& exit) {
  const auto script = compile_script(request, file, exit);
  return script ? set_scene(request, *script, exit) : std::nullopt;
}

renderer::RenderOptions render_options(const RenderRequest& request) {
  renderer::RenderOptions options;
  options.width = request.width;
  options.height = request.height;
  options.first_sample = request.first_sample;
  options.samples = request.end_sample;
  options.seconds = request.seconds;
  options.error = request.error_limit;
  options.filter = *renderer::filter_named(request.filter);
  options.estimator = *renderer::estimator_named(request.estimator);
  options.generator = *renderer::generator_named(request.sampler);
  options.threads = request.thread_count;
  options.seed = request.seed_number;
  options.max_depth = request.depth;
  options.stop = &stop;
  return options;
}

void print_report(const RenderRequest& request, const RenderScript& linked,
                  const std::string& script, const std::string& path, const renderer::Report& r) {
  Json json = to_json(script, path, r);
  std::set<std::string> files{script};
  for (const std::string& name : named_files(request, linked))
    if (std::error_code ignored; fs::is_regular_file(name, ignored)) files.insert(name);
  json["files"] = files;
  if (request.json()) {
    fmt::print("{}\n", json.dump());
  } else if (!request.quiet) {
    const std::string more = r.mean_samples > r.samples
                                 ? fmt::format(" or more, {:.1f} on average", r.mean_samples)
                                 : "";
    fmt::print("{}: {} per pixel{}, {:.2f} s, estimated error {}\n", path,
               counted(r.samples, "sample"), more, r.seconds,
               error_text(std::uint32_t(r.samples), r.rmse));
    if (request.report)
      for (const auto& [name, value] : json.items())
        if (value.is_number()) fmt::print("  {:<18}{}\n", name, value.dump());
  }
  std::fflush(stdout);
  warn_of_samples(script, r);
  for (const renderer::NotFinite& n : r.not_finite)
    fmt::print(stderr,
               "warning: {0}: `{1}` of `{2}` was not finite there\n  = help: to see every value on "
               "the way of an expression of it: mms eval --trace -f {0}{3}{4} 'EXPRESSION'\n",
               script, n.output, n.descriptor, n.settings.empty() ? "" : " ", n.settings);
  if (r.denser_samples > 0)
    fmt::print(stderr,
               "warning: {}: volume denser than its bound: {} of {}; it was taken to be as "
               "dense as the bound there\n",
               script, r.denser_samples, counted(r.medium_samples, "sample"));
  for (const renderer::GainCount& g : r.gains)
    fmt::print(stderr,
               "warning: {}: the weights of `{}`'s material add up to more than 1 at {} of {}, to "
               "{:.4g} at most: more light leaves it there than comes\n  = help: lower one, or use "
               "`mix(a, b, t)`, which shares\n",
               g.where, g.descriptor, g.points, counted(g.of, "point"), g.most);
  for (const renderer::FaultCount& f : r.faults)
    fmt::print(stderr, "warning: {}: {} at {}: the output's default was taken there\n", f.where,
               f.cause, counted(f.lanes, "point"));
}

}  // namespace mms::tools
