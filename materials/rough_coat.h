// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Coats and the lobes below them at few directions, with polynomials between: where G of
/// materials/coated.h is not in a table it is solved for, once for all directions
/// (materials/under_coats.h, materials/two_coats.h).

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

  bool operator==(const CoatPart&) const = default;
};

/// The lobes of a coat, none of them stretched.
template <class R>
struct CoatParts {
  static constexpr int kMost = 4;
  std::array<CoatPart<R>, kMost> parts;
  int count = 0;

  bool operator==(const CoatParts&) const = default;
  std::span<const CoatPart<R>> span() const { return {parts.data(), std::size_t(count)}; }
  /// One that is no mirror, if any.
  const CoatLobe<R>* rough() const {
    for (int k = 0; k < count; ++k)
      if (parts[k].lobe.known()) return &parts[k].lobe;
    return nullptr;
  }
};

/// Coats above a lobe, and their indices of each wavelength: one, or one of a single lobe or of a
/// mirror right under another. All that is solved for depends on these.
template <class R>
struct Coats {
  using Indices = std::array<R, kWavelengths>;
  CoatParts<R> above;
  Indices above_ior{};
  CoatLobe<R> lower{};
  Indices lower_ior{};  ///< 0: there is one

  bool operator==(const Coats&) const = default;
};

/// A lobe's matrix, of its width.
template <class R>
struct SpreadMatrix {
  static constexpr int kDirections = axes::kSpread;
  using Values = std::array<R, kDirections>;
  std::array<Values, CoatedTables::kColumns> rows{};  ///< as in CoatedTables::spread

  explicit SpreadMatrix(const CoatedLobe<R>& lobe) {
    constexpr int n0 = CoatedTables::kColumns * kDirections;
    for (int q = 0; q < 4; ++q) {
      const float* p = lobe.tables->spread + (lobe.width.first + q) * n0;
      for (int k = 0; k < CoatedTables::kColumns; ++k)
        for (int j = 0; j < kDirections; ++j)
          rows[k][j] += lobe.width.weight[q] * R(p[k * kDirections + j]);
    }
  }

  const Values& cosines() const { return rows[kDirections]; }
  const Values& places() const { return rows[kDirections + 1]; }  ///< axes::coat_direction

  /// int K `of` |cos i| di along the directions.
  Values mean(const Values& of) const {
    Values sum{};
    for (int k = 0; k < kDirections; ++k)
      for (int j = 0; j < kDirections; ++j) sum[j] += rows[k][j] * of[k];
    return sum;
  }
  /// int `of` 2 z dz.
  R hemispherical_mean(const Values& of) const {
    R sum = 0;
    for (int k = 0; k < kDirections; ++k) sum += rows[kDirections + 2][k] * of[k];
    return sum;
  }
};

/// g and G of materials/coated.h for a lobe under what lets T = `through` pass.
template <class R>
struct Scaling {
  using Values = typename SpreadMatrix<R>::Values;
  Values g, mean;

  /// Scaling by a power of what is still wrong (Knight, Ruiz and Ucar 2014), of first order: an
  /// eigenvalue l of K in [0, 1] leaves 1 - power (1 + l) of its error. Two powers in turn are the
  /// best of two (Chebyshev), a seventeenth at most: two steps leave 1e-3, four less than 1e-4.
  Scaling(const SpreadMatrix<R>& matrix, const Values& through, int steps = 4) : g(through) {
    const auto spread = [&] {
      mean = matrix.mean(g);
      for (R& m : mean) m = std::max(m, R(1e-6));
    };
    const int n = int(g.size());
    spread();
    for (int k = 0; k < n; ++k) g[k] = through[k] / std::sqrt(mean[k]);
    spread();
    constexpr R root = R(0.25) * std::numbers::sqrt2_v<R>,
                power[] = {1 / (R(1.5) + root), 1 / (R(1.5) - root)};
    for (int step = 0; step < steps; ++step) {
      for (int k = 0; k < n; ++k)  // along the surface nothing may pass
        if (g[k] > 0)
          g[k] *= std::max(1 + power[step % 2] * (through[k] / (g[k] * mean[k]) - 1), R(0.2));
      spread();
    }
  }
};

/// The one index, above 1, of all wavelengths, or three with quadratics between.
template <class R>
struct FewIndices {
  static constexpr int kMost = 3;
  int count = 0;     ///< 0: none is above 1
  R place[kMost]{};  ///< axes::index
  std::array<std::array<R, kMost>, kWavelengths> weight;

  explicit FewIndices(const R* ior) {
    R all[kWavelengths], least = 1, most = 0;
    for_each_index(ior, [&](int j, bool) {
      const R eta = relative_eta(ior[j], Vec3<R>{0, 0, 1});
      all[j] = axes::index(eta);
      if (eta > 1) least = std::min(least, all[j]), most = std::max(most, all[j]);
    });
    count = least < most ? kMost : least == most ? 1 : 0;
    for (int n = 0; n < count; ++n) place[n] = least + R(n) / 2 * (most - least);
    for (int j = 0; j < kWavelengths; ++j) {
      const R t = count > 1 ? 2 * (all[j] - least) / (most - least) : R(0);
      weight[j] = {(1 - t) * (2 - t) / 2, t * (2 - t), t * (t - 1) / 2};
    }
  }

  /// For wavelength j, of what there is for each index.
  template <class Values>
  Values between(int j, const Values* of) const {
    Values sum{};
    for (int n = 0; n < count; ++n)
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight[j][n] * of[n][k];
    return sum;
  }
};

/// 1 - E of a coat of an index at `place`, along the directions of a matrix.
template <class R>
inline typename SpreadMatrix<R>::Values let_through(const CoatLobe<R>& coat, R place,
                                                    const SpreadMatrix<R>& matrix) {
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
  typename SpreadMatrix<R>::Values through;
  for (int k = 0; k < kSpread; ++k) {
    const FresnelSplit<R> s = fresnel_split(limited(matrix.cosines()[k], R(0), R(1)), eta);
    const R difference = interpolate(line, Stencil<R>::at(matrix.places()[k], kCoatDirection));
    through[k] = (s.transmitted + 1 - coat.mean_of(s.reflected, difference)) / 2;
  }
  return through;
}
template <class R>
inline typename SpreadMatrix<R>::Values let_through(std::span<const CoatPart<R>> coat, R place,
                                                    const SpreadMatrix<R>& matrix) {
  typename SpreadMatrix<R>::Values through{};
  for (const CoatPart<R>& part : coat) {
    const auto of_part = let_through(part.lobe, place, matrix);
    for (int k = 0; k < axes::kSpread; ++k) through[k] += part.share * of_part[k];
  }
  return through;
}

}  // namespace mms::materials
