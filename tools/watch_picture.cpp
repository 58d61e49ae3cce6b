// SPDX-License-Identifier: Apache-2.0
#include "tools/watch.h"

#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "renderer/film_file.h"
#include "renderer/picture.h"
#include "tools/output.h"
#include "tools/overwrite.h"
#include "tools/render_job.h"

namespace mms::tools {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// How often files are looked at: soon enough to feel immediate, at no cost that could be measured.
constexpr std::chrono::milliseconds kGlance{20};

/// The first picture has a sixteenth of the pixels.
constexpr int kCoarse = 4;

/// Between two pictures that refine.
constexpr double kRefineSeconds = 0.4;

/// What tells that a file is another one: replaced, written to, made or removed.
struct Stamp {
  std::int64_t seconds = 0, nanoseconds = 0, size = -1;
  std::uint64_t node = 0;
  bool operator==(const Stamp&) const = default;
};

/// Of what is no file, as of none: a folder changes whenever a picture is written to it.
Stamp stamp(const std::string& path) {
  struct stat s {};
  if (::stat(path.c_str(), &s) != 0 || !S_ISREG(s.st_mode)) return {};
  return {s.st_mtim.tv_sec, s.st_mtim.tv_nsec, s.st_size, s.st_ino};
}

constexpr std::string_view kUdim = "<UDIM>";

/// How many files there are that `pattern` may mean.
int tiles_of(const std::string& pattern) {
  const fs::path path(pattern);
  const std::string name = path.filename().string();
  const std::size_t at = name.find(kUdim);
  if (at == name.npos) return 0;
  int count = 0;
  std::error_code ignored;
  for (const auto& entry :
       fs::directory_iterator(path.has_parent_path() ? path.parent_path() : ".", ignored)) {
    const std::string file = entry.path().filename().string();
    count += file.starts_with(name.substr(0, at)) && file.ends_with(name.substr(at + kUdim.size()));
  }
  return count;
}

/// Files as they were when they were added, and those that were not there.
class WatchedFiles {
 public:
  void add(const std::string& path) {
    if (path.find(kUdim) == path.npos)
      files_.emplace(path, stamp(path));
    else
      tiles_.emplace(path, tiles_of(path));
  }

  bool changed() const {
    return std::any_of(files_.begin(), files_.end(),
                       [](const auto& f) { return stamp(f.first) != f.second; }) ||
           std::any_of(tiles_.begin(), tiles_.end(),
                       [](const auto& t) { return tiles_of(t.first) != t.second; });
  }

 private:
  std::map<std::string, Stamp> files_;
  std::map<std::string, int> tiles_;
};

/// Each pixel of a coarse picture as a square of the whole one.
renderer::Film enlarged(const renderer::Film& coarse, int width, int height) {
  renderer::Film film{width, height, {}, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int row = std::min(y / kCoarse, coarse.height - 1);
      const int column = std::min(x / kCoarse, coarse.width - 1);
      const std::size_t i = std::size_t(row) * std::size_t(coarse.width) + std::size_t(column);
      film.xyz.push_back(coarse.xyz[i]);
      film.variance.push_back(coarse.variance[i]);
    }
  return film;
}

/// One version of the files, from the coarse picture to the last.
class Version {
 public:
  Version(const RenderRequest& request, const RenderJob& job, const std::string& file,
          const std::string& path, const std::atomic<bool>& stop)
      : request_(request), job_(job), file_(file), path_(path), options_(render_options(request)) {
    options_.stop = &stop;
  }

  void render(Clock::time_point asked) {
    if (!begin()) return;
    print_first(std::chrono::duration<double>(Clock::now() - asked).count());
    options_.save = [this](const renderer::PartialFilm& film) { refine(film); };
    options_.save_seconds = kRefineSeconds;
    options_.layers = path_.ends_with(".exr");
    const auto r = renderer::render(job_.linked->program, job_.scene, options_);
    if (!r) {
      fail(exit_of(r.error()), r.error(), request_);
      return;
    }
    if (r->report.stopped && !interrupted()) return;  // another version is there
    const renderer::FilmKey key = renderer::film_key(job_.scene, options_, job_.hash);
    write({r->film, r->layers.get(), metadata(path_, key, *r->sums)});
    print_report(request_, job_, file_, path_, r->report);
  }

 private:
  bool begin() {
    renderer::RenderOptions coarse = options_;
    coarse.width = std::max(1, options_.width / kCoarse);
    coarse.height = std::max(1, options_.height / kCoarse);
    coarse.first_sample = 0;
    coarse.samples = 1;
    coarse.filter = renderer::FilterShape::Box;
    const auto r = renderer::render(job_.linked->program, job_.scene, coarse);
    if (!r) {
      fail(exit_of(r.error()), r.error(), request_);
      return false;
    }
    first_ = enlarged(r->film, options_.width, options_.height);
    return write({first_});
  }

  /// What is there; where nothing is yet, the coarse picture.
  void refine(const renderer::PartialFilm& sums) {
    renderer::Film film = sums.develop();
    for (std::size_t i = 0; i < film.xyz.size(); ++i)
      if (film.samples[i] == 0) film.xyz[i] = first_.xyz[i];
    write({film});
  }

  bool write(const renderer::Picture& picture) {
    const auto written = renderer::write_picture(path_, picture, view_of(request_));
    if (!written) fail(Exit::File, written.error(), request_);
    return bool(written);
  }

  void print_first(double seconds) const {
    if (request_.json())
      fmt::print("{}\n",
                 nlohmann::ordered_json{
                     {"script", file_}, {"picture", path_}, {"first_picture_seconds", seconds}}
                     .dump());
    else if (!request_.quiet)
      fmt::print("{}: first picture after {:.3f} s\n", path_, seconds);
    std::fflush(stdout);
  }

  const RenderRequest& request_;
  const RenderJob& job_;
  const std::string &file_, &path_;
  renderer::RenderOptions options_;
  renderer::Film first_;
};

}  // namespace

Exit watch(RenderRequest request, const std::string& file, const std::string& path) {
  Clock::time_point asked = Clock::now();
  while (!interrupted()) {
    // Each is added before it is read: what changes after that is seen.
    WatchedFiles files;
    files.add(file);
    for (const std::string& name : files_of_scene(request.scene)) files.add(name);
    files.add(request.environment);
    request.looked_for = [&](const std::string& name) { files.add(name); };
    Exit exit = Exit::Ok;
    const auto job = prepare(request, file, exit);
    std::fflush(stdout);  // messages as JSON
    if (job)
      if (const auto error = overwrites(path, inputs_of(request, *job)))
        return fail(Exit::Usage, *error, request);
    if (job)
      for (const std::string& name : job->linked->dependencies) files.add(name);
    std::atomic<bool> stop{false};
    const std::jthread glances([&] {
      while (!interrupted() && !files.changed()) std::this_thread::sleep_for(kGlance);
      stop = true;
      stop.notify_all();
    });
    if (job) Version(request, *job, file, path, stop).render(asked);
    stop.wait(false);
    asked = Clock::now();
    // Let an editor finish what it writes.
    std::this_thread::sleep_for(kGlance);
  }
  return Exit::Interrupted;
}

}  // namespace mms::tools
