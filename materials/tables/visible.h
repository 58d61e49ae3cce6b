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

/// s^4 (35 - 84 s + 70 s^2 - 20 s^3) maps [0, 1] to itself and crowds points at both ends.
inline double crowd(double s) { return s * s * s * s * (35 + s * (-84 + s * (70 - s * 20))); }
inline double crowd_slope(double s) {
  const double t = s * (1 - s);
  return 140 * t * t * t;
}

/// Integral of f over [a, b], crowding points at both ends.
template <int N, class F>
double integrate_crowded(const F& f, double a, double b) {
  return integrate<N>(
      [&](double s) { return (b - a) * crowd_slope(s) * f(a + (b - a) * crowd(s)); }, 0, 1);
}

/// Integral of f over [a, b], cut where one of `edges(x)` changes its sign.
template <class F, class Edges>
double integrate_between_edges(const F& f, const Edges& edges, double a, double b) {
  constexpr int scan = 8;
  std::vector<double> cuts{a};
  auto before = edges(a);
  for (int i = 1; i <= scan; ++i) {
    const double x = a + (b - a) * i / scan;
    const auto here = edges(x);
    for (std::size_t k = 0; k < here.size(); ++k) {
      if ((here[k] > 0) == (before[k] > 0)) continue;
      // Regula falsi; an end that stays counts half (the Illinois rule).
      double lo = a + (b - a) * (i - 1) / scan, hi = x, at_lo = before[k], at_hi = here[k];
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
    if (cuts[i] > cuts[i - 1]) sum += integrate_crowded<16>(f, cuts[i - 1], cuts[i]);
  return sum;
}

/// Mean of f(h) over the normals of `ggx` that `wo` sees; `edges(h)` change sign where f is not
/// smooth. As Ggx::sample_visible, u2 outside and u1 inside; each panel outside to within
/// `tolerance`.
template <class F, class Edges>
double visible_mean(const Ggx<double>& ggx, Vec3d wo, const F& f, const Edges& edges,
                    double tolerance) {
  const Vec3d w = normalize(Vec3d{ggx.ax * wo.x, ggx.ay * wo.y, wo.z});
  const double start = std::atan2(w.y, w.x);
  // Where all is alike around a direction in the x z plane, half the ring is enough.
  const bool half = ggx.ax == ggx.ay;
  const auto ring = [&](double up) {  // 1 - u2, small towards grazing normals
    const double rise = up * (1 + w.z), low = (1 + w.z) - rise;
    const double r = std::sqrt(std::max(0.0, low * (1 - w.z + rise)));
    const auto normal = [&](double phi) {
      return normalize(
          Vec3d{ggx.ax * (r * std::cos(phi) + w.x), ggx.ay * (r * std::sin(phi) + w.y), rise});
    };
    double sum = 0;  // in halves, so that a pair of close edges is seen apart
    for (int k = 0; k < (half ? 1 : 2); ++k)
      sum += integrate_between_edges([&](double phi) { return f(normal(phi)); },
                                     [&](double phi) { return edges(normal(phi)); },
                                     start + k * kPi<double>, start + (k + 1) * kPi<double>);
    return sum / ((half ? 1 : 2) * kPi<double>);
  };
  // The tail of steep facets is as long as 1 / alpha^2: up = e^-t.
  constexpr double cuts[] = {0, 0.5, 1.7, 3.5, 7, 12, 20};
  double sum = 0;
  for (std::size_t i = 1; i < std::size(cuts); ++i)
    sum += integrate_adaptive([&](double t) { return std::exp(-t) * ring(std::exp(-t)); },
                              cuts[i - 1], cuts[i], tolerance, 6);
  return sum;
}

/// The same of Beckmann's, over slopes along (outside) and across (inside) the direction.
template <class F, class Edges>
double visible_mean(const Beckmann<double>& facets, Vec3d wo, const F& f, const Edges& edges,
                    double tolerance) {
  const double t = facets.tangent(wo), l = std::hypot(t, wo.z), c = wo.z / l, s = t / l;
  const double cx = t > 0 ? facets.ax * wo.x / t : 1, cy = t > 0 ? facets.ay * wo.y / t : 0;
  constexpr double reach = 5.5;  // e^(-5.5^2) = 7e-14
  const bool half = facets.ax == facets.ay;
  const auto line = [&](double x) {
    const auto normal = [&](double y) {
      const double u = x * cx - y * cy, v = x * cy + y * cx;
      return normalize(Vec3d{-facets.ax * u, -facets.ay * v, 1});
    };
    double sum = 0;
    for (const double from : {0.0, -reach}) {
      sum +=
          integrate_between_edges([&](double y) { return std::exp(-y * y) * f(normal(y)); },
                                  [&](double y) { return edges(normal(y)); }, from, from + reach);
      if (half) break;
    }
    return (c - s * x) * std::exp(-x * x) / kPi<double> * sum * (half ? 2 : 1);
  };
  const double end = c < reach * s ? c / s : reach;
  const double mid = std::min(0.0, end - 1);
  const double sum = integrate_adaptive(line, -reach, mid, tolerance, 6) +
                     integrate_adaptive(line, mid, end, tolerance, 6);
  return sum / (c + facets.shadow(wo) / l);
}

}  // namespace mms::materials::tables
