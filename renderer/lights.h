// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Everything that sends light out: emitting objects and the environment. Offers sample, pdf and
/// evaluate; what a scripted emitter radiates is asked of its script by the integrator.

#include <array>
#include <vector>

#include "renderer/accel.h"
#include "renderer/cluster.h"
#include "renderer/light_tree.h"
#include "renderer/scene.h"

namespace mms::renderer {

inline constexpr int kEnvironment = -1;

/// Up to so many lights are weighed one by one for each point; more are kept in a tree.
inline constexpr int kLightsWeighed = 32;

/// Up to so many are each drawn at the first vertices of a path, where no shadow ray waits for a
/// script: they come back together, and sums are made in one order.
inline constexpr int kLightsDrawnEach = 4;

/// What light drawing knows of that which scatters it.
struct Receives {
  Vec3f normal;       ///< unit, towards the only side that light matters from; zero if all do
  bool even = false;  ///< by the cosine to it alone
  int draws = 0;      ///< directions that are drawn towards each light; 0: one, towards one of them
};

/// Where light is to be scattered.
struct Receiver {
  Vec3d position, normal;
  bool even = false;
  int draws = 0;

  Receiver(Vec3d p, const Receives& r = {})
      : position(p), normal(r.normal), even(r.even), draws(r.draws) {}
};

/// A direction towards a light, as seen from some point.
struct LightSample {
  int object = kEnvironment;  ///< index into SceneData::objects
  SurfacePoint surface;       ///< of the object; as `sample_place` gives it
  Vec3d direction;            ///< unit, towards the light
  double pdf = 0;             ///< per steradian, choice of the light included; 0: no sample
};

/// A point from which light goes out.
struct EmissionPoint {
  int object = -1;       ///< index into SceneData::objects
  SurfacePoint surface;  ///< of it
  double pdf = 0;        ///< per m^2, choice of the light included
};

/// Piecewise constant density over the texels of a picture, drawn by inverting two tables.
class TexelDensity {
 public:
  TexelDensity() = default;
  /// `weight` row by row, not negative, not all zero.
  TexelDensity(std::vector<double> weight, int width, int height);
  /// A point of the unit square and its density there.
  struct Drawn {
    double x, y, pdf;
  };
  Drawn sample(double u, double v) const;
  double pdf(double x, double y) const;

 private:
  int width_ = 0, height_ = 0;
  std::vector<double> rows_, columns_;  ///< cumulative, each starting with 0
};

class Lights {
 public:
  /// `radiance[i]` estimates the mean luminance that object i radiates, 0 if it is no emitter.
  Lights(const SceneData& scene, const std::vector<double>& radiance);

  bool any() const { return !choices_.empty(); }

  /// What is known of a light from afar.
  struct Lamp {
    int object;
    double radiance, area, radius;  ///< `radius` of a ball around `centre` that holds the light
    Vec3d centre, facing;           ///< `facing` is zero where light leaves to all sides
  };
  const Lamp& lamp(int choice) const { return choices_[choice]; }
  /// About what a lamp's visible area fills from afar, at most the hemisphere's.
  static double solid_angle(const Lamp& lamp, Vec3d from);
  /// About what all lights send straight to a point. \pre they are at most kLightsWeighed
  double irradiance(const Receiver& at) const;

  /// Draws a light by its estimated irradiance at `from`, then a direction. `u` chooses the light,
  /// and what is left of it the place on the light.
  LightSample sample(const Receiver& from, double u, double v) const;
  /// Draws a direction towards the light of number `choice` in [0, count()): what `sample` does
  /// once it has chosen.
  LightSample sample_one(int choice, const Receiver& from, double u, double v) const;
  int count() const { return int(choices_.size()); }
  /// Whether the light of that number lies where nothing of it matters to the receiver.
  bool below_horizon(int choice, const Receiver& from) const;

  /// Density, per steradian and choice included, of drawing the direction from `from` that meets
  /// `object` at `at`. 0 for what is not an emitter.
  double pdf(const Receiver& from, int object, const SurfacePoint& at) const;
  double pdf_environment(const Receiver& from, Vec3d direction) const;

  /// Draws a point of an emitting object, by its estimated power: where a path from the light
  /// begins. \pre some object emits (`any_object`).
  EmissionPoint sample_point(double u, double v) const;
  /// Density of any point of `object` by `sample_point`; 0 for what is not an emitter.
  double pdf_point(int object) const;
  bool any_object() const { return powers_.size() > 1; }

  /// Radiance that comes from the environment, from far along `direction`.
  Spectrumf environment(Vec3d direction, const Cluster& cluster) const;

 private:
  struct Choice : Lamp {
    std::vector<double> triangles;  ///< cumulative area of a mesh's triangles
  };
  void add_environment();
  SurfacePoint place(const Choice& c, double u, double v) const;
  static double irradiance(const Lamp& lamp, const Receiver& at);
  /// Estimates for each light, and their sum.
  double weigh(const Receiver& from, std::array<double, kLightsWeighed>& weights) const;
  double environment_share(Vec3d from) const;
  double probability(int i, const Receiver& from) const;
  struct Drawn {
    int choice;
    double probability;
  };
  Drawn choose(const Receiver& from, double& u) const;
  double density(const Choice& c, const Receiver& from, const SurfacePoint& at) const;
  double density_environment(Vec3d direction) const;
  Rgb texel(double x, double y) const;

  const SceneData* scene_;
  std::vector<Choice> choices_;
  std::vector<int> choice_of_;  ///< object to choice, or -1
  int environment_choice_ = -1;
  LightTree tree_;  ///< of all choices but the environment, if they are many
  TexelDensity texels_;
  std::vector<double> powers_{0};  ///< cumulative radiance times area of the objects among choices
};

}  // namespace mms::renderer
