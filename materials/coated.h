// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Lobes that are to reflect a given share of light: those below a coat what it lets through, its
/// own what it reflects. K(o, i) is such a lobe that is white and lossless, so that int K |cos i|
/// di = 1, and A(o) > 0 the share. There is one positive g with
///
///   g(o) G(o) = A(o),   G(o) = int g(i) K(o, i) |cos i| di
///
/// (the scaling of a symmetric kernel to given sums, Sinkhorn 1967), and g(o) g(i) K(o, i) is
/// reciprocal, positive and reflects A exactly: coat and base together lose nothing. For Lambert's
/// lobe g = A / sqrt(mean A); for one that is all but a mirror, sqrt A. Where the base absorbs, its
/// f is below K's, and so is what it reflects.
///
/// Tables hold, for each width, index above 1 and direction, G^2 - T where T is 1 - (1 - s) F - s L
/// (materials/coat.h) for some s, with polynomials between; and ln (G^2 / E) as a coat: E is next
/// to nothing along most directions where the index is next to 1 (materials/tables/coated.cpp).
/// Where a part of T does not depend on the direction, G^2 - T is as much less as F and L are, but
/// for the square of how much they vary. What stretched facets have above round ones as wide along
/// the direction is in further tables, as polynomials over the shape that they have along it
/// (materials/tables/stretched_coats.cpp). What that is off by says materials/combine.h. Below
/// several coats and films G is solved for (materials/under_coats.h).

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "materials/coat.h"
#include "materials/energy.h"
#include "materials/fresnel.h"
#include "materials/lobe.h"

namespace mms::materials {

namespace axes {
/// Widths of `rough_matte`, and directions of a lobe's matrix.
inline constexpr int kCoatedMatte = 5, kSpread = 40;
/// Heights of the directions of one of stretched facets; azimuths at each, and fewer at the last,
/// within 30 degrees of the normal, towards which all azimuths are alike; quotients of widths.
inline constexpr int kStretchedSpread = 27, kSpreadTurns = 12, kSpreadRings = 9;
inline constexpr int kFewSpreadTurns = 6, kSpreadOfFew = 6;
/// Roots of widths, with which what Beckmann facets do changes faster.
inline constexpr int kGgxSpreadAlpha = 20, kBeckmannSpreadAlpha = 28;
/// s of the coats that lobes lie below in the tables.
inline constexpr double kHeld[] = {0, 0.2, 0.5, 0.8, 1}, kStretchedHeld[] = {0, 0.3, 0.7, 1};
/// Of stretched facets; the axis of the width is that of an interface.
inline constexpr int kStretchedCoatAlpha = 22, kStretchedCoatIndex = 23,
                     kStretchedCoatDirection = 36;
inline constexpr ShapeOrder kStretchedCoatShapes{20, 4};
inline constexpr double kLeastCoatIndex = 0.1, kMostCoatIndex = 0.9844914;  ///< of 1.0002 and 32

template <class R>
inline R stretched_coat_index(R eta) {
  return (index(eta) - R(kLeastCoatIndex)) / R(kMostCoatIndex - kLeastCoatIndex);
}
/// Of a direction of |cosine| `z`: crowded towards grazing, where what coats let through changes,
/// and as a cosine towards the normal, about which it is even in the angle.
template <class R>
inline R spread_direction(R z) {
  const R a = angle(z, std::sqrt(std::max((1 - z) * (1 + z), R(0)))),
          x = (3 * std::sqrt(a) + a) / 4;
  return x * (9 - 4 * x) / 5;
}
/// Its inverse.
template <class R>
inline R spread_cosine(R place) {
  const R x = (9 - std::sqrt(81 - 80 * place)) / 8, root = (std::sqrt(9 + 16 * x) - 3) / 2;
  return std::sin(std::numbers::pi_v<R> / 2 * std::min(root * root, R(1)));
}
/// Of the widths of stretched facets: what is uniform here are rings of their shapes.
template <class R>
inline R ring(R wide, R narrow) {
  const R radius = Shape<R>::radius(wide, narrow);
  return std::asin(std::min(radius, R(1))) * (2 / std::numbers::pi_v<R>);
}
/// Of a tangent (x, y), x along the wider axis, `quotient` times as wide as the other: half of it
/// azimuths from the narrower axis, half those of a tangent that is stretched nearly as much.
template <class R>
inline R spread_turn(R x, R y, R quotient) {
  return (azimuth(std::sqrt(quotient * std::sqrt(quotient)) * x, y) + azimuth(x, y)) / 2;
}
}  // namespace axes

/// Of one kind of lobe, for relative indices above 1.
struct CoatedTables {
  /// Of G^2 - T for each s of axes::kHeld: [width][index][direction].
  const float* under[std::size(axes::kHeld)];
  const float* coat;  ///< of ln (G^2 / E), where the lobe can be a coat
  /// The same of stretched facets, for each s of axes::kStretchedHeld:
  /// [root of both alphas][index][direction][term of ShapeBasis].
  const float* under_stretched[std::size(axes::kStretchedHeld)];
  const float* coat_stretched;
  /// [width][column][direction o]: int K l |cos i| di for each of axes::kSpread polynomials l over
  /// axes::spread_direction, which are 1 at one of the directions and 0 at the others.
  const float* spread;
  /// The same of stretched facets, [root of both alphas][ring][column][direction o], the directions
  /// of axes::kStretchedSpread heights, azimuths at Chebyshev's points over axes::spread_turn:
  /// polynomials of both.
  const float* spread_stretched;
  int spread_alpha;  ///< nodes of its first axis
};
extern const CoatedTables kGgxCoated, kBeckmannCoated, kGlossyCoated, kMatteCoated;

/// What tables over a lobe's width hold for relative index `eta` > 1 and a direction at `place` of
/// axes::coat_direction: the sum of `count` of them, by weights, or one.
template <class R>
inline R interpolate_coat(const float* const* tables, const R* weights, int count,
                          const Stencil<R>& width, R eta, R place) {
  using namespace axes;
  const auto n = Stencil<R>::at(index(eta), kCoatIndex);
  const auto d = Stencil<R>::at(place, kCoatDirection);
  constexpr int n1 = coefficients(kCoatDirection), n0 = n1 * coefficients(kCoatIndex);
  R sum = 0;
  for (int k = 0; k < count; ++k)
    if (weights[k] != 0) sum += weights[k] * interpolate(tables[k], width, n0, n, n1, d);
  return sum;
}
template <class R>
inline R interpolate_coat(const float* table, const Stencil<R>& width, R eta, R place) {
  const R one = 1;
  return interpolate_coat(&table, &one, 1, width, eta, place);
}

/// Facets as they look along one direction.
template <class R>
struct FacetsAlong {
  R like;  ///< the width of round ones that are nearly as wide; at most 1
  R mean;  ///< of both widths, the geometric one
  bool stretched = false;
  R wide, narrow, x, y;  ///< x along the wider axis
  Stencil<R> root{};
  Shape<R> shape{};

  FacetsAlong(R ax, R ay, Vec3<R> w)
      : like(ax),
        mean(std::sqrt(ax * ay)),
        stretched(ax != ay),
        wide(std::max(ax, ay)),
        narrow(std::min(ax, ay)),
        x(ax < ay ? w.y : w.x),
        y(ax < ay ? w.x : w.y) {
    if (!stretched) return;
    like = coated_width(w.z);
    root = Stencil<R>::at(axes::interface_alpha(mean), axes::kStretchedCoatAlpha);
    shape = Shape<R>::of(wide, narrow, x, y);
  }

  /// The sum of `count` tables, by weights, for relative index `eta` > 1 and a direction at `place`
  /// of axes::coat_direction.
  R difference(const float* const* tables, const R* weights, int count, R eta, R place) const {
    using namespace axes;
    using Basis = ShapeBasis<R>;
    constexpr int terms = Basis::terms(kStretchedCoatShapes),
                  n1 = terms * coefficients(kStretchedCoatDirection),
                  n0 = n1 * coefficients(kStretchedCoatIndex);
    const auto n = Stencil<R>::at(stretched_coat_index(eta), kStretchedCoatIndex);
    const auto d = Stencil<R>::at(place, kStretchedCoatDirection);
    const Basis basis(shape, kStretchedCoatShapes);
    R sums[terms] = {};
    for (int b = 0; b < count; ++b)
      if (weights[b] != 0)
        add_terms(sums, basis.count, tables[b], weights[b], root, n0, n, n1, d, terms);
    const R sum = basis.sum(sums);
    // Above the axis few directions are let through.
    const auto mean_through = [](R index) { return 1 - fresnel_dielectric_diffuse(index); };
    return eta > 32 ? sum * (mean_through(eta) / mean_through(R(32))) : sum;
  }

 private:
  R coated_width(R z) const {
    const R a = wide * x, b = narrow * y, along = std::sqrt(a * a + b * b + z * z * (mean * mean));
    return along / (1 + (along - mean));
  }
};

/// The weights of values at `nodes` for that of their polynomial at `x`.
template <class R, std::size_t N>
inline std::array<R, N> lagrange(const double (&nodes)[N], R x) {
  std::array<R, N> to;
  for (std::size_t k = 0; k < N; ++k) {
    to[k] = 1;
    for (std::size_t m = 0; m < N; ++m)
      if (m != k) to[k] *= (x - R(nodes[m])) * R(1 / (nodes[k] - nodes[m]));
  }
  return to;
}

/// One lobe along one direction.
template <class R>
struct CoatedLobe {
  const CoatedTables* tables = nullptr;
  Stencil<R> width{};
  R as_facets = 0;     ///< alpha of facets that are as wide, as a coat
  R z = 1, place = 1;  ///< the direction's |cosine|, and where it is on axes::coat_direction
  FacetsAlong<R> along{R(1), R(1), {}};

  CoatedLobe() = default;
  static CoatedLobe facets(const CoatedTables& tables, R ax, R ay, Vec3<R> w) {
    const FacetsAlong<R> along(ax, ay, w);
    CoatedLobe lobe(tables, facet_width(along.like), w);
    lobe.as_facets = along.mean;
    lobe.along = along;
    return lobe;
  }
  static CoatedLobe glossy(R gloss, Vec3<R> w) {
    CoatedLobe lobe(kGlossyCoated, Stencil<R>::at(axes::gloss(gloss), axes::kGloss), w);
    lobe.as_facets = glossy_as_facets(gloss);
    return lobe;
  }
  static CoatedLobe matte(R roughness, Vec3<R> w) {
    return {kMatteCoated, Stencil<R>::at(roughness, axes::kCoatedMatte), w};
  }
  static Stencil<R> facet_width(R alpha) {
    return Stencil<R>::at(axes::coat_alpha(alpha), axes::kCoatAlpha);
  }

  bool stretched() const { return along.stretched; }
  Broadness<R> broad() const { return Broadness<R>::facets(as_facets); }
  /// Whether it is the same but for its direction.
  bool is_like(const CoatedLobe& other) const {
    if (tables != other.tables || stretched() != other.stretched()) return false;
    if (stretched()) return along.wide == other.along.wide && along.narrow == other.along.narrow;
    return width == other.width;
  }

  /// G^2 below a coat of relative index `eta` > 1, for T = `through`. What rounding leaves of G^2
  /// next to the surface is kept from 0.
  R below(R eta, const CoatShape<R>& coat, R through) const {
    const R varies = coat.steep + coat.held;
    if (!(varies > 0)) return through;
    const R s = coat.held / varies;
    const auto weights = lagrange<R>(axes::kHeld, s);
    R above =
        interpolate_coat(tables->under, weights.data(), int(weights.size()), width, eta, place);
    if (stretched()) {
      const auto of_shape = lagrange<R>(axes::kStretchedHeld, s);
      // Below the axis few directions are not let through.
      constexpr R least = R(axes::kLeastCoatIndex * axes::kLeastCoatIndex * axes::kLeastCoatIndex *
                            axes::kLeastCoatIndex);
      above += along.difference(tables->under_stretched, of_shape.data(), int(of_shape.size()), eta,
                                place) *
               std::min((eta - 1) / (least * (eta + 1)), R(1));
    }
    return std::max(through + varies * above, through / 2);
  }
  /// The same as a part of a coat, for E = `reflected`.
  R as_coat(R eta, R reflected) const {
    R quotient = interpolate_coat(tables->coat, width, eta, place);
    if (stretched()) {
      const R one = 1;
      quotient += along.difference(&tables->coat_stretched, &one, 1, eta, place);
    }
    return reflected * std::exp(limited(quotient, R(-20), R(40)));
  }

 private:
  CoatedLobe(const CoatedTables& its_tables, const Stencil<R>& its_width, Vec3<R> w)
      : tables(&its_tables),
        width(its_width),
        z(std::min(std::abs(w.z), R(1))),
        place(axes::coat_direction(z)) {}
};

}  // namespace mms::materials
