// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A film (materials/thin_film.h) over metal (`film_conductor`) or glass (`film_dielectric`), which
/// both may be rough: facets are larger than the film is thick, and each has its colours. What
/// light between facets of metal reflects is taken as for a bare one. Rough glass keeps its energy
/// within 3e-4 under films of up to 600 nm at 550 nm, 3e-3 at anisotropy 0.9 or where its index is
/// below 1, and 1e-2 under thicker ones, 2e-2 at anisotropy 0.9 (materials/film_energy.h).

#include <complex>

#include "materials/conductor.h"
#include "materials/dielectric.h"
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
    const R thickness = p[3 * kWavelengths];
    const R* wavelength = p + 3 * kWavelengths + 1;
    for (int j = 0; j < kWavelengths; ++j) {
      const std::complex<R> metal(limited(p[j], R(0), R(1e3)),
                                  limited(p[kWavelengths + j], R(0), R(1e3)));
      const Film<R> film(p[2 * kWavelengths + j], thickness, wavelength[j]);
      f[j] = film.split(c, R(1), metal).reflected;
    }
    return f;
  }
};

template <class R>
using FilmConductor = RoughMetal<R, FilmFresnel>;

/// An interface under a film on its outside: index and thickness of the film and the wavelengths.
template <class R>
struct FilmFace {
  static constexpr bool kFilmed = true;
  static constexpr int kNumbers = 2 * kWavelengths + 1;
  const R* p;

  explicit FilmFace(const R* numbers) : p(numbers) {}

  bool repeated(int j) const {
    const R* wavelength = p + kWavelengths + 1;
    return p[j] == p[j - 1] && wavelength[j] == wavelength[j - 1];
  }
  FresnelSplit<R> split(int j, R c, R eta, bool outside) const {
    if (!(refraction_g2(c, eta) > 0)) return {R(1), R(0)};
    return outside ? film(j).split(c, R(1), eta) : film(j).split(c, 1 / eta, R(1));
  }

  using Loss = FilmedLoss<R>;
  static Loss loss(const Ggx<R>& facets, R eta, Vec3<R> w) {
    return Loss::at(kGgxFilm, interface_loss(facets, eta), mirrors(facets), w);
  }
  static Loss mean_loss(const Ggx<R>& facets, R eta) {
    return Loss::mean(kGgxFilm, interface_loss(facets, eta), mirrors(facets));
  }
  using Law = FilmLaw<R>;
  using Shared = FilmPoints<R>;
  /// Of the index inside.
  Law law(int j, R n, Shared& points) const { return {film(j), n, points}; }

 private:
  Film<R> film(int j) const { return {p[j], p[kWavelengths], p[kWavelengths + 1 + j]}; }
  static FacetLoss<R> mirrors(const Ggx<R>& facets) {
    return {&facets.tables(), facets.ax, facets.ay};
  }
};

template <class R>
using FilmDielectric = RoughInterface<R, Ggx, FilmFace<R>>;

}  // namespace mms::materials
