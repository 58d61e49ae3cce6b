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

/// What the tables hold for light along one direction.
template <class R>
class FilmGlassWeights {
 public:
  FilmGlassWeights() = default;
  /// Along `w`, of facets of width `alpha`, at which light meets the index `eta`.
  /// \pre in_glass_tables(eta); outside it is above 1
  FilmGlassWeights(R alpha, Vec3<R> w, R eta) : inside_(w.z < 0) {
    using namespace axes;
    const R z = std::min(std::abs(w.z), R(1)), s = std::sqrt(w.x * w.x + w.y * w.y);
    const auto a = Stencil<R>::at(glass_alpha(alpha), kFilmGlassAlpha);
    const auto n = Stencil<R>::at(glass_index(eta), kFilmGlassIndex);
    const auto d =
        Stencil<R>::at(glass_direction(inside_, z, s, alpha, eta), kFilmGlassDirection[inside_]);
    const int n1 = kChanges * coefficients(kFilmGlassDirection[inside_]),
              n0 = n1 * coefficients(kFilmGlassIndex);
    add_terms(changes_, kChanges, kGgxFilmGlass.change[inside_], R(1), a, n0, n, n1, d, kChanges);
    add_terms(losses_, kLosses, kGgxFilmGlass.further, R(1), a,
              kLosses * coefficients(kFilmGlassIndex), n, kLosses);
  }

  /// How much more coats send back, but for T(o), than below the bare interface: `q` is of the
  /// film, and `bare` and `filmed` what bounces on and then goes outside.
  R more_sent_back(const CoatOnGlass<R>& coat, const R (&q)[axes::kFilmTerms], R bare,
                   R filmed) const {
    using axes::kFilmTerms;
    const auto few = coat.few_sent(inside_);
    // What bounces on goes where losses are, with a film or without.
    R sent = 0, here[2] = {}, all[2] = {};
    for (int i = 0; i < kFewGlassPoints; ++i) {
      const R* l = losses_ + i * (1 + kFilmTerms);
      R change = 0, filmed_loss = l[0];
      for (int k = 0; k < kFilmTerms; ++k) {
        change += q[k] * changes_[i * kFilmTerms + k];
        filmed_loss -= q[k] * l[1 + k];
      }
      const R x = few[i];
      sent += x * (inside_ ? change : -change);
      here[0] += x * l[0], all[0] += l[0];
      here[1] += x * filmed_loss, all[1] += filmed_loss;
    }
    const auto share = [&](int f) {
      return all[f] > 0 ? limited(here[f] / all[f], R(0), R(1)) : R(0);
    };
    return sent + filmed * share(1) - bare * share(0);
  }

 private:
  static constexpr int kChanges = kFewGlassPoints * axes::kFilmTerms,
                       kLosses = kFewGlassPoints * (1 + axes::kFilmTerms);
  bool inside_ = false;
  R changes_[kChanges] = {}, losses_[kLosses] = {};
};

}  // namespace mms::materials
