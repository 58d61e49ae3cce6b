// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Interfaces, as of glass, below coats. Light that changes sides passes a coat once, along its
/// direction outside, of which T = 1 - E lets it through whichever way it goes (materials/coat.h);
/// what the glass reflects outside passes twice, and inside never. So f of the bare glass gets
///
///   across    T                 of the direction outside
///   outside   T T' / M          M the most that T is: mostly T(1), along the normal
///   inside    1
///
/// all of it symmetric; T is the product of all coats that count together. What the coats lack of
/// that they send back:
///
///   outside   E(o) + S(o),  S = T(o) int f (1 - T(i) / M) |cos i| di    over i outside
///   inside    S(o) = int f E(i) |cos i| di                              over i outside
///
/// E by their own lobes, S as a mirror would, or the more of it S S' / (pi mean S) the broader both
/// coat and glass are: all of it is reciprocal, and lossless glass below lossless coats loses
/// nothing. Where glass is smooth that is exact. Of facets tables hold, for any direction o, the
/// weights of a rule for int f g(i) |cos i| di: over Chebyshev's points of |cos i|, exact of g that
/// are polynomials of it (materials/tables/glass.cpp). So coats may be any, films among them; how
/// exactly, says materials/combine.h. Where the index of rough glass is above 4 or below 1/4 all is
/// as below other coats. What stretched facets have above round ones as wide along the direction is
/// in further tables, by fewer points, as polynomials over the shape that they have along it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/spectrum.h"
#include "materials/chebyshev.h"
#include "materials/coat.h"
#include "materials/energy.h"
#include "materials/facets.h"
#include "materials/fresnel.h"
#include "materials/lobe.h"

namespace mms::materials {

namespace axes {
/// Nodes of a table of glass below coats, and its polynomials over shapes of stretched facets. Of
/// two, [0] is of light that meets a higher index, [1] a lower one.
struct GlassGrid {
  int width, index, direction;
  ShapeOrder shapes{};
};
inline constexpr GlassGrid kRoundGlass[] = {{28, 20, 44}, {28, 20, 80}};
inline constexpr GlassGrid kBentGlass[] = {{14, 11, 28, {16, 4}}, {16, 21, 32, {20, 5}}};
/// The ends of the axis of the index, 1.0002 and 4, and the least width, nearly a mirror's.
inline constexpr double kLeastGlassIndex = 0.1, kMostGlassIndex = 0.8801117;
inline constexpr double kLeastGlassAlpha = 0.0464;

/// `eta` or its inverse.
template <class R>
inline R glass_index(R eta) {
  return (index(eta) - R(kLeastGlassIndex)) / R(kMostGlassIndex - kLeastGlassIndex);
}
template <class R>
inline R glass_alpha(R alpha) {
  return (interface_alpha(alpha) - R(kLeastGlassAlpha)) / R(1 - kLeastGlassAlpha);
}
/// Places along these and along glass_direction, of stretched facets: finer towards wide ones, high
/// indices and the normal.
template <class R>
inline R bent_glass(R place) {
  return place > 0 ? place * (1 + std::sqrt(place)) / 2 : R(0);
}

/// Of a direction from which the index falls, `eta` < 1. With x how much z^2 is above that of the
/// critical angle, what nearly flat facets do is smooth over the roots of x and of -x, but for what
/// they blur; of rough ones it is over interface_direction.
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

/// Of a direction of |cosine| `z` and tangential length `s`, from which light meets the relative
/// index `eta`. From outside, all is reflected beyond the critical angle too, and coats see where.
template <class R>
inline R glass_direction(bool inside, R z, R s, R alpha, R eta) {
  if (!(eta < 1)) return (grazing_direction(z) + direction(z, s, width(alpha))) / 2;
  const R critical = critical_direction(z, s, alpha, eta);
  return inside ? critical : (critical + grazing_direction(z)) / 2;
}
}  // namespace axes

/// The points of the rules: of round facets and of `phong_glass`, and fewer of what stretched ones
/// have above these and of what films change.
inline constexpr int kGlassPoints = 16, kFewGlassPoints = 10;

/// [of light from inside][that meets a lower index].
struct GlassTables {
  const float* round[2][2];  ///< [width][index][direction][point]
  const float* bent[2][2];   ///< [width][index][direction][point][term of ShapeBasis]
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

/// Whether the tables know of a relative index.
template <class R>
inline bool in_glass_tables(R eta) {
  return eta >= R(0.25) && eta <= 4 && eta != 1;
}

/// The coats above glass, at one wavelength.
template <class R>
struct CoatOnGlass {
  using Points = std::array<R, kGlassPoints>;

  bool counts = false;    ///< or what follows is of no coats
  bool repeated = false;  ///< it is as at the wavelength before
  R most{1};              ///< M
  /// What of each point's weight they send back: [0] of light from outside, for what it is over
  /// T(o); [1] from inside.
  Points sent[2] = {};

  CoatOnGlass() = default;
  /// From E and T at the points, and T along the normal.
  CoatOnGlass(const Points& reflected, const Points& through, R normal)
      : counts(true),
        most(std::max(normal, *std::max_element(through.begin(), through.end()))),
        sent{through, reflected} {
    for (R& t : sent[0]) t = most > 0 ? (most - t) / most : R(0);
  }

  /// The same of the fewer points.
  std::array<R, kFewGlassPoints> few_sent(bool inside) const {
    std::array<R, kFewGlassPoints> few{};
    const auto& matrix = chebyshev_transfer<kFewGlassPoints, kGlassPoints>();
    for (int m = 0; m < kFewGlassPoints; ++m)
      for (int i = 0; i < kGlassPoints; ++i) few[m] += R(matrix[m][i]) * sent[inside][i];
    return few;
  }
};

/// The factor of f where T is `o` along one direction and `i` along the other, and `most` is M.
template <class R>
inline R glass_factor(bool o_outside, bool i_outside, R o, R i, R most) {
  if (o_outside != i_outside) return o_outside ? o : i;
  if (!o_outside) return 1;
  most = std::max({o, i, most});  // between points T may be more
  return most > 0 ? o * i / most : R(0);
}

namespace detail {
/// Adds `terms` numbers of a table for `f` along its direction; of one of stretched facets, `bent`.
template <class R>
inline void add_glass(R* sums, int terms, const float* table, const axes::GlassGrid& grid,
                      const StretchedFacets<R>& f, bool inside, R eta, bool bent) {
  using namespace axes;
  const R alpha = f.like(), s = std::sqrt(f.x * f.x + f.y * f.y);
  const int n1 = terms * coefficients(grid.direction), n0 = n1 * coefficients(grid.index);
  const auto at = [bent](R place, int nodes) {
    return Stencil<R>::at(bent ? bent_glass(place) : place, nodes);
  };
  add_terms(sums, terms, table, R(1), at(glass_alpha(alpha), grid.width), n0,
            at(glass_index(eta), grid.index), n1,
            at(glass_direction(inside, f.z, s, alpha, eta), grid.direction), terms);
}
}  // namespace detail

/// What a table of `Count` numbers for each round interface, [width][index][direction][number],
/// holds for facets as wide as `f` is along its direction, from which light meets the relative
/// index `eta`. \pre in_glass_tables(eta)
template <const auto& kGrids, std::size_t Count, class R>
inline std::array<R, Count> of_round_glass(const float* table, const StretchedFacets<R>& f,
                                           bool inside, R eta) {
  std::array<R, Count> numbers{};
  detail::add_glass(numbers.data(), int(Count), table, kGrids[eta < 1], f, inside, eta, false);
  return numbers;
}

/// The same of `f` itself, [width][index][direction][number][term of ShapeBasis].
template <const auto& kGrids, std::size_t Count, class R>
inline std::array<R, Count> of_bent_glass(const float* table, const StretchedFacets<R>& f,
                                          bool inside, R eta) {
  using Basis = ShapeBasis<R>;
  const axes::GlassGrid& grid = kGrids[eta < 1];
  const Basis basis(f.shape(axes::widening(eta, f.like())), grid.shapes);
  const int terms = Basis::terms(grid.shapes);
  constexpr int most = std::max(Basis::terms(kGrids[0].shapes), Basis::terms(kGrids[1].shapes));
  R sums[Count * most] = {};
  detail::add_glass(sums, int(Count) * terms, table, grid, f, inside, eta, true);
  std::array<R, Count> numbers;
  for (std::size_t i = 0; i < Count; ++i) numbers[i] = basis.sum(sums + i * terms);
  return numbers;
}

/// The weights of the points for such round facets.
template <class R>
inline std::array<R, kGlassPoints> round_weights(const GlassTables& tables,
                                                 const StretchedFacets<R>& f, bool inside, R eta) {
  return of_round_glass<axes::kRoundGlass, kGlassPoints>(tables.round[inside][eta < 1], f, inside,
                                                         eta);
}

/// The weights for light along one direction.
template <class R>
struct GlassWeights {
  bool inside = false, stretched = false;
  std::array<R, kGlassPoints> round{};
  std::array<R, kFewGlassPoints> shape{};

  GlassWeights() = default;
  /// Along `w`, of facets of the widths `ax` and `ay`, at which light meets the index `eta`.
  /// \pre in_glass_tables(eta)
  GlassWeights(const GlassTables& tables, R ax, R ay, Vec3<R> w, R eta)
      : inside(w.z < 0), stretched(ax != ay) {
    const auto f = StretchedFacets<R>::of(ax, ay, {w.x, w.y, std::min(std::abs(w.z), R(1))});
    round = round_weights(tables, f, inside, eta);
    if (stretched)
      shape = of_bent_glass<axes::kBentGlass, kFewGlassPoints>(tables.bent[inside][eta < 1], f,
                                                               inside, eta);
  }

  /// S, but for T(o).
  R sent_back(const CoatOnGlass<R>& coat) const {
    R sent = 0;
    for (int i = 0; i < kGlassPoints; ++i) sent += round[i] * coat.sent[inside][i];
    if (!stretched) return sent;
    const auto few = coat.few_sent(inside);
    for (int i = 0; i < kFewGlassPoints; ++i) sent += shape[i] * few[i];
    return sent;
  }
};

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

  /// Of an interface as broad as `spread`, which is as at the wavelength before where `repeated(j)`
  /// says so: `sent(j, law)` is S, but for T(o) and `tint`.
  template <class Coats, class Repeated, class Sent>
  static SentBack rough(Vec3<R> wo, const Spectrum<R>& eta, const Spectrum<R>& tint,
                        const Broadness<R>& spread, const Coats& coats, const Repeated& repeated,
                        const Sent& sent) {
    SentBack back(wo, eta);
    back.broad = spread.held + spread.even;
    for (int j = 0; j < kWavelengths; ++j) {
      const CoatOnGlass<R>& law = coats.law[j];
      if (!law.counts) continue;
      if (repeated(j) && law.repeated) {
        back.share[j] = back.share[j - 1];
        continue;
      }
      back.share[j] = tint[j] * limited(sent(j, law), R(0), R(1));
      if (wo.z > 0) back.share[j] *= coats.split(j, back.cosine[j]).transmitted;
    }
    return back;
  }

  /// Of an interface of deltas. `coats.law[j]` is a CoatOnGlass, `coats.split(j, z)` E and T.
  template <class Coats>
  static SentBack smooth(const SpecularTerms<R>& terms, Vec3<R> wo, const Coats& coats) {
    SentBack back(wo, terms.eta);
    for (int j = 0; j < kWavelengths; ++j) {
      if (!coats.law[j].counts) continue;
      const FresnelSplit<R> e = coats.split(j, back.cosine[j]);
      const R t = e.transmitted;
      back.share[j] = wo.z < 0 ? terms.transmit_weight[j] * e.reflected
                               : terms.reflect_weight[j] *
                                     (t - glass_factor(true, true, t, t, coats.law[j].most));
    }
    return back;
  }
};

}  // namespace mms::materials
