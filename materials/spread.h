// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Lobes as matrices over few directions, with polynomials between, and G of materials/coated.h of
/// these. Round lobes are known along as many |cosines|; stretched facets by fewer, at each of some
/// azimuths of a quarter turn, which they see alike in all four.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/spectrum.h"
#include "base/warp.h"
#include "materials/chebyshev.h"
#include "materials/coated.h"
#include "materials/lobe.h"

namespace mms::materials {

/// `N` directions at Chebyshev's points of axes::spread_direction, both ends among them, where
/// polynomials over it are known.
template <class R, int N>
struct SpreadPoints {
  R place[N], cosine[N], weight[N];  ///< the weights are of the barycentric form

  SpreadPoints() {
    constexpr int last = N - 1;
    for (int k = 0; k <= last; ++k) {
      const R s = std::sin(kPi<R> / 2 * R(k) / R(last));
      place[k] = s * s;
      cosine[k] = limited(axes::spread_cosine(place[k]), R(0), R(1));
      weight[k] = R(k % 2 ? -1 : 1) * (k == 0 || k == last ? R(0.5) : R(1));
    }
  }
  static const SpreadPoints& get() {
    static const SpreadPoints points;
    return points;
  }

  /// What a polynomial's values at the points are multiplied with for that along a |cosine| `z`.
  std::array<R, N> weights_at(R z) const {
    const R x = axes::spread_direction(z);
    std::array<R, N> to;
    R sum = 0;
    for (int k = 0; k < N; ++k) {
      const R d = x - place[k];
      to[k] = weight[k] / (d == 0 ? R(1e-20) : d);
      sum += to[k];
    }
    for (R& w : to) w /= sum;
    return to;
  }
};

/// A round lobe's matrix, of its width.
template <class R>
struct SpreadMatrix {
  static constexpr int kHeights = axes::kSpread, kDirections = kHeights;
  static constexpr int turns(int) { return 1; }
  static constexpr int kCoatSteps = 8;  ///< of `scaled`, where E is to be reflected
  using Values = std::array<R, kDirections>;
  std::array<Values, kDirections> rows{};  ///< as in CoatedTables::spread

  explicit SpreadMatrix(const CoatedLobe<R>& lobe) {
    constexpr int n0 = kDirections * kDirections;
    for (int q = 0; q < 4; ++q) {
      const float* p = lobe.tables->spread + (lobe.width.first + q) * n0;
      for (int k = 0; k < kDirections; ++k)
        for (int j = 0; j < kDirections; ++j)
          rows[k][j] += lobe.width.weight[q] * R(p[k * kDirections + j]);
    }
  }

  /// What G counts as at least, over g.
  R least_mean() const { return 0; }
  /// How much of T shows in G^2, whose rest is nearly a polynomial.
  R shown() const { return 1; }

  /// What values at the directions are multiplied with for that along the direction of `lobe`.
  static Values weights_at(const CoatedLobe<R>& lobe) {
    return SpreadPoints<R, kDirections>::get().weights_at(lobe.z);
  }

  /// int K `of` |cos i| di along the directions, for `count` functions.
  void means(const Values* of, int count, Values* to) const {
    std::fill_n(to, count, Values{});
    for (int n = 0; n < count; ++n)
      for (int k = 0; k < kDirections; ++k)
        for (int j = 0; j < kDirections; ++j) to[n][j] += rows[k][j] * of[n][k];
  }
};

/// That of stretched facets, of both their widths: as large as 50 of the other.
template <class R>
class StretchedMatrix {
 public:
  static constexpr int kHeights = axes::kStretchedSpread;
  static constexpr int turns(int height) {
    return height < kHeights - axes::kSpreadOfFew ? axes::kSpreadTurns : axes::kFewSpreadTurns;
  }
  static constexpr int kDirections =
      (kHeights - axes::kSpreadOfFew) * axes::kSpreadTurns +
      axes::kSpreadOfFew * axes::kFewSpreadTurns;  ///< those of a height are together
  static constexpr int kCoatSteps = 6;
  using Values = std::array<R, kDirections>;

  StretchedMatrix() {}  // not zeroed

  bool is_of(const CoatedLobe<R>& lobe) const {
    return lobe.tables == tables_ && lobe.along.mean == mean_ && ring(lobe) == ring_;
  }
  /// Makes it the matrix of a lobe, which takes long.
  void read(const CoatedLobe<R>& lobe) {
    tables_ = lobe.tables, mean_ = lobe.along.mean, ring_ = ring(lobe);
    const auto root = Stencil<R>::at(axes::interface_alpha(mean_), tables_->spread_alpha);
    constexpr int n1 = kDirections * kDirections, n0 = n1 * coefficients(axes::kSpreadRings);
    for (int k = 0; k < kDirections; ++k) {
      Values row{};
      add_terms(row.data(), kDirections, tables_->spread_stretched + k * kDirections, R(1), root,
                n0, ring_, n1);
      std::copy(row.begin(), row.end(), rows_ + k * kDirections);
    }
  }

  /// Less than G is along the surface, where broad lobes lead most away; of narrow ones, of which
  /// few directions know, polynomials may swing below 0.
  R least_mean() const { return std::min(R(0.002) / mean_, R(0.1)); }
  /// The broader lobes are, the more they blur the fringes of a film, which T has.
  R shown() const {
    constexpr R blurs = R(0.03);
    return 1 / (1 + mean_ * mean_ / (blurs * blurs));
  }

  static Values weights_at(const CoatedLobe<R>& lobe) {
    const auto heights = SpreadPoints<R, kHeights>::get().weights_at(lobe.z);
    const FacetsAlong<R>& f = lobe.along;
    const R turn = axes::spread_turn(f.x, f.y, f.wide / f.narrow);
    const R x = (1 + std::cos(kPi<R> * turn)) / 2;
    const auto many = chebyshev_weights<axes::kSpreadTurns>(x);
    const auto few = chebyshev_weights<axes::kFewSpreadTurns>(x);
    Values to;
    int k = 0;
    for (int h = 0; h < kHeights; ++h)
      for (int t = 0; t < turns(h); ++t)
        to[k++] = heights[h] * (turns(h) == axes::kSpreadTurns ? many[t] : few[t]);
    return to;
  }

  /// int K `of` |cos i| di along the directions, for `count` functions: of a few rows at a time,
  /// which stay in the cache, for all of them.
  void means(const Values* of, int count, Values* to) const {
    constexpr int kRows = 32;
    static_assert(kDirections % kRows == 0);
    std::fill_n(to, count, Values{});
    for (int first = 0; first < kDirections; first += kRows)
      for (int n = 0; n < count; ++n) {
        WeightedRows<R, kRows> rows;
        for (int k = first; k < first + kRows; ++k) rows.add(k * kDirections, of[n][k]);
        add_rows(to[n].data(), kDirections, rows_, rows);
      }
  }

 private:
  static Stencil<R> ring(const CoatedLobe<R>& lobe) {
    return Stencil<R>::at(axes::ring(lobe.along.wide, lobe.along.narrow), axes::kSpreadRings);
  }

  const CoatedTables* tables_ = nullptr;
  R mean_;  ///< of both widths
  Stencil<R> ring_;
  float rows_[kDirections * kDirections];  ///< as CoatedTables has them
};

/// Calls `visit(first, count, z)` for each |cosine| z of the directions of a matrix, which `count`
/// of them from the first on have.
template <class Matrix, class R, class Visit>
inline void for_each_height(const Visit& visit) {
  const auto& cosine = SpreadPoints<R, Matrix::kHeights>::get().cosine;
  for (int h = 0, first = 0; h < Matrix::kHeights; first += Matrix::turns(h++))
    visit(first, Matrix::turns(h), cosine[h]);
}

/// int K g |cos i| di along the direction of `lobe`, of whose widths `matrix` is, for `g` of the
/// |cosine|.
template <class Matrix, class R, class G>
inline R mean_along(const Matrix& matrix, const CoatedLobe<R>& lobe, const G& g) {
  typename Matrix::Values of, all;
  for_each_height<Matrix, R>(
      [&](int first, int count, R z) { std::fill_n(&of[first], count, g(z)); });
  matrix.means(&of, 1, &all);
  const auto weights = Matrix::weights_at(lobe);
  R sum = 0;
  for (int k = 0; k < Matrix::kDirections; ++k) sum += weights[k] * all[k];
  return sum;
}

/// By a power of what is still wrong, an eigenvalue l of K leaves 1 - power (1 + l) of its error.
/// That of a step of some, which together are the best for l in [-0.2, 1] (Chebyshev): broad facets
/// lead light along the normal to the surface, and back, so that some l are negative. Four leave a
/// 230th at most.
template <class R>
inline R scaling_power(int step, int steps) {
  return 1 / (R(1.4) - R(0.6) * std::cos(kPi<R> * (R(step) + R(0.5)) / R(steps)));
}

/// G of materials/coated.h for a lobe that is to reflect each of `count` shares, by powers of what
/// is still wrong (Knight, Ruiz and Ucar 2014), of first order. Four steps leave less than 1e-4
/// where T is to be reflected, Matrix::kCoatSteps where E is.
template <class Matrix, class Values = typename Matrix::Values>
inline void scaled(const Matrix& matrix, const Values* shares, int count, int steps,
                   Values* means) {
  using R = typename Values::value_type;
  Values all[kWavelengths];
  std::copy_n(shares, count, all);
  const R least = matrix.least_mean();
  // Of each g, its mean and the share; along the surface nothing may pass.
  const auto for_each = [&](const auto& visit) {
    for (int n = 0; n < count; ++n)
      for (std::size_t k = 0; k < all[n].size(); ++k)
        if (shares[n][k] > 0) visit(all[n][k], means[n][k], shares[n][k]);
  };
  const auto spread = [&] {
    matrix.means(all, count, means);
    for (int n = 0; n < count; ++n)
      for (std::size_t k = 0; k < all[n].size(); ++k)
        means[n][k] = std::max({means[n][k], least * all[n][k], R(1e-6)});
  };
  spread();
  for_each([](R& g, R mean, R share) { g = share / std::sqrt(mean); });
  spread();
  for (int step = 0; step < steps; ++step) {
    const R power = scaling_power<R>(step, steps);
    for_each([&](R& g, R mean, R share) {
      g *= std::max(1 + power * (share / (g * mean) - 1), R(0.2));
    });
    spread();
  }
}

}  // namespace mms::materials
