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
/// lobe is rough, T is 1 - E (materials/energy.h), of another width and an index; there G is solved
/// for where it is needed, with K as a matrix over few directions (materials/rough_coat.h).
///
/// For stretched facets under a polished coat another table says what theirs is above that of round
/// ones as wide along the direction, as polynomials over the shape that they have along it
/// (materials/tables/stretched_coats.cpp): within 3e-4, beyond anisotropy 0.9 within 1e-3, for
/// indices up to 4.

#include "materials/energy.h"
#include "materials/fresnel.h"

namespace mms::materials {

namespace axes {
/// Widths of `rough_matte`, and directions of a lobe's matrix.
inline constexpr int kCoatedMatte = 5, kSpread = 32;
/// Of stretched facets; the axis of the width is that of an interface.
inline constexpr int kStretchedCoatAlpha = 17, kStretchedCoatIndex = 11,
                     kStretchedCoatDirection = 25, kStretchedCoatDegree = 12;
inline constexpr double kLeastCoatIndex = 0.1, kMostCoatIndex = 0.8801117;  ///< of 1.0002 and 4

template <class R>
inline R stretched_coat_index(R eta) {
  return (index(eta) - R(kLeastCoatIndex)) / R(kMostCoatIndex - kLeastCoatIndex);
}

/// Of a direction of |cosine| `z`, for a lobe as wide as cosines of `width`: what a lobe does to
/// smooth functions changes next to there, and what a coat lets through next to grazing.
template <class R>
inline R spread_direction(R z, R width) {
  const R d = coat_direction(z), s = std::sqrt(std::max((1 - z) * (1 + z), R(0)));
  return R(0.35) * d * std::sqrt(d) + R(0.65) * direction(z, s, width);
}
/// That width of `glossy`.
template <class R>
inline R gloss_width(R gloss) {
  return 1 / std::sqrt(1 + gloss);
}
}  // namespace axes

/// Of one kind of lobe.
struct CoatedTables {
  const float* polished;  ///< [width][index][direction] along the axes of a coat
  /// [width][column][direction o]: int K l |cos i| di for each of axes::kSpread polynomials l over
  /// axes::spread_direction, which are 1 at one of the directions and 0 at the others. Then the
  /// cosines of these directions, and their axes::coat_direction.
  const float* spread;
  static constexpr int kColumns = axes::kSpread + 2;
};
extern const CoatedTables kGgxCoated, kBeckmannCoated, kGlossyCoated, kMatteCoated;

/// What G^2 of stretched facets is above that of round ones of `coated_width`:
/// [root of both alphas][index][direction][term of ShapeBasis].
extern const float* const kGgxStretchedCoated;
extern const float* const kBeckmannStretchedCoated;

/// Mean of the product of Fresnel's reflectances of two relative indices: int F G 2 z dz, to 1e-4.
extern const float* const kFresnelProduct;  ///< [index][index]

template <class R>
inline R mean_fresnel_product(R a, R b) {
  using namespace axes;
  const auto x = Stencil<R>::at(index(a), kCoatIndex), y = Stencil<R>::at(index(b), kCoatIndex);
  return interpolate(kFresnelProduct, x, coefficients(kCoatIndex), y);
}

/// Of T over the hemisphere.
template <class R>
inline R mean_through(R eta) {
  return 1 - fresnel_dielectric_diffuse(eta);
}

/// The width of round facets that are nearly as wide along `w`, x along the wider axis; at most 1.
template <class R>
inline R coated_width(R wide, R narrow, Vec3<R> w) {
  const R x = wide * w.x, y = narrow * w.y, area = wide * narrow, root = std::sqrt(area);
  const R along = std::sqrt(x * x + y * y + w.z * w.z * area);
  return along / (1 + (along - root));
}

/// What stretched facets have above round ones, along one direction.
template <class R>
struct StretchedCoated {
  const float* table = nullptr;  ///< null: they are round
  Stencil<R> root;
  Shape<R> shape;

  /// Of G^2, for relative index `eta` > 1 and |cosine| `z`.
  R difference(R eta, R z) const {
    using namespace axes;
    using Basis = ShapeBasis<R>;
    constexpr int terms = Basis::terms(kStretchedCoatDegree),
                  n1 = terms * coefficients(kStretchedCoatDirection),
                  n0 = n1 * coefficients(kStretchedCoatIndex);
    const auto n = Stencil<R>::at(stretched_coat_index(eta), kStretchedCoatIndex);
    const auto d = Stencil<R>::at(coat_direction(z), kStretchedCoatDirection);
    R sums[terms] = {};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 4; ++k) {
          const float* p =
              table + (root.first + i) * n0 + (n.first + j) * n1 + (d.first + k) * terms;
          const R weight = root.weight[i] * n.weight[j] * d.weight[k];
          for (int t = 0; t < terms; ++t) sums[t] += weight * R(p[t]);
        }
    const Basis basis(shape, kStretchedCoatDegree);
    R sum = 0;
    for (int t = 0; t < terms; ++t) sum += sums[t] * basis.value[t];
    // Next to 1, few directions are not let through; above 4, few are.
    constexpr R least = R(kLeastCoatIndex * kLeastCoatIndex * kLeastCoatIndex * kLeastCoatIndex);
    if (eta > 4) return sum * (mean_through(eta) / mean_through(R(4)));
    return sum * std::min((eta - 1) / (least * (eta + 1)), R(1));
  }
};

/// One lobe's width; of stretched facets, along one direction.
template <class R>
struct CoatedLobe {
  const CoatedTables* tables;
  Stencil<R> width;
  R cosines = 1;  ///< the width as that of axes::spread_direction
  StretchedCoated<R> stretched{};

  static CoatedLobe facets(const CoatedTables& tables, R alpha) {
    const auto width = Stencil<R>::at(axes::coat_alpha(alpha), axes::kCoatAlpha);
    return {&tables, width, axes::width(alpha)};
  }
  /// x along the wider axis.
  static CoatedLobe facets(const CoatedTables& round, const float* stretched, R wide, R narrow,
                           Vec3<R> w) {
    CoatedLobe lobe = facets(round, coated_width(wide, narrow, w));
    lobe.stretched = {
        stretched,
        Stencil<R>::at(axes::interface_alpha(std::sqrt(wide * narrow)), axes::kStretchedCoatAlpha),
        Shape<R>::of(wide, narrow, w.x, w.y)};
    return lobe;
  }
  static CoatedLobe glossy(R gloss) {
    return {&kGlossyCoated, Stencil<R>::at(axes::gloss(gloss), axes::kGloss),
            axes::gloss_width(gloss)};
  }
  static CoatedLobe matte(R roughness) {
    return {&kMatteCoated, Stencil<R>::at(roughness, axes::kCoatedMatte)};
  }

  /// G^2 - T along a direction of |cosine| `z`, for relative index `eta` > 1.
  R above(R eta, R z) const {
    const R above = interpolate_coat(tables->polished, width, eta, z);
    return stretched.table ? above + stretched.difference(eta, z) : above;
  }
  /// G^2, for T = `through` along the direction. Nowhere below half of T: what rounding leaves of
  /// it next to the surface is kept from 0.
  R mean_squared(R eta, R z, R through) const {
    return std::max(through + above(eta, z), through / 2);
  }
};

}  // namespace mms::materials
