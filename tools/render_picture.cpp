// SPDX-License-Identifier: Apache-2.0
// mms render: from scripts to pictures.
#include <unistd.h>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "api/library.h"
#include "base/hash.h"
#include "renderer/film_file.h"
#include "renderer/picture.h"
#include "tools/output.h"
#include "tools/render.h"
#include "vm/serialise.h"

namespace mms::tools {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The one global: a signal handler can reach nothing else.
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void on_interrupt(int signal) {
  interrupted = true;
  std::signal(signal, SIG_DFL);  // a second Ctrl-C ends at once
}

std::string stem(const std::string& file) {
  return file == "-" ? "stdin" : fs::path(file).stem().string();
}

/// Where the picture of `file` goes.
Result<std::string> picture_path(const RenderRequest& request, const std::string& file) {
  const std::string name = stem(file) + ".png";
  if (request.output.empty()) return name;
  std::error_code ignored;
  if (request.output.back() == '/' || fs::is_directory(request.output, ignored))
    return (fs::path(request.output) / name).string();
  if (request.files.size() > 1)
    return Error{"-o", fmt::format("one picture, but {} scripts", request.files.size()),
                 "name a folder: each script's picture goes there"};
  return request.output;
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
  if (names.size() > 1 && !request.quiet)
    fmt::print(stderr, "note: {}: {} surfaces; rendering `{}` (--surface takes another: {})\n",
               file, names.size(), names[0], fmt::join(names.begin() + 1, names.end(), ", "));
  return names[0];
}

/// A line on the terminal that is written over while rendering goes on.
class ProgressLine {
 public:
  ProgressLine(bool shown, std::string name) : shown_(shown), name_(std::move(name)) {}
  ~ProgressLine() {
    if (shown_) fmt::print(stderr, "\r\x1b[K");
  }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const renderer::Progress& p) const {
    if (!shown_) return;
    const std::string error = p.error > 0 ? fmt::format(", error {:.2g}", p.error) : "";
    fmt::print(stderr, "\r{}: {:3.0f}% {} samples{}, {:.0f} s, {:.0f} s left\x1b[K", name_,
               100 * p.fraction, p.samples, error, p.seconds, p.seconds_left);
    std::fflush(stderr);
  }

 private:
  bool shown_;
  std::string name_;
};

Json to_json(const std::string& script, const std::string& path, const renderer::Report& r) {
  Json faults = Json::array();
  for (const renderer::FaultCount& f : r.faults)
    faults.push_back({{"where", f.where}, {"cause", f.cause}, {"lanes", f.lanes}});
  return {{"script", script},
          {"picture", path},
          {"samples", r.samples},
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
          {"fault_lanes", r.fault_lanes},
          {"faults", faults},
          {"stopped", r.stopped}};
}

void print_report(const RenderRequest& request, const std::string& script, const std::string& path,
                  const renderer::Report& r) {
  const Json json = to_json(script, path, r);
  if (request.json()) {
    fmt::print("{}\n", json.dump());
  } else if (!request.quiet) {
    fmt::print("{}: {} samples per pixel, {:.2f} s, estimated error {:.2g}\n", path, r.samples,
               r.seconds, r.rmse);
    if (request.report)
      for (const auto& [name, value] : json.items())
        if (value.is_number()) fmt::print("  {:<18}{}\n", name, value.dump());
  }
  std::fflush(stdout);
  if (r.dropped.count() > 0)
    fmt::print(
        stderr,
        "warning: {}: {} samples were not finite and were left out; the first: pixel ({}, {}), "
        "sample {}\n",
        script, r.dropped.count(), r.dropped.first_x, r.dropped.first_y, r.dropped.first_sample);
  if (r.denser_samples > 0)
    fmt::print(stderr,
               "warning: {}: volume denser than its bound: {} of {} samples; it was taken to be as "
               "dense as the bound there\n",
               script, r.denser_samples, r.medium_samples);
  for (const renderer::FaultCount& f : r.faults)
    fmt::print(stderr, "warning: {}: {} at {} points: the output's default was taken there\n",
               f.where, f.cause, f.lanes);
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
  options.stop = &interrupted;
  return options;
}

/// How a finished render ends: stopped by hand, given up for its faults, or well.
Exit verdict(const RenderRequest& request, const std::string& path, const renderer::Report& r) {
  if (r.too_many_faults)
    return fail(Exit::Budget,
                {r.faults.empty() ? path : r.faults[0].where,
                 fmt::format("too many points ran out of budget ({}); what was there is in {}",
                             r.fault_lanes, path),
                 "check the condition that ends the recursion on this line"},
                request);
  if (!r.stopped) return Exit::Ok;
  fmt::print(stderr, "stopped: {} holds what was there, {} samples per pixel; --resume goes on\n",
             path, r.samples);
  return Exit::Interrupted;
}

/// What a scene that did not load means: no such file, no such built-in scene, or a wrong one.
Exit scene_exit(const std::string& name) {
  for (const std::string& known : renderer::builtin_scenes())
    if (name == known) return Exit::Script;
  std::error_code ignored;
  if (fs::exists(name, ignored)) return Exit::Script;
  return name.ends_with(".json") || name.find('/') != std::string::npos ? Exit::File : Exit::Usage;
}

/// Where the exact sums of a render to `path` are kept while it goes on.
std::string checkpoint_path(const std::string& path) {
  return path.ends_with(renderer::kFilmExtension) ? path
                                                  : path + std::string(renderer::kFilmExtension);
}

/// A number for the linked program, the same wherever its files are.
std::uint64_t script_hash(const vm::Program& program) {
  vm::Package package{program, {}, {}};
  for (std::string& name : package.program.sources) name.clear();
  const std::vector<std::byte> bytes = vm::save(package, api::standard_library().builtins);
  return hash_bytes({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// What an earlier render left, or nothing where there is none. Errors: damaged, or of another
/// picture.
Result<std::shared_ptr<const renderer::PartialFilm>> earlier(const std::string& checkpoint,
                                                             const renderer::FilmKey& key) {
  std::shared_ptr<const renderer::PartialFilm> none;
  std::error_code ignored;
  if (!fs::exists(checkpoint, ignored)) return none;
  auto stored = renderer::load_film(checkpoint);
  if (!stored) return stored.error();
  if (const std::string other = renderer::difference(stored->key, key); !other.empty())
    return Error{checkpoint, "is of another picture: " + other,
                 "give the options it was made with, or leave --resume out"};
  return std::make_shared<const renderer::PartialFilm>(std::move(stored->film));
}

/// Keeps the sums of a render, and says once if that cannot be done.
class Checkpoint {
 public:
  Checkpoint(std::string path, const renderer::FilmKey& key) : path_(std::move(path)), key_(key) {}
  void save(const renderer::PartialFilm& film) {
    const auto saved = renderer::save_film(path_, key_, film);
    if (!saved && !std::exchange(failed_, true))
      fmt::print(stderr, "\nwarning: {}: {}; rendering goes on\n", saved.error().where,
                 saved.error().what);
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  renderer::FilmKey key_;
  bool failed_ = false;
};

/// Writes what was asked for, and leaves a checkpoint behind where work would be lost without.
Result<renderer::Done> write_result(const RenderRequest& request, const std::string& path,
                                    Checkpoint& checkpoint, const renderer::FilmKey& key,
                                    const renderer::Rendered& r) {
  if (path == checkpoint.path()) return renderer::save_film(path, key, *r.sums);
  if (r.report.stopped) checkpoint.save(*r.sums);
  const auto written = renderer::write_picture(
      path, {r.film, r.layers.get(), metadata(path, key, *r.sums)}, view_of(request));
  if (!written && !r.report.stopped) checkpoint.save(*r.sums);
  std::error_code ignored;
  if (written && !r.report.stopped) fs::remove(checkpoint.path(), ignored);
  return written;
}

Exit render_one(const RenderRequest& request, const std::string& file, const std::string& path) {
  Exit exit = Exit::Ok;
  const auto linked = compile_files({file}, request, exit);
  if (!linked) return exit;
  if (linked->program.descriptors.empty())
    return fail(Exit::Script,
                {file, "nothing to render: no surface and no volume",
                 "add one: surface \"plain\" bsdf = matte(0.5); end"},
                request);
  const renderer::SceneSource source{request.scene, choose_surface(request, file, linked->program),
                                     request.volume};
  const auto scene = renderer::load_scene(linked->program, source);
  if (!scene) return fail(scene_exit(request.scene), scene.error(), request);

  renderer::RenderOptions options = render_options(request);
  const renderer::FilmKey key = renderer::film_key(*scene, options, script_hash(linked->program));
  options.layers = path.ends_with(".exr");
  Checkpoint checkpoint(checkpoint_path(path), key);
  if (request.resume) {
    const auto found = earlier(checkpoint.path(), key);
    if (!found) return fail(Exit::File, found.error(), request);
    options.begin_with = *found;
  }
  if (request.checkpoint_seconds > 0) {
    options.save = [&](const renderer::PartialFilm& film) { checkpoint.save(film); };
    options.save_seconds = request.checkpoint_seconds;
  }
  auto rendered = [&] {
    const ProgressLine line(!request.quiet && isatty(STDERR_FILENO), path);
    options.progress = [&line](const renderer::Progress& p) { line.show(p); };
    return renderer::render(linked->program, *scene, options);
  }();
  if (!rendered) return fail(Exit::Budget, rendered.error(), request);
  const auto written = write_result(request, path, checkpoint, key, *rendered);
  if (!written) return fail(Exit::File, written.error(), request);
  print_report(request, file, path, rendered->report);
  return verdict(request, path, rendered->report);
}

}  // namespace

Exit render_pictures(const RenderRequest& request) {
  std::vector<std::string> paths;
  for (const std::string& file : request.files) {
    const auto path = picture_path(request, file);
    if (!path) return fail(Exit::Usage, path.error(), request);
    paths.push_back(*path);
  }
  if (const auto ok = check_output(paths, request); !ok)
    return fail(Exit::File, ok.error(), request);
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);  // what batch systems send
  Exit worst = Exit::Ok;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Exit exit = render_one(request, request.files[i], paths[i]);
    if (exit > worst) worst = exit;
    if (interrupted) break;
  }
  return worst;
}

}  // namespace mms::tools
