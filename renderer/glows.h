// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Directions to volumes that emit. A ray that is drawn so gathers what all volumes on it emit, up
/// to what is opaque: one density holds for it, whatever it meets.

#include <vector>

#include "base/vec.h"

namespace mms::renderer {

/// A volume that emits: a ball around it, and about how much it emits on a way through.
struct Glow {
  Vec3d centre;
  double radius;
  double radiance;  ///< > 0
};

class Glows {
 public:
  Glows() = default;
  explicit Glows(std::vector<Glow> glows) : glows_(std::move(glows)) {}

  bool any() const { return !glows_.empty(); }

  struct Sample {
    Vec3d direction;  ///< unit
    double pdf;       ///< 1/sr
  };
  /// Of one of the balls, chosen by radiance times solid angle, any direction alike. `u` and `v`
  /// are in [0, 1).
  Sample sample(Vec3d from, double u, double v) const;
  /// Of `direction`, a unit vector; 0 where it misses all of them.
  double pdf(Vec3d from, Vec3d direction) const;

 private:
  std::vector<Glow> glows_;
};

}  // namespace mms::renderer
