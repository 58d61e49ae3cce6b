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
/// the energy of coat and base is 1 within 1e-3. Of stretched facets only a share gets such a
/// factor, the rest one that loses (materials/combine.h), as the factor is that of round facets and
/// alone would gain up to 4% at some azimuths: they lose up to 10% and gain 2e-3 at most.

#include "materials/energy.h"

namespace mms::materials {

/// [width][index][direction] along the axes of a coat (materials/energy.h).
extern const float* const kGgxCoated;
extern const float* const kBeckmannCoated;
extern const float* const kGlossyCoated;

/// One lobe's width; of stretched facets, along one direction.
template <class R>
struct CoatedLobe {
  const float* table;
  Stencil<R> width;
  R share = 1;  ///< how much of it is known

  static CoatedLobe facets(const float* table, R alpha, R share = 1) {
    return {table, Stencil<R>::at(axes::coat_alpha(alpha), axes::kCoatAlpha), share};
  }
  static CoatedLobe glossy(R gloss) {
    return {kGlossyCoated, Stencil<R>::at(axes::gloss(gloss), axes::kGloss), R(1)};
  }

  /// G^2 along a direction of |cosine| `z`, for relative index `eta` > 1 and T = `through` there.
  /// Nowhere below half of T: what rounding leaves of it next to the surface is kept from 0.
  R mean_squared(R eta, R z, R through) const {
    return std::max(through + interpolate_coat(table, width, eta, z), through / 2);
  }
};

}  // namespace mms::materials
