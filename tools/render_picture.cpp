// SPDX-License-Identifier: Apache-2.0
// mms render: from scripts to pictures.
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "renderer/film_file.h"
#include "renderer/picture.h"
#include "renderer/samples.h"
#include "tools/output.h"
#include "tools/overwrite.h"
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
    fmt::print(stderr, "\r{}: {:3.0f}% {}{}, {:.0f} s, {:.0f} s left\x1b[K", name_,
               100 * p.fraction, counted(p.samples, "sample"), error, p.seconds, p.seconds_left);
    std::fflush(stderr);
  }

 private:
  bool shown_;
  std::string name_;
};

/// How a finished render ends: stopped by hand, given up for its faults, or well.
Exit verdict(const RenderRequest& request, const std::string& path, const renderer::Report& r,
             bool resumable) {
  if (r.too_many_faults)
    return fail(Exit::Budget,
                {r.faults.empty() ? path : r.faults[0].where,
                 fmt::format("too many points ran out of budget ({}); what was there is in {}",
                             r.fault_lanes, path),
                 "check the condition that ends the recursion on this line"},
                request);
  if (!r.stopped) return Exit::Ok;
  fmt::print(stderr, "stopped: {} holds what was there, {} per pixel{}\n", path,
             counted(r.samples, "sample"), resumable ? "; --resume goes on" : "");
  return Exit::Interrupted;
}

/// Where the exact sums of a render to `path` are kept while it goes on.
std::string checkpoint_path(const std::string& path) {
  return path.ends_with(renderer::kFilmExtension) ? path
                                                  : path + std::string(renderer::kFilmExtension);
}

/// What an earlier render left, or nothing where there is none. Errors: damaged, of another
/// picture, or with samples from number `end` on, which no picture of the samples before it has.
Result<std::shared_ptr<const renderer::PartialFilm>> earlier(const std::string& checkpoint,
                                                             const renderer::FilmKey& key,
                                                             std::uint32_t end) {
  std::shared_ptr<const renderer::PartialFilm> none;
  std::error_code ignored;
  if (!fs::exists(checkpoint, ignored)) return none;
  auto stored = renderer::load_film(checkpoint);
  if (!stored) return stored.error();
  if (const std::string other = renderer::difference(stored->key, key); !other.empty())
    return Error{checkpoint, "is of another picture: " + other,
                 "give the options it was made with, or leave --resume out"};
  std::uint32_t last = 0;
  for (const renderer::SampleSet& tile : stored->film.done)
    if (!tile.ranges().empty()) last = std::max(last, tile.ranges().back().second);
  if (last > end)
    return Error{checkpoint,
                 fmt::format("has samples up to {} already, more than --samples {}", last, end),
                 fmt::format("go on to --samples {}, or take what is there: mms merge {} -o PATH",
                             last, quoted(checkpoint))};
  return std::make_shared<const renderer::PartialFilm>(std::move(stored->film));
}

/// Keeps the sums of a render, and says once if that cannot be done.
class Checkpoint {
 public:
  /// `below`: under a progress line.
  Checkpoint(std::string path, const renderer::FilmKey& key, bool below)
      : path_(std::move(path)), key_(key), below_(below) {}
  void save(const renderer::PartialFilm& film) {
    const auto saved = renderer::save_film(path_, key_, film);
    if (!saved && !std::exchange(failed_, true))
      fmt::print(stderr, "{}warning: {}: {}; rendering goes on\n", below_ ? "\n" : "",
                 saved.error().where, saved.error().what);
  }
  /// The same once rendering has ended.
  void save_last(const renderer::PartialFilm& film) {
    const auto saved = renderer::save_film(path_, key_, film);
    if (saved) return;
    last_failed_ = true;
    fmt::print(stderr, "warning: {}: {}; --resume will lack the last samples\n",
               saved.error().where, saved.error().what);
  }
  /// Whether `--resume` goes on with all that was rendered.
  bool holds_all() const { return !last_failed_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  renderer::FilmKey key_;
  bool below_, failed_ = false, last_failed_ = false;
};

/// Writes what was asked for, and leaves a checkpoint behind where work would be lost without.
Result<renderer::Done> write_result(const RenderRequest& request, const std::string& path,
                                    Checkpoint& checkpoint, const renderer::FilmKey& key,
                                    const renderer::Rendered& r) {
  if (path == checkpoint.path()) return renderer::save_film(path, key, *r.sums, r.layers.get());
  if (r.report.stopped) checkpoint.save_last(*r.sums);
  const auto written = renderer::write_picture(
      path, {r.film, r.layers.get(), metadata(path, key, *r.sums)}, view_of(request));
  if (!written && !r.report.stopped) checkpoint.save_last(*r.sums);
  std::error_code ignored;
  if (written && !r.report.stopped) fs::remove(checkpoint.path(), ignored);
  return written;
}

/// Who forgot the light sees nothing, which says nothing.
void note_if_black(const std::string& path, const renderer::Film& film) {
  const std::array<double, 3> black{};
  if (std::all_of(film.xyz.begin(), film.xyz.end(), [&](const auto& c) { return c == black; }))
    fmt::print(stderr,
               "note: {} is black: no light gets to what the camera sees; a scene has an "
               "`environment` or an `emission`\n",
               path);
}

Exit render_one(const RenderRequest& request, const RenderScript& script, const std::string& file,
                const std::string& path) {
  if (const auto error = overwrites(path, inputs_of(request, script)))
    return fail(Exit::Usage, *error, request);
  Exit exit = Exit::Ok;
  const auto job = set_scene(request, script, exit);
  if (!job) return exit;
  renderer::RenderOptions options = render_options(request);
  const renderer::FilmKey key = renderer::film_key(job->scene, options, job->hash);
  options.layers = path.ends_with(".exr") || path.ends_with(renderer::kFilmExtension);
  const bool progress = !request.quiet && isatty(STDERR_FILENO);
  Checkpoint checkpoint(checkpoint_path(path), key, progress);
  if (request.resume) {
    const auto found = earlier(checkpoint.path(), key, std::uint32_t(options.samples));
    if (!found) return fail(Exit::File, found.error(), request);
    options.begin_with = *found;
  }
  if (request.checkpoint_seconds > 0) {
    options.save = [&](const renderer::PartialFilm& film) { checkpoint.save(film); };
    options.save_seconds = request.checkpoint_seconds;
  }
  auto rendered = [&] {
    const ProgressLine line(progress, path);
    if (progress) options.progress = [&line](const renderer::Progress& p) { line.show(p); };
    return renderer::render(job->linked->program, job->scene, options);
  }();
  if (!rendered) return fail(exit_of(rendered.error()), rendered.error(), request);
  const auto written = write_result(request, path, checkpoint, key, *rendered);
  if (!written) return fail(Exit::File, written.error(), request);
  print_report(request, script, file, path, rendered->report);
  if (!request.quiet) note_if_black(path, rendered->film);
  return verdict(request, path, rendered->report, checkpoint.holds_all());
}

/// One turn of the test object: `NAME.000.png` and so on.
Exit render_turn(RenderRequest request, const RenderScript& script, const std::string& file,
                 const std::string& path) {
  const fs::path name(path);
  Exit worst = Exit::Ok;
  for (int i = 0; i < request.frames; ++i) {
    if (interrupted()) return Exit::Interrupted;
    request.turn = 2 * std::numbers::pi * i / request.frames;
    fs::path frame = name;
    frame.replace_extension(fmt::format("{:03}{}", i, name.extension().string()));
    worst = std::max(worst, render_one(request, script, file, frame.string()));
  }
  return worst;
}

/// Sheets and pictures that follow their files keep no sums.
std::optional<Error> check_checkpoint(const RenderRequest& request) {
  const bool sheet = wants_sheet(request);
  const bool checkpoint = !request.checkpoint.empty() && request.checkpoint_seconds > 0;
  if (!(sheet || request.watch) || !(request.resume || checkpoint)) return std::nullopt;
  return Error{
      request.resume ? "--resume" : "--checkpoint",
      sheet ? "a sheet keeps nothing to go on from" : "--watch keeps nothing to go on from",
      sheet ? "render its pictures one by one, scripts to a folder: -o out/" : "leave it out"};
}

/// Two scripts whose pictures would be one file.
std::optional<Error> check_distinct(const RenderRequest& request,
                                    const std::vector<std::string>& paths) {
  std::map<std::string, std::string> script_of;
  for (std::size_t i = 0; i < paths.size(); ++i)
    if (const auto [first, added] = script_of.emplace(paths[i], request.files[i]); !added)
      return Error{"-o",
                   fmt::format("the pictures of {} and {} would both be {}", first->second,
                               request.files[i], paths[i]),
                   "render one of them by itself, or all to one sheet: -o sheet.png"};
  return std::nullopt;
}

/// `-o DIR/` is made where it is not there.
std::optional<Error> make_folder(const std::string& output) {
  std::error_code error;
  if (output.ends_with('/')) fs::create_directories(output, error);
  if (!error) return std::nullopt;
  return Error{output, "the folder cannot be made: " + error.message(), "name another with -o"};
}

}  // namespace

Exit render_pictures(const RenderRequest& request) {
  if (const auto error = check_checkpoint(request)) return fail(Exit::Usage, *error, request);
  if (wants_sheet(request)) {
    if (const auto error = make_folder(request.output)) return fail(Exit::File, *error, request);
    catch_interrupts();
    return render_sheet(request);
  }
  std::vector<std::string> paths;
  for (const std::string& file : request.files) {
    const auto path = picture_path(request, file);
    if (!path) return fail(Exit::Usage, path.error(), request);
    paths.push_back(*path);
  }
  if (const auto error = check_distinct(request, paths)) return fail(Exit::Usage, *error, request);
  if (const auto error = make_folder(request.output)) return fail(Exit::File, *error, request);
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
    if (interrupted()) return Exit::Interrupted;
    Exit exit = Exit::Ok;
    if (const auto script = compile_script(request, request.files[i], exit))
      exit = request.frames > 0 ? render_turn(request, *script, request.files[i], paths[i])
                                : render_one(request, *script, request.files[i], paths[i]);
    worst = std::max(worst, exit);
  }
  return worst;
}

}  // namespace mms::tools
