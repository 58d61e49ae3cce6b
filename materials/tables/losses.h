// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What single bounces off lossless facets lose, for the tables. Nothing here is used when
/// rendering.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "materials/energy.h"
#include "materials/facets.h"
#include "materials/tables/grid.h"
#include "materials/tables/visible.h"

namespace mms::materials::tables {

inline constexpr int kAngles = 192;
inline constexpr double kLeast = 1e-7;  ///< an axis' first direction and width, instead of 0

/// cos theta from its place along an axis that maps a cosine and a sine, by halving.
template <class Axis>
double cosine(double place, const Axis& axis) {
  double lo = 0, hi = 1;
  for (int i = 0; i < 60; ++i) {
    const double angle = (lo + hi) * kPi<double> / 4;
    (axis(std::sin(angle), std::cos(angle)) < place ? lo : hi) = (lo + hi) / 2;
  }
  return std::sin(lo * kPi<double> / 2);
}

/// Mean over a quarter of a turn of `f(x, y)`, a number or some, (x, y) of unit length and x along
/// the wider axis of facets of that quotient of both widths: by `n` directions that crowd a little
/// about the narrower one, where losses change fastest.
template <class F>
auto quarter_mean(double aspect, int n, const F& f) {
  const double crowding = std::pow(aspect, 0.2);
  decltype(f(0.0, 0.0)) sum{};
  for (int i = 0; i < n; ++i) {
    const double turn = (i + 0.5) / n * kPi<double> / 2;
    const double x = std::cos(turn), y = crowding * std::sin(turn), length = std::hypot(x, y);
    sum += f(x / length, y / length) * (crowding / (length * length));
  }
  return sum / n;
}

/// The loss of one bounce off lossless facets.
template <class Facets>
double loss(const Facets& facets, Vec3d wo, int angles = kAngles) {
  const auto mirrored = [&](Vec3d h) { return h * (2 * dot(wo, h)) - wo; };
  const double so = facets.shadow(wo);
  return visible_mean(
      facets, wo,
      [&](Vec3d h) {
        const Vec3d wi = mirrored(h);
        if (!(wi.z > 0)) return 1.0;
        const double s = wo.z * facets.shadow(wi);
        return s / (wo.z * wi.z + so * wi.z + s);
      },
      [&](Vec3d h) { return std::array{mirrored(h).z}; }, angles);
}

/// FacetTables::loss.
template <template <class> class Distribution>
std::vector<float> round_losses() {
  const Grid grid({axes::kAlpha, axes::kDirection}, [](const double* x) {
    const double alpha = std::max(x[0] * x[0], 1e-5);
    const auto axis = [&](double z, double s) { return axes::direction(z, s, axes::width(alpha)); };
    const double z = std::max(cosine(std::min(x[1], 1 - kLeast), axis), kLeast * alpha);
    return loss(Distribution<double>{{alpha, alpha}}, {std::sqrt(1 - z * z), 0, z});
  });
  const std::vector<double> spline = grid.spline();
  return {spline.begin(), spline.end()};
}

}  // namespace mms::materials::tables
