// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Lobes as matrices over directions, and the factors that keep what a coat lets through: what the
/// tables of materials/coated.h are made from. Nothing here is used when rendering.

#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/facets.h"
#include "materials/glossy.h"
#include "materials/oren_nayar.h"
#include "materials/tables/coats.h"
#include "materials/tables/losses.h"

namespace mms::materials::tables {

inline constexpr int kNodes = 200;

/// Directions in the middles of as many steps along the axis of the tables.
struct Directions {
  Values z = Values(kNodes), weight = Values(kNodes);  ///< of int 2 z dz

  Directions() {
    for (int k = 0; k < kNodes; ++k) {
      z[k] = cosine_at((k + 0.5) / kNodes);
      const double a = cosine_at(double(k) / kNodes), b = cosine_at((k + 1.0) / kNodes);
      weight[k] = b * b - a * a;
    }
  }
};
inline const Directions& directions() {
  static const Directions d;
  return d;
}

/// Of four nodes, for Lagrange's cubic: what is linear widens a lobe by a step, which near grazing
/// is 1e-3 of the mean of T.
struct Place : Cubic {
  explicit Place(double place)
      : Cubic(std::clamp(place * kNodes - 0.5, -0.5, kNodes - 0.5), 0, kNodes - 4) {}
  static Place of(double z) { return Place(axes::coat_direction(z)); }

  double value(const Values& of) const {
    double sum = 0;
    for (int k = 0; k < 4; ++k) sum += weight[k] * of[first + k];
    return sum;
  }
};

/// The lobe as a matrix: at [i][o] what of the light along o is spread to i; sums over i are 1.
struct Spread {
  std::vector<Values> to = std::vector<Values>(kNodes, Values(kNodes));

  void add(int from, double z, double share) {
    const Place p = Place::of(z);
    for (int k = 0; k < 4; ++k) to[p.first + k][from] += share * p.weight[k];
  }

  Values sums() const { return mean(Values(kNodes, 1.0)); }
  Values mean(const Values& of) const {
    Values m(kNodes);
    for (int i = 0; i < kNodes; ++i)
      for (int o = 0; o < kNodes; ++o) m[o] += to[i][o] * of[i];
    return m;
  }
  std::vector<Values> means(const std::vector<Values>& of) const {
    std::vector<Values> all;
    for (const Values& one : of) all.push_back(mean(one));
    return all;
  }
  void normalise() {
    const Values all = sums();
    for (Values& line : to)
      for (int o = 0; o < kNodes; ++o) line[o] /= all[o];
  }
};

/// With what single bounces lose, as materials/energy.h gives it back: as `losses` has it.
template <class Facets>
Spread facet_lobe(const Facets& facets, const std::vector<float>& losses) {
  const FacetTables tables{losses.data(), nullptr, nullptr, nullptr};
  const FacetLoss<double> loss{&tables, facets.ax, facets.ay};
  const auto& [z, weight] = directions();
  const std::vector<Facet> all = all_facets(facets, 17711, 10946);
  Spread lobe;
  Values lost(kNodes);
  double mean = 0;
  for (int o = 0; o < kNodes; ++o) {
    const Vec3d wo{std::sqrt(1 - z[o] * z[o]), 0, z[o]};
    lost[o] = loss.at(wo);
    mean += lost[o] * weight[o];
    double sum = 0;
    single_bounces(facets, all, wo, [&](Vec3d wi, double share) {
      lobe.add(o, wi.z, share);
      sum += share;
    });
    for (Values& line : lobe.to) line[o] *= (1 - lost[o]) / sum;
  }
  for (int i = 0; i < kNodes && mean > 0; ++i)
    for (int o = 0; o < kNodes; ++o) lobe.to[i][o] += lost[o] * lost[i] * weight[i] / mean;
  lobe.normalise();
  return lobe;
}

inline Spread glossy_lobe(double gloss) {
  const Latitude<double> latitude(gloss);
  Spread lobe;
  for (int o = 0; o < kNodes; ++o) {
    const double z = directions().z[o], y = z * z;
    constexpr int kPoints = 512;
    for (int k = 0; k < kPoints; ++k) {  // crowded at both ends
      const double t = (k + 0.5) / kPoints, u = t * t * (3 - 2 * t);
      const double x = latitude.inverse(u, 1 - u, y, 1 - y);
      lobe.add(o, std::sqrt(std::clamp(x, 0.0, 1.0)), 6 * t * (1 - t) / kPoints);
    }
  }
  return lobe;
}

/// `rough_matte`, the mean over the azimuth between both directions.
inline Spread matte_lobe(double roughness) {
  using Matte = RoughMatte<double>;
  const double a = 1 / (1 + Matte::c1 * roughness), more = roughness * a / (Matte::c1 - Matte::c2);
  const auto& [z, weight] = directions();
  Spread lobe;
  for (int o = 0; o < kNodes; ++o) {
    for (int i = 0; i < kNodes; ++i) {
      const double s = std::sqrt((1 - z[o] * z[o]) * (1 - z[i] * z[i]));
      const double single = a * (1 + roughness * s / kPi<double> * (1 / std::max(z[o], z[i]) - 1));
      const double further = more * Matte::loss(z[o]) * Matte::loss(z[i]);
      lobe.to[i][o] = (single + further) * weight[i];
    }
  }
  lobe.normalise();
  return lobe;
}

/// `make(place)` for places along the axis of widths.
template <class Make>
std::vector<Spread> lobes(int count, const Make& make) {
  std::vector<Spread> all(count);
  parallel(count, [&](int k) { all[k] = make(double(k) / (count - 1)); });
  return all;
}

/// The inverses of axes::coat_alpha and axes::gloss.
inline double alpha_at(double place) { return std::max(place * place * place * place, 1e-6); }
inline double gloss_at(double place) { return std::expm1(place * std::log1p(axes::kLargestGloss)); }

}  // namespace mms::materials::tables
