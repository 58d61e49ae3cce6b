// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A film thinner than the coherence of light: the waves that its two faces reflect, summed for
/// both polarisations (Born and Wolf, 1.6). Exact in index, angle and wavelength.

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "materials/fresnel.h"
#include "materials/lobe.h"

namespace mms::materials {

namespace detail {
/// (n cos)^2 in a medium of index `n`, as in refraction_g2 where the sine is near sin.
template <class R, class T>
inline T normal_square(R c, R near, T n) {
  return c > R(0.7) ? n * n - near * near * (1 - c) * (1 + c)
                    : (n - near) * (n + near) + near * near * (c * c);
}
template <class R>
inline R root_above(R x) {
  return x > 0 ? std::sqrt(x) : R(0);
}
}  // namespace detail

/// What is left of fringes, in [0, 1], where there are so many `more` than do not fade to the mean
/// of films of all thicknesses.
template <class R>
inline R faded(R more) {
  return more > 0 ? std::exp(-more * more) : R(1);
}

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
  /// How thick it is, in waves of where the index is 1.
  R waves() const { return phases / (2 * kPi<R>); }
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
    const R g1 = near * c, film2 = detail::normal_square(c, near, ior),
            g2 = std::sqrt(std::abs(film2));
    const Far g3 = root(detail::normal_square(c, near, far));
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

 private:
  using C = std::complex<R>;

  void count_fringes() {
    fringes = phases * (ior - std::sqrt(std::max((ior - 1) * (ior + 1), R(0)))) / kPi<R>;
  }

  static R root(R x) { return detail::root_above(x); }
  static C root(C x) { return std::sqrt(x); }
  /// |a - i b|^2.
  static R norm(R a, R b) { return a * a + b * b; }
  static R norm(C a, C b) { return std::norm(C(a.real() + b.imag(), a.imag() - b.real())); }
  /// Re(a conj b).
  static R real_product(R a, R b) { return a * b; }
  static R real_product(C a, C b) { return a.real() * b.real() + a.imag() * b.imag(); }
};

/// Films of one index between outside and a real `far`, along N directions of incidence: all but
/// the phase, in which alone wavelengths of the same indices differ.
template <class R, int N = 1>
class FilmAlong {
 public:
  using Values = std::array<R, N>;

  FilmAlong() = default;
  /// \pre cosines in [0, 1]
  FilmAlong(const Values& cosines, R ior, R far) : ior_(ior), far_(far) {
    for (int i = 0; i < N; ++i) {
      const R c = cosines[i];
      g2_[i] = detail::root_above(detail::normal_square(c, R(1), ior));
      const R g3 = detail::root_above(detail::normal_square(c, R(1), far));
      waves_[0].set(i, c, g2_[i], g3);
      waves_[1].set(i, c, g2_[i] / (ior * ior), g3 / (far * far));
    }
  }

  /// Whether it is of these indices.
  bool is_of(R ior, R far) const { return ior == ior_ && far == far_; }

  /// Film::split, but of fringes as `contrast` in [0, 1] has them: of 0 it is the mean over films
  /// of all thicknesses, so over b. Of each polarisation,
  ///   (A cos^2 b + B sin^2 b) / (C cos^2 b + D sin^2 b)
  /// has the mean (A / sqrt C + B / sqrt D) / (sqrt C + sqrt D).
  /// \pre neither index is below 1
  FresnelSplit<Values> split(R phases, R contrast) const {
    const R faded = 1 - contrast;
    Values cosine2;
    for (int i = 0; i < N; ++i) cosine2[i] = (1 + std::cos(2 * phases * g2_[i])) / 2;
    FresnelSplit<Values> sum{};
    for (const Waves& w : waves_)
      for (int i = 0; i < N; ++i) {
        const R sine2 = 1 - cosine2[i];
        const R sharp = contrast / (w.c[i] * cosine2[i] + w.d[i] * sine2);
        sum.reflected[i] += (w.a[i] * cosine2[i] + w.b[i] * sine2) * sharp / 2 + faded * w.mean[i];
        sum.transmitted[i] += w.through[i] * (sharp + faded * w.mean_inverse[i]);
      }
    for (int i = 0; i < N; ++i) {
      sum.reflected[i] = std::min(sum.reflected[i], R(1));
      sum.transmitted[i] = std::min(sum.transmitted[i], R(1));
    }
    return sum;
  }

 private:
  /// Of one polarisation.
  struct Waves {
    Values a{}, b{}, c{}, d{}, through{}, mean{}, mean_inverse{};

    /// By the admittances. Along the surface, where y1 is 0, all is reflected.
    void set(int i, R y1, R y2, R y3) {
      if (!(y1 > 0)) {
        a[i] = b[i] = c[i] = d[i] = 1, mean[i] = R(0.5);
        return;
      }
      const R odd = y1 * y3 / y2, root_c = y1 + y3, root_d = odd + y2;
      a[i] = (y1 - y3) * (y1 - y3), b[i] = (odd - y2) * (odd - y2);
      c[i] = root_c * root_c, d[i] = root_d * root_d;
      through[i] = 2 * y1 * y3;
      mean_inverse[i] = 1 / (root_c * root_d);
      mean[i] = (a[i] * root_d + b[i] * root_c) * mean_inverse[i] / (root_c + root_d) / 2;
    }
  };

  R ior_ = 0, far_ = 0;
  Values g2_{};
  std::array<Waves, 2> waves_;
};

}  // namespace mms::materials
