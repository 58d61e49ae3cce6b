// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// From a linked program and a scene to a picture: the renderer's whole public interface.
/// Nothing here prints, exits or throws; every mistake of the user is an `Error`.

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "renderer/filter.h"
#include "renderer/switches.h"
#include "vm/program.h"

namespace mms::renderer {

/// Where a scene comes from, and what takes the place of the descriptors that it names.
struct SceneSource {
  std::string name = "sphere";  ///< a built-in scene (`builtin_scenes()`) or the path of a .json
  /// Surface and volume of the object under test (`"test": true` in a file; `ball` in the built-in
  /// scenes). Empty: what the scene says, else the program's only surface, and the volume of the
  /// same name if there is one.
  std::string surface, volume;
  /// Turns the object under test about the vertical axis through its own origin; radians.
  double turn = 0;
  /// In place of the scene's: the name of an environment (renderer/environments.h), or the path of
  /// a latitude-longitude picture. Empty: the scene's own.
  std::string environment = {};
};

/// Names of the built-in scenes, the default first.
std::vector<std::string> builtin_scenes();

struct SceneData;  // renderer/scene.h

/// A validated scene: immutable, shared by all threads.
class Scene {
 public:
  explicit Scene(std::shared_ptr<const SceneData> data) : data_(std::move(data)) {}
  const SceneData& data() const { return *data_; }
  const std::string& surface() const;  ///< descriptor bound to the test object; may be empty
  const std::string& volume() const;   ///< likewise

 private:
  std::shared_ptr<const SceneData> data_;
};

/// Loads and checks a scene against the descriptors of `program`, which must outlive it.
/// Errors say where: `file: objects[2].material`.
Result<Scene> load_scene(const vm::Program& program, const SceneSource& source);

struct Progress {
  double fraction = 0;      ///< of the samples asked for, in [0, 1]
  int samples = 0;          ///< of a pixel that are there, with those gone on from; their mean
  double seconds = 0;       ///< since rendering began
  double seconds_left = 0;  ///< estimated
  double error = 0;         ///< as Report::rmse; 0 where it is not known yet
};

struct PartialFilm;  // renderer/samples.h

/// Samples of a pixel that a render may have: sums have room for them.
inline constexpr int kMostSamples = 1 << 24;

struct RenderOptions {
  int width = 512, height = 512;  ///< pixels, each in [1, 32768]
  int first_sample = 0;           ///< numbers of the samples of each pixel: from this one
  int samples = 64;               ///< to this one, which is left out; at most kMostSamples
  double seconds = 0;             ///< if above 0, ends soon after as many and a first pass
  double error = 0;               ///< ends when Report::rmse is no larger, if above 0
  int threads = 0;                ///< 0: as many as the machine has
  std::uint64_t seed = 0;
  int max_depth = 64;  ///< scattering events of a path, at least 1
  FilterShape filter = FilterShape::BlackmanHarris;
  Estimator estimator = Estimator::Clustered;
  Generator generator = Generator::Niederreiter;
  /// What is there already, of the same scene and options: only other samples are made. May be
  /// null.
  std::shared_ptr<const PartialFilm> begin_with;
  /// Called every `save_seconds` with what is there, from the thread that called `render`.
  std::function<void(const PartialFilm&)> save;
  double save_seconds = 60;
  bool layers = false;  ///< find Rendered::layers too
  /// Called from one thread at a time, at most ten times a second, and once at the end.
  std::function<void(const Progress&)> progress;
  /// When it becomes true, rendering ends soon with what is there. May be null.
  const std::atomic<bool>* stop = nullptr;
};

/// Samples that could not be added, by cause; `overflow` is of light that is finite, but brighter
/// than sums have room for (renderer/film.h).
struct Dropped {
  std::uint64_t nan = 0, infinite = 0, overflow = 0;
  int first_x = -1, first_y = -1, first_sample = -1;  ///< the first in scan order; replays alone
  std::uint64_t count() const { return nan + infinite + overflow; }
};

/// A number of a script that was not finite, in the first sample of those dropped that shows it.
struct NotFinite {
  std::string descriptor, output;
  /// What the script was told there, as `mms eval` takes it: `--set uv=[0.5,0.25] ...`.
  std::string settings;
};

/// Lanes that the machine gave up at one source line.
struct FaultCount {
  std::string where;  ///< file:line
  std::string cause;
  std::uint64_t lanes = 0;
};

/// Points where the colours and factors of a material that varies add up to more than 1
/// (materials/weight.h).
struct GainCount {
  std::string where;  ///< file:line
  std::string descriptor;
  std::uint64_t points = 0, of = 0;
  float most = 0;  ///< sum
};

/// What a render did. Counters are totals over all threads.
struct Report {
  int samples = 0;          ///< samples a pixel actually done (the smallest over the image)
  double mean_samples = 0;  ///< over the image: where `error` ends a render they differ
  double seconds = 0;       ///< of rendering, without loading
  int threads = 0;
  /// Root mean square, over all pixels, of the standard error of a pixel's linear luminance
  /// (1 is display white): renderer/error.h. Below two samples it is not known, and 0.
  double rmse = 0;
  std::uint64_t cut = 0;  ///< samples brighter than variances know: `rmse` may be too small

  std::uint64_t paths = 0;
  std::uint64_t script_runs = 0;    ///< runs of the machine, of any entry
  std::uint64_t script_points = 0;  ///< lanes in them
  std::uint64_t pass_runs = 0;      ///< of them, runs of `pass` entries
  std::uint64_t emission_runs = 0;  ///< of them, runs of `emit` entries
  std::uint64_t medium_runs = 0;    ///< of them, runs of volume descriptors
  std::uint64_t media_steps = 0;    ///< tentative collisions and closed-form flights in media
  /// Samples of volumes that vary from place to place, and of them those that were denser than
  /// their bound: there the volume is taken to be as dense as the bound.
  std::uint64_t medium_samples = 0, denser_samples = 0;
  std::uint64_t rays = 0;  ///< camera and scattered rays
  std::uint64_t shadow_rays = 0;
  double batch_fill = 0;  ///< mean lanes of a run over the width of a batch; 0 if no run

  Dropped dropped;
  std::vector<NotFinite> not_finite;  ///< one for each descriptor, in the program's order
  std::vector<FaultCount> faults;     ///< by number, largest first
  std::uint64_t fault_lanes = 0;
  std::vector<GainCount> gains;  ///< one for each descriptor, in the program's order
  bool stopped = false;          ///< `stop` ended it early
  bool error_reached = false;    ///< `error` ended it
  bool too_many_faults = false;  ///< more than `kMaxFaultLanes` ended it early
};

/// Lanes that may be given up before a render ends.
inline constexpr std::uint64_t kMaxFaultLanes = 1000;

/// Points that are shaded before a render begins; a lane given up there is an error.
inline constexpr int kProbePoints = 256;

/// A linear picture: means of CIE XYZ (Y = 1 is display white) and the variance of the mean of Y.
struct Film {
  int width = 0, height = 0;
  std::vector<std::array<double, 3>> xyz;  ///< row by row, top first
  std::vector<double> variance;            ///< of the mean of Y
  /// Of the samples that fell into each pixel: all, and those that were not finite. May be empty.
  std::vector<std::uint32_t> samples = {}, dropped = {};
};

struct Layers;  // renderer/layers.h

struct Rendered {
  Film film;
  Report report;
  std::shared_ptr<const PartialFilm> sums;    ///< what the film was developed from
  std::shared_ptr<const Layers> layers = {};  ///< null unless asked for
};

/// Success with nothing to say.
struct Done {};

/// Renders; the error's `where` is the source line where the probe faulted, or the option.
Result<Rendered> render(const vm::Program& program, const Scene& scene,
                        const RenderOptions& options);

}  // namespace mms::renderer
