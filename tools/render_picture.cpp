// SPDX-License-Identifier: Apache-2.0
// mms render: from scripts to pictures.
#include <unistd.h>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "renderer/film_file.h"
#include "renderer/picture.h"
#include "tools/output.h"
#include "tools/render.h"
#include "tools/render_job.h"
#include "tools/sheet.h"
#include "tools/watch.h"

namespace mms::tools {

namespace {

namespace fs = std::filesystem;

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

/// Where the exact sums of a render to `path` are kept while it goes on.
std::string checkpoint_path(const std::string& path) {
  return path.ends_with(renderer::kFilmExtension) ? path
                                                  : path + std::string(renderer::kFilmExtension);
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
  if (path == checkpoint.path()) return renderer::save_film(path, key, *r.sums, r.layers.get());
  if (r.report.stopped) checkpoint.save(*r.sums);
  const auto written = renderer::write_picture(
      path, {r.film, r.layers.get(), metadata(path, key, *r.sums)}, view_of(request));
  if (!written && !r.report.stopped) checkpoint.save(*r.sums);
  std::error_code ignored;
  if (written && !r.report.stopped) fs::remove(checkpoint.path(), ignored);
  return written;
}

Exit render_one(RenderRequest request, const std::string& file, const std::string& path) {
  Exit exit = Exit::Ok;
  const auto job = prepare(request, file, exit);
  if (!job) return exit;
  renderer::RenderOptions options = render_options(request);
  const renderer::FilmKey key = renderer::film_key(job->scene, options, job->script);
  options.layers = path.ends_with(".exr") || path.ends_with(renderer::kFilmExtension);
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
    return renderer::render(job->linked->program, job->scene, options);
  }();
  if (!rendered) return fail(Exit::Budget, rendered.error(), request);
  const auto written = write_result(request, path, checkpoint, key, *rendered);
  if (!written) return fail(Exit::File, written.error(), request);
  print_report(request, file, path, rendered->report);
  return verdict(request, path, rendered->report);
}

/// One turn of the test object: `NAME.000.png` and so on.
Exit render_turn(RenderRequest request, const std::string& file, const std::string& path) {
  const fs::path name(path);
  Exit worst = Exit::Ok;
  for (int i = 0; i < request.frames && !interrupted(); ++i) {
    request.turn = 2 * std::numbers::pi * i / request.frames;
    fs::path frame = name;
    frame.replace_extension(fmt::format("{:03}{}", i, name.extension().string()));
    worst = std::max(worst, render_one(request, file, frame.string()));
  }
  return worst;
}

}  // namespace

Exit render_pictures(const RenderRequest& request) {
  if (wants_sheet(request)) {
    catch_interrupts();
    return render_sheet(request);
  }
  std::vector<std::string> paths;
  for (const std::string& file : request.files) {
    const auto path = picture_path(request, file);
    if (!path) return fail(Exit::Usage, path.error(), request);
    paths.push_back(*path);
  }
  if (const auto ok = check_output(paths, request); !ok)
    return fail(Exit::File, ok.error(), request);
  catch_interrupts();
  if (request.watch) {
    if (paths.size() == 1 && request.files[0] != "-" &&
        !paths[0].ends_with(renderer::kFilmExtension))
      return watch(request, request.files[0], paths[0]);
    return fail(Exit::Usage,
                {"--watch", "follows one script file, to one picture",
                 "as in mms render marble.mms --watch -o marble.png"},
                request);
  }
  Exit worst = Exit::Ok;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto render = request.frames > 0 ? render_turn : render_one;
    worst = std::max(worst, render(request, request.files[i], paths[i]));
    if (interrupted()) break;
  }
  return worst;
}

}  // namespace mms::tools
