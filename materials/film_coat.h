// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Rough `film_dielectric` below coats (materials/glass_coat.h): what they send back as below the
/// bare interface, and what the film changes of that. With q of materials/film_energy.h, the film
/// lets q - 1 = sum_k q_k t_k(c) times more through at each facet and reflects as much less; tables
/// that are computed when the project is built (materials/tables/film_glass.cpp) hold for each k
/// the weights of the points for what round GGX facets so send outside, and for l and D_k there, by
/// which what bounces on is distributed. Stretched facets count as the round ones that are as wide
/// along the direction.

#include <cmath>

#include "materials/film_energy.h"
#include "materials/glass_coat.h"

namespace mms::materials {

/// [0] of light from outside, [1] from inside.
struct FilmGlassTables {
  const float* change[2];  ///< [width][index][direction][point of the fewer][k]
  const float* further;    ///< [width][index][point of the fewer][of l, and then of each D_k]
};
extern const FilmGlassTables kGgxFilmGlass;

namespace axes {
inline constexpr int kFilmGlassAlpha = 18, kFilmGlassIndex = 14, kFilmGlassDirection[] = {36, 72};
}

/// How much more of light along `w` coats send back, but for T(o), than below bare facets of width
/// `alpha` and index `glass`: `q` is of the film, and `bare` and `filmed` what bounces on and then
/// goes outside. \pre in_glass_tables(glass)
template <class R>
inline R more_sent_back(R alpha, Vec3<R> w, R glass, const CoatOnGlass<R>& coat,
                        const R (&q)[axes::kFilmTerms], R bare, R filmed) {
  using namespace axes;
  constexpr int points = kFewGlassPoints, terms = points * kFilmTerms;
  const bool inside = w.z < 0;
  const R z = std::min(std::abs(w.z), R(1)), s = std::sqrt(w.x * w.x + w.y * w.y);
  const auto a = Stencil<R>::at(glass_alpha(alpha), kFilmGlassAlpha);
  const auto n = Stencil<R>::at(glass_index(glass), kFilmGlassIndex);
  const auto d =
      Stencil<R>::at(glass_direction(inside, z, s, alpha, glass), kFilmGlassDirection[inside]);
  R changes[terms] = {}, losses[terms + points] = {};
  const int n1 = terms * coefficients(kFilmGlassDirection[inside]),
            n0 = n1 * coefficients(kFilmGlassIndex);
  add_terms(changes, terms, kGgxFilmGlass.change[inside], R(1), a, n0, n, n1, d, terms);
  add_terms(losses, terms + points, kGgxFilmGlass.further, R(1), a,
            (terms + points) * coefficients(kFilmGlassIndex), n, terms + points);
  // What bounces on goes where losses are, with a film or without.
  R sent = 0, here[2] = {}, all[2] = {};
  for (int i = 0; i < points; ++i) {
    const R* l = losses + i * (1 + kFilmTerms);
    R change = 0, filmed_loss = l[0];
    for (int k = 0; k < kFilmTerms; ++k) {
      change += q[k] * changes[i * kFilmTerms + k];
      filmed_loss -= q[k] * l[1 + k];
    }
    const R x = coat.few[inside][i];
    sent += x * (inside ? change : -change);
    here[0] += x * l[0], all[0] += l[0];
    here[1] += x * filmed_loss, all[1] += filmed_loss;
  }
  const auto share = [&](int f) {
    return all[f] > 0 ? limited(here[f] / all[f], R(0), R(1)) : R(0);
  };
  return sent + filmed * share(1) - bare * share(0);
}

}  // namespace mms::materials
