// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A film (materials/thin_film.h) over metal (`film_conductor`) or glass (`film_dielectric`), which
/// both may be rough: facets are larger than the film is thick, and each has its colours. What
/// light between facets of metal reflects is taken as for a bare one. Rough glass keeps its energy
/// within 1e-3 under films of an index from 1.1 (materials/film_energy.h), but that one random
/// setting in 4000 of anisotropy 1, and in 15000 of 0.9, is up to 3.6e-3 off. More than one and a
/// half fringes, and those of films of more than two waves of where the index is 1, fade to the
/// mean of films of all thicknesses: no few numbers say what many facets lose under these, and
/// films of that thickness, which is not even to a wave, look so.

#include <algorithm>
#include <array>
#include <complex>

#include "materials/conductor.h"
#include "materials/dielectric.h"
#include "materials/film_coat.h"
#include "materials/film_energy.h"
#include "materials/thin_film.h"

namespace mms::materials {

/// Reflectance of metal under a film. Arguments in the order of the row.
template <class R>
struct FilmFresnel {
  static constexpr int kNumbers = 4 * kWavelengths + 1;
  const R* p;

  Spectrum<R> operator()(R c) const {
    Spectrum<R> f;
    for (int j = 0; j < kWavelengths; ++j) {
      const std::complex<R> metal(limited(p[j], R(0), R(1e3)),
                                  limited(p[kWavelengths + j], R(0), R(1e3)));
      f[j] = film(j).split(c, R(1), metal).reflected;
    }
    return f;
  }
  /// Of the cosine, in which there is half a fringe at most, but of films of many.
  int parts() const {
    R most = 0;
    for (int j = 0; j < kWavelengths; ++j) most = std::max(most, film(j).fringes);
    return 2 + int(std::min(2 * most, R(14)));
  }

 private:
  Film<R> film(int j) const {
    return {p[2 * kWavelengths + j], p[3 * kWavelengths], p[3 * kWavelengths + 1 + j]};
  }
};

template <class R>
using FilmConductor = RoughMetal<R, FilmFresnel>;

/// An interface under a film on its outside: index and thickness of the film and the wavelengths.
template <class R>
struct FilmFace {
  static constexpr bool kFilmed = true;
  static constexpr int kNumbers = 2 * kWavelengths + 1;
  std::array<Film<R>, kWavelengths> films;
  bool thin = true;  ///< see kThinFilm; none is on an index below 1, where films reflect more

  /// Behind the index of what lies inside.
  explicit FilmFace(const R* ior) {
    const R* index = ior + kWavelengths;
    const R* wavelength = index + kWavelengths + 1;
    for (int j = 0; j < kWavelengths; ++j) {
      films[j] = {index[j], index[kWavelengths], wavelength[j]};
      thin &= ior[j] >= 1 && beyond_thin(films[j]) <= 0;
    }
  }

  bool repeated(int j) const { return films[j] == films[j - 1]; }
  FresnelSplit<R> split(int j, R c, R eta, bool outside) const {
    if (!(refraction_g2(c, eta) > 0)) return {R(1), R(0)};
    return outside ? films[j].split(c, R(1), eta) : films[j].split(c, 1 / eta, R(1));
  }
  FresnelSplit<R> facet(int j, R c, R eta, bool outside) const {
    if (thin) return split(j, c, eta, outside);
    const R n = outside ? eta : 1 / eta, lower = std::min(n, R(1));
    const Film<R> film = films[j].in(lower);
    const R contrast = film_contrast(film);
    if (contrast == 1) return split(j, c, eta, outside);
    const R g2 = refraction_g2(c, eta);
    if (!(g2 > 0)) return {R(1), R(0)};
    const R lower_cosine = eta >= 1 ? c : std::min(std::sqrt(g2) / eta, R(1));
    const auto e = FilmAlong<R>({lower_cosine}, film.ior, std::max(n, R(1)) / lower)
                       .split(film.phases, contrast);
    return {e.reflected[0], e.transmitted[0]};
  }

  using Loss = FilmedLoss<R>;
  Loss loss(const Ggx<R>& facets, const InterfaceLoss<R>& bare, Vec3<R> w) const {
    return Loss::at(kGgxFilm, bare, mirrors(facets), w, terms());
  }
  Loss mean_loss(const Ggx<R>& facets, const InterfaceLoss<R>& bare) const {
    return Loss::mean(kGgxFilm, bare, mirrors(facets), terms());
  }
  using SentWeights = FilmGlassWeights<R>;
  using Law = FilmLaw<R>;
  using Shared = SharedFilms<R>;
  /// Of the index inside.
  Law law(int j, R n, Shared& shared) const { return {films[j], n, thin, shared}; }

 private:
  int terms() const { return thin ? kThinFilm.terms : kThickFilm.terms; }
  static FacetLoss<R> mirrors(const Ggx<R>& facets) {
    return {&facets.tables(), facets.ax, facets.ay};
  }
};

template <class R>
using FilmDielectric = RoughInterface<R, Ggx, FilmFace<R>>;

}  // namespace mms::materials
