// SPDX-License-Identifier: Apache-2.0
// Spreads a picture over threads and adds up what they find.
#include "renderer/render.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>

#include <fmt/format.h>

#include "renderer/film.h"
#include "renderer/integrator.h"
#include "renderer/prepare.h"

namespace mms::renderer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTile = 16;           // pixels along an edge
constexpr int kSamplesOfChunk = 8;  // so a chunk has 2048 paths
constexpr int kLargestSide = 32768;

/// A tile of the picture and a range of samples: what a thread takes at a time.
struct Chunk {
  int x0, y0, x1, y1, tile;
  int sample0, sample1;
};

class Job {
 public:
  Job(const World& world, const RenderOptions& options)
      : world_(world), options_(options), film_(options.width, options.height) {
    tiles_x_ = (options.width + kTile - 1) / kTile;
    tiles_ = tiles_x_ * ((options.height + kTile - 1) / kTile);
    passes_ = (options.samples + kSamplesOfChunk - 1) / kSamplesOfChunk;
    tile_locks_ = std::vector<std::mutex>(tiles_);
  }

  Rendered run() {
    const Clock::time_point begin = Clock::now();
    const int machine = int(std::max(1u, std::thread::hardware_concurrency()));
    const int wanted = options_.threads > 0 ? options_.threads : machine;
    const int threads = int(std::min<std::int64_t>(wanted, std::int64_t(tiles_) * passes_));
    {
      std::vector<std::jthread> workers;
      running_ = threads;
      for (int i = 0; i < threads; ++i) workers.emplace_back([this] { work(); });
      watch(begin);
    }
    report_.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    report_.threads = threads;
    finish();
    return {film_.develop(), std::move(report_)};
  }

 private:
  bool ended() const {
    return too_many_faults_ || (options_.stop && options_.stop->load(std::memory_order_relaxed));
  }

  Chunk chunk(std::int64_t number) const {
    const int pass = int(number / tiles_), tile = int(number % tiles_);
    const int x = tile % tiles_x_ * kTile, y = tile / tiles_x_ * kTile;
    return {x,
            y,
            std::min(x + kTile, options_.width),
            std::min(y + kTile, options_.height),
            tile,
            pass * kSamplesOfChunk,
            std::min((pass + 1) * kSamplesOfChunk, options_.samples)};
  }

  /// One thread: takes chunks until there are none.
  void work() {
    Integrator integrator(world_);
    std::vector<PixelSample> samples;
    std::vector<std::array<double, 3>> values;
    std::uint64_t faults = 0;
    while (!ended()) {
      const std::int64_t number = next_chunk_.fetch_add(1);
      if (number >= std::int64_t(tiles_) * passes_) break;
      const Chunk c = chunk(number);
      samples.clear();
      for (int y = c.y0; y < c.y1; ++y)
        for (int x = c.x0; x < c.x1; ++x)
          for (int s = c.sample0; s < c.sample1; ++s) samples.push_back({x, y, s});
      values.resize(samples.size());
      integrator.trace(samples, values);
      add(c.tile, samples, values);
      paths_done_ += samples.size();
      const std::uint64_t all = integrator.scripts().fault_lanes();
      if ((fault_lanes_ += all - faults) > kMaxFaultLanes) too_many_faults_ = true;
      faults = all;
    }
    const std::scoped_lock lock(report_lock_);
    account(integrator);
    --running_;
    finished_.notify_all();
  }

  void add(int tile, const std::vector<PixelSample>& samples,
           const std::vector<std::array<double, 3>>& values) {
    const std::scoped_lock lock(tile_locks_[tile]);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const PixelSample& s = samples[i];
      const SampleFate fate = add_sample(film_.pixel(s.x, s.y), values[i]);
      if (fate != SampleFate::Added) drop(s, fate);
    }
  }

  void drop(const PixelSample& s, SampleFate fate) {
    const std::scoped_lock lock(report_lock_);
    Dropped& d = report_.dropped;
    ++(fate == SampleFate::NotANumber ? d.nan
       : fate == SampleFate::Infinite ? d.infinite
                                      : d.overflow);
    const auto before = std::tuple(d.first_y, d.first_x, d.first_sample);
    if (d.first_x < 0 || std::tuple(s.y, s.x, s.sample) < before)
      d.first_x = s.x, d.first_y = s.y, d.first_sample = s.sample;
  }

  /// Reports progress until all threads are done.
  void watch(Clock::time_point begin) {
    std::unique_lock lock(report_lock_);
    for (bool done = false; !done;) {
      done = finished_.wait_for(lock, std::chrono::milliseconds(100),
                                [this] { return running_ == 0; });
      if (!options_.progress) continue;
      const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
      const double total = double(options_.width) * options_.height * options_.samples;
      const double fraction = double(paths_done_.load()) / total;
      lock.unlock();
      options_.progress({fraction, int(fraction * options_.samples), seconds,
                         fraction > 0 ? seconds * (1 - fraction) / fraction : 0});
      lock.lock();
    }
  }

  void account(const Integrator& integrator) {
    const ScriptCounters& s = integrator.scripts().counters();
    const FlightCounters& f = integrator.counters();
    report_.script_runs += s.runs;
    report_.script_points += s.points;
    report_.pass_runs += s.pass_runs;
    report_.emission_runs += s.emission_runs;
    report_.medium_runs += s.medium_runs;
    report_.media_steps += f.media_steps;
    report_.medium_samples += f.medium_samples;
    report_.denser_samples += f.denser_samples;
    report_.rays += f.rays;
    report_.shadow_rays += f.shadow_rays;
    for (const auto& [where, lanes] : integrator.scripts().faults()) faults_[where] += lanes;
  }

  void finish() {
    report_.paths = paths_done_;
    report_.fault_lanes = fault_lanes_;
    report_.too_many_faults = too_many_faults_;
    report_.stopped = options_.stop && options_.stop->load();
    if (report_.script_runs > 0)
      report_.batch_fill =
          double(report_.script_points) / double(report_.script_runs) / world_.compiled.width();
    report_.samples = options_.samples;
    for (int y = 0; y < options_.height; ++y)
      for (int x = 0; x < options_.width; ++x)
        report_.samples = std::min(report_.samples, int(film_.pixel(x, y).samples));
    if (report_.samples == options_.samples) report_.stopped = false;
    const Film film = film_.develop();
    double sum = 0;
    for (double v : film.variance) sum += v;
    report_.rmse = std::sqrt(sum / double(film.variance.size()));
    for (const auto& [where, lanes] : faults_)
      report_.faults.push_back({place(world_.compiled.program(), where.source, where.line),
                                cause_text(where.cause), lanes});
    std::stable_sort(report_.faults.begin(), report_.faults.end(),
                     [](const FaultCount& a, const FaultCount& b) { return a.lanes > b.lanes; });
  }

  const World& world_;
  const RenderOptions& options_;
  FilmSums film_;
  int tiles_x_ = 0, tiles_ = 0, passes_ = 0;
  std::vector<std::mutex> tile_locks_;
  std::atomic<std::int64_t> next_chunk_{0};
  std::atomic<std::uint64_t> paths_done_{0}, fault_lanes_{0};
  std::atomic<bool> too_many_faults_{false};
  std::mutex report_lock_;
  std::condition_variable finished_;
  int running_ = 0;
  Report report_;
  std::map<Scripts::FaultPlace, std::uint64_t> faults_;
};

std::optional<Error> check(const RenderOptions& o) {
  if (o.width < 1 || o.width > kLargestSide || o.height < 1 || o.height > kLargestSide)
    return Error{"size", fmt::format("a picture of {} x {} pixels", o.width, o.height),
                 fmt::format("each side must be in [1, {}]", kLargestSide)};
  if (o.samples < 1)
    return Error{"samples", fmt::format("{} samples a pixel", o.samples), "at least 1"};
  if (o.max_depth < 1)
    return Error{"depth", fmt::format("paths of {} scattering events", o.max_depth), "at least 1"};
  if (o.threads < 0) return Error{"threads", fmt::format("{} threads", o.threads), "0 means all"};
  return {};
}

}  // namespace

Result<Rendered> render(const vm::Program& program, const Scene& scene,
                        const RenderOptions& options) {
  if (const std::optional<Error> e = check(options)) return *e;
  const SceneData& data = scene.data();
  const Compiled compiled(program);
  Result<Findings> findings = probe(data, compiled);
  if (!findings) return findings.error();

  std::vector<bool> collected;
  bool plain = true;
  for (const Object& o : data.objects) {
    collected.push_back(semi_transparent(data, compiled, o));
    plain &= !collected.back() && o.volume < 0;
  }
  const Accel accel(data, collected);
  const Lights lights(data, findings->radiance);
  World world{data,
              compiled,
              accel,
              lights,
              CameraRays(data.camera, options.width, options.height),
              {},
              {},
              plain,
              options.seed,
              options.max_depth,
              std::move(findings->majorants)};
  for (int i = 0; i < int(data.objects.size()); ++i)
    world.sealed.push_back(sealed(data, compiled, i));
  for (int i = 0; i < int(data.objects.size()); ++i)
    if (data.objects[i].volume >= 0 && contains(data.objects[i].shape, data.camera.position))
      world.camera_media.enter(i);
  return Job(world, options).run();
}

}  // namespace mms::renderer
