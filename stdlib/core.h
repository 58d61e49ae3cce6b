// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set (rows_isa.h): everything is in namespace MMS_ISA, so that
// code compiled for one processor can never be linked in where another is running.
#pragma once

/// \file
/// The arithmetic under the float kernels: reductions and polynomials of our own, without libm.
///
/// Only + - * / sqrt fma floor trunc, integer operations and bit casts, so the bits are the same
/// on every machine; only selects, so loops over lanes are vectorised. The functions over double
/// here serve float kernels (their errors are far below half a float ulp); double kernels call
/// libm. Coefficients: interpolation at Chebyshev nodes in 40-digit arithmetic; the relative error
/// of each polynomial stands beside it. Denormals must not be flushed to zero by the caller.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "base/exponential.h"

namespace mms::stdlib::MMS_ISA {

using core::bits, core::exp_core, core::Exponential, core::exponential, core::exponential_in_range,
    core::fused, core::kLn2High, core::kLn2Low, core::kLog2E, core::kRound64, core::log_in_range,
    core::polynomial, core::value_of;

template <class R>
inline constexpr bool kDouble = std::is_same_v<R, double>;
template <class R>
inline constexpr R kInf = std::numeric_limits<R>::infinity();
template <class R>
inline constexpr R kNan = std::numeric_limits<R>::quiet_NaN();

// The compiler's own functions rather than std:: wrappers: an inline std:: function compiled here
// for AVX2 could otherwise be the one copy that the linker keeps for everybody.
MMS_INLINE float magnitude(float x) { return __builtin_fabsf(x); }
MMS_INLINE double magnitude(double x) { return __builtin_fabs(x); }
MMS_INLINE float with_sign(float x, float s) { return __builtin_copysignf(x, s); }
MMS_INLINE double with_sign(double x, double s) { return __builtin_copysign(x, s); }
MMS_INLINE float root(float x) { return __builtin_sqrtf(x); }
MMS_INLINE double root(double x) { return __builtin_sqrt(x); }
MMS_INLINE float floor_of(float x) { return __builtin_floorf(x); }
MMS_INLINE double floor_of(double x) { return __builtin_floor(x); }
MMS_INLINE float trunc_of(float x) { return __builtin_truncf(x); }
MMS_INLINE double trunc_of(double x) { return __builtin_trunc(x); }

// As kRound64, of float: to a number below 2^22.
inline constexpr float kRound32 = 0x1.8p23f;

inline constexpr double kHalfPi = 0x1.921fb54442d18p+0, kHalfPiLow = 0x1.1a62633145c07p-54;
inline constexpr double kPi = 0x1.921fb54442d18p+1;

/// From here on the trigonometric float kernels reduce their argument lane by lane.
inline constexpr double kTrigLimit = 0x1p48;

/// x = quarters pi/2 + r, |r| <= pi/4 (and a little).
struct Reduced {
  double r;
  std::int64_t quarters;  ///< modulo 4
};

/// \pre x holds a float. For |x| < 2^48 the quotient is below 2^48, so what two fused steps leave
/// is off by less than 2^-53 of r plus 2^48 times 2^-109; the nearest float to a multiple of pi/2
/// is 2^-33 away. Larger arguments are taken for 0, infinite ones for NaN.
MMS_INLINE Reduced reduce(double x) {
  x = magnitude(x) < kTrigLimit ? x : x * 0.0;
  const double t = fused(x, 1 / kHalfPi, kRound64);
  const double k = t - kRound64;
  const double r = fused(-k, kHalfPiLow, fused(-k, kHalfPi, x));
  return {r, bits<std::int64_t>(t) & 3};
}

/// The first 224 binary places of 2 / pi.
inline constexpr std::uint32_t kTwoOverPi[] = {0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0,
                                               0xdb629599, 0x3c439041, 0xfe5163ab};

/// The same for a finite float of 2^24 or more (Payne and Hanek 1983): of 2/pi only the 96 places
/// count that make quarters below 4 and their fraction; what is cut off is below 2^-70.
inline Reduced reduce_large(float x) {
  const auto b = bits<std::uint32_t>(x);
  const std::uint64_t m = (b & 0x007fffffu) | 0x00800000u;
  const std::uint32_t from = (b >> 23 & 255) - 150 - 2;  // x = m 2^e; places from e - 1 on
  const std::uint32_t word = from >> 5, shift = from & 31;
  const auto places = [&](std::uint32_t k) {
    const std::uint64_t two = std::uint64_t(kTwoOverPi[word + k]) << 32 | kTwoOverPi[word + k + 1];
    return two << shift >> 32;
  };
  const std::uint64_t low = m * places(2), middle = m * places(1) + (low >> 32);
  const std::uint64_t high = (m * places(0) << 32) + middle;
  // Two binary digits of quarters, then the fraction, which as a signed number is below 1/2.
  const std::uint64_t fraction = high << 2 | (low & 0xffffffffu) >> 30;
  const std::uint64_t quarters = (high >> 62) + (fraction >> 63);
  const double r = double(std::int64_t(fraction)) * 0x1p-64 * kHalfPi;
  const bool negative = b >> 31;
  return {negative ? -r : r, std::int64_t(negative ? 0 - quarters : quarters) & 3};
}

MMS_INLINE bool needs_large(float x) {
  return (magnitude(x) >= float(kTrigLimit)) & (magnitude(x) < kInf<float>);
}
MMS_INLINE bool needs_large(double) { return false; }  // libm's functions take them all

/// How an angle is reduced: the body for all lanes, or that for large ones.
struct Usual {
  MMS_INLINE static Reduced reduced(double x) { return reduce(x); }
};
struct Large {
  static Reduced reduced(double x) {
    return needs_large(float(x)) ? reduce_large(float(x)) : reduce(x);
  }
};

struct SinCos {
  double sin, cos;
};
/// Relative error below 1e-15 (polynomials: 7e-18, 2e-18) but for the reduction's.
template <class Reduction = Usual>
MMS_INLINE SinCos sin_cos(double x) {
  const Reduced a = Reduction::reduced(x);
  const double t = a.r * a.r;
  const double sine =
      fused(a.r * t,
            polynomial(t, -0x1.5555555555555p-3, 0x1.1111111111110p-7, -0x1.a01a01a019937p-13,
                       0x1.71de3a54607a5p-19, -0x1.ae64541295cdfp-26, 0x1.61217ee5cca1bp-33,
                       -0x1.ab17bdcbd3414p-41),
            a.r);
  const double cosine =
      fused(t * t,
            polynomial(t, 0x1.5555555555555p-5, -0x1.6c16c16c16c16p-10, 0x1.a01a01a019d0ap-16,
                       -0x1.27e4fb7712ca2p-22, 0x1.1eed8deb82809p-29, -0x1.9394b9eb4d56dp-37,
                       0x1.ab78473be59d7p-45),
            fused(t, -0.5, 1.0));
  const double first = a.quarters & 1 ? cosine : sine;
  const double second = a.quarters & 1 ? sine : cosine;
  return {a.quarters & 2 ? -first : first, (a.quarters + 1) & 2 ? -second : second};
}

/// Sine of x + quarter pi/2 in float: reduction in double, polynomials (3.4e-9, 7e-10) in float.
/// Where quarter is 0, the sign of x is set aside, for the polynomials lose that of -0.
template <std::int32_t quarter, class Reduction = Usual>
MMS_INLINE float sine_float(float x) {
  const Reduced a = Reduction::reduced(quarter ? x : magnitude(x));
  const float r = float(a.r), t = r * r;
  const float sine = fused(
      r * t, polynomial(t, -0x1.555556p-3f, 0x1.11110ep-7f, -0x1.a013a8p-13f, 0x1.6dbdeep-19f), r);
  const float cosine = fused(
      t * t, polynomial(t, 0x1.555556p-5f, -0x1.6c16c0p-10f, 0x1.a015c4p-16f, -0x1.25243cp-22f),
      fused(t, -0.5f, 1.0f));
  const std::int32_t q = std::int32_t(a.quarters) + quarter;
  const float value = q & 1 ? cosine : sine;
  const std::uint32_t flip = std::uint32_t(q & 2) << 30;
  const std::uint32_t sign = quarter ? 0 : bits<std::uint32_t>(x) & 0x80000000u;
  return bits<float>(bits<std::uint32_t>(value) ^ flip ^ sign);
}

/// e^x - 1 without cancellation.
MMS_INLINE double expm1_core(double x) {
  const Exponential e = exponential(x);
  return fused(e.scale, e.small, e.scale - 1);
}

/// Natural logarithm of a float; -infinity at 0, NaN below.
MMS_INLINE double log_core(double x) {
  const double edge = x == 0 ? -kInf<double> : x == kInf<double> ? x : kNan<double>;
  return (x > 0) & (x < kInf<double>) ? log_in_range(x) : edge;
}

/// log(1 + x) for any float x.
MMS_INLINE double log1p_core(double x) {
  const double u = 1 + x;
  const double lost = x - (u - 1);  // what the sum rounded away
  const double r = log_core(u) + lost / u;
  return (u > 0) & (u < kInf<double>) ? r : log_core(u);
}

/// log(1 + x) for x not below 0, or NaN; the same bits as log1p_core, with less to choose.
MMS_INLINE double log1p_positive(double x) {
  const double u = 1 + x;
  const double r = log_in_range(u) + (x - (u - 1)) / u;
  return u < kInf<double> ? r : x;
}

/// Inverse hyperbolic sine.
MMS_INLINE double asinh_core(double x) {
  const double a = magnitude(x);
  const double r = log1p_positive(a + a * (a / (1 + root(fused(a, a, 1.0)))));
  return with_sign(a < kInf<double> ? r : a, x);
}

/// Angle of (x, y) in [-pi, pi]; signs of zero and infinities as C99 atan2. \pre no NaN
MMS_INLINE double angle_core(double y, double x) {
  const double ax0 = magnitude(x), ay0 = magnitude(y);
  const double ax = ax0 < 1e300 ? ax0 : 1e300, ay = ay0 < 1e300 ? ay0 : 1e300;
  const double large0 = ay > ax ? ay : ax, small = ay > ax ? ax : ay;
  const double large = large0 > 1e-300 ? large0 : 1e-300;
  constexpr double tan_pi_8 = 0x1.a827999fcef32p-2;
  const bool turned = small > tan_pi_8 * large;
  const double q = (turned ? small - large : small) / (turned ? small + large : large);
  const double t = q * q;
  // Polynomial: relative error 2e-16.
  const double angle =
      fused(q * t,
            polynomial(t, -0x1.5555555555546p-2, 0x1.9999999990a81p-3, -0x1.2492491dd36fep-3,
                       0x1.c71c6dd12673dp-4, -0x1.745c7f6f74ddep-4, 0x1.3b068d86c9c53p-4,
                       -0x1.105e316e925c8p-4, 0x1.d5eaddccfafaep-5, -0x1.6f43e8bd8d90ap-5,
                       0x1.74b7f80f108e5p-6),
            q) +
      (turned ? kPi / 4 : 0.0);
  const double half = ay > ax ? kHalfPi - angle : angle;
  return with_sign(with_sign(1.0, x) < 0 ? kPi - half : half, y);
}
MMS_INLINE double atan2_core(double y, double x) {
  return (x == x) & (y == y) ? angle_core(y, x) : x + y;
}

/// sinh and cosh of a float.
struct SinhCosh {
  double sinh, cosh;
};
MMS_INLINE SinhCosh sinh_cosh(double x) {
  const double a = magnitude(x);
  const double m = expm1_core(a), e = m + 1;
  return {with_sign(0.5 * (m + m / e), x), 0.5 * (e + 1 / e)};
}

/// 2^k e^r for |r| <= 0.35, where t = k + kRound32.
MMS_INLINE float scaled_exp(float r, float t) {
  // Polynomial: relative error 1.1e-8.
  const float tail = polynomial(r, 0x1.000000p-1f, 0x1.5554dcp-3f, 0x1.55551ap-5f, 0x1.120b6ep-7f,
                                0x1.6d110ap-10f);
  const float p = fused(r * r, tail, r) + 1;
  // The power of two in two halves, so that only the last product can leave the normal range.
  const std::int32_t n = bits<std::int32_t>(t) - bits<std::int32_t>(kRound32);
  const std::int32_t h = n >> 1;
  return p * bits<float>((h + 127) << 23) * bits<float>((n - h + 127) << 23);
}
MMS_INLINE float exp_float(float x) {
  // 2^151 and 2^-151 are beyond the float range on either side.
  x = x > 104.5f ? 104.5f : x < -104.5f ? -104.5f : x;
  const float t = fused(x, 0x1.715476p+0f, kRound32), k = t - kRound32;
  return scaled_exp(fused(-k, -0x1.05c61p-29f, fused(-k, 0x1.62e43p-1f, x)), t);
}
MMS_INLINE float exp2_float(float x) {
  x = x > 151.0f ? 151.0f : x < -151.0f ? -151.0f : x;
  const float t = x + kRound32;
  const float d = x - (t - kRound32);  // exact
  return scaled_exp(fused(d, 0x1.62e43p-1f, d * -0x1.05c61p-29f), t);
}

/// x = 2^k (1 + f), 1 + f in [sqrt(1/2), sqrt 2); log1p(f) apart from k.
struct FloatLog {
  float k, f, tail;  ///< log(1 + f) = f + tail
};
MMS_INLINE FloatLog float_log(float x) {
  constexpr std::uint32_t root_half = 0x3f3504f3;
  const bool tiny = x < 0x1p-126f;
  const std::uint32_t b = bits<std::uint32_t>(tiny ? x * 0x1p23f : x) - root_half;
  const float k = float(std::int32_t(b) >> 23) - (tiny ? 23.0f : 0.0f);
  const float f = bits<float>((b & 0x007fffff) + root_half) - 1;
  // Polynomial: relative error 3.4e-9.
  const float t = f * f;
  return {k, f,
          fused(t * f,
                polynomial(f, 0x1.555554p-2f, -0x1.fffffcp-3f, 0x1.999d5ap-3f, -0x1.555b4ap-3f,
                           0x1.23d21ap-3f, -0x1.fcf4c6p-4f, 0x1.dea282p-4f, -0x1.d635bcp-4f,
                           0x1.1d8ea6p-4f),
                -0.5f * t)};
}
MMS_INLINE float log_edges(float x, float r) {
  const float edge = x == 0 ? -kInf<float> : x == kInf<float> ? x : kNan<float>;
  return (x > 0) & (x < kInf<float>) ? r : edge;
}
MMS_INLINE float log_float(float x) {
  const FloatLog a = float_log(x);
  // The high part of ln 2 has 14 bits, so its product with k is exact.
  const float r = fused(a.k, 0x1.62e000p-1f, a.f + fused(a.k, 0x1.0bfbe8p-15f, a.tail));
  return log_edges(x, r);
}
MMS_INLINE float log2_float(float x) {
  const FloatLog a = float_log(x);
  // log2 e = 1.4426950 + 1.93e-8; f times the high part is kept with its rounding error.
  const float p = a.f * 0x1.715476p+0f;
  const float lost = fused(a.f, 0x1.715476p+0f, -p);
  const float low = fused(a.tail, 0x1.715476p+0f, fused(a.f, 0x1.4ae0cp-26f, lost));
  return log_edges(x, a.k + (p + low));
}

}  // namespace mms::stdlib::MMS_ISA
