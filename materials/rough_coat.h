// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What lobes are scaled by under a coat whose own lobe is rough: G of materials/coated.h, solved
/// for once where light is seen along one direction, at few directions with polynomials between.
/// White facets, `glossy` and `rough_matte` below a white `glossy`, `microfacet` or `beckmann`,
/// none of them stretched, keep their energy within 1e-4, for indices from 1.02 to 4 (next to a
/// mirror, of a roughness below 0.1, 1e-3; above 4, 2e-3).

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "base/spectrum.h"
#include "base/warp.h"
#include "materials/coated.h"
#include "materials/energy.h"
#include "materials/fresnel.h"
#include "materials/lobe.h"

namespace mms::materials {

/// Chebyshev's points on [0, 1], where polynomials over axes::spread_direction are known.
template <class R>
struct SpreadPoints {
  R place[axes::kSpread], weight[axes::kSpread];  ///< the weights are of the barycentric form

  SpreadPoints() {
    constexpr int last = axes::kSpread - 1;
    for (int k = 0; k <= last; ++k) {
      const R s = std::sin(kPi<R> / 2 * R(k) / R(last));
      place[k] = s * s;
      weight[k] = R(k % 2 ? -1 : 1) * (k == 0 || k == last ? R(0.5) : R(1));
    }
  }
  static const SpreadPoints& get() {
    static const SpreadPoints points;
    return points;
  }

  /// What a polynomial's values at the points are multiplied with for its value at `x`.
  std::array<R, axes::kSpread> weights_at(R x) const {
    std::array<R, axes::kSpread> to;
    R sum = 0;
    for (int k = 0; k < axes::kSpread; ++k) {
      const R d = x - place[k];
      to[k] = weight[k] / (d == 0 ? R(1e-20) : d);
      sum += to[k];
    }
    for (R& w : to) w /= sum;
    return to;
  }
};

/// One lobe of a coat, not stretched, and how much of the coat it is. A mirror has no tables.
template <class R>
struct CoatPart {
  CoatLobe<R> lobe{};
  R share = 1;
};

/// G of lobes that are not stretched, under one rough coat.
template <class R>
class UnderRoughCoat {
  static constexpr int kDirections = axes::kSpread, kIndices = 3;
  using Values = std::array<R, kDirections>;
  using Columns = std::array<Values, CoatedTables::kColumns>;

 public:
  /// For the coat's index of each wavelength, `ior`; where that is above 1. Of three indices if
  /// they differ, with quadratics between.
  void solve(const CoatedLobe<R>& base, std::span<const CoatPart<R>> coat, const R* ior) {
    R place[kWavelengths], least = 1, most = 0;
    for_each_index(ior, [&](int j, bool) {
      const R eta = relative_eta(ior[j], Vec3<R>{0, 0, 1});
      place[j] = axes::index(eta);
      if (eta > 1) least = std::min(least, place[j]), most = std::max(most, place[j]);
    });
    count_ = least < most ? kIndices : least == most ? 1 : 0;
    if (count_ == 0) return;
    constexpr int n0 = CoatedTables::kColumns * kDirections;
    Columns columns{};
    for (int q = 0; q < 4; ++q) {
      const float* p = base.tables->spread + (base.width.first + q) * n0;
      for (int k = 0; k < CoatedTables::kColumns; ++k)
        for (int j = 0; j < kDirections; ++j)
          columns[k][j] += base.width.weight[q] * R(p[k * kDirections + j]);
    }
    for (int n = 0; n < count_; ++n)
      above_[n] = solve(columns, let_through(coat, least + R(n) / 2 * (most - least),
                                             columns[kDirections], columns[kDirections + 1]));
    for (int j = 0; j < kWavelengths; ++j) {
      const R t = count_ > 1 ? 2 * (place[j] - least) / (most - least) : R(0);
      weight_[j] = {(1 - t) * (2 - t) / 2, t * (2 - t), t * (t - 1) / 2};
    }
  }

  /// What `mean_squared` takes of a direction of |cosine| `z`.
  using Along = std::array<R, kIndices>;
  Along along(const CoatedLobe<R>& base, R z) const {
    const Values weights =
        SpreadPoints<R>::get().weights_at(axes::spread_direction(z, base.cosines));
    Along above{};
    for (int n = 0; n < count_; ++n)
      for (int k = 0; k < kDirections; ++k) above[n] += weights[k] * above_[n][k];
    return above;
  }

  /// G^2 of wavelength j, for T = `through` along the direction.
  R mean_squared(int j, const Along& along, R through) const {
    R sum = through;
    for (int n = 0; n < kIndices; ++n) sum += weight_[j][n] * along[n];
    return std::max(sum, through / 2);
  }

 private:
  /// G^2 - T. Scaling by a power of what is still wrong (Knight, Ruiz and Ucar 2014), of first
  /// order: an eigenvalue l of K in [0, 1] leaves 1 - power (1 + l) of its error. Two powers in
  /// turn are the best of two (Chebyshev), a seventeenth at most.
  static Values solve(const Columns& columns, const Values& through) {
    Values g = through, mean;
    const auto spread = [&] {
      mean.fill(0);
      for (int k = 0; k < kDirections; ++k)
        for (int j = 0; j < kDirections; ++j) mean[j] += columns[k][j] * g[k];
      for (R& m : mean) m = std::max(m, R(1e-6));
    };
    spread();
    for (int k = 0; k < kDirections; ++k) g[k] = through[k] / std::sqrt(mean[k]);
    spread();
    constexpr R root = R(0.25) * std::numbers::sqrt2_v<R>,
                power[] = {1 / (R(1.5) + root), 1 / (R(1.5) - root)};
    for (int n = 0; n < 6; ++n) {
      for (int k = 0; k < kDirections; ++k)
        g[k] *= std::max(1 + power[n % 2] * (through[k] / (g[k] * mean[k]) - 1), R(0.2));
      spread();
    }
    for (int k = 0; k < kDirections; ++k) mean[k] = mean[k] * mean[k] - through[k];
    return mean;
  }

  /// 1 - E of the coat of an index at `place`, along directions of |cosine| z and the
  /// axes::coat_direction d.
  static Values let_through(std::span<const CoatPart<R>> coat, R place, const Values& z,
                            const Values& d) {
    Values through{};
    for (const CoatPart<R>& part : coat) {
      const Values of_part = let_through(part.lobe, place, z, d);
      for (int k = 0; k < kDirections; ++k) through[k] += part.share * of_part[k];
    }
    return through;
  }
  static Values let_through(const CoatLobe<R>& coat, R place, const Values& z, const Values& d) {
    using namespace axes;
    const R x = std::min(place * place * place * place, R(1 - 1e-6)), eta = (1 + x) / (1 - x);
    const auto n = Stencil<R>::at(place, kCoatIndex);
    constexpr int n1 = coefficients(kCoatDirection), n0 = n1 * coefficients(kCoatIndex);
    R line[n1] = {};
    for (int i = 0; coat.known() && i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const float* p = coat.tables->round + (coat.width.first + i) * n0 + (n.first + j) * n1;
        for (int k = 0; k < n1; ++k) line[k] += coat.width.weight[i] * n.weight[j] * R(p[k]);
      }
    Values through;
    for (int k = 0; k < kDirections; ++k) {
      const FresnelSplit<R> s = fresnel_split(limited(z[k], R(0), R(1)), eta);
      through[k] =
          (s.transmitted + 1 -
           coat.mean_of(s.reflected, interpolate(line, Stencil<R>::at(d[k], kCoatDirection)))) /
          2;
    }
    return through;
  }

  int count_;                                                 ///< of indices; 0: none is above 1
  Values above_[kIndices];                                    ///< G^2 - T at the points
  std::array<std::array<R, kIndices>, kWavelengths> weight_;  ///< of the indices
};

}  // namespace mms::materials
