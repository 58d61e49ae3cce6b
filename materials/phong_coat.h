// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// `phong_glass` below coats (materials/glass_coat.h). In its terms of momentum what coats send
/// back is, with K about the momentum of wo, and z the cosine of a direction outside of momentum p,
///
///   int K g(z) d^2 p     over |p| < 1
///
/// of g = E times a half of what Fresnel says of both directions. As there that is a sum over
/// points, and a table that is computed when the project is built (materials/tables/phong.cpp)
/// holds their weights for any exponent and momentum.

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/glass_coat.h"
#include "materials/lobe.h"
#include "materials/radial.h"
#include "materials/spline.h"

namespace mms::materials {

/// [exponent][momentum][point].
extern const float* const kPhongWeights;

namespace axes {
inline constexpr int kPhongExponent = 40, kPhongMomentum = 96;

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
/// From 0 to 1 for momenta from 0 to 2, beyond which none is that of a direction outside. What is
/// there goes as roots of 1 - `momentum` do, blurred by K.
template <class R>
inline R phong_momentum(R momentum, R n) {
  const R area = phong_area(n);
  const auto root = [area](R under) {
    const R far = std::sqrt(under * under + area) + std::abs(under);
    return std::sqrt(std::sqrt(under > 0 ? far : area / far));
  };
  const R from = root(R(1));
  return (from - root(1 - momentum)) / (from - root(R(-1)));
}
}  // namespace axes

/// The weights for light of that momentum. \pre the exponent is not above kMaxExponent
template <class R>
inline std::array<R, kGlassPoints> phong_weights(R n, R momentum) {
  using namespace axes;
  std::array<R, kGlassPoints> weights{};
  constexpr int n1 = kGlassPoints, n0 = n1 * coefficients(kPhongMomentum);
  add_terms(weights.data(), kGlassPoints, kPhongWeights, R(1),
            Stencil<R>::at(phong_exponent(n), kPhongExponent), n0,
            Stencil<R>::at(phong_momentum(momentum, n), kPhongMomentum), n1);
  return weights;
}

}  // namespace mms::materials
