// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What facets of an interface lose under a film. Of light whose |cosine| at a facet is c on the
/// side of the lower index, the film lets q(c) times as much through as is without it, and q - 1 is
/// nearly a polynomial. So the loss is
///
///   l(w) - sum_k q_k D_k(w),   q(c) - 1 = sum_k q_k t_k(c),
///
/// where D_k is the mean over the facets that w sees of t_k(c) T(c) times how much less of what
/// goes through than of what is reflected other facets take, T = 1 - F, and t_k is Chebyshev's
/// polynomial of degree k over [0, 1]. Tables that are computed when the project is built
/// (materials/tables/film.cpp) hold D_k over the sum of l and of what facets lose that are mirrors,
/// which it never exceeds, of GGX facets: of round ones, and what stretched ones have above those
/// as wide along w, as polynomials over the shape that they have along it (materials/energy.h).

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/chebyshev.h"
#include "materials/energy.h"
#include "materials/fresnel.h"
#include "materials/lobe.h"
#include "materials/thin_film.h"

namespace mms::materials {

/// [0] where the index rises on the far side, [1] where it falls.
struct FilmTables {
  const float* loss[2];       ///< [alpha][index][direction][k], isotropic
  const float* stretched[2];  ///< [width][index][direction][k][term of ShapeBasis]
  const float* mean[2];       ///< [alpha][aspect][index][k]
};
extern const FilmTables kGgxFilm;

namespace axes {
inline constexpr int kFilmTerms = 12;
inline constexpr int kFilmAlpha = 18, kFilmIndex = 16, kFilmDirection[] = {36, 64};
inline constexpr int kFilmMeanAlpha = 24, kFilmMeanAspect = 6;
inline constexpr BentGrid kFilmBent[] = {{16, 9, 32, {16}}, {16, 28, 40, {16}}};

/// Of indices from 1.0002 to 4, or their inverses. Stretched facets have the axes of their bare
/// losses (bent_index, bent_direction).
template <class R>
inline R film_index(R eta) {
  return (index(eta) - R(kLeastBentIndex)) / R(kMostBentIndex - kLeastBentIndex);
}
}  // namespace axes

/// A loss, along a direction or of all, and what films change of it.
template <class R>
struct FilmedLoss {
  R bare = 0, terms[axes::kFilmTerms] = {};

  /// The first `count` of the terms.
  static FilmedLoss at(const FilmTables& tables, const InterfaceLoss<R>& loss,
                       const FacetLoss<R>& mirrors, Vec3<R> w, int count) {
    FilmedLoss to{loss.at(w)};
    quotients(tables, loss, w, to.terms, count);
    const R unit = to.bare + mirrors.at(w);
    for (int k = 0; k < count; ++k) to.terms[k] *= unit;
    return to;
  }

  static FilmedLoss mean(const FilmTables& tables, const InterfaceLoss<R>& loss,
                         const FacetLoss<R>& mirrors, int count) {
    using namespace axes;
    const R wide = std::max(loss.ax, loss.ay), narrow = std::min(loss.ax, loss.ay);
    const int n2 = kFilmTerms, n1 = n2 * coefficients(kFilmIndex),
              n0 = n1 * coefficients(kFilmMeanAspect);
    FilmedLoss to{loss.mean()};
    add_terms(to.terms, count, tables.mean[loss.eta < 1], to.bare + mirrors.mean(),
              Stencil<R>::at(interface_alpha(std::sqrt(wide * narrow)), kFilmMeanAlpha), n0,
              Stencil<R>::at(aspect(wide / narrow), kFilmMeanAspect), n1,
              Stencil<R>::at(film_index(loss.eta), kFilmIndex), n2);
    return to;
  }

  /// Adds what the tables hold along `w`, the first `count`.
  static void quotients(const FilmTables& tables, const InterfaceLoss<R>& loss, Vec3<R> w,
                        R (&sums)[axes::kFilmTerms], int count) {
    using namespace axes;
    const bool falls = loss.eta < 1;
    const R z = std::abs(w.z), s = std::sqrt(w.x * w.x + w.y * w.y);
    const StretchedFacets<R> f = loss.stretched({w.x, w.y, z});
    const bool round = loss.ax == loss.ay;
    const R alpha = round ? loss.ax : f.like();
    const R place = round ? loss.same.direction(z, s) : interface_direction(z, s, alpha, loss.eta);
    const auto add = [&](R* to, int of_each, const float* table, const Stencil<R>& width,
                         const Stencil<R>& index, int indices, const Stencil<R>& direction,
                         int directions) {
      const int n2 = of_each * kFilmTerms, n1 = n2 * coefficients(directions),
                n0 = n1 * coefficients(indices);
      add_terms(to, of_each * count, table, R(1), width, n0, index, n1, direction, n2);
    };
    add(sums, 1, tables.loss[falls], Stencil<R>::at(interface_alpha(alpha), kFilmAlpha),
        Stencil<R>::at(film_index(loss.eta), kFilmIndex), kFilmIndex,
        Stencil<R>::at(place, kFilmDirection[falls]), kFilmDirection[falls]);
    if (round) return;
    const BentGrid& grid = kFilmBent[falls];
    const R kink = R(loss.tables->kink), bent = bent_direction(place, z, s, alpha, loss.eta, kink);
    R shapes[ShapeBasis<R>::terms(kFilmBent[1].shapes) * kFilmTerms] = {};
    const int terms = ShapeBasis<R>::terms(grid.shapes);
    add(shapes, terms, tables.stretched[falls], Stencil<R>::at(bent_width(alpha), grid.width),
        Stencil<R>::at(bent_index(loss.eta, kink), grid.index), grid.index,
        Stencil<R>::at(bent, grid.direction), grid.direction);
    const ShapeBasis<R> basis(f.shape(widening(loss.eta, alpha)), grid.shapes);
    for (int k = 0; k < count; ++k) sums[k] += basis.sum(shapes + k * terms);
  }
};

/// The terms by which a film's q is known, and the points that they are found from.
struct FilmOrder {
  int terms, points;
};
/// Those of films that do not fade, and of others.
inline constexpr FilmOrder kThinFilm{8, 10}, kThickFilm{axes::kFilmTerms, 14};

/// How many more fringes, or waves of where the index is 1, a film has, seen from the lower index,
/// than its few terms know within 5e-4 of what facets lose: the more of these, the sharper films of
/// high indices are towards grazing.
template <class R>
inline R beyond_thin(const Film<R>& film) {
  return std::max(film.fringes - R(1.5), film.waves() - 2);
}

/// How much of its fringes a film on rough glass shows, seen from the lower index.
template <class R>
inline R film_contrast(const Film<R>& film) {
  return film.ior < 1 ? R(1) : faded(beyond_thin(film));
}

/// Films between two indices at Chebyshev's points of the cosine at a facet.
template <class R, const FilmOrder& kOrder>
struct FilmPoints {
  static constexpr int kCount = kOrder.points;
  using Values = std::array<R, kCount>;
  FilmAlong<R, kCount> films;
  Values bare{};  ///< what goes through where there is no film

  FilmPoints() = default;
  FilmPoints(R film, R far) : films(rule().cosines, film, far) {
    for (int i = 0; i < kCount; ++i) bare[i] = fresnel_split(rule().cosines[i], far).transmitted;
  }

  /// Adds the terms of `film`, seen from the lower index, to `q`.
  void add_terms(const Film<R>& film, R eta, R* q) {
    const auto& [cosines, parts] = rule();
    if (!films.is_of(film.ior, eta)) *this = {film.ior, eta};
    Values through;
    if (film.ior < 1)
      for (int i = 0; i < kCount; ++i) through[i] = film.split(cosines[i], R(1), eta).transmitted;
    else
      through = films.split(film.phases, film_contrast(film)).transmitted;
    for (int i = 0; i < kCount; ++i) {
      const R change = bare[i] > 0 ? through[i] / bare[i] - 1 : R(0);
      through[i] = limited(change, R(-1), R(1e3));
    }
    for (int k = 0; k < kOrder.terms; ++k)
      for (int i = 0; i < kCount; ++i) q[k] += parts[k][i] * through[i];
  }

 private:
  /// The points, and what a function's values there are multiplied with for its part of each
  /// polynomial.
  struct Rule {
    Values cosines, parts[kOrder.terms];

    Rule() {
      for (int i = 0; i < kCount; ++i) {
        cosines[i] = R(chebyshev_points<kCount>()[i]);
        const auto terms = chebyshev_terms<kOrder.terms>(cosines[i]);
        for (int k = 0; k < kOrder.terms; ++k)
          parts[k][i] = terms[k] * R(k == 0 ? 1 : 2) / R(kCount);
      }
    }
  };
  static const Rule& rule() {
    static const Rule rule;
    return rule;
  }
};

/// Those of either order, for laws of the same indices.
template <class R>
struct SharedFilms {
  FilmPoints<R, kThinFilm> thin;
  FilmPoints<R, kThickFilm> thick;
};

/// What a film does to losses.
template <class R>
struct FilmLaw {
  R q[axes::kFilmTerms] = {};

  FilmLaw() = default;
  /// Between outside and the index `n`.
  FilmLaw(const Film<R>& outside, R n, bool thin, SharedFilms<R>& shared) {
    const R near = std::min(n, R(1)), far = std::max(n, R(1));
    const Film<R> film = outside.in(near);
    if (thin)
      shared.thin.add_terms(film, far / near, q);
    else
      shared.thick.add_terms(film, far / near, q);
  }

  R of(const FilmedLoss<R>& loss) const {
    R l = loss.bare;
    for (int k = 0; k < axes::kFilmTerms; ++k) l -= q[k] * loss.terms[k];
    return limited(l, loss.bare / 100, R(1));
  }
};

}  // namespace mms::materials
