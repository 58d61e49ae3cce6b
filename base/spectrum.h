// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The wavelength cluster of a path, and a spectrum as its values at those wavelengths.
/// Owns nothing; every function is pure.

#include <array>
#include <cmath>

namespace mms {

/// Wavelengths in a cluster. Eight is the thesis' measured optimum (section 4.3.3, Figure 4.8):
/// four show colour noise, twelve bring nothing visible; eight floats also fill one AVX register.
inline constexpr int kWavelengths = 8;

/// Range of the rendered spectrum, nanometres.
inline constexpr double kLambdaMin = 360.0;
inline constexpr double kLambdaMax = 830.0;

/// One value for each wavelength of the cluster.
template <class R>
struct Spectrum {
  std::array<R, kWavelengths> v{};

  constexpr Spectrum() = default;
  constexpr explicit Spectrum(R value) { v.fill(value); }
  template <class S>
  constexpr explicit Spectrum(const Spectrum<S>& s) {
    for (int i = 0; i < kWavelengths; ++i) v[i] = R(s.v[i]);
  }

  constexpr R& operator[](int i) { return v[i]; }
  constexpr R operator[](int i) const { return v[i]; }

  /// The spectrum whose value `i` is `f(a[i])` or `f(a[i], b[i])`.
  template <class F>
  static constexpr Spectrum map(F f, const Spectrum& a) {
    Spectrum r;
    for (int i = 0; i < kWavelengths; ++i) r.v[i] = f(a.v[i]);
    return r;
  }
  template <class F>
  static constexpr Spectrum map(F f, const Spectrum& a, const Spectrum& b) {
    Spectrum r;
    for (int i = 0; i < kWavelengths; ++i) r.v[i] = f(a.v[i], b.v[i]);
    return r;
  }

  friend constexpr Spectrum operator+(const Spectrum& a, const Spectrum& b) {
    return map([](R x, R y) { return x + y; }, a, b);
  }
  friend constexpr Spectrum operator-(const Spectrum& a, const Spectrum& b) {
    return map([](R x, R y) { return x - y; }, a, b);
  }
  friend constexpr Spectrum operator*(const Spectrum& a, const Spectrum& b) {
    return map([](R x, R y) { return x * y; }, a, b);
  }
  friend constexpr Spectrum operator/(const Spectrum& a, const Spectrum& b) {
    return map([](R x, R y) { return x / y; }, a, b);
  }
  friend constexpr Spectrum operator*(const Spectrum& a, R s) { return a * Spectrum(s); }
  friend constexpr Spectrum operator*(R s, const Spectrum& a) { return a * Spectrum(s); }
  friend constexpr Spectrum operator/(const Spectrum& a, R s) { return a / Spectrum(s); }
  constexpr Spectrum& operator+=(const Spectrum& b) { return *this = *this + b; }
  constexpr Spectrum& operator*=(const Spectrum& b) { return *this = *this * b; }
  constexpr Spectrum& operator*=(R s) { return *this = *this * s; }
  friend constexpr bool operator==(const Spectrum& a, const Spectrum& b) { return a.v == b.v; }

  constexpr R sum() const {
    R s{};
    for (R x : v) s += x;
    return s;
  }
  constexpr R average() const { return sum() / R(kWavelengths); }
  constexpr R max() const {
    R m = v[0];
    for (R x : v) m = x > m ? x : m;
    return m;
  }
  constexpr bool is_black() const {
    for (R x : v)
      if (x != R(0)) return false;
    return true;
  }
  bool is_finite() const {
    for (R x : v)
      if (!std::isfinite(x)) return false;
    return true;
  }
};

using Spectrumf = Spectrum<float>;

/// The wavelengths a path carries, and the density each was drawn with.
/// Element 0 is the hero: the one that scattering directions are sampled for.
struct Wavelengths {
  Spectrum<float> nm;   ///< nanometres, in [kLambdaMin, kLambdaMax]
  Spectrum<float> pdf;  ///< density of each, per nanometre
};

/// Draws a cluster from one number `u` in [0, 1): eight points a cyclic eighth apart in the
/// cumulative distribution of `sech^2(A (lambda - B))`, thesis (4.8), A = 0.0072 / nm, B = 538 nm.
/// Each has the same marginal density, so any could have been the hero with the same cluster.
Wavelengths sample_wavelengths(double u);

/// The density of thesis (4.8), per nanometre, at `lambda` nanometres.
double wavelength_pdf(double lambda_nm);

}  // namespace mms
