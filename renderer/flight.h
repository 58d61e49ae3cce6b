// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Rays on their way: through semi-transparent surfaces and media, to where something happens.
/// Many fly at a time, so that what they meet can be asked of scripts in batches.

#include <span>
#include <vector>

#include "renderer/sampler.h"
#include "renderer/world.h"

namespace mms::renderer {

/// What met a light: a direction drawn by what scatters, or one drawn towards the light.
enum class Technique : std::uint8_t { Scattering, Light };

/// What a path carries: for each wavelength the contribution so far over the density of the
/// hero's choices, and how likely the same choices were with that wavelength as the hero. All are
/// kept relative to the most likely wavelength, so that nothing overflows (thesis (4.6), (4.20)).
struct Carried {
  Spectrumf beta{1.0f};       ///< contribution over density
  Spectrumf pdf{1.0f};        ///< relative density of getting here by scattering
  Spectrumf light_pdf{0.0f};  ///< of getting to the last vertex, per unit density of light sampling

  /// Records an event of probability `p[j]` for wavelength j (which happened, so p[0] > 0) that
  /// multiplies the contribution by `f`. Light sampling reaches past it without the choice.
  void happened(const Spectrumf& f, const Spectrumf& p);
  /// Scales by the largest density.
  void rescale();
  /// Light found by technique `by`, and by light sampling with density `light_density` per
  /// steradian, over its density and weighed: the balance heuristic over wavelengths if clustered
  /// (thesis (4.20)), and between the two techniques the power heuristic.
  Spectrumf weighted(Technique by, double light_density, Estimator estimator) const;
};

enum class Errand : std::uint8_t {
  Path,
  Shadow,  ///< to light that is known
  Gather,  ///< of what volumes emit on the way
};
enum class End : std::uint8_t {
  Flying,
  Surface,  ///< of a path: to be shaded at `hit`
  Medium,   ///< of a path: scattered in a volume at `t`
  Free,     ///< nothing (more) in the way
  Lost,     ///< absorbed or blocked
};

/// What a flight waits for a script to say.
enum class Need : std::uint8_t { Nothing, Coefficients, Collision, Emission, Crossing };

/// What a volume does to light, for each wavelength.
struct Coefficients {
  Spectrumf scattering, absorption;  ///< 1/m
  Spectrumf emission;                ///< W m^-3 sr^-1 nm^-1
};

struct Flight {
  Vec3f origin, direction;
  Receives receives;  ///< what it left as a scattered ray
  int path = 0;       ///< whose it is
  Errand errand = Errand::Path;
  End end = End::Flying;
  Need need = Need::Nothing;
  bool emission_seen = false;  ///< of the crossing that `hit` is
  float t = 0;                 ///< how far it has come
  float t_max = 0;             ///< how far it goes at most
  Hit hit;                     ///< the opaque surface at its end
  int next = 0;                ///< crossing to come
  std::uint32_t step = 0;      ///< counts its random numbers
  std::uint32_t stream = 0;    ///< tells them from those of other flights of the path
  double light_density = 0;    ///< of a ray for light: with which that was drawn, 1/sr
  float glow_chance = 0;       ///< of a path: that where it left World::glows were drawn too
  int beyond = -1;  ///< of a shadow ray that leaves a ball: what it goes on by, as its owner knows
  Media media;
  Carried carried;
  int medium = -1;  ///< object whose volume is asked, or scattered it
  float rate = 0;   ///< of such events as it has come to, where it is, 1/m
  /// Where the first volume that varies and emits is asked next; before 0: not known.
  RateGrid::Event look{-1, 0};
  float look_step = 1;  ///< how many times as seldom it is as it may be
  int known = 0;        ///< how many of the even volumes here have been asked
  Coefficients even;    ///< the sum of those
  /// Of the even volumes the one that is to scatter, drawn by the hero's share, and what it does.
  int drawn = -1;
  Spectrumf drawn_scattering;

  /// For the density of light sampling where the flight began.
  Receiver left() const { return {Vec3d(origin), receives}; }

  int crossings = -1;  ///< where Flights keeps what lies on its way; -1 before it began

  /// In other media from here on.
  void forget_media() {
    look = {-1, 0};
    known = 0;
    even = {};
    drawn = -1;
  }
};

/// What flights need to know of the paths they belong to.
struct PathView {
  const Cluster* cluster;
  const Sampler* sampler;
  Spectrumf* radiance;  ///< where light met on the way is added
  Spectrumf* gathered;  ///< that of flights on that errand
  double cone;          ///< width of the pixel for each metre of ray
};

struct FlightCounters {
  std::uint64_t rays = 0, shadow_rays = 0, media_steps = 0;
  std::uint64_t medium_samples = 0, denser_samples = 0;  ///< as in Report
};

class Flights {
 public:
  Flights(const World& world, Scripts& scripts) : world_(world), scripts_(scripts) {}

  /// Lets flights go on until no more than the share `left` of those that fly at the start still
  /// do: they come along the next time, so that scripts are run on full batches. What has ended is
  /// not touched.
  void fly(std::vector<Flight>& flights, const std::vector<PathView>& paths, double left = 0);

  /// Whether nothing lies between two points of a plain world.
  bool open(Vec3f from, Vec3f to);

  const FlightCounters& counters() const { return counters_; }

 private:
  struct Request {
    int flight;
    Need need;
    int key;  ///< volume or surface to ask
  };

  void begin(Flight& f);
  void trace(Flight& f, Crossings& crossings, float from);
  void advance_all(std::vector<Flight>& flights, const std::vector<PathView>& paths);
  Need advance(Flight& f, Crossings& crossings, const PathView& path);
  bool through_even(Flight& f, float length, const PathView& path);
  void answer(std::vector<Flight>& flights, const std::vector<PathView>& paths,
              std::span<const Request> requests);
  bool along_media(Flight& f, float to, const PathView& path, Need& need);
  Spectrumf answered(const vm::ValueSource& v, int lane, const PathView& path) const;
  Coefficients removed(const vm::Descriptor& d, int lane, const PathView& path);
  Spectrumf emission(const vm::Entry& entry, const materials::Layout& shape, const Flight& f,
                     int lane, const PathView& path);
  void add_even(Flight& f, const Coefficients& c, const PathView& path);
  void collide(Flight& f, const Coefficients& c, const PathView& path);
  void find_emission(Flight& f, const Filling& filling, float to, double& end, Need& need,
                     const PathView& path);
  void see(const Flight& f, const Spectrumf& light, const PathView& path);
  void pass_false_surface(Flight& f, const Hit& hit);
  void cross(Flight& f, const ScriptPoint& point, const Spectrumf& scattering,
             const Spectrumf& absorption, const PathView& path);
  void add_crossing_emission(const Flight& f, const ScriptPoint& point, const Spectrumf& emitted,
                             const PathView& path);
  float random(Flight& f, const PathView& path) const {
    return path.sampler->hashed(f.stream, f.step++);
  }

  const World& world_;
  Scripts& scripts_;
  FlightCounters counters_;
  std::vector<Crossings> crossings_;
  std::vector<int> free_crossings_;
  std::vector<int> flying_;
  std::vector<Request> requests_;
  std::vector<std::span<const Request>> part_filled_;  ///< batches of them
  std::vector<ScriptPoint> points_;
  std::vector<const ScriptPoint*> lanes_;
  std::vector<float> params_;
};

/// A flight of path `path` from the camera through (x, y), in pixels; `sampler` chooses the point
/// of the lens.
Flight camera_flight(const World& world, int path, const Sampler& sampler, double x, double y);

/// The point a flight has come to, for a script: on the surface of `hit`, or free in a volume.
ScriptPoint script_point(const World& world, const Flight& f, const Hit* hit, const PathView& path);

}  // namespace mms::renderer
