// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A film thinner than the coherence of light, over metal (`film_conductor`) or glass
/// (`film_dielectric`): Airy's sum of the waves that its two faces reflect, for both polarisations
/// (Born and Wolf, 7.6). Exact in index, angle and wavelength; light between facets is taken as for
/// a bare metal.

#include <complex>

#include "materials/conductor.h"

namespace mms::materials {

/// Lengths of one wavelength.
template <class R>
struct Film {
  R ior = 1;     ///< of the film
  R phases = 0;  ///< 2 pi thickness / wavelength

  Film(R index, R thickness, R wavelength) : ior(index > 0 ? limited(index, R(0.1), R(10)) : R(1)) {
    // Beyond 1e4 wavelengths nothing interferes, and the phase would have no digits.
    const R turns = non_negative(thickness) / (wavelength > 0 ? wavelength : R(550e-9));
    phases = 2 * kPi<R> * limited(turns, R(0), R(1e4));
  }

  /// Reflectance at the cosine of incidence `c` in [0, 1] of the film between `near` and `far`.
  R reflectance(R c, R near, std::complex<R> far) const {
    using C = std::complex<R>;
    const R s = near * near * (1 - c) * (1 + c);
    const C n[3] = {near, ior, far};
    const C g[3] = {near * c, std::sqrt(C(ior * ior - s)), std::sqrt(far * far - s)};  // n cos
    const C turn = std::exp(C(0, 2) * phases * g[1]);
    const auto reflect = [&](int a, int b, bool parallel) {
      const C p = parallel ? n[b] * n[b] * g[a] : g[a], q = parallel ? n[a] * n[a] * g[b] : g[b];
      const C sum = p + q;
      return std::norm(sum) > 0 ? (p - q) / sum : C(1);
    };
    R total = 0;
    for (bool parallel : {false, true}) {
      const C first = reflect(0, 1, parallel), second = reflect(1, 2, parallel) * turn;
      const C below = R(1) + first * second;
      total += std::norm(below) > 0 ? std::norm((first + second) / below) : R(1);
    }
    return limited(total / 2, R(0), R(1));
  }
};

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
      f[j] = film.reflectance(c, R(1), metal);
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
      const R r = total ? R(1) : film.reflectance(c, wo.z > 0 ? R(1) : ior, wo.z > 0 ? ior : R(1));
      t.reflect_weight[j] = t.reflect_probability[j] = r;
      t.transmit_weight[j] = t.transmit_probability[j] = 1 - r;
    }
    return t;
  }
};

}  // namespace mms::materials
