// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A film (materials/thin_film.h) over metal (`film_conductor`) or glass (`film_dielectric`). Light
/// between facets is taken as for a bare metal.

#include <complex>

#include "materials/conductor.h"
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

/// Smooth glass under a film on its outside; lossless.
template <class R>
struct FilmDielectric {
  const R* p;

  explicit FilmDielectric(const R* numbers) : p(numbers) {}

  Spectrum<R> estimate(Vec3<R>) const { return Spectrum<R>(R(1)); }

  SpecularTerms<R> terms(Vec3<R> wo) const {
    const R c = std::min(std::abs(wo.z), R(1)), thickness = p[2 * kWavelengths];
    const R* wavelength = p + 2 * kWavelengths + 1;
    SpecularTerms<R> t;
    for (int j = 0; j < kWavelengths; ++j) {
      t.eta[j] = relative_eta(p[j], wo);
      const R ior = wo.z > 0 ? t.eta[j] : 1 / t.eta[j];
      const Film<R> film(p[kWavelengths + j], thickness, wavelength[j]);
      const bool total = !(refraction_g2(c, t.eta[j]) > 0);
      const FresnelSplit<R> s = total ? FresnelSplit<R>{R(1), R(0)}
                                      : film.split(c, wo.z > 0 ? R(1) : ior, wo.z > 0 ? ior : R(1));
      const R sum = s.reflected + s.transmitted;
      t.reflect_weight[j] = s.reflected, t.reflect_probability[j] = s.reflected / sum;
      t.transmit_weight[j] = s.transmitted, t.transmit_probability[j] = s.transmitted / sum;
    }
    return t;
  }
};

}  // namespace mms::materials
