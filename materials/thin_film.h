// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A film thinner than the coherence of light: the waves that its two faces reflect, summed for
/// both polarisations (Born and Wolf, 1.6). Exact in index, angle and wavelength.

#include <algorithm>
#include <cmath>
#include <complex>

#include "materials/fresnel.h"
#include "materials/lobe.h"

namespace mms::materials {

/// Lengths of one wavelength.
template <class R>
struct Film {
  R ior = 1;      ///< of the film
  R phases = 0;   ///< 2 pi thickness / wavelength
  R fringes = 0;  ///< between the normal and grazing, seen from where the index is 1

  Film() = default;
  Film(R index, R thickness, R wavelength) : ior(index > 0 ? limited(index, R(0.1), R(10)) : R(1)) {
    // Beyond 1e4 wavelengths nothing interferes, and the phase would have no digits.
    const R turns = non_negative(thickness) / (wavelength > 0 ? wavelength : R(550e-9));
    phases = 2 * kPi<R> * limited(turns, R(0), R(1e4));
    count_fringes();
  }
  /// The same where indices are measured in that of a medium `near`, which then counts as 1.
  Film in(R near) const {
    Film to = *this;
    to.ior /= near;
    to.phases *= near;
    to.count_fringes();
    return to;
  }

  /// Whether there is one.
  bool there() const { return phases > 0; }
  bool operator==(const Film&) const = default;

  /// Of light at the cosine of incidence `c` in [0, 1], between `near` and `far`, which is real or
  /// complex: transmitted is what is absorbed in, or goes on through, what lies beyond. Each
  /// directly, by the amplitudes of the characteristic matrix,
  ///   N, D = (y_1 -+ y_3) cos b - i (y_1 y_3 / y_2 -+ y_2) sin b,  b = phases g
  ///   reflected |N / D|^2, transmitted 4 y_1 Re y_3 / |D|^2
  /// of the admittances y = g (s) and g / n^2 (p), g = n cos. All but those of `far` are real: sine
  /// and cosine are hyperbolic where the film reflects totally, and then divided by the cosine.
  /// \pre a real `far` does not reflect totally
  template <class Far>
  FresnelSplit<R> split(R c, R near, Far far) const {
    const R g1 = near * c, film2 = normal_square(c, near, ior), g2 = std::sqrt(std::abs(film2));
    const Far g3 = root(normal_square(c, near, far));
    const bool wave = film2 > 0;
    const R b = phases * g2, cosine = wave ? std::cos(b) : R(1);
    const R sine = g2 > 0 ? (wave ? std::sin(b) : std::tanh(b)) / g2 : phases;  // over g
    const R falls = wave ? R(1) : 1 / std::cosh(b);
    FresnelSplit<R> sum{R(0), R(0)};
    const auto add = [&](R y1, R square, Far far_square) {  // y = g / square; those of far times it
      const Far even = y1 * far_square * cosine, odd = y1 * g3 * (sine * square);
      const Far even3 = g3 * cosine, odd3 = far_square * (film2 * sine / square);
      const R d = norm(even + even3, odd + odd3);
      const R through = 4 * y1 * real_product(g3, far_square) * falls * falls;
      sum.reflected += d > 0 ? norm(even - even3, odd - odd3) / d / 2 : R(0.5);
      sum.transmitted += d > 0 ? through / d / 2 : R(0);
    };
    add(g1, R(1), Far(1));
    add(g1 / (near * near), ior * ior, far * far);
    return {limited(sum.reflected, R(0), R(1)), limited(sum.transmitted, R(0), R(1))};
  }

  /// The same between outside and a real `far`, but of fringes as `contrast` in [0, 1] has them: of
  /// 0 it is the mean over films of all thicknesses, so over b. Of each polarisation,
  ///   (A cos^2 b + B sin^2 b) / (C cos^2 b + D sin^2 b)
  /// has the mean (A / sqrt C + B / sqrt D) / (sqrt C + sqrt D).
  /// \pre neither the film's index nor `far` is below 1
  FresnelSplit<R> faded_split(R c, R far, R contrast) const {
    if (!(c > 0)) return {R(1), R(0)};
    const R g2 = std::sqrt(normal_square(c, R(1), ior)), g3 = root(normal_square(c, R(1), far));
    const R cosine2 = (1 + std::cos(2 * phases * g2)) / 2, sine2 = 1 - cosine2;
    FresnelSplit<R> sum{R(0), R(0)};
    const auto add = [&](R y2, R y3) {
      const R odd = c * y3 / y2, root_c = c + y3, root_d = odd + y2;
      const R a = (c - y3) * (c - y3), b = (odd - y2) * (odd - y2);
      const R sharp = contrast / (root_c * root_c * cosine2 + root_d * root_d * sine2);
      const R faded = (1 - contrast) / (root_c * root_d);
      sum.reflected += (a * cosine2 + b * sine2) * sharp / 2 +
                       (a * root_d + b * root_c) * faded / (root_c + root_d) / 2;
      sum.transmitted += 2 * c * y3 * (sharp + faded);
    };
    add(g2, g3);
    add(g2 / (ior * ior), g3 / (far * far));
    return {std::min(sum.reflected, R(1)), std::min(sum.transmitted, R(1))};
  }

 private:
  using C = std::complex<R>;

  void count_fringes() {
    fringes = phases * (ior - std::sqrt(std::max((ior - 1) * (ior + 1), R(0)))) / kPi<R>;
  }

  /// (n cos)^2 in a medium of index `n`, as in refraction_g2 where the sine is near sin.
  template <class T>
  static T normal_square(R c, R near, T n) {
    return c > R(0.7) ? n * n - near * near * (1 - c) * (1 + c)
                      : (n - near) * (n + near) + near * near * (c * c);
  }
  static R root(R x) { return x > 0 ? std::sqrt(x) : R(0); }
  static C root(C x) { return std::sqrt(x); }
  /// |a - i b|^2.
  static R norm(R a, R b) { return a * a + b * b; }
  static R norm(C a, C b) { return std::norm(C(a.real() + b.imag(), a.imag() - b.real())); }
  /// Re(a conj b).
  static R real_product(R a, R b) { return a * b; }
  static R real_product(C a, C b) { return a.real() * b.real() + a.imag() * b.imag(); }
};

}  // namespace mms::materials
