// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the programs that make tables of glass below coats share. Nothing here is used when
/// rendering.

#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/glass_coat.h"
#include "materials/tables/grid.h"
#include "materials/tables/losses.h"
#include "materials/tables/points.h"
#include "materials/tables/slopes.h"

namespace mms::materials::tables {

/// The index and the width of places along their axes.
inline double glass_index_at(double place, bool falls = false) {
  return index_of(axes::kLeastGlassIndex + (axes::kMostGlassIndex - axes::kLeastGlassIndex) * place,
                  !falls);
}
inline double glass_alpha_at(double place) {
  return std::pow(axes::kLeastGlassAlpha + (1 - axes::kLeastGlassAlpha) * place, 3);
}
/// The |cosine| at a place on the axis of directions, from which light meets the index `eta`; above
/// 0.
inline double glass_cosine_at(bool inside, double place, double alpha, double eta, double root) {
  const double z = cosine(std::min(place, 1 - kLeast), [&](double c, double s) {
    return axes::glass_direction(inside, c, s, alpha, eta);
  });
  return std::max(z, kLeast * root);
}

/// Integrals of t_k of the |cosine| outside.
template <int Points>
using Moments = Numbers<Points>;

template <int Points>
Moments<Points> terms_at(double z) {
  Moments<Points> to;
  const auto t = chebyshev_terms<Points>(z);
  std::copy(t.begin(), t.end(), to.of.begin());
  return to;
}

/// Those of what further bounces send outside, as a share of that: their means over l there
/// (materials/energy.h).
template <int Points, class Facets>
Moments<Points> further_outside(const Facets& facets, double glass) {
  const InterfaceLoss<double> outside{facets.interface(), facets.ax, facets.ay, glass};
  const bool round = facets.ax == facets.ay;
  const auto azimuth_mean = [&](const auto& f) {
    return quarter_mean(facets.ax / facets.ay, round ? 1 : 6, f);
  };
  std::vector<decltype(along_azimuth(outside, 0, 0))> along;
  azimuth_mean([&](double x, double y) {
    along.push_back(along_azimuth(outside, x, y));
    return 0.0;
  });
  const auto sum = height_mean(
      [&](double z, double s) {
        auto next = along.begin();
        const double l = azimuth_mean([&](double, double) { return (*next++)(z, s); });
        return terms_at<Points>(z) * l;
      },
      facets.ax * facets.ay, ridge_of(glass), round ? 24 : 12);
  return sum / sum.of[0];  // t_0 is 1
}

/// Coefficients along every axis but the last.
inline std::vector<float> spline_of(const Grid& grid) {
  const std::vector<double> of = grid.spline(1);
  return {of.begin(), of.end()};
}

}  // namespace mms::materials::tables
