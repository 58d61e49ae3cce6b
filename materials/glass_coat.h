// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Interfaces, as of glass, below a polished coat. Light that changes sides passes the coat once,
/// along its direction outside, of which T = 1 - F lets it through whichever way it goes; what the
/// glass reflects outside passes twice, and inside never. So f of the bare glass gets
///
///   across    T                                of the direction outside
///   outside   T T' / max(T, T', T(1))          T(1) along the normal, where T is most, nearly
///   inside    1
///
/// all of it symmetric. What the coat lacks of that it sends back as the mirror that it is, which
/// is reciprocal whatever it reflects:
///
///   outside   F(o) + T(o) int f (1 - T' / max(T, T', T(1))) |cos i| di     over i outside
///   inside    int f F(i) |cos i| di                                        over i outside
///
/// so that lossless glass below a lossless coat loses nothing. Where both are smooth it is exact;
/// of facets tables hold both integrals (materials/tables/glass.cpp): within 1e-3 for roughness
/// from 0.1, below that within 3e-3. Beyond indices of 1 and 4 all is as below other coats. What
/// stretched facets have above round ones as wide along the direction is in further tables, as
/// polynomials over the shape that they have along it.

#include <algorithm>
#include <cmath>

#include "base/spectrum.h"
#include "materials/energy.h"
#include "materials/facets.h"
#include "materials/fresnel.h"
#include "materials/lobe.h"

namespace mms::materials {

namespace axes {
/// Of glass below a polished coat: [0] seen from outside, [1] from inside.
inline constexpr int kGlassAlpha[] = {18, 20}, kGlassIndex[] = {12, 15},
                     kGlassDirection[] = {44, 50}, kGlassCoat[] = {20, 14};
/// The same of stretched facets, and the degree of polynomials over their shapes.
struct BentGlassGrid {
  int width, index, direction, coat, degree;
};
inline constexpr BentGlassGrid kBentGlass[] = {{7, 7, 12, 6, 8}, {10, 10, 22, 7, 10}};
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
/// ones it is over rare_direction.
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
  return (rare_direction(z, s, alpha, eta) + share * (place + masked / 2)) / (1 + R(1.5) * share);
}

/// Of a direction of |cosine| `z` and tangential length `s`.
template <class R>
inline R glass_direction(bool inside, R z, R s, R alpha, R glass) {
  return inside ? critical_direction(z, s, alpha, 1 / glass) : coat_direction(z);
}
}  // namespace axes

/// What the coat's mirror gets besides F(o) outside, and the root of what it gets inside: [width]
/// [index of the glass][direction][index of the coat], for round facets.
struct GlassTables {
  const float* sent[2];  ///< seen from outside, and from inside
  /// Of stretched ones less that: [width][index of the glass][direction][index of
  /// the coat][term of ShapeBasis].
  const float* bent[2];
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

/// T(1) of a dielectric.
template <class R>
inline R through_normal(R eta) {
  return 4 * eta / ((eta + 1) * (eta + 1));
}

/// The factor of f where T is `o` along one direction and `i` along the other, of a coat of
/// relative index `eta` > 1.
template <class R>
inline R glass_factor(bool o_outside, bool i_outside, R o, R i, R eta) {
  if (o_outside != i_outside) return o_outside ? o : i;
  if (!o_outside) return 1;
  const R most = std::max({o, i, through_normal(eta)});
  return most > 0 ? o * i / most : R(0);
}

/// What of light along a direction the mirror of a coat of index `coat` gets besides F, of round
/// facets as wide as `f` is along it, of index `glass`. \pre in_glass_tables of both indices
template <class R>
inline R sent_back_by_round(const GlassTables& tables, const StretchedInterface<R>& f, bool inside,
                            R glass, R coat) {
  using namespace axes;
  const R alpha = f.like(), s = std::sqrt(f.x * f.x + f.y * f.y);
  const auto a = Stencil<R>::at(glass_alpha(alpha), kGlassAlpha[inside]);
  const auto n = Stencil<R>::at(glass_index(glass), kGlassIndex[inside]);
  const auto d =
      Stencil<R>::at(glass_direction(inside, f.z, s, alpha, glass), kGlassDirection[inside]);
  const auto c = Stencil<R>::at(glass_index(coat), kGlassCoat[inside]);
  const int n2 = coefficients(kGlassCoat[inside]), n1 = n2 * coefficients(kGlassDirection[inside]),
            n0 = n1 * coefficients(kGlassIndex[inside]);
  const R read = interpolate(tables.sent[inside], a, n0, n, n1, d, n2, c);
  return inside ? read * read : std::max(read, R(0));
}

/// How much more it is of `f` itself.
template <class R>
inline R sent_back_by_shape(const GlassTables& tables, const StretchedInterface<R>& f, bool inside,
                            R glass, R coat) {
  using namespace axes;
  using Basis = ShapeBasis<R>;
  const BentGlassGrid& grid = kBentGlass[inside];
  const R alpha = f.like(), s = std::sqrt(f.x * f.x + f.y * f.y);
  const auto a = Stencil<R>::at(glass_alpha(alpha), grid.width);
  const auto n = Stencil<R>::at(glass_index(glass), grid.index);
  const auto d = Stencil<R>::at(glass_direction(inside, f.z, s, alpha, glass), grid.direction);
  const auto c = Stencil<R>::at(glass_index(coat), grid.coat);
  const int terms = Basis::terms(grid.degree), n2 = terms * coefficients(grid.coat),
            n1 = n2 * coefficients(grid.direction), n0 = n1 * coefficients(grid.index);
  R sums[Basis::kMost] = {};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k)
        for (int l = 0; l < 4; ++l) {
          const float* p = tables.bent[inside] + (a.first + i) * n0 + (n.first + j) * n1 +
                           (d.first + k) * n2 + (c.first + l) * terms;
          const R weight = a.weight[i] * n.weight[j] * d.weight[k] * c.weight[l];
          for (int t = 0; t < terms; ++t) sums[t] += weight * R(p[t]);
        }
  const Basis basis(f.shape(), grid.degree);
  R sum = 0;
  for (int t = 0; t < terms; ++t) sum += sums[t] * basis.value[t];
  return sum;
}

/// What of light along `w` the mirror of a coat of index `coat` gets besides F, of facets of the
/// widths `ax` and `ay` and index `glass`. \pre in_glass_tables of both indices
template <class R>
inline R sent_back(const GlassTables& tables, R ax, R ay, Vec3<R> w, R glass, R coat) {
  using namespace axes;
  const bool inside = w.z < 0;
  const R z = std::min(std::abs(w.z), R(1));
  const StretchedInterface<R> f = ax < ay ? StretchedInterface<R>{ay, ax, w.y, w.x, z}
                                          : StretchedInterface<R>{ax, ay, w.x, w.y, z};
  R sent = sent_back_by_round(tables, f, inside, glass, coat);
  if (ax != ay) sent = std::max(sent + sent_back_by_shape(tables, f, inside, glass, coat), R(0));
  // Next to 1, few directions are not let through.
  constexpr R x = R(kLeastGlassIndex * kLeastGlassIndex * kLeastGlassIndex * kLeastGlassIndex);
  sent *= std::min((coat - 1) / (x * (coat + 1)), R(1));
  return std::min(sent, R(1));
}

/// The same at each wavelength, and the |cosine| outside of the light that it is, or nearly.
template <class R>
struct SentBack {
  Spectrum<R> share{}, cosine{};

  /// Nothing yet, of light along `wo`; `eta` as in SpecularTerms.
  SentBack(Vec3<R> wo, const Spectrum<R>& eta) {
    for (int j = 0; j < kWavelengths; ++j) {
      const R c = std::min(std::abs(wo.z), R(1));
      const R g2 = wo.z > 0 ? R(0) : refraction_g2(c, eta[j]);
      cosine[j] = wo.z > 0 ? c : g2 > 0 ? std::min(std::sqrt(g2) / eta[j], R(1)) : R(0);
    }
  }

  /// Of an interface of deltas.
  static SentBack smooth(const SpecularTerms<R>& terms, Vec3<R> wo, const R* coat) {
    SentBack back(wo, terms.eta);
    for (int j = 0; j < kWavelengths; ++j) {
      const R n = relative_eta(coat[j], Vec3<R>{0, 0, 1});
      const FresnelSplit<R> f = fresnel_split(back.cosine[j], n);
      const R t = f.transmitted;
      back.share[j] = wo.z < 0 ? terms.transmit_weight[j] * f.reflected
                               : terms.reflect_weight[j] * (t - glass_factor(true, true, t, t, n));
    }
    return back;
  }
};

}  // namespace mms::materials
