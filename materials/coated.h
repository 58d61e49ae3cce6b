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
/// the energy of coat and base is 1 within 1e-4, of facets of a roughness below 0.1 within 2e-4, of
/// stretched ones within 3e-4 (beyond anisotropy 0.9: 1e-3).
/// For stretched facets a second table says what theirs is above that of round ones as wide along
/// the direction, as polynomials over the shape that they have along it
/// (materials/tables/stretched_coats.cpp).

#include "materials/energy.h"
#include "materials/fresnel.h"

namespace mms::materials {

/// Nodes of these tables, along the axes of a coat. As many indices keep what the spline rings by
/// next to infinity, where T changes fast, from those below 4.
namespace axes {
inline constexpr int kCoatedAlpha = 37, kCoatedGloss = 65, kCoatedIndex = 49;
/// Of stretched facets; the axis of the width is that of an interface.
inline constexpr int kStretchedCoatAlpha = 17, kStretchedCoatIndex = 11,
                     kStretchedCoatDirection = 25, kStretchedCoatDegree = 12;
inline constexpr double kLeastCoatIndex = 0.1, kMostCoatIndex = 0.8801117;  ///< of 1.0002 and 4

template <class R>
inline R stretched_coat_index(R eta) {
  return (index(eta) - R(kLeastCoatIndex)) / R(kMostCoatIndex - kLeastCoatIndex);
}
}  // namespace axes

/// [width][index][direction] along the axes of a coat (materials/energy.h).
extern const float* const kGgxCoated;
extern const float* const kBeckmannCoated;
extern const float* const kGlossyCoated;

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
  const float* table;
  Stencil<R> width;
  StretchedCoated<R> stretched{};

  static CoatedLobe facets(const float* table, R alpha) {
    return {table, Stencil<R>::at(axes::coat_alpha(alpha), axes::kCoatedAlpha)};
  }
  /// x along the wider axis.
  static CoatedLobe facets(const float* round, const float* stretched, R wide, R narrow,
                           Vec3<R> w) {
    CoatedLobe lobe = facets(round, coated_width(wide, narrow, w));
    lobe.stretched = {
        stretched,
        Stencil<R>::at(axes::interface_alpha(std::sqrt(wide * narrow)), axes::kStretchedCoatAlpha),
        Shape<R>::of(wide, narrow, w.x, w.y)};
    return lobe;
  }
  static CoatedLobe glossy(R gloss) {
    return {kGlossyCoated, Stencil<R>::at(axes::gloss(gloss), axes::kCoatedGloss)};
  }

  /// G^2 along a direction of |cosine| `z`, for relative index `eta` > 1 and T = `through` there.
  /// Nowhere below half of T: what rounding leaves of it next to the surface is kept from 0.
  R mean_squared(R eta, R z, R through) const {
    R above = interpolate_coat<axes::kCoatedIndex>(table, width, eta, z);
    if (stretched.table) above += stretched.difference(eta, z);
    return std::max(through + above, through / 2);
  }
};

}  // namespace mms::materials
