// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What coats do to light: how much of it one whose own lobe is known reflects and lets through.
/// With F Fresnel's reflectance along wo, F' along wi, its lobe K is scaled by (F + F') / 2, and so
///
///   E(wo) = (F + M) / 2 is reflected, M(wo) = int F' K |cos wi| dwi, and T = 1 - E let through
///
/// Tables hold M - F for round facets and `glossy`, and what stretched facets have above round
/// ones as wide along the direction, as polynomials over the shape that they have along it
/// (materials/tables/stretched_coats.cpp).

#include <cmath>

#include "base/spectrum.h"
#include "materials/energy.h"
#include "materials/fresnel.h"
#include "materials/lobe.h"

namespace mms::materials {

namespace axes {
/// Of stretched facets; the axis of the width is that of an interface.
inline constexpr int kStretchedCoatAlpha = 17, kStretchedCoatIndex = 11,
                     kStretchedCoatDirection = 25, kStretchedCoatDegree = 12;
inline constexpr double kLeastCoatIndex = 0.1, kMostCoatIndex = 0.8801117;  ///< of 1.0002 and 4

template <class R>
inline R stretched_coat_index(R eta) {
  return (index(eta) - R(kLeastCoatIndex)) / R(kMostCoatIndex - kLeastCoatIndex);
}
/// As wide as facets of axes::width are lobes of `glossy` of that.
template <class R>
inline R gloss_width(R gloss) {
  return 1 / std::sqrt(1 + gloss);
}
}  // namespace axes

struct CoatedTables;

/// Of one kind of lobe, for relative indices above 1.
struct CoatTables {
  const float* round;      ///< M - F: [width][index][direction]
  const float* stretched;  ///< of M: [root of both alphas][index][direction][term of ShapeBasis]
  const CoatedTables* coated;  ///< of the same lobe, itself under a coat
};
extern const CoatTables kGgxCoat, kBeckmannCoat, kGlossyCoat;

/// What a table over a lobe's width holds for relative index `eta` > 1 and |cosine| `z`.
template <class R>
inline R interpolate_coat(const float* table, const Stencil<R>& width, R eta, R z) {
  using namespace axes;
  const auto n = Stencil<R>::at(index(eta), kCoatIndex);
  const auto d = Stencil<R>::at(coat_direction(z), kCoatDirection);
  constexpr int n1 = coefficients(kCoatDirection), n0 = n1 * coefficients(kCoatIndex);
  return interpolate(table, width, n0, n, n1, d);
}

/// Of T over the hemisphere.
template <class R>
inline R mean_through(R eta) {
  return 1 - fresnel_dielectric_diffuse(eta);
}

/// Facets as they look along one direction.
template <class R>
struct FacetsAlong {
  R like;                        ///< the width of round ones that are nearly as wide; at most 1
  const float* table = nullptr;  ///< what stretched ones have above those; null: they are round
  Stencil<R> root{};
  Shape<R> shape{};

  FacetsAlong(const float* stretched, R ax, R ay, Vec3<R> w) : like(ax) {
    if (ax == ay) return;
    if (ax < ay) std::swap(ax, ay), std::swap(w.x, w.y);
    like = coated_width(ax, ay, w);
    table = stretched;
    root = Stencil<R>::at(axes::interface_alpha(std::sqrt(ax * ay)), axes::kStretchedCoatAlpha);
    shape = Shape<R>::of(ax, ay, w.x, w.y);
  }

  /// `x` along the wider axis.
  static R coated_width(R wide, R narrow, Vec3<R> w) {
    const R x = wide * w.x, y = narrow * w.y, area = wide * narrow;
    const R along = std::sqrt(x * x + y * y + w.z * w.z * area);
    return along / (1 + (along - std::sqrt(area)));
  }

  /// What the table says, for relative index `eta` > 1 and |cosine| `z`.
  R difference(R eta, R z) const {
    if (!table) return 0;
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

/// The lobe of a coat, where it is known how it spreads light.
template <class R>
struct CoatLobe {
  const CoatTables* tables = nullptr;  ///< null: not known
  Stencil<R> width{};                  ///< of one that is not stretched
  R cosines = 1;                       ///< that width as of axes::spread_direction
  R ax = 0, ay = 0;                    ///< of facets

  static CoatLobe glossy(R gloss) {
    return {&kGlossyCoat, Stencil<R>::at(axes::gloss(gloss), axes::kGloss),
            axes::gloss_width(gloss)};
  }
  static CoatLobe facets(const CoatTables& tables, R ax, R ay) {
    return {&tables, facet_width(ax), axes::width(ax), ax, ay};
  }

  bool operator==(const CoatLobe&) const = default;
  bool known() const { return tables; }
  bool stretched() const { return ax != ay; }

  /// M, from F and what a table of round lobes says.
  static R mean_of(R f, R difference) {
    const R mean = f + difference;
    return mean > 0 ? std::min(mean, R(1)) : R(0);
  }
  static Stencil<R> facet_width(R alpha) {
    return Stencil<R>::at(axes::coat_alpha(alpha), axes::kCoatAlpha);
  }
};

/// What a coat does to light along one direction, at each wavelength: F and T; T is 1 - F where the
/// lobe is not known, or the index not above 1.
template <class R>
struct CoatAlong {
  Spectrum<R> reflected{}, through{};

  CoatAlong() = default;
  CoatAlong(const R* ior, const CoatLobe<R>& lobe, Vec3<R> w) {
    const R z = limited(std::abs(w.z), R(0), R(1));
    const FacetsAlong<R> facets(lobe.known() ? lobe.tables->stretched : nullptr, lobe.ax, lobe.ay,
                                w);
    const Stencil<R> width = lobe.stretched() ? lobe.facet_width(facets.like) : lobe.width;
    for_each_index(ior, [&](int j, bool repeated) {
      if (repeated) {
        reflected[j] = reflected[j - 1], through[j] = through[j - 1];
        return;
      }
      const R eta = relative_eta(ior[j], Vec3<R>{0, 0, 1});
      const FresnelSplit<R> f = fresnel_split(z, eta);
      reflected[j] = f.reflected;
      through[j] = f.transmitted;
      if (!lobe.known() || !(eta > 1)) return;
      const R difference =
          interpolate_coat(lobe.tables->round, width, eta, z) + facets.difference(eta, z);
      through[j] = (f.transmitted + 1 - lobe.mean_of(f.reflected, difference)) / 2;
    });
  }
};

}  // namespace mms::materials
