// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Means over the normals that a direction sees, by quadrature: what the tables are made from.
/// Nothing here is used when rendering.

#include <array>
#include <cmath>
#include <vector>

#include "base/quadrature.h"
#include "materials/facets.h"

namespace mms::materials::tables {

/// Integral of f over [a, b], crowding points at both ends, where f may be as a square root.
template <int N, class F>
double integrate_crowded(const F& f, double a, double b) {
  return integrate<N>(
      [&](double s) { return (b - a) * 6 * s * (1 - s) * f(a + (b - a) * s * s * (3 - 2 * s)); }, 0,
      1);
}

/// Integral of f over [a, b], cut where one of `edges(x)` changes its sign, `Points` to a part. Two
/// changes within one of the steps are not seen.
template <int Points, class F, class Edges>
double integrate_between_edges(const F& f, const Edges& edges, double a, double b) {
  constexpr int kSteps = 8;
  const auto place = [&](int i) { return a + (b - a) * i / kSteps; };
  std::vector<double> cuts{a};
  auto before = edges(a);
  for (int i = 1; i <= kSteps; ++i) {
    const double x = place(i);
    const auto here = edges(x);
    for (std::size_t k = 0; k < here.size(); ++k) {
      if ((here[k] > 0) == (before[k] > 0)) continue;
      // Regula falsi; an end that stays counts half (the Illinois rule).
      double lo = place(i - 1), hi = x, at_lo = before[k], at_hi = here[k];
      double cut = (lo + hi) / 2;
      for (int n = 0; n < 10 && hi > lo; ++n) {
        cut = (lo * at_hi - hi * at_lo) / (at_hi - at_lo);
        const double at = edges(cut)[k];
        if (std::abs(at) < 1e-12) break;
        if ((at > 0) == (at_hi > 0)) {
          hi = cut, at_hi = at, at_lo /= 2;
        } else {
          lo = cut, at_lo = at, at_hi /= 2;
        }
      }
      cuts.push_back(cut);
    }
    before = here;
  }
  cuts.push_back(b);
  std::sort(cuts.begin(), cuts.end());
  double sum = 0;
  for (std::size_t i = 1; i < cuts.size(); ++i)
    if (cuts[i] > cuts[i - 1]) sum += integrate_crowded<Points>(f, cuts[i - 1], cuts[i]);
  return sum;
}

/// Mean over a turn of ray(cos, sin), by the middle of as many angles: of a smooth one, all but
/// exact. `half`: where the other half of the turn is alike.
template <class Ray>
double turn_mean(const Ray& ray, double start, int angles, bool half) {
  const int n = half ? angles / 2 : angles;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double phi = start + 2 * kPi<double> * (i + 0.5) / angles;
    sum += ray(std::cos(phi), std::sin(phi));
  }
  return sum / n;
}

/// Mean of f(h) over the normals of `ggx` that `wo` sees; `edges(h)` change sign where f is not
/// smooth. As Ggx::sample_visible: `angles` of u1, for each of them all u2.
template <int Points = 16, class F, class Edges>
double visible_mean(const Ggx<double>& ggx, Vec3d wo, const F& f, const Edges& edges, int angles) {
  const Vec3d w = normalize(Vec3d{ggx.ax * wo.x, ggx.ay * wo.y, wo.z});
  const auto ray = [&](double c, double s) {
    // The tail of steep facets is as long as 1 / alpha^2: x^4 = 1 - u2, but for the last 1e-12.
    const auto normal = [&](double x) {
      const double rise = x * x * x * x * (1 + w.z), low = (1 + w.z) - rise;
      const double r = std::sqrt(std::max(0.0, low * (1 - w.z + rise)));
      return normalize(Vec3d{ggx.ax * (r * c + w.x), ggx.ay * (r * s + w.y), rise});
    };
    return integrate_between_edges<Points>([&](double x) { return 4 * x * x * x * f(normal(x)); },
                                           [&](double x) { return edges(normal(x)); }, 1e-3, 1);
  };
  return turn_mean(ray, std::atan2(w.y, w.x), angles, ggx.ax == ggx.ay);
}

/// The same of Beckmann's, over slopes as polar coordinates; twice the points.
template <int Points = 16, class F, class Edges>
double visible_mean(const Beckmann<double>& facets, Vec3d wo, const F& f, const Edges& edges,
                    int angles) {
  const double t = facets.tangent(wo), l = std::hypot(t, wo.z), c = wo.z / l, s = t / l;
  const double cx = t > 0 ? facets.ax * wo.x / t : 1, cy = t > 0 ? facets.ay * wo.y / t : 0;
  constexpr double reach = 5.5;               // e^(-5.5^2) = 7e-14
  const auto ray = [&](double x, double y) {  // x along the direction, y across
    const double u = x * cx - y * cy, v = x * cy + y * cx;
    const auto normal = [&](double r) {
      return normalize(Vec3d{-facets.ax * u * r, -facets.ay * v * r, 1});
    };
    const double end = s * x * reach > c ? c / (s * x) : reach;  // facets that face away
    return integrate_between_edges<2 * Points>(
        [&](double r) { return 2 * r * std::exp(-r * r) * (c - s * x * r) * f(normal(r)); },
        [&](double r) { return edges(normal(r)); }, 0, end);
  };
  return turn_mean(ray, 0, angles, facets.ax == facets.ay) / (c + facets.shadow(wo) / l);
}

}  // namespace mms::materials::tables
