// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Maps from the unit square to directions and discs, with their densities.
/// Directions are in a local frame whose z axis is the normal; densities per steradian.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vec.h"

namespace mms {

template <class R>
inline constexpr R kPi = std::numbers::pi_v<R>;

/// A point of the unit disc (Shirley and Chiu 1997: area-preserving, continuous).
template <class R>
inline Vec3<R> square_to_disc(R u, R v) {
  const R a = 2 * u - 1, b = 2 * v - 1;
  if (a == 0 && b == 0) return {0, 0, 0};
  const bool wide = std::abs(a) > std::abs(b);
  const R r = wide ? a : b;
  const R phi = wide ? kPi<R> / 4 * (b / a) : kPi<R> / 2 - kPi<R> / 4 * (a / b);
  return {r * std::cos(phi), r * std::sin(phi), 0};
}

/// Cosine-distributed direction of the upper hemisphere; density `z / pi`.
template <class R>
inline Vec3<R> square_to_cosine_hemisphere(R u, R v) {
  const Vec3<R> d = square_to_disc(u, v);
  return {d.x, d.y, std::sqrt(std::max(R(0), 1 - d.x * d.x - d.y * d.y))};
}

/// Uniform direction of the sphere; density `1 / (4 pi)`.
template <class R>
inline Vec3<R> square_to_sphere(R u, R v) {
  const R z = 1 - 2 * u;
  const R r = 2 * std::sqrt(u * (1 - u));
  const R phi = 2 * kPi<R> * v;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace mms
