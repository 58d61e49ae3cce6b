// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the programs that make the tables of coats share. Nothing here is used when rendering.

#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/facets.h"

namespace mms::materials::tables {

using Values = std::vector<double>;

/// |Cosine| at a place on the axis of directions.
inline double cosine_at(double place) {
  return std::sin(place * place * place * place * kPi<double> / 2);
}

/// Numbers in (0, 1) and weights that crowd at both ends; `offset` in (0, 1) of a step.
template <class F>
void crowded(int n, double offset, const F& f) {
  for (int k = 0; k < n; ++k) {
    const double u = (k + offset) / n;
    f(u * u * (3 - 2 * u), 6 * u * (1 - u) / n);
  }
}

/// The slope that a share `u` of facets of width 1 does not exceed.
inline double slope(const Ggx<double>&, double u) { return std::sqrt(u / (1 - u)); }
inline double slope(const Beckmann<double>&, double u) { return std::sqrt(-std::log1p(-u)); }

/// Lagrange's cubic through the four nodes from the second below `x` on, a step apart.
struct Cubic {
  int first;
  double weight[4];

  /// `first` stays within [least, most].
  Cubic(double x, int least, int most) : first(std::clamp(int(std::floor(x)) - 1, least, most)) {
    const double a = x - first, b = a - 1, c = a - 2, d = a - 3;
    weight[0] = -b * c * d / 6;
    weight[1] = a * c * d / 2;
    weight[2] = -a * b * d / 2;
    weight[3] = a * b * c / 6;
  }
};

/// G of materials/coated.h of a lobe, as what it lets light through along each direction, from g =
/// T / sqrt(K T), which is nearly right, by the square root of what is still wrong (Knight, Ruiz
/// and Ucar 2014: the symmetric form of Sinkhorn's iteration).
template <class Lobe>
Values scaled_mean(const Lobe& lobe, const Values& through) {
  Values g = through, mean = lobe.mean(g);
  double worst = 1;
  for (int n = 0; n < 100 && worst > 1e-7; ++n) {
    worst = 0;
    for (std::size_t o = 0; o < g.size(); ++o) {
      worst = std::max(worst, std::abs(g[o] * mean[o] - through[o]));
      g[o] = std::sqrt(g[o] * through[o] / mean[o]);
    }
    mean = lobe.mean(g);
  }
  return mean;
}

/// What stretched facets of a distribution have other than round ones: coefficients of
/// [width][index][direction][term of ShapeBasis].
struct StretchedTables {
  std::vector<float> coat, coated;  ///< of CoatTables, and of CoatedTables
};
/// From the tables of round ones, CoatTables::round and CoatedTables::polished.
template <template <class> class Distribution>
StretchedTables stretched_coats(const float* round_coat, const float* round_coated);

}  // namespace mms::materials::tables
