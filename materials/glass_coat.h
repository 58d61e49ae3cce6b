// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Interfaces, as of glass, below coats. Light that changes sides passes a coat once, along its
/// direction outside, of which T = 1 - E lets it through whichever way it goes (materials/coat.h);
/// what the glass reflects outside passes twice, and inside never. So f of the bare glass gets
///
///   across    T                 of the direction outside
///   outside   T T' / T(1)       T(1) along the normal, or T or T' where that is more
///   inside    1
///
/// all of it symmetric; T is the product of all coats that count together. What the coats lack of
/// that they send back:
///
///   outside   E(o) + S(o),  S = T(o) / T(1) int f (E(i) - E(1)) |cos i| di    over i outside
///   inside    S(o) = int f E(i) |cos i| di                                    over i outside
///
/// E by their own lobes, S as a mirror would, or the more of it S S' / (pi mean S) the broader both
/// coat and glass are: all of it is reciprocal, and lossless glass below lossless coats loses
/// nothing. Where glass is smooth that is exact; of facets tables hold the integrals for polished
/// coats, and for four functions that the rest of E is a sum of (materials/tables/glass.cpp); how
/// exactly, says materials/combine.h. Beyond indices of 1 and 4 all is as below other coats. What
/// stretched facets have above round ones as wide along the direction is in further tables, as
/// polynomials over the shape that they have along it.

#include <algorithm>
#include <cmath>

#include "base/spectrum.h"
#include "materials/coat.h"
#include "materials/energy.h"
#include "materials/facets.h"
#include "materials/fresnel.h"
#include "materials/lobe.h"

namespace mms::materials {

namespace axes {
/// Of glass below coats: [0] seen from outside, [1] from inside.
inline constexpr int kGlassAlpha = 28, kGlassIndex = 20, kGlassDirection[] = {44, 80},
                     kGlassCoat[] = {20, 14};
/// The same of stretched facets, and the degree of polynomials over their shapes.
struct BentGlassGrid {
  int width, index, direction, coat, degree;
};
inline constexpr BentGlassGrid kBentGlass[] = {{9, 9, 15, 6, 12}, {15, 18, 25, 8, 12}};
/// The ends of the axes of both indices, 1.0002 and 4, and the least width, nearly a mirror's.
inline constexpr double kLeastGlassIndex = 0.1, kMostGlassIndex = 0.8801117;
inline constexpr double kLeastGlassAlpha = 0.0464;

template <class R>
inline R glass_index(R eta) {
  return (index(eta) - R(kLeastGlassIndex)) / R(kMostGlassIndex - kLeastGlassIndex);
}
template <class R>
inline R glass_alpha(R alpha) {
  return (interface_alpha(alpha) - R(kLeastGlassAlpha)) / R(1 - kLeastGlassAlpha);
}

/// Of a direction inside, `eta` < 1. With x how much z^2 is above that of the critical angle, what
/// nearly flat facets do is smooth over the roots of x and of -x, but for what they blur; of rough
/// ones it is over interface_direction.
template <class R>
inline R critical_direction(R z, R s, R alpha, R eta) {
  const R zc2 = (1 - eta) * (1 + eta), zc = std::sqrt(zc2);
  const R blur = alpha * eta * (2 * zc + alpha * eta), blur2 = blur * blur;
  const auto roots = [&](R x) {
    const R far = std::sqrt(x * x + blur2) + std::abs(x);
    const R large = std::sqrt(far), small = std::sqrt(blur2 / far);
    return x > 0 ? R(0.6) * large / eta - R(0.4) * small / zc
                 : R(0.6) * small / eta - R(0.4) * large / zc;
  };
  const R from = roots(-zc2), place = (roots(z * z - zc2) - from) / (roots(eta * eta) - from);
  const R flat = (1 - alpha) * (1 - alpha), share = 5 * flat * flat * flat;
  const R masked = direction(z, s, width(alpha));
  return (interface_direction(z, s, alpha, eta) + share * (place + masked / 2)) /
         (1 + R(1.5) * share);
}

/// Of a direction of |cosine| `z` and tangential length `s`.
template <class R>
inline R glass_direction(bool inside, R z, R s, R alpha, R glass) {
  return inside ? critical_direction(z, s, alpha, 1 / glass) : coat_direction(z);
}
}  // namespace axes

/// E of a coat of facets but for what is F is smooth over z: a sum of four functions, each 1 at one
/// of these |cosines| and 0 at the others. The functions are sums of 1 and of L of three indices,
/// within 2e-4 of L for indices from 1 to 4 (materials/tables/glass.cpp).
inline constexpr int kRest = 4;
inline constexpr double kRestCosine[kRest] = {0, 0.3, 0.6, 1};

/// What int f E |cos i| di of `S` above is for each part of E: inside of F and of the four
/// functions, outside of (F - F(1)) / T(1) and of what each has above its value along the normal.
/// Inside, tables of F hold the root of it.
struct GlassTables {
  const float* steep[2];  ///< [width][index of the glass][direction][index of the coat]
  const float* rest[2];   ///< [width][index of the glass][direction][function]
  /// Of stretched facets less that of round ones: [width][index of the glass][direction]
  /// [index of the coat][term of ShapeBasis], and [...][direction][function][term].
  const float* bent_steep[2];
  const float* bent_rest[2];
};
extern const GlassTables kGgxGlass, kBeckmannGlass;

template <class R>
inline const GlassTables& glass_tables(const Ggx<R>&) {
  return kGgxGlass;
}
template <class R>
inline const GlassTables& glass_tables(const Beckmann<R>&) {
  return kBeckmannGlass;
}

/// Whether the tables know of a relative index of glass or coat.
template <class R>
inline bool in_glass_tables(R eta) {
  return eta > 1 && eta <= 4;
}

/// The coats above glass, at one wavelength: E = steep F(z, eta) + the rest.
template <class R>
struct CoatOnGlass {
  R eta{1};  ///< above 1, or what follows does not count
  R steep{};
  R rest[kRest]{};  ///< at kRestCosine
  R normal{1};      ///< T(1)

  bool operator==(const CoatOnGlass&) const = default;
  bool counts() const { return eta > 1; }
  bool polished() const {
    return std::all_of(rest, rest + kRest, [](R x) { return x == 0; });
  }
};

/// The factor of f where T is `o` along one direction and `i` along the other, and `normal` along
/// the normal.
template <class R>
inline R glass_factor(bool o_outside, bool i_outside, R o, R i, R normal) {
  if (o_outside != i_outside) return o_outside ? o : i;
  if (!o_outside) return 1;
  const R most = std::max({o, i, normal});  // above 3.7, T has its most away from the normal
  return most > 0 ? o * i / most : R(0);
}

/// The integral of GlassTables for each part.
template <class R>
struct SentParts {
  R steep = 0, rest[kRest] = {};
};

/// Of round facets as wide as `f` is along its direction, of index `glass`, below `coat`. Parts
/// that the coat has not are left at 0. \pre in_glass_tables of both indices
template <class R>
inline SentParts<R> round_parts(const GlassTables& tables, const StretchedInterface<R>& f,
                                bool inside, R glass, const CoatOnGlass<R>& coat) {
  using namespace axes;
  const R alpha = f.like(), s = std::sqrt(f.x * f.x + f.y * f.y);
  const auto a = Stencil<R>::at(glass_alpha(alpha), kGlassAlpha);
  const auto n = Stencil<R>::at(glass_index(glass), kGlassIndex);
  const auto d =
      Stencil<R>::at(glass_direction(inside, f.z, s, alpha, glass), kGlassDirection[inside]);
  const int directions = coefficients(kGlassDirection[inside]), indices = coefficients(kGlassIndex);
  SentParts<R> parts;
  if (coat.steep != 0) {
    const auto c = Stencil<R>::at(glass_index(coat.eta), kGlassCoat[inside]);
    const int n2 = coefficients(kGlassCoat[inside]), n1 = n2 * directions, n0 = n1 * indices;
    const R read = interpolate(tables.steep[inside], a, n0, n, n1, d, n2, c);
    parts.steep = inside ? read * read : read;
  }
  if (!coat.polished()) {
    constexpr int n2 = kRest;
    const int n1 = n2 * directions, n0 = n1 * indices;
    add_terms(parts.rest, kRest, tables.rest[inside], R(1), a, n0, n, n1, d, n2);
  }
  return parts;
}

/// How much more they are of `f` itself.
template <class R>
inline SentParts<R> shape_parts(const GlassTables& tables, const StretchedInterface<R>& f,
                                bool inside, R glass, const CoatOnGlass<R>& coat) {
  using namespace axes;
  using Basis = ShapeBasis<R>;
  const BentGlassGrid& grid = kBentGlass[inside];
  const R alpha = f.like(), s = std::sqrt(f.x * f.x + f.y * f.y);
  const auto a = Stencil<R>::at(glass_alpha(alpha), grid.width);
  const auto n = Stencil<R>::at(glass_index(glass), grid.index);
  const auto d = Stencil<R>::at(glass_direction(inside, f.z, s, alpha, glass), grid.direction);
  const int directions = coefficients(grid.direction), indices = coefficients(grid.index);
  const Basis basis(f.shape(widening(inside ? 1 / glass : glass, alpha)), grid.degree);
  const int terms = basis.count;
  R sums[kRest * Basis::kMost] = {};
  SentParts<R> parts;
  if (coat.steep != 0) {
    const auto c = Stencil<R>::at(glass_index(coat.eta), grid.coat);
    const int n3 = terms, n2 = n3 * coefficients(grid.coat), n1 = n2 * directions,
              n0 = n1 * indices;
    add_terms(sums, terms, tables.bent_steep[inside], R(1), a, n0, n, n1, d, n2, c, n3);
    parts.steep = basis.sum(sums);
  }
  if (!coat.polished()) {
    std::fill(sums, sums + terms, R(0));
    const int n2 = kRest * terms, n1 = n2 * directions, n0 = n1 * indices;
    add_terms(sums, n2, tables.bent_rest[inside], R(1), a, n0, n, n1, d, n2);
    for (int m = 0; m < kRest; ++m) parts.rest[m] = basis.sum(sums + m * terms);
  }
  return parts;
}

/// S of light along `w`, but for T(o), of facets of the widths `ax` and `ay` and index `glass`.
/// \pre in_glass_tables of both indices
template <class R>
inline R sent_back(const GlassTables& tables, R ax, R ay, Vec3<R> w, R glass,
                   const CoatOnGlass<R>& coat) {
  using namespace axes;
  const bool inside = w.z < 0;
  const R z = std::min(std::abs(w.z), R(1));
  const StretchedInterface<R> f = ax < ay ? StretchedInterface<R>{ay, ax, w.y, w.x, z}
                                          : StretchedInterface<R>{ax, ay, w.x, w.y, z};
  SentParts<R> parts = round_parts(tables, f, inside, glass, coat);
  if (ax != ay) {
    const SentParts<R> more = shape_parts(tables, f, inside, glass, coat);
    parts.steep += more.steep;
    for (int m = 0; m < kRest; ++m) parts.rest[m] += more.rest[m];
  }
  // Next to 1, few directions are not let through.
  constexpr R x = R(kLeastGlassIndex * kLeastGlassIndex * kLeastGlassIndex * kLeastGlassIndex);
  const R next_to_1 = std::min((coat.eta - 1) / (x * (coat.eta + 1)), R(1));
  R sent = coat.steep * next_to_1 * parts.steep *
           (inside ? R(1) : fresnel_split(R(1), coat.eta).transmitted);
  for (int m = 0; m < kRest; ++m) sent += coat.rest[m] * parts.rest[m];
  return limited(inside ? sent : sent / coat.normal, R(0), R(1));
}

/// S at each wavelength, and the |cosine| outside of the light that it is, or nearly.
template <class R>
struct SentBack {
  Spectrum<R> share{}, cosine{};
  R broad{};  ///< how broad the glass is, as the sum of Broadness

  /// Nothing yet, of light along `wo`; `eta` as in SpecularTerms.
  SentBack(Vec3<R> wo, const Spectrum<R>& eta) {
    for (int j = 0; j < kWavelengths; ++j) {
      const R c = std::min(std::abs(wo.z), R(1));
      const R g2 = wo.z > 0 ? R(0) : refraction_g2(c, eta[j]);
      cosine[j] = wo.z > 0 ? c : g2 > 0 ? std::min(std::sqrt(g2) / eta[j], R(1)) : R(0);
    }
  }

  /// Of an interface of deltas. `coats.law[j]` is a CoatOnGlass, `coats.split(j, z)` E and T.
  template <class Coats>
  static SentBack smooth(const SpecularTerms<R>& terms, Vec3<R> wo, const Coats& coats) {
    SentBack back(wo, terms.eta);
    for (int j = 0; j < kWavelengths; ++j) {
      if (!coats.law[j].counts()) continue;
      const FresnelSplit<R> e = coats.split(j, back.cosine[j]);
      const R t = e.transmitted;
      back.share[j] = wo.z < 0 ? terms.transmit_weight[j] * e.reflected
                               : terms.reflect_weight[j] *
                                     (t - glass_factor(true, true, t, t, coats.law[j].normal));
    }
    return back;
  }
};

}  // namespace mms::materials
