// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Light in a layer of upright fibres, by random walks: what the table of `sheen` is made from.
/// Nothing here is used when rendering.
///
/// The layer has depth 1. Its fibres are SGGX microflakes (Heitz et al. 2015), white mirrors whose
/// matrix is diag(1, 1, s^2), s = roughness^2: thin fibres along the normal for s near 0, specks
/// that scatter alike in every direction for s = 1. Seen along w, their projected area is
/// sqrt(w.x^2 + w.y^2 + s^2 w.z^2) for each unit of depth.

#include <optional>
#include <vector>

#include "base/vec.h"
#include "base/warp.h"

namespace mms::materials::tables {

/// The direction, if any, in which light that came from `wo` leaves the layer above.
/// `random.next()` gives numbers in [0, 1).
template <class Random>
std::optional<Vec3d> walk_in_fibres(double roughness, Vec3d wo, Random& random) {
  const double s = roughness * roughness;
  Vec3d from = wo;  // against the light
  for (double depth = 0;;) {
    const double area = std::hypot(from.x, from.y, s * from.z);
    depth += -std::log1p(-random.next()) * from.z / area;
    if (depth < 0) return -from;
    if (depth > 1) return {};
    // The normal of a flake that is seen: of a ball's, were the flakes stretched to one.
    const double u = random.next();
    const Vec3d ball = Frame<double>::around(normalize(Vec3d{from.x, from.y, s * from.z}))
                           .to_world(square_to_cosine_hemisphere(u, random.next()));
    const Vec3d flake = normalize(Vec3d{ball.x, ball.y, s * ball.z});
    from = normalize(from - flake * (2 * dot(from, flake)));
  }
}

/// A transformed cosine's numbers, materials/sheen.h.
struct Transform {
  double a = 1, b = 0;
};

/// The transform under which `directions` (seen from `wo`, with wo.y = 0 < wo.x) are most likely:
/// the likelihood's derivatives are 0, as weighted means whose weights hang on a and b.
inline Transform fit_directions(const std::vector<Vec3d>& directions, Vec3d wo) {
  Transform t;
  for (int step = 0; step < 60; ++step) {
    double along = 0, across = 0, up = 0, sum = 0;
    for (const Vec3d& w : directions) {
      const double x = t.a * w.x + t.b * w.z * wo.x, y = t.a * w.y;
      const double weight = 1 / (x * x + y * y + w.z * w.z);
      along += weight * w.x * w.z;
      across += weight * (w.x * w.x + w.y * w.y);
      up += weight * w.z * w.z;
      sum += 1;
    }
    t.a = std::sqrt(sum / (2 * (across - along * along / up)));
    t.b = -t.a * along / (up * wo.x);
  }
  return t;
}

}  // namespace mms::materials::tables
