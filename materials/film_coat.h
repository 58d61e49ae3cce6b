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
/// [0] of light that meets a higher index, [1] a lower one.
inline constexpr int kFilmGlassAlpha = 18, kFilmGlassIndex = 14, kFilmGlassDirection[] = {36, 72};
inline constexpr BentGlassGrid kFilmBentGlass[] = {{8, 7, 10, 6}, {8, 9, 14, 6}};
inline constexpr int kFilmBentPoints = 6, kFilmBentTerms = kThinFilm.terms;
inline constexpr int kFilmGlassAspect = 5;
}  // namespace axes

/// `change` and `bent` as in GlassTables, of each k; `further` [of glass of a lower index than
/// outside].
struct FilmGlassTables {
  const float* change[2][2];  ///< [width][index][direction][point of the fewer][k]
  const float* bent[2][2];    ///< [width][index][direction][point][k][term of ShapeBasis]
  const float* further[2];    ///< [width][aspect][index][point of the fewer][l, and each D_k]
};
extern const FilmGlassTables kGgxFilmGlass;

/// [point of the fewer][k] for the round facets that are as wide as `f` is along its direction, at
/// which light meets the index `eta`.
/// \pre in_glass_tables(eta)
template <class R>
inline std::array<R, kFewGlassPoints * axes::kFilmTerms> round_film_weights(
    const FilmGlassTables& tables, const StretchedInterface<R>& f, bool inside, R eta) {
  using namespace axes;
  const R alpha = f.like(), s = std::sqrt(f.x * f.x + f.y * f.y);
  const bool falls = eta < 1;
  const int n2 = kFewGlassPoints * kFilmTerms, n1 = n2 * coefficients(kFilmGlassDirection[falls]),
            n0 = n1 * coefficients(kFilmGlassIndex);
  std::array<R, kFewGlassPoints * kFilmTerms> weights{};
  add_terms(weights.data(), n2, tables.change[inside][falls], R(1),
            Stencil<R>::at(glass_alpha(alpha), kFilmGlassAlpha), n0,
            Stencil<R>::at(glass_index(eta), kFilmGlassIndex), n1,
            Stencil<R>::at(glass_direction(inside, f.z, s, alpha, eta), kFilmGlassDirection[falls]),
            n2);
  return weights;
}

/// [point][k] of how much more those are for `f` itself.
template <class R>
inline std::array<R, axes::kFilmBentPoints * axes::kFilmBentTerms> shape_film_weights(
    const FilmGlassTables& tables, const StretchedInterface<R>& f, bool inside, R eta) {
  using namespace axes;
  using Basis = ShapeBasis<R>;
  constexpr int count = kFilmBentPoints * kFilmBentTerms;
  const bool falls = eta < 1;
  const BentGlassGrid& grid = kFilmBentGlass[falls];
  const R alpha = f.like(), s = std::sqrt(f.x * f.x + f.y * f.y);
  const Basis basis(f.shape(widening(eta, alpha)), grid.degree);
  const int n2 = count * basis.count, n1 = n2 * coefficients(grid.direction),
            n0 = n1 * coefficients(grid.index);
  R sums[count * Basis::terms(std::max(kFilmBentGlass[0].degree, kFilmBentGlass[1].degree))] = {};
  add_terms(sums, n2, tables.bent[inside][falls], R(1),
            Stencil<R>::at(glass_alpha(alpha), grid.width), n0,
            Stencil<R>::at(glass_index(eta), grid.index), n1,
            Stencil<R>::at(glass_direction(inside, f.z, s, alpha, eta), grid.direction), n2);
  std::array<R, count> weights;
  for (int i = 0; i < count; ++i) weights[i] = basis.sum(sums + i * basis.count);
  return weights;
}

/// What the tables hold for light along one direction.
template <class R>
class FilmGlassWeights {
 public:
  FilmGlassWeights() = default;
  /// Along the direction of `f`, from where light meets the index `eta`.
  /// \pre in_glass_tables(eta)
  FilmGlassWeights(const StretchedInterface<R>& f, R eta, bool inside)
      : inside_(inside),
        stretched_(f.wide != f.narrow),
        round_(round_film_weights(kGgxFilmGlass, f, inside, eta)) {
    using namespace axes;
    if (stretched_) shape_ = shape_film_weights(kGgxFilmGlass, f, inside, eta);
    constexpr int n2 = kLosses, n1 = n2 * coefficients(kFilmGlassIndex),
                  n0 = n1 * coefficients(kFilmGlassAspect);
    add_terms(losses_, kLosses, kGgxFilmGlass.further[inside != (eta < 1)], R(1),
              Stencil<R>::at(glass_alpha(f.root()), kFilmGlassAlpha), n0,
              Stencil<R>::at(aspect(f.wide / f.narrow), kFilmGlassAspect), n1,
              Stencil<R>::at(glass_index(eta), kFilmGlassIndex), n2);
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
    const auto& matrix = chebyshev_transfer<kFilmBentPoints, kFewGlassPoints>();
    R changed = 0;
    for (int m = 0; m < kFilmBentPoints; ++m) {
      R there = 0, change = 0;
      for (int i = 0; i < kFewGlassPoints; ++i) there += R(matrix[m][i]) * sent[i];
      for (int k = 0; k < kFilmBentTerms; ++k) change += q[k] * shape_[m * kFilmBentTerms + k];
      changed += there * change;
    }
    return changed;
  }

  bool inside_ = false, stretched_ = false;
  std::array<R, kFewGlassPoints * axes::kFilmTerms> round_{};
  std::array<R, axes::kFilmBentPoints * axes::kFilmBentTerms> shape_{};
  R losses_[kLosses] = {};
};

}  // namespace mms::materials
