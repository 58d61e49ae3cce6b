// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A film thinner than the coherence of light, over metal (`film_conductor`) or glass
/// (`film_dielectric`): the waves that its two faces reflect, summed for both polarisations (Born
/// and Wolf, 1.6). Exact in index, angle and wavelength; light between facets is taken as for a
/// bare metal.

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

  /// Of light at the cosine of incidence `c` in [0, 1], between `near` and `far`: transmitted is
  /// what is absorbed in, or goes on through, what lies beyond. Each directly, by the amplitudes of
  /// the characteristic matrix,
  ///   N, D = (y_1 -+ y_3) cos b - i (y_1 y_3 / y_2 -+ y_2) sin b,  b = phases g
  ///   reflected |N / D|^2, transmitted 4 y_1 Re y_3 / |D|^2
  /// of the admittances y = g (s) and g / n^2 (p), g = n cos. All but those of `far` are real: sine
  /// and cosine are hyperbolic where the film reflects totally, and then divided by the cosine.
  FresnelSplit<R> split(R c, R near, std::complex<R> far) const {
    using C = std::complex<R>;
    const R g1 = near * c, film2 = normal_square(c, near, ior), g2 = std::sqrt(std::abs(film2));
    const C g3 = std::sqrt(normal_square(c, near, far));
    const bool wave = film2 > 0;
    const R b = phases * g2, cosine = wave ? std::cos(b) : R(1);
    const R sine = g2 > 0 ? (wave ? std::sin(b) : std::tanh(b)) / g2 : phases;  // over g
    const R falls = wave ? R(1) : 1 / std::cosh(b);
    FresnelSplit<R> sum{R(0), R(0)};
    const auto add = [&](R y1, R square, C far_square) {  // y = g / square; those of far times it
      const C even = y1 * far_square * cosine, odd = C(0, -1) * y1 * g3 * (sine * square);
      const C even3 = g3 * cosine, odd3 = C(0, -1) * far_square * (film2 * sine / square);
      const R d = std::norm((even + even3) + (odd + odd3));
      const R through = 4 * y1 * (g3 * std::conj(far_square)).real() * falls * falls;
      sum.reflected += d > 0 ? std::norm((even - even3) + (odd - odd3)) / d / 2 : R(0.5);
      sum.transmitted += d > 0 ? through / d / 2 : R(0);
    };
    add(g1, R(1), C(1));
    add(g1 / (near * near), ior * ior, far * far);
    return {limited(sum.reflected, R(0), R(1)), limited(sum.transmitted, R(0), R(1))};
  }

 private:
  /// (n cos)^2 in a medium of index `n`, as in refraction_g2 where the sine is near sin.
  template <class T>
  static T normal_square(R c, R near, T n) {
    return c > R(0.7) ? n * n - near * near * (1 - c) * (1 + c)
                      : (n - near) * (n + near) + near * near * (c * c);
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
