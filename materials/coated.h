// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Lobes that reflect, under a coat. K(o, i) is such a lobe that is white and lossless, so that
/// int K |cos i| di = 1, and T(o) = 1 - F(o) what the coat lets through along o. There is one
/// positive g with
///
///   g(o) G(o) = T(o),   G(o) = int g(i) K(o, i) |cos i| di
///
/// (the scaling of a symmetric kernel to given sums, Sinkhorn 1967), and g(o) g(i) K(o, i) is
/// reciprocal, positive and reflects T exactly: coat and base together lose nothing. For Lambert's
/// lobe g = T / sqrt(mean T); for one that is all but a mirror, sqrt T. Where the base absorbs, its
/// f is below K's, and so is what it reflects.
///
/// Tables hold G^2 - T for each width, index above 1 and direction (materials/tables/coated.cpp):
/// the energy of coat and base is 1 within 1e-4, of facets of a roughness below 0.1 within 2e-4.
/// The factor of stretched facets is that of round ones as wide along the direction, which gains at
/// some azimuths and loses at others: it is lowered by about the most that it gains.

#include "materials/energy.h"

namespace mms::materials {

/// Nodes of these tables, along the axes of a coat. As many indices keep what the spline rings by
/// next to infinity, where T changes fast, from those below 4.
namespace axes {
inline constexpr int kCoatedAlpha = 37, kCoatedGloss = 65, kCoatedIndex = 49;
}

/// [width][index][direction] along the axes of a coat (materials/energy.h).
extern const float* const kGgxCoated;
extern const float* const kBeckmannCoated;
extern const float* const kGlossyCoated;

/// Mean of the product of Fresnel's reflectances of two relative indices: int F G 2 z dz, to 1e-4.
extern const float* const kFresnelProduct;  ///< [index][index]

template <class R>
inline R mean_fresnel_product(R a, R b) {
  using namespace axes;
  const auto x = Stencil<R>::at(index(a), kCoatIndex), y = Stencil<R>::at(index(b), kCoatIndex);
  return interpolate(kFresnelProduct, x, coefficients(kCoatIndex), y);
}

/// One lobe's width; of stretched facets, along one direction.
template <class R>
struct CoatedLobe {
  const float* table;
  Stencil<R> width;
  R scale = 1;  ///< of the factor

  static CoatedLobe facets(const float* table, R alpha, R scale = 1) {
    return {table, Stencil<R>::at(axes::coat_alpha(alpha), axes::kCoatedAlpha), scale};
  }
  static CoatedLobe glossy(R gloss) {
    return {kGlossyCoated, Stencil<R>::at(axes::gloss(gloss), axes::kCoatedGloss), R(1)};
  }

  /// G^2 along a direction of |cosine| `z`, for relative index `eta` > 1 and T = `through` there.
  /// Nowhere below half of T: what rounding leaves of it next to the surface is kept from 0.
  R mean_squared(R eta, R z, R through) const {
    const R above = interpolate_coat<axes::kCoatedIndex>(table, width, eta, z);
    return std::max(through + above, through / 2);
  }
};

}  // namespace mms::materials
