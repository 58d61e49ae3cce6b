// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Latitude-longitude pictures: where in one a direction lies, and back. +y is up, the middle
/// column looks along -z, columns follow the azimuth from there towards +x, rows the angle from +y.

#include <algorithm>
#include <array>
#include <cmath>

#include "base/vec.h"
#include "base/warp.h"

namespace mms::renderer {

/// Column and row in [0, 1] of the unit vector `d` in a picture turned by `rotation` about +y,
/// radians.
inline std::array<double, 2> latlong_of(Vec3d d, double rotation) {
  double x = 0.5 + (std::atan2(d.x, -d.z) - rotation) / (2 * kPi<double>);
  x -= std::floor(x);
  return {x, std::acos(std::clamp(d.y, -1.0, 1.0)) / kPi<double>};
}

/// The unit vector at column `x` and row `y`.
inline Vec3d latlong_direction(double x, double y, double rotation) {
  const double phi = (x - 0.5) * 2 * kPi<double> + rotation, theta = y * kPi<double>;
  return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

}  // namespace mms::renderer
