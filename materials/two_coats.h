// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Two coats, one right under the other. The upper one lets T through; the lower one's lobe K, as
/// any below a coat, is scaled by g(o) g(i) (materials/coated.h), where it reflects F of Fresnel's.
/// So of T it sends back
///
///   (F + M) / 2,   M(o) = int F' g(i) K(o, i) |cos i| di / G(o)
///
/// which is what it does alone, but for the g in the mean; S is what is left, and T S what lobes
/// below both are scaled for. A Lambert's lobe times T T' S S' / mean (T S) sends it back exactly:
/// a white matte below white `glossy`, `microfacet`, `beckmann` and mirrors keeps its energy
/// within 1e-4.

#include <algorithm>
#include <array>
#include <span>

#include "base/spectrum.h"
#include "materials/coat_lobe.h"
#include "materials/coated.h"
#include "materials/fresnel.h"
#include "materials/lobe.h"
#include "materials/rough_coat.h"

namespace mms::materials {

/// S of one coat of a single lobe or of a mirror, under another of any number; none is stretched.
template <class R>
class LowerCoat {
  using Values = typename SpreadMatrix<R>::Values;

 public:
  void solve(const Coats<R>& coats) {
    coats_ = coats;
    const auto& [above, ior_above, lobe, ior] = coats_;
    for (int j = 0; j < kWavelengths; ++j) {
      const bool repeated = j > 0 && ior[j] == ior[j - 1] && ior_above[j] == ior_above[j - 1];
      first_[j] = repeated ? first_[j - 1] : j;
      eta_[j] = relative_eta(ior[j], Vec3<R>{0, 0, 1});
      eta_above_[j] = relative_eta(ior_above[j], Vec3<R>{0, 0, 1});
    }
    if (const CoatLobe<R>* rough = lobe.known() ? &lobe : above.rough())
      solve(SpreadMatrix<R>(CoatedLobe<R>::of(*rough)), FewIndices<R>(ior_above.data()));
    else
      for_each_solution([&](int j) { mean_[j] = mean_through(eta_[j], eta_above_[j]); });
  }

  bool solves(const Coats<R>& coats) const { return coats == coats_; }
  const Coats<R>& coats() const { return coats_; }

  /// The first wavelength of the same indices as j.
  int first_like(int j) const { return first_[j]; }
  /// Whether both indices are above 1: elsewhere there is no more.
  bool known(int j) const { return eta_[j] > 1 && eta_above_[j] > 1; }
  /// The mean of T S.
  R mean(int j) const { return mean_[first_[j]]; }

  /// S along a direction of |cosine| `z`; `alone` is what the coat does without the upper ones.
  Spectrum<R> along(const CoatAlong<R>& alone, R z) const {
    Spectrum<R> left = alone.through;
    if (!coats_.lower.known()) return left;
    const Values weights = weights_at(z);
    for (int j = 0; j < kWavelengths; ++j) {
      const R f = alone.reflected[j];
      if (first_[j] != j)
        left[j] = left[first_[j]];
      else if (known(j))
        left[j] = left_of(j, {f, 1 - f}, weights);
    }
    return left;
  }

  /// T S along the directions of a matrix. \pre known(j)
  Values through_both(int j, const SpreadMatrix<R>& matrix) const {
    Values through = let_through(coats_.above.span(), axes::index(eta_above_[j]), matrix);
    for (int k = 0; k < axes::kSpread; ++k) {
      const R z = limited(matrix.cosines()[k], R(0), R(1));
      const FresnelSplit<R> f = fresnel_split(z, eta_[j]);
      through[k] *= coats_.lower.known() ? left_of(j, f, weights_at(z)) : f.transmitted;
    }
    return through;
  }

 private:
  template <class Visit>
  void for_each_solution(Visit visit) const {
    for (int j = 0; j < kWavelengths; ++j)
      if (first_[j] == j && known(j)) visit(j);
  }

  void solve(const SpreadMatrix<R>& matrix, const FewIndices<R>& few) {
    Values through[FewIndices<R>::kMost], g[FewIndices<R>::kMost];
    for (int n = 0; n < few.count; ++n) {
      through[n] = let_through(coats_.above.span(), few.place[n], matrix);
      if (coats_.lower.known()) g[n] = Scaling<R>(matrix, through[n], 2).g;
    }
    for_each_solution([&](int j) {
      Values reflected, left;
      for (int k = 0; k < axes::kSpread; ++k) {
        const R z = limited(matrix.cosines()[k], R(0), R(1));
        const FresnelSplit<R> f = fresnel_split(z, eta_[j]);
        reflected[k] = f.reflected;
        left[k] = f.transmitted;
      }
      if (coats_.lower.known()) {
        const Values scaling = few.between(j, g);
        Values sent = scaling;
        for (int k = 0; k < axes::kSpread; ++k) sent[k] *= reflected[k];
        const Values all = matrix.mean(scaling), back = matrix.mean(sent);
        for (int k = 0; k < axes::kSpread; ++k) {
          difference_[j][k] = back[k] / std::max(all[k], R(1e-6)) - reflected[k];
          left[k] -= difference_[j][k] / 2;
        }
      }
      const Values above = few.between(j, through);
      for (int k = 0; k < axes::kSpread; ++k) left[k] *= above[k];
      mean_[j] = matrix.hemispherical_mean(left);
    });
  }

  Values weights_at(R z) const {
    return SpreadPoints<R>::get().weights_at(
        axes::spread_direction(std::min(z, R(1)), coats_.lower.cosines));
  }
  R left_of(int j, const FresnelSplit<R>& f, const Values& weights) const {
    R difference = 0;
    for (int k = 0; k < axes::kSpread; ++k) difference += weights[k] * difference_[j][k];
    return (f.transmitted + 1 - coats_.lower.mean_of(f.reflected, difference)) / 2;
  }

  Coats<R> coats_;
  int first_[kWavelengths];
  R eta_[kWavelengths], eta_above_[kWavelengths];
  // Of the first wavelengths only.
  R mean_[kWavelengths];
  Values difference_[kWavelengths];  ///< M - F at the points of the lobe
};

}  // namespace mms::materials
