// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// One render: spreads a picture over threads, adds up what they find, and knows when to end.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <tuple>

#include "renderer/integrator.h"
#include "renderer/samples.h"

namespace mms::renderer {

class Job {
 public:
  /// Both outlive the job.
  Job(const World& world, const RenderOptions& options);

  /// Renders what is missing. Call once.
  Rendered run();

 private:
  using Clock = std::chrono::steady_clock;
  /// A tile of the picture and a pass: what a thread takes at a time.
  struct Chunk {
    int tile;
    SampleSet::Range samples;
  };

  void work();
  bool was_there(int tile, std::uint32_t sample) const;
  std::vector<Chunk> next();
  void done(int chunks);
  bool begin_round();
  void begin_pass();
  void begin_wanted();
  void add(const Chunk& chunk, FilmSums& part, std::span<const FilmSample> samples);
  void drop(const PixelSample& s, SampleFate fate);
  bool ended() const;        ///< \pre schedule_lock_ is held
  bool out_of_time() const;  ///< \pre schedule_lock_ is held
  void watch();
  void show_progress();
  void save();
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }
  void account(const Integrator& integrator);
  void explain_dropped();
  Rendered finish();

  const World& world_;
  const RenderOptions& options_;
  Clock::time_point begin_ = Clock::now();

  std::mutex film_lock_;  ///< film, what is in it, and what was dropped
  std::shared_ptr<PartialFilm> film_;

  std::mutex schedule_lock_;  ///< what is below, to the line
  std::condition_variable round_over_;
  std::vector<Chunk> round_;  ///< handed out before the next is known
  std::size_t next_chunk_ = 0;
  std::uint64_t handed_out_ = 0;  ///< chunks
  int in_flight_ = 0;
  int next_pass_ = 0;  ///< of a picture that does not end by its error

  std::atomic<std::uint64_t> paths_done_{0}, fault_lanes_{0};
  std::uint64_t paths_asked_ = 0, paths_before_ = 0;
  std::atomic<bool> too_many_faults_{false}, good_{false};
  std::mutex report_lock_;
  std::condition_variable finished_;
  int threads_ = 1;  ///< fixed before they begin
  int running_ = 0;
  double shown_error_ = 0, next_error_at_ = 0, saved_at_ = 0;
  Report report_;
  /// The first samples dropped in scan order, as (y, x, number), at most kExplained.
  std::set<std::tuple<int, int, int>> first_dropped_;
  std::map<Scripts::FaultPlace, std::uint64_t> faults_;
  std::map<const vm::Descriptor*, Integrator::Weighed> weighed_;
};

}  // namespace mms::renderer
