// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Rough `film_dielectric` below coats (materials/glass_coat.h): what they send back as below the
/// bare interface, and what the film changes of that. With q of materials/film_energy.h, the film
/// lets q - 1 = sum_k q_k t_k(c) times more through at each facet and reflects as much less; tables
/// that are computed when the project is built (materials/tables/film_glass.cpp) hold for each k
/// the weights of the points for what round GGX facets so send outside, what stretched ones have
/// above those as wide along the direction, by fewer points and k, and for l and D_k outside, by
/// which what bounces on is distributed.

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/film_energy.h"
#include "materials/glass_coat.h"

namespace mms::materials {

namespace axes {
inline constexpr GlassGrid kRoundFilmGlass[] = {{18, 14, 36}, {18, 14, 72}};
inline constexpr GlassGrid kBentFilmGlass[] = {{8, 7, 10, {4}}, {8, 9, 14, {4}}};
inline constexpr int kBentFilmPoints = 5, kBentFilmTerms = kThinFilm.terms;
inline constexpr int kFurtherAlpha = 18, kFurtherAspect = 5, kFurtherIndex = 14;
}  // namespace axes

/// `change` and `bent` as in GlassTables, of each k; `further` [of glass of a lower index than
/// outside].
struct FilmGlassTables {
  const float* change[2][2];  ///< [width][index][direction][point of the fewer][k]
  const float* bent[2][2];    ///< [width][index][direction][point][k][term of ShapeBasis]
  const float* further[2];    ///< [width][aspect][index][point of the fewer][l, and each D_k]
};
extern const FilmGlassTables kGgxFilmGlass;

/// [point of the fewer][k] of the round facets that are as wide as `f` is along its direction.
/// \pre in_glass_tables(eta)
template <class R>
inline std::array<R, kFewGlassPoints * axes::kFilmTerms> round_film_weights(
    const FilmGlassTables& tables, const StretchedFacets<R>& f, bool inside, R eta) {
  return of_round_glass<axes::kRoundFilmGlass, kFewGlassPoints * axes::kFilmTerms>(
      tables.change[inside][eta < 1], f, inside, eta);
}

/// What the tables hold for light along one direction.
template <class R>
class FilmGlassWeights {
 public:
  FilmGlassWeights() = default;
  /// Along the direction of `f`, from where light meets the index `eta`.
  /// \pre in_glass_tables(eta)
  FilmGlassWeights(const StretchedFacets<R>& f, R eta, bool inside)
      : inside_(inside),
        stretched_(f.wide != f.narrow),
        round_(round_film_weights(kGgxFilmGlass, f, inside, eta)) {
    using namespace axes;
    if (stretched_)
      shape_ = of_bent_glass<kBentFilmGlass, kBentFilmPoints * kBentFilmTerms>(
          kGgxFilmGlass.bent[inside][eta < 1], f, inside, eta);
    constexpr int n2 = kLosses, n1 = n2 * coefficients(kFurtherIndex),
                  n0 = n1 * coefficients(kFurtherAspect);
    add_terms(losses_, kLosses, kGgxFilmGlass.further[inside != (eta < 1)], R(1),
              Stencil<R>::at(glass_alpha(f.root()), kFurtherAlpha), n0,
              Stencil<R>::at(aspect(f.wide / f.narrow), kFurtherAspect), n1,
              Stencil<R>::at(glass_index(eta), kFurtherIndex), n2);
  }

  /// How much more coats send back, but for T(o), than below the bare interface: `q` is of the
  /// film, and `bare` and `filmed` what bounces on and then goes outside.
  R more_sent_back(const CoatOnGlass<R>& coat, const R (&q)[axes::kFilmTerms], R bare,
                   R filmed) const {
    using namespace axes;
    const auto few = coat.few_sent(inside_);
    // What bounces on goes where losses are, with a film or without.
    R changed = 0, here[2] = {}, all[2] = {};
    for (int i = 0; i < kFewGlassPoints; ++i) {
      const R* l = losses_ + i * (1 + kFilmTerms);
      R change = 0, filmed_loss = l[0];
      for (int k = 0; k < kFilmTerms; ++k) {
        change += q[k] * round_[i * kFilmTerms + k];
        filmed_loss -= q[k] * l[1 + k];
      }
      const R x = few[i];
      changed += x * change;
      here[0] += x * l[0], all[0] += l[0];
      here[1] += x * filmed_loss, all[1] += filmed_loss;
    }
    if (stretched_) changed += of_shape(few, q);
    const auto share = [&](int f) {
      return all[f] > 0 ? limited(here[f] / all[f], R(0), R(1)) : R(0);
    };
    return (inside_ ? changed : -changed) + filmed * share(1) - bare * share(0);
  }

 private:
  static constexpr int kLosses = kFewGlassPoints * (1 + axes::kFilmTerms);

  R of_shape(const std::array<R, kFewGlassPoints>& sent, const R (&q)[axes::kFilmTerms]) const {
    using namespace axes;
    const auto& matrix = chebyshev_transfer<kBentFilmPoints, kFewGlassPoints>();
    R changed = 0;
    for (int m = 0; m < kBentFilmPoints; ++m) {
      R there = 0, change = 0;
      for (int i = 0; i < kFewGlassPoints; ++i) there += R(matrix[m][i]) * sent[i];
      for (int k = 0; k < kBentFilmTerms; ++k) change += q[k] * shape_[m * kBentFilmTerms + k];
      changed += there * change;
    }
    return changed;
  }

  bool inside_ = false, stretched_ = false;
  std::array<R, kFewGlassPoints * axes::kFilmTerms> round_{};
  std::array<R, axes::kBentFilmPoints * axes::kBentFilmTerms> shape_{};
  R losses_[kLosses] = {};
};

}  // namespace mms::materials
