// SPDX-License-Identifier: Apache-2.0
#include "renderer/glows.h"

#include <algorithm>
#include <cmath>

#include "base/warp.h"

namespace mms::renderer {
namespace {

/// The directions in which a ball is seen: all of them from inside.
struct Cone {
  Vec3d axis{0, 0, 1};
  double sin2 = 0;           ///< of the angle to its edge
  double one_minus_cos = 2;  ///< likewise
  double brightness;         ///< radiance times solid angle

  Cone(const Glow& g, Vec3d from) {
    const Vec3d to = g.centre - from;
    const double distance2 = dot(to, to), radius2 = g.radius * g.radius;
    // What lies on the ball counts as inside, however it was rounded.
    if (distance2 > radius2 * 1.001) {
      axis = to / std::sqrt(distance2);
      sin2 = radius2 / distance2;
      one_minus_cos = sin2 / (1 + std::sqrt(1 - sin2));
    }
    brightness = g.radiance * one_minus_cos;
  }
  double pdf() const { return 1 / (2 * kPi<double> * one_minus_cos); }
  bool holds(Vec3d d) const {
    if (one_minus_cos == 2) return true;
    const Vec3d across = cross(axis, d);
    return dot(axis, d) > 0 && dot(across, across) <= sin2;
  }
};

}  // namespace

Glows::Sample Glows::sample(Vec3d from, double u, double v) const {
  double sum = 0;
  for (const Glow& g : glows_) sum += Cone(g, from).brightness;
  u *= sum;
  for (const Glow& g : glows_) {
    const Cone cone(g, from);
    if (u >= cone.brightness && &g != &glows_.back()) {
      u -= cone.brightness;
      continue;
    }
    const double less = cone.one_minus_cos * std::min(u / cone.brightness, 1.0);
    const double s = std::sqrt(less * (2 - less)), phi = 2 * kPi<double> * v;
    const Vec3d local{s * std::cos(phi), s * std::sin(phi), 1 - less};
    const Vec3d direction = normalize(Frame<double>::around(cone.axis).to_world(local));
    return {direction, pdf(from, direction)};
  }
  return {{}, 0};
}

double Glows::pdf(Vec3d from, Vec3d direction) const {
  double sum = 0, seen = 0;
  for (const Glow& g : glows_) {
    const Cone cone(g, from);
    sum += cone.brightness;
    if (cone.holds(direction)) seen += cone.brightness * cone.pdf();
  }
  return sum > 0 ? seen / sum : 0;
}

}  // namespace mms::renderer
