// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The exponential and the logarithm of our own, over double, without libm: only + - * / fma,
/// integer operations and bit casts, so the bits are the same on every machine; only selects, so
/// loops over them are vectorised. Coefficients: interpolation at Chebyshev nodes in 40-digit
/// arithmetic; the relative error of each polynomial stands beside it. Denormals must not be
/// flushed to zero by the caller.

#include <cstdint>

// The loops over lanes are vectorised only where everything in them has been inlined.
#define MMS_INLINE [[gnu::always_inline]] inline

namespace mms::core {

// The compiler's own functions rather than std:: wrappers: an inline std:: function compiled for
// AVX2 could otherwise be the one copy that the linker keeps for everybody. What is always inlined
// is never a copy.
MMS_INLINE float fused(float a, float b, float c) { return __builtin_fmaf(a, b, c); }
MMS_INLINE double fused(double a, double b, double c) { return __builtin_fma(a, b, c); }
template <class To, class From>
MMS_INLINE To bits(From x) {
  return __builtin_bit_cast(To, x);
}

/// c + c1 x + c2 x^2 + ...
template <class R>
MMS_INLINE R polynomial(R, R c) {
  return c;
}
template <class R, class... More>
MMS_INLINE R polynomial(R x, R c, More... more) {
  return fused(polynomial(x, more...), x, c);
}

// Adding this to a number below 2^51 in magnitude rounds it to an integer, which then stands in the
// low bits.
inline constexpr double kRound64 = 0x1.8p52;

inline constexpr double kLn2High = 0x1.62e42fefa39efp-1, kLn2Low = 0x1.abc9e3b39803fp-56;
inline constexpr double kLog2E = 0x1.71547652b82fep+0;

/// e^x as scale (1 + small), |small| < 0.42.
struct Exponential {
  double small, scale;
};
/// \pre |x| <= 200
MMS_INLINE Exponential exponential_in_range(double x) {
  const double t = fused(x, kLog2E, kRound64);
  const double k = t - kRound64;
  const double r = fused(-k, kLn2Low, fused(-k, kLn2High, x));
  // Polynomial: relative error 5e-17.
  const auto power = (bits<std::uint64_t>(t) << 52) + 0x3ff0000000000000ULL;
  return {fused(r * r,
                polynomial(r, 0x1.0000000000001p-1, 0x1.5555555555556p-3, 0x1.5555555553d63p-5,
                           0x1.11111111109b3p-7, 0x1.6c16c1788bd90p-10, 0x1.a01a01a7c41d5p-13,
                           0x1.a019b90d2ae7ap-16, 0x1.71de0dae63bb3p-19, 0x1.289185613a3d6p-22,
                           0x1.af38a9b0ec855p-26),
                r),
          bits<double>(power)};
}
/// Arguments beyond 200 are taken for 200: floats end before.
MMS_INLINE Exponential exponential(double x) {
  return exponential_in_range(x > 200 ? 200 : x < -200 ? -200 : x);
}
MMS_INLINE double value_of(Exponential e) { return fused(e.scale, e.small, e.scale); }
MMS_INLINE double exp_core(double x) { return value_of(exponential(x)); }

/// Natural logarithm of a positive normal double.
MMS_INLINE double log_in_range(double x) {
  constexpr std::uint64_t root_half = 0x3fe6a09e667f3bcdULL;
  const std::uint64_t b = bits<std::uint64_t>(x) - root_half;
  // The biased exponent becomes a double through the bits of 2^52 + biased.
  const std::uint64_t biased = (b + 0x3ff0000000000000ULL) >> 52;
  const double k = bits<double>(biased | 0x4330000000000000ULL) - (0x1p52 + 1023);
  const double m = bits<double>((b & 0x000fffffffffffffULL) + root_half);
  const double s = (m - 1) / (m + 1), t = s * s;
  // Polynomial: relative error 5e-18.
  const double log_m =
      fused(s * t,
            polynomial(t, 0x1.5555555555558p-1, 0x1.99999999952d7p-2, 0x1.2492492df281ap-2,
                       0x1.c71c62e3f11e6p-3, 0x1.7462b51cb66b1p-3, 0x1.39fe51a7c18f9p-3,
                       0x1.2b5900de53b32p-3),
            2 * s);
  return fused(k, kLn2High, fused(k, kLn2Low, log_m));
}

}  // namespace mms::core
