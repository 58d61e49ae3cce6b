// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// Elementary functions of reals and integers: float bodies of our own, double bodies from libm,
/// which tests hold to the 4 ulp of double that glibc's manual states (complex.h: 7 for each part).

#include "stdlib/core.h"

namespace mms::stdlib::MMS_ISA {

// MMS_UNARY(Name, float body, double body): a kernel of one real.
#define MMS_UNARY(Name, float_body, double_body) \
  template <class R>                             \
  struct Name {                                  \
    [[gnu::always_inline]] static R eval(R x) {  \
      if constexpr (kDouble<R>)                  \
        return double_body;                      \
      else                                       \
        return R(float_body);                    \
    }                                            \
  };
MMS_UNARY(Acos, atan2_core(root((1.0 - x) * (1.0 + x)), x), __builtin_acos(x))
MMS_UNARY(Asin, atan2_core(x, root((1.0 - x) * (1.0 + x))), __builtin_asin(x))
MMS_UNARY(Atan, atan2_core(x, 1.0), __builtin_atan(x))
MMS_UNARY(Sinh, sinh_cosh(x).sinh, __builtin_sinh(x))
MMS_UNARY(Cosh, sinh_cosh(x).cosh, __builtin_cosh(x))
MMS_UNARY(Exp, exp_float(x), __builtin_exp(x))
MMS_UNARY(Exp2, exp2_float(x), __builtin_exp2(x))
MMS_UNARY(Log, log_float(x), __builtin_log(x))
MMS_UNARY(Log2, log2_float(x), __builtin_log2(x))
MMS_UNARY(Log10, log_core(x) * 0x1.bcb7b1526e50ep-2, __builtin_log10(x))
MMS_UNARY(Sqrt, root(x), root(x))
MMS_UNARY(Floor, floor_of(x), floor_of(x))
MMS_UNARY(Ceil, -floor_of(-x), -floor_of(-x))
MMS_UNARY(Trunc, trunc_of(x), trunc_of(x))
MMS_UNARY(Abs, magnitude(x), magnitude(x))
#undef MMS_UNARY

template <class Reduction>
MMS_INLINE float tangent(float x) {
  const SinCos s = sin_cos<Reduction>(x);
  return x == 0 ? x : float(s.sin / s.cos);
}

// MMS_ANGLE(Name, float body over a Reduction, double body): a kernel of one angle.
#define MMS_ANGLE(Name, float_body, double_body)                            \
  template <class R>                                                        \
  struct Name {                                                             \
    template <class Reduction>                                              \
    [[gnu::always_inline]] static R body(R x) {                             \
      if constexpr (kDouble<R>)                                             \
        return double_body;                                                 \
      else                                                                  \
        return float_body;                                                  \
    }                                                                       \
    [[gnu::always_inline]] static R eval(R x) { return body<Usual>(x); }    \
    [[gnu::always_inline]] static bool rare(R x) { return needs_large(x); } \
    static R eval_rare(R x) { return body<Large>(x); }                      \
  };
MMS_ANGLE(Sin, (sine_float<0, Reduction>(x)), __builtin_sin(x))
MMS_ANGLE(Cos, (sine_float<1, Reduction>(x)), __builtin_cos(x))
MMS_ANGLE(Tan, tangent<Reduction>(x), __builtin_tan(x))
#undef MMS_ANGLE

template <class R>
struct Asinh {
  [[gnu::always_inline]] static R eval(R x) {
    if constexpr (kDouble<R>) return __builtin_asinh(x);
    return x == 0 ? x : R(asinh_core(x));
  }
};
template <class R>
struct Acosh {
  [[gnu::always_inline]] static R eval(R x) {
    if constexpr (kDouble<R>) return __builtin_acosh(x);
    const double t = double(x) - 1;
    return R(t < 0 ? kNan<double> : log1p_positive(t + root(t) * root(t + 2)));
  }
};
template <class R>
struct Atanh {
  [[gnu::always_inline]] static R eval(R x) {
    if constexpr (kDouble<R>) return __builtin_atanh(x);
    const double a = magnitude(x);
    const double r = 0.5 * log1p_core(2 * a / (1 - a));
    return x == 0 ? x : R(with_sign(r, double(x)));
  }
};

/// a - b trunc(a / b) without rounding: C's fmod. Where |a / b| < 2^28 the quotient of two floats
/// cannot round up to a whole number in double, and the remainder is a float.
template <class R>
struct Fmod {
  /// |a| mod b for 0 < b < inf.
  MMS_INLINE static double step(double a, double b) { return fused(-trunc_of(a / b), b, a); }
  MMS_INLINE static double guarded(double r, double a, double b) {
    const bool undefined = (magnitude(a) == kInf<double>) | (b == 0) | (a != a) | (b != b);
    const double kept = magnitude(b) == kInf<double> ? magnitude(a) : r;
    return undefined ? kNan<double> : with_sign(kept, a);
  }
  [[gnu::always_inline]] static R eval(R a, R b) {
    if constexpr (kDouble<R>) return __builtin_fmod(a, b);
    return R(guarded(step(magnitude(a), magnitude(b)), a, b));
  }
  [[gnu::always_inline]] static bool rare(R a, R b) {
    return !kDouble<R> && (b != 0) & (magnitude(a) < kInf<R>)&(double(magnitude(a)) >=
                                                               0x1p28 * double(magnitude(b)));
  }
  /// Long division, 28 binary digits of the quotient at a time.
  static R eval_rare(R a, R b) {
    double rest = magnitude(a), multiple = magnitude(b);
    while (multiple * 0x1p28 <= rest) multiple *= 0x1p28;
    for (; multiple >= magnitude(b); multiple *= 0x1p-28) rest = step(rest, multiple);
    return R(with_sign(rest, double(a)));
  }
};

template <class R>
struct Tanh {
  [[gnu::always_inline]] static R eval(R x) {
    if constexpr (kDouble<R>) return __builtin_tanh(x);
    const double m = expm1_core(2 * double(magnitude(x)));
    return R(with_sign(m / (m + 2), double(x)));
  }
};

template <class R>
struct Expm1 {
  [[gnu::always_inline]] static R eval(R x) {
    if constexpr (kDouble<R>) return __builtin_expm1(x);
    return x == 0 ? x : R(expm1_core(x));
  }
};

template <class R>
struct Log1p {
  [[gnu::always_inline]] static R eval(R x) {
    if constexpr (kDouble<R>) return __builtin_log1p(x);
    return x == 0 ? x : R(log1p_core(x));
  }
};

template <class R>
struct Cbrt {
  [[gnu::always_inline]] static R eval(R x) {
    if constexpr (kDouble<R>) return __builtin_cbrt(x);
    const double a = magnitude(x), edge = x;
    const double r = value_of(exponential_in_range(log_in_range(a) * (1.0 / 3)));
    return R((a > 0) & (a < kInf<double>) ? with_sign(r, edge) : edge);
  }
};

template <class R>
struct Atan2 {
  [[gnu::always_inline]] static R eval(R y, R x) {
    if constexpr (kDouble<R>) return __builtin_atan2(y, x);
    return R(atan2_core(y, x));
  }
};

template <class R>
struct Hypot {
  [[gnu::always_inline]] static R eval(R x, R y) {
    if constexpr (kDouble<R>) return __builtin_hypot(x, y);
    const double a = x, b = y;
    const bool infinite = (magnitude(a) == kInf<double>) | (magnitude(b) == kInf<double>);
    return R(infinite ? kInf<double> : root(a * a + b * b));
  }
};

/// C99 7.12.7.4 with its edge cases (Annex F.9.4.4).
template <class R>
struct Pow {
  [[gnu::always_inline]] static R eval(R x, R y) {
    if constexpr (kDouble<R>) return __builtin_pow(x, y);
    const double a = magnitude(x), b = y;
    const double l = log_core(a);
    // 1^y and x^0 are 1 even where the other is infinite or NaN.
    const double r = exp_core((l == 0) | (b == 0) ? 0.0 : l * b);
    const bool whole = floor_of(b) == b;
    const bool odd = whole & (floor_of(b * 0.5) != b * 0.5);
    const bool negative = with_sign(1.0, double(x)) < 0;
    const double value = negative & odd ? -r : r;
    const bool undefined = negative & (a > 0) & (a < kInf<double>)&!whole;
    return R(undefined ? kNan<double> : (x == 1) | (b == 0) ? 1.0 : value);
  }
};

/// x^n by repeated squaring in double: 31 steps for every lane.
template <class R>
struct PowI {
  [[gnu::always_inline]] static R eval(R x, std::int32_t n) {
    const std::uint32_t m = n < 0 ? 0u - std::uint32_t(n) : std::uint32_t(n);
    double base = x, r = 1;
#pragma GCC unroll 32
    for (int k = 0; k < 32; ++k) {
      r = (m >> k) & 1 ? r * base : r;
      base = base * base;
    }
    return R(n < 0 ? 1 / r : r);
  }
};

template <class R>
struct Round {
  [[gnu::always_inline]] static R eval(R x) {
    const R a = magnitude(x), t = trunc_of(a);
    return with_sign(a - t >= R(0.5) ? t + 1 : t, x);
  }
};

template <class R>
struct Fract {
  [[gnu::always_inline]] static R eval(R x) {
    constexpr R below_one = 1 - std::numeric_limits<R>::epsilon() / 2;
    const R f = x - floor_of(x);
    return f >= 1 ? below_one : f;
  }
};

template <class R>
struct Sign {
  [[gnu::always_inline]] static R eval(R x) { return x > 0 ? R(1) : x < 0 ? R(-1) : x; }
};

// The order of the operands makes NaN win on either side.
template <class T>
MMS_INLINE T least(T a, T b) {
  return (a < b) | (a != a) ? a : b;
}
template <class T>
MMS_INLINE T greatest(T a, T b) {
  return (a > b) | (a != a) ? a : b;
}
template <class R>
struct Min {
  [[gnu::always_inline]] static R eval(R a, R b) { return least(a, b); }
};
template <class R>
struct Max {
  [[gnu::always_inline]] static R eval(R a, R b) { return greatest(a, b); }
};
template <class R>
struct Clamp {
  [[gnu::always_inline]] static R eval(R x, R low, R high) {
    const R r = x < low ? low : x;
    return r > high ? high : r;
  }
};

using Int = std::int32_t;
template <class>
struct AbsI {
  [[gnu::always_inline]] static Int eval(Int x) { return x < 0 ? Int(0u - std::uint32_t(x)) : x; }
};
template <class>
struct SignI {
  [[gnu::always_inline]] static Int eval(Int x) { return Int(x > 0) - Int(x < 0); }
};
template <class>
struct MinI {
  [[gnu::always_inline]] static Int eval(Int a, Int b) { return a < b ? a : b; }
};
template <class>
struct MaxI {
  [[gnu::always_inline]] static Int eval(Int a, Int b) { return a > b ? a : b; }
};
template <class>
struct ClampI {
  [[gnu::always_inline]] static Int eval(Int x, Int low, Int high) {
    const Int r = x > low ? x : low;
    return r < high ? r : high;
  }
};

}  // namespace mms::stdlib::MMS_ISA
