// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What lobes are scaled by under one rough coat, and under two of any kind. White facets, `glossy`
/// and `rough_matte` below a white `glossy`, `microfacet` or `beckmann`, none of them stretched,
/// keep their energy within 1e-4, for indices from 1.02 to 4 (next to a mirror, of a roughness
/// below 0.1, 1e-3; above 4, 2e-3).

#include <algorithm>
#include <array>
#include <span>

#include "materials/coated.h"
#include "materials/lobe.h"
#include "materials/rough_coat.h"
#include "materials/two_coats.h"

namespace mms::materials {

/// G of a lobe that is not stretched.
template <class R>
class UnderCoats {
  static constexpr int kMost = kWavelengths, kNear = FewIndices<R>::kMost;
  using Values = typename SpreadMatrix<R>::Values;

 public:
  /// For the wavelengths of which all indices are above 1. `lower` is solved for two coats, and
  /// null for one.
  void solve(const CoatedLobe<R>& base, const Coats<R>& coats, const LowerCoat<R>* lower) {
    base_ = base;
    coats_ = coats;
    lower ? solve_two(*lower) : solve_one();
  }
  bool solves(const CoatedLobe<R>& base, const Coats<R>& coats, const LowerCoat<R>*) const {
    return base.is_like(base_) && coats == coats_;
  }

  /// What `mean_squared` takes of a direction of |cosine| `z`.
  using Along = std::array<R, kMost + kNear - 1>;
  Along along(R z) const {
    const Values weights =
        SpreadPoints<R>::get().weights_at(axes::spread_direction(z, base_.cosines));
    Along above{};
    for (int n = 0; n < count_; ++n)
      for (int k = 0; k < axes::kSpread; ++k) above[n] += weights[k] * above_[n][k];
    return above;
  }

  /// G^2 of wavelength j, for T = `through` along the direction.
  R mean_squared(int j, const Along& along, R through) const {
    R sum = through;
    for (int n = 0; n < kNear; ++n) sum += weight_[j][n] * along[near_[j] + n];
    return std::max(sum, through / 2);
  }

 private:
  void solve_one() {
    const FewIndices<R> few(coats_.above_ior.data());
    near_.fill(0);
    weight_ = few.weight;
    solve(few.count, [&](int n, const SpreadMatrix<R>& matrix) {
      return let_through(coats_.above.span(), few.place[n], matrix);
    });
  }

  void solve_two(const LowerCoat<R>& lower) {
    int at[kMost], count = 0;
    for (int j = 0; j < kWavelengths; ++j) {
      const int first = lower.first_like(j);
      weight_[j] = {R(1)};
      near_[j] = 0;
      if (!lower.known(j)) continue;
      if (first == j) at[count++] = j;
      near_[j] = first == j ? count - 1 : near_[first];
    }
    solve(count,
          [&](int n, const SpreadMatrix<R>& matrix) { return lower.through_both(at[n], matrix); });
  }

  template <class Through>
  void solve(int count, const Through& through_of) {
    count_ = count;
    if (count == 0) return;
    const SpreadMatrix<R> matrix(base_);
    for (int n = 0; n < count; ++n) {
      const Values through = through_of(n, matrix);
      const Scaling<R> scaled(matrix, through);
      for (int k = 0; k < axes::kSpread; ++k)
        above_[n][k] = scaled.mean[k] * scaled.mean[k] - through[k];
    }
  }

  CoatedLobe<R> base_;
  Coats<R> coats_;
  int count_;                                              ///< of solutions
  Values above_[kMost];                                    ///< G^2 - T at the points
  std::array<int, kWavelengths> near_;                     ///< the first solution of a wavelength
  std::array<std::array<R, kNear>, kWavelengths> weight_;  ///< of that and the next
};

}  // namespace mms::materials
