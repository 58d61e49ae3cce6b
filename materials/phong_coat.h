// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// `phong_glass` below coats (materials/glass_coat.h). In its terms of momentum what coats send
/// back is, with K about the momentum of wo, and z the cosine of a direction outside of momentum p,
///
///   int K g(z) d^2 p     over |p| < 1
///
/// of g = E times a half of what Fresnel says of both directions. As there that is a sum over
/// points, and tables that are computed when the project is built (materials/tables/phong.cpp)
/// hold their weights for any exponent and momentum.
///
/// Where the index of glass is the lower one, momenta outside go up to N = 1 / index, and F has an
/// edge at 1, beyond which it is 1: another table, for all momenta up to N, has a second set of
/// weights besides, for F times g.

#include <algorithm>
#include <cmath>

#include "materials/chebyshev.h"
#include "materials/fresnel.h"
#include "materials/glass_coat.h"
#include "materials/lobe.h"
#include "materials/radial.h"
#include "materials/spline.h"

namespace mms::materials {

struct PhongGlassTables {
  const float* rises;  ///< [exponent][momentum][point], of glass of a higher index than outside
  const float* falls;  ///< [exponent][index][momentum][of both sets][point], of a lower one
};
extern const PhongGlassTables kPhongGlass;

namespace axes {
inline constexpr int kPhongExponent = 40, kPhongMomentum = 96;
inline constexpr int kLowPhongExponent = 40, kLowPhongIndex = 28, kLowPhongMomentum = 44;

/// The mean square of what K adds to a momentum.
template <class R>
inline R phong_area(R n) {
  return 2 / (n + 4);
}
/// From 0 to 1 for exponents from 0 to kMaxExponent: even over the logarithm of that.
template <class R>
inline R phong_exponent(R n) {
  return std::log1p(n / 4) / R(std::log1p(kMaxExponent / 4));
}
/// From 0 to 1 for momenta from 0 to `most`. What is there goes as roots of 1 - `momentum` and of
/// `end` - `momentum` do, blurred by K.
template <class R>
inline R phong_momentum(R momentum, R n, R most, R end) {
  const R area = phong_area(n);
  const auto root = [area](R under) {
    const R far = std::sqrt(under * under + area) + std::abs(under);
    return std::sqrt(std::sqrt(under > 0 ? far : area / far));
  };
  const auto roots = [&](R at) { return root(1 - at) + root(end - at); };
  const R from = roots(R(0));
  return (from - roots(momentum)) / (from - roots(most));
}
/// Glass of a higher index: beyond momenta of 2 none is that of a direction outside.
template <class R>
inline R phong_momentum(R momentum, R n) {
  return phong_momentum(momentum, n, R(2), R(1));
}
/// Of a lower index: up to that of light along the surface outside.
template <class R>
inline R low_phong_momentum(R momentum, R n, R index) {
  return phong_momentum(momentum, n, 1 / index, 1 / index);
}
}  // namespace axes

/// The weights for light along one direction.
template <class R>
struct PhongWeights {
  /// The second half times what Fresnel says of the other direction: of light from inside T, else
  /// F.
  R of[2 * kGlassPoints] = {};

  /// Of light whose direction has the sine `s` and that meets the index `eta`.
  /// \pre the exponent is not above kMaxExponent; glass of a lower index is in_glass_tables
  PhongWeights(R n, R s, R eta, bool inside) {
    using namespace axes;
    const R momentum = eta < 1 ? s / eta : s;
    if (inside ? eta > 1 : eta < 1) {
      constexpr int n2 = 2 * kGlassPoints, n1 = n2 * coefficients(kLowPhongMomentum),
                    n0 = n1 * coefficients(kLowPhongIndex);
      const R place = low_phong_momentum(momentum, n, inside ? 1 / eta : eta);
      add_terms(of, n2, kPhongGlass.falls, R(1),
                Stencil<R>::at(phong_exponent(n), kLowPhongExponent), n0,
                Stencil<R>::at(glass_index(eta), kLowPhongIndex), n1,
                Stencil<R>::at(place, kLowPhongMomentum), n2);
      if (inside)
        for (int i = 0; i < kGlassPoints; ++i) of[kGlassPoints + i] = of[i] - of[kGlassPoints + i];
      return;
    }
    constexpr int n1 = kGlassPoints, n0 = n1 * coefficients(kPhongMomentum);
    add_terms(of, n1, kPhongGlass.rises, R(1), Stencil<R>::at(phong_exponent(n), kPhongExponent),
              n0, Stencil<R>::at(phong_momentum(momentum, n), kPhongMomentum), n1);
    for (int i = 0; i < kGlassPoints; ++i) {
      const FresnelSplit<R> there =
          fresnel_split(R(chebyshev_points<kGlassPoints>()[i]), inside ? 1 / eta : eta);
      of[kGlassPoints + i] = of[i] * (inside ? there.transmitted : there.reflected);
    }
  }
};

}  // namespace mms::materials
