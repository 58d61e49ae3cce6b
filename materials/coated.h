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
/// Tables hold G^2 - T under a polished coat for each width, index above 1 and direction
/// (materials/tables/coated.cpp): the energy of coat and base is 1 within 1e-4. Under a coat whose
/// lobe is rough, T is 1 - E (materials/coat_lobe.h), of another width and an index; there, and
/// below two coats, G is solved for, with K as a matrix over few directions
/// (materials/under_coats.h).
///
/// For stretched facets under a polished coat another table says what theirs is above that of round
/// ones as wide along the direction, as polynomials over the shape that they have along it
/// (materials/tables/stretched_coats.cpp): within 3e-4, beyond anisotropy 0.9 within 1e-3, for
/// indices up to 4.

#include "materials/coat_lobe.h"

namespace mms::materials {

namespace axes {
/// Widths of `rough_matte`, and directions of a lobe's matrix.
inline constexpr int kCoatedMatte = 5, kSpread = 32;

/// Of a direction of |cosine| `z`, for a lobe as wide as cosines of `width`: what a lobe does to
/// smooth functions changes next to there, and what a coat lets through next to grazing.
template <class R>
inline R spread_direction(R z, R width) {
  const R d = coat_direction(z), s = std::sqrt(std::max((1 - z) * (1 + z), R(0)));
  return R(0.35) * d * std::sqrt(d) + R(0.65) * direction(z, s, width);
}
}  // namespace axes

/// Of one kind of lobe.
struct CoatedTables {
  const float* polished;   ///< [width][index][direction] along the axes of a coat
  const float* stretched;  ///< of `polished`, for stretched facets (materials/coat_lobe.h)
  /// [width][column][direction o]: int K l |cos i| di for each of axes::kSpread polynomials l over
  /// axes::spread_direction, which are 1 at one of the directions and 0 at the others. Then the
  /// cosines of these directions, their axes::coat_direction, and int l 2 z dz of the polynomials.
  const float* spread;
  static constexpr int kColumns = axes::kSpread + 3;
};
extern const CoatedTables kGgxCoated, kBeckmannCoated, kGlossyCoated, kMatteCoated;

/// Mean of the product of Fresnel's reflectances of two relative indices: int F G 2 z dz, to 1e-4.
extern const float* const kFresnelProduct;  ///< [index][index]

template <class R>
inline R mean_fresnel_product(R a, R b) {
  using namespace axes;
  const auto x = Stencil<R>::at(index(a), kCoatIndex), y = Stencil<R>::at(index(b), kCoatIndex);
  return interpolate(kFresnelProduct, x, coefficients(kCoatIndex), y);
}

/// Of the product of what two coats let through; of the first alone where there are not two indices
/// above 1.
template <class R>
inline R mean_through(R eta, R above) {
  const R through = mean_through(eta);
  if (!(above > 1 && eta > 1)) return through;
  return through - fresnel_dielectric_diffuse(above) + mean_fresnel_product(eta, above);
}

/// One lobe's width; of stretched facets, along one direction.
template <class R>
struct CoatedLobe {
  const CoatedTables* tables;
  Stencil<R> width;
  R cosines = 1;  ///< the width as that of axes::spread_direction
  FacetsAlong<R> along{nullptr, R(1), R(1), {}};

  static CoatedLobe facets(const CoatedTables& tables, R ax, R ay, Vec3<R> w) {
    const FacetsAlong<R> along(tables.stretched, ax, ay, w);
    return {&tables, CoatLobe<R>::facet_width(along.like), axes::width(along.like), along};
  }
  static CoatedLobe glossy(R gloss) {
    return {&kGlossyCoated, Stencil<R>::at(axes::gloss(gloss), axes::kGloss),
            axes::gloss_width(gloss)};
  }
  /// That of a coat which lies under another. \pre known, and not stretched
  static CoatedLobe of(const CoatLobe<R>& coat) {
    return {coat.tables->coated, coat.width, coat.cosines};
  }
  static CoatedLobe matte(R roughness) {
    return {&kMatteCoated, Stencil<R>::at(roughness, axes::kCoatedMatte)};
  }

  bool stretched() const { return along.table; }
  /// Of lobes that are not stretched.
  bool is_like(const CoatedLobe& other) const {
    return tables == other.tables && width == other.width && cosines == other.cosines;
  }

  /// G^2 - T along a direction of |cosine| `z`, for relative index `eta` > 1.
  R above(R eta, R z) const {
    return interpolate_coat(tables->polished, width, eta, z) + along.difference(eta, z);
  }
  /// G^2, for T = `through` along the direction. Nowhere below half of T: what rounding leaves of
  /// it next to the surface is kept from 0.
  R mean_squared(R eta, R z, R through) const {
    return std::max(through + above(eta, z), through / 2);
  }
};

}  // namespace mms::materials
