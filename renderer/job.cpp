// SPDX-License-Identifier: Apache-2.0
#include "renderer/job.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <tuple>

#include "renderer/adaptive.h"
#include "renderer/error.h"
#include "renderer/prepare.h"

namespace mms::renderer {
namespace {

/// Between two estimates of the error for those who watch, at least; and what part of the time they
/// may take, as no thread adds samples meanwhile.
constexpr double kSecondsOfError = 1, kShareOfError = 0.01;

/// Samples that were dropped of which it is found out why.
constexpr std::size_t kExplained = 64;

/// Where scripts run many paths are worked on together, for full batches; but every thread
/// is to have some turns of a picture.
int chunks_at_once(std::int64_t tiles, int threads) {
  return int(std::clamp<std::int64_t>(tiles / (8 * threads), 1, 16));
}

}  // namespace

Job::Job(const World& world, const RenderOptions& options)
    : world_(world),
      options_(options),
      film_(options.begin_with
                ? std::make_shared<PartialFilm>(*options.begin_with)
                : std::make_shared<PartialFilm>(options.width, options.height, options.filter)) {
  next_pass_ = pass_of(std::uint32_t(options.first_sample));
  for (int t = 0; t < film_->tiles(); ++t) {
    SampleSet all = film_->done[t];
    all.add({std::uint32_t(options.first_sample), std::uint32_t(options.samples)});
    const std::uint64_t there = film_->done[t].count(), area = film_->tile(t).area();
    paths_before_ += there * area;
    paths_asked_ += (all.count() - there) * area;
  }
}

Rendered Job::run() {
  begin_ = Clock::now();
  next_error_at_ = kSecondsOfError;
  const int machine = int(std::max(1u, std::thread::hardware_concurrency()));
  const int wanted = options_.threads > 0 ? options_.threads : machine;
  const int passes = pass_of(std::uint32_t(options_.samples - 1)) + 1 - next_pass_;
  const int threads = int(std::min<std::int64_t>(wanted, std::int64_t(passes) * film_->tiles()));
  {
    std::vector<std::jthread> workers;
    running_ = threads_ = threads;
    for (int i = 0; i < threads; ++i) workers.emplace_back([this] { work(); });
    watch();
  }
  report_.seconds = seconds();
  report_.threads = threads_;
  return finish();
}

/// Time ends nothing before every tile has been handed out once: a picture has a sample everywhere.
bool Job::out_of_time() const {
  return options_.seconds > 0 && handed_out_ >= std::uint64_t(film_->tiles()) &&
         seconds() >= options_.seconds;
}

bool Job::ended() const {
  return too_many_faults_ || good_ || out_of_time() ||
         (options_.stop && options_.stop->load(std::memory_order_relaxed));
}

/// The next tiles and passes with samples that are missing, or nothing. Where a picture ends by its
/// error it waits at the end of a round.
std::vector<Job::Chunk> Job::next() {
  std::unique_lock lock(schedule_lock_);
  std::vector<Chunk> taken;
  while (taken.empty()) {
    if (ended()) return {};
    const int most = !world_.compiled.executable() ? 1 : chunks_at_once(film_->tiles(), threads_);
    while (next_chunk_ < round_.size() && int(taken.size()) < most) {
      taken.push_back(round_[next_chunk_++]);
      ++in_flight_;
      ++handed_out_;
    }
    if (!taken.empty()) break;
    if (options_.error > 0 && in_flight_ > 0)
      round_over_.wait(lock);
    else if (!begin_round())
      return {};
  }
  return taken;
}

void Job::done(int chunks) {
  const std::scoped_lock lock(schedule_lock_);
  in_flight_ -= chunks;
  if (in_flight_ == 0) round_over_.notify_all();
}

/// What is to be done next, if anything is. Where a picture ends by its error all samples that were
/// wanted are there, so neither the picture nor where it ends depends on the threads.
/// \pre schedule_lock_ is held
bool Job::begin_round() {
  round_.clear();
  next_chunk_ = 0;
  if (options_.error > 0)
    begin_wanted();
  else
    begin_pass();
  round_over_.notify_all();
  return !round_.empty();
}

/// One pass over all tiles.
void Job::begin_pass() {
  const SampleSet::Range pass = pass_range(next_pass_++);
  const std::uint32_t first = std::max(pass.first, std::uint32_t(options_.first_sample)),
                      last = std::min(pass.second, std::uint32_t(options_.samples));
  for (int t = 0; first < last && t < film_->tiles(); ++t) round_.push_back({t, {first, last}});
}

/// As many samples of each tile as the error is worth. What an earlier render was at comes first.
void Job::begin_wanted() {
  const std::scoped_lock lock(film_lock_);
  const auto begin = std::uint32_t(options_.first_sample), end = std::uint32_t(options_.samples);
  const auto hand_out = [&] {
    for (int t = 0; t < int(film_->wanted.size()); ++t) {
      const std::uint32_t last = std::min(film_->wanted[t], end);
      for (std::uint32_t first = film_->done[t].missing_from(begin); first < last;) {
        const std::uint32_t next = std::min(last, pass_range(pass_of(first)).second);
        round_.push_back({t, {first, next}});
        first = next;
      }
    }
    // All tiles have their first samples before one has its next.
    std::stable_sort(round_.begin(), round_.end(), [](const Chunk& a, const Chunk& b) {
      return a.samples.first < b.samples.first;
    });
  };
  hand_out();
  if (!round_.empty()) return;
  film_->wanted = next_samples(*film_, options_.error, begin, end);
  good_ = film_->wanted.empty() && ErrorEstimate(*film_).rmse() <= options_.error;
  hand_out();
}

bool Job::was_there(int tile, std::uint32_t sample) const {
  return options_.begin_with && options_.begin_with->done[std::size_t(tile)].has(sample);
}

/// One thread: takes chunks until there are none.
void Job::work() {
  Integrator integrator(world_);
  std::vector<PixelSample> wanted;
  std::vector<FilmSample> samples;
  std::vector<std::size_t> ends;  // of each chunk's samples
  FilmSums part(options_.width, options_.height, options_.filter, {});
  std::uint64_t faults = 0;
  for (std::vector<Chunk> chunks = next(); !chunks.empty(); chunks = next()) {
    wanted.clear();
    ends.clear();
    for (const Chunk& c : chunks) {
      const Rect tile = film_->tile(c.tile);
      for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
          for (std::uint32_t s = c.samples.first; s < c.samples.second; ++s)
            if (!was_there(c.tile, s)) wanted.push_back({x, y, int(s)});
      ends.push_back(wanted.size());
    }
    samples.resize(wanted.size());
    integrator.trace(wanted, samples);
    for (std::size_t i = 0, first = 0; i < chunks.size(); first = ends[i++]) {
      part.restart(film_->parts[std::size_t(chunks[i].tile)].rect());
      add(chunks[i], part, std::span(samples).subspan(first, ends[i] - first));
    }
    paths_done_ += samples.size();
    const std::uint64_t all = integrator.scripts().fault_lanes();
    if ((fault_lanes_ += all - faults) > kMaxFaultLanes) too_many_faults_ = true;
    faults = all;
    done(int(chunks.size()));
  }
  const std::scoped_lock lock(report_lock_);
  account(integrator);
  --running_;
  finished_.notify_all();
}

/// A chunk is in the film with all its samples or not at all.
void Job::add(const Chunk& chunk, FilmSums& part, std::span<const FilmSample> samples) {
  std::vector<std::pair<PixelSample, SampleFate>> dropped;
  std::uint64_t cut = 0;
  for (const FilmSample& s : samples) {
    const SampleFate fate = part.add(s);
    if (fate != SampleFate::Added)
      dropped.push_back({{int(s.x), int(s.y), int(s.number)}, fate});
    else
      cut += std::abs(s.xyz[1]) > kLargestForVariance;
  }
  const std::scoped_lock lock(film_lock_);
  report_.cut += cut;
  film_->parts[std::size_t(chunk.tile)].merge(part);
  film_->done[chunk.tile].add(chunk.samples);
  for (const auto& [sample, fate] : dropped) drop(sample, fate);
}

void Job::drop(const PixelSample& s, SampleFate fate) {
  Dropped& d = report_.dropped;
  ++(fate == SampleFate::NotANumber ? d.nan
     : fate == SampleFate::Infinite ? d.infinite
                                    : d.overflow);
  first_dropped_.insert({s.y, s.x, s.sample});
  if (first_dropped_.size() > kExplained) first_dropped_.erase(std::prev(first_dropped_.end()));
  std::tie(d.first_y, d.first_x, d.first_sample) = *first_dropped_.begin();
}

/// Makes the first samples that were dropped once more, and looks at what scripts say.
void Job::explain_dropped() {
  if (first_dropped_.empty()) return;
  std::vector<PixelSample> again;
  for (const auto& [y, x, sample] : first_dropped_) again.push_back({x, y, sample});
  std::vector<FilmSample> stream(again.size());
  Integrator integrator(world_);
  integrator.watch_scripts();
  integrator.trace(again, stream);
  for (const auto& [descriptor, found] : integrator.scripts().not_finite())
    report_.not_finite.push_back(found);
}

/// Reports and saves until all threads are done.
void Job::watch() {
  std::unique_lock lock(report_lock_);
  for (bool all_done = false; !all_done;) {
    all_done =
        finished_.wait_for(lock, std::chrono::milliseconds(100), [this] { return running_ == 0; });
    lock.unlock();
    if (options_.progress) show_progress();
    if (!all_done && options_.save && seconds() - saved_at_ >= options_.save_seconds) save();
    lock.lock();
  }
}

void Job::show_progress() {
  const double now = seconds();
  const std::uint64_t done = paths_done_;
  const auto samples =
      int((paths_before_ + done) / (std::uint64_t(options_.width) * options_.height));
  double fraction = paths_asked_ > 0 ? double(done) / double(paths_asked_) : 1;
  if (now >= next_error_at_) {
    const std::scoped_lock lock(film_lock_);
    const double begin = seconds();
    shown_error_ = ErrorEstimate(*film_).rmse();
    const double end = seconds();
    next_error_at_ = end + std::max(kSecondsOfError, (end - begin) / kShareOfError);
  }
  double left = fraction > 0 ? now * (1 - fraction) / fraction : 0;
  // Error falls at least like 1 / sqrt(samples), so no later than this.
  if (options_.error > 0 && shown_error_ > 0) {
    const double by_error = now * std::max(0.0, std::pow(shown_error_ / options_.error, 2) - 1);
    left = std::min(left, by_error);
  }
  if (options_.seconds > 0) left = std::min(left, std::max(0.0, options_.seconds - now));
  if (left + now > 0 && (options_.error > 0 || options_.seconds > 0))
    fraction = std::max(fraction, now / (now + left));
  options_.progress({fraction, samples, now, left, shown_error_});
}

/// Hands a copy out, so that threads go on while it is written.
void Job::save() {
  std::optional<PartialFilm> copy;
  {
    const std::scoped_lock lock(film_lock_);
    copy.emplace(*film_);
  }
  options_.save(*copy);
  saved_at_ = seconds();
}

void Job::account(const Integrator& integrator) {
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
  for (const auto& [descriptor, found] : integrator.weighed()) weighed_[descriptor].add(found);
}

Rendered Job::finish() {
  report_.paths = paths_done_;
  report_.fault_lanes = fault_lanes_;
  explain_dropped();
  report_.too_many_faults = too_many_faults_;
  if (report_.script_runs > 0)
    report_.batch_fill =
        double(report_.script_points) / double(report_.script_runs) / world_.compiled.width();
  report_.samples = int(film_->fewest_samples());
  std::uint64_t all = 0;
  for (int t = 0; t < film_->tiles(); ++t) all += film_->done[t].count() * film_->tile(t).area();
  report_.mean_samples = double(all) / options_.width / options_.height;
  report_.error_reached = good_;
  report_.stopped = options_.stop && options_.stop->load() && paths_done_ < paths_asked_ && !good_;
  const ErrorEstimate error(*film_);
  report_.rmse = error.rmse();
  const vm::Program& program = world_.compiled.program();
  for (const auto& [where, lanes] : faults_)
    report_.faults.push_back(
        {place(program, where.source, where.line), cause_text(where.cause), lanes});
  std::stable_sort(report_.faults.begin(), report_.faults.end(),
                   [](const FaultCount& a, const FaultCount& b) { return a.lanes > b.lanes; });
  for (const vm::Descriptor& d : program.descriptors)
    if (const auto w = weighed_.find(&d); w != weighed_.end() && w->second.above_one > 0)
      report_.gains.push_back({place(program, d.line.source, d.line.line), d.name,
                               w->second.above_one, w->second.points, w->second.most});
  return {film_->develop(error), std::move(report_), film_};
}

}  // namespace mms::renderer
