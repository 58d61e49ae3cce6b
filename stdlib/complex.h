// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// Complex functions: principal branches, signed zeros as C99 Annex G. Float bodies compute in
/// double with the functions of core.h; double bodies call libm.

#include "stdlib/core.h"

namespace mms::stdlib::MMS_ISA {

/// A complex number while it is computed with.
struct Complex {
  double re, im;
};
MMS_INLINE Complex operator*(Complex a, Complex b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
/// i z and -i z: quarter turns, which only move and flip parts.
MMS_INLINE Complex turned_left(Complex z) { return {-z.im, z.re}; }
MMS_INLINE Complex turned_right(Complex z) { return {z.im, -z.re}; }

template <class R>
MMS_INLINE std::array<R, 2> pair(Complex z) {
  return {R(z.re), R(z.im)};
}
/// libm's complex numbers, and back.
__extension__ typedef _Complex double LibmComplex;
MMS_INLINE LibmComplex libm(Complex z) {
  LibmComplex r;
  __real__ r = z.re;
  __imag__ r = z.im;
  return r;
}
MMS_INLINE Complex of_libm(LibmComplex z) { return {__real__ z, __imag__ z}; }
/// `r` of an inverse function of `z`: no number where a part of `z` is none, as in float.
MMS_INLINE Complex of_libm(Complex z, LibmComplex r) {
  const bool known = (z.re == z.re) & (z.im == z.im);
  return {known ? __real__ r : kNan<double>, known ? __imag__ r : kNan<double>};
}

/// A product in which a zero stays zero whatever the other factor: sin(0) e^inf.
MMS_INLINE double damped(double zero, double x) { return zero == 0 ? zero : zero * x; }

template <class Reduction = Usual>
MMS_INLINE SinCos signed_sin_cos(double x) {
  const SinCos s = sin_cos<Reduction>(x);
  return {x == 0 ? x : s.sin, s.cos};
}

/// Whether only the modulus is known of what an angle of these turns: x + iy with x infinite.
MMS_INLINE bool infinite_without_angle(double x, SinCos angle) {
  return (magnitude(x) == kInf<double>)&(angle.cos != angle.cos);
}

/// Where the angle is no number: 0 for a real part of -inf, and an infinite real part for inf
/// (C99).
template <class Reduction = Usual>
MMS_INLINE Complex exp_complex(Complex z) {
  const double m = exp_core(z.re);
  const SinCos a = signed_sin_cos<Reduction>(z.im);
  const bool open = infinite_without_angle(z.re, a);
  const bool none = open & (z.re < 0);
  return {none ? 0.0 : open ? m : m * a.cos, none ? 0.0 : damped(a.sin, m)};
}

/// log |z| is taken from |z|^2 - 1, of which every term is exact in double where z is float.
MMS_INLINE Complex log_complex(Complex z) {
  const double x = magnitude(z.re), y = magnitude(z.im);
  const double large = x > y ? x : y, small = x > y ? y : x;
  const double near_one = fused(large - 1, large + 1, small * small);
  const bool close = (large > 0.5) & (large < 2);
  const double far = log_core(large * large + small * small);
  const double modulus = 0.5 * (close ? log1p_core(near_one) : far);
  const bool infinite = (x == kInf<double>) | (y == kInf<double>);
  return {infinite ? kInf<double> : modulus, atan2_core(z.im, z.re)};
}

MMS_INLINE Complex sqrt_complex(Complex z) {
  const double x = magnitude(z.re), y = magnitude(z.im);
  const double m = root(0.5 * (x + root(x * x + y * y)));
  const double n = m == 0 ? 0.0 : 0.5 * y / m;  // NaN stays NaN
  const bool right = with_sign(1.0, z.re) > 0;
  const Complex r = {right ? m : n, with_sign(right ? n : m, z.im)};
  // C99: an infinite imaginary part wins over everything, then an infinite real part.
  const Complex real_infinite = {right    ? kInf<double>
                                 : y == y ? 0.0
                                          : kNan<double>,
                                 with_sign(right ? (y == y ? 0.0 : y) : kInf<double>, z.im)};
  const bool wide = y == kInf<double>, long_ = x == kInf<double>;
  return {wide    ? kInf<double>
          : long_ ? real_infinite.re
                  : r.re,
          wide    ? z.im
          : long_ ? real_infinite.im
                  : r.im};
}

/// Where the angle is no number: infinite with an infinite real part, of a sign that C99 leaves
/// open and libm has positive; and sinh keeps a real part of 0.
template <class Reduction = Usual>
MMS_INLINE Complex sinh_complex(Complex z) {
  const SinhCosh h = sinh_cosh(z.re);
  const SinCos a = signed_sin_cos<Reduction>(z.im);
  const double re = (z.re == 0) & (a.cos != a.cos) ? h.sinh : h.sinh * a.cos;
  return {infinite_without_angle(z.re, a) ? h.cosh : re, damped(a.sin, h.cosh)};
}
template <class Reduction = Usual>
MMS_INLINE Complex cosh_complex(Complex z) {
  const SinhCosh h = sinh_cosh(z.re);
  const SinCos a = signed_sin_cos<Reduction>(z.im);
  const double im = a.sin == 0 ? with_sign(0.0, h.sinh) * a.sin : h.sinh * a.sin;
  return {infinite_without_angle(z.re, a) ? h.cosh : h.cosh * a.cos,
          (z.re == 0) & (im != im) ? 0.0 : im};
}
/// (sinh x cosh x + i sin y cos y) / (sinh^2 x + cos^2 y). Beyond 60 the imaginary part is below
/// the least float. Infinite x gives +-1 whatever the angle, and a zero stays zero (C99).
template <class Reduction = Usual>
MMS_INLINE Complex tanh_complex(Complex z) {
  const double x = z.re > 60 ? 60 : z.re < -60 ? -60 : z.re;
  const SinhCosh h = sinh_cosh(x);
  const SinCos a = signed_sin_cos<Reduction>(z.im);
  const double d = h.sinh * h.sinh + a.cos * a.cos;
  const bool open = infinite_without_angle(z.re, a);
  return {open        ? with_sign(1.0, z.re)
          : z.re == 0 ? z.re
                      : h.sinh * h.cosh / d,
          open        ? with_sign(0.0, z.im)
          : z.im == 0 ? z.im
                      : a.sin * a.cos / d};
}

/// 0^w is 1 for w = 0, else 0 where Re w > 0 and infinite where Re w < 0; z^0 is 1.
MMS_INLINE Complex pow_complex(Complex z, Complex w) {
  const bool zero = (z.re == 0) & (z.im == 0), one = (w.re == 0) & (w.im == 0);
  const Complex r = exp_complex(w * log_complex(z));
  const double of_zero = w.re > 0 ? 0.0 : w.re < 0 ? kInf<double> : kNan<double>;
  return {one ? 1.0 : zero ? of_zero : r.re, one | zero ? 0.0 : r.im};
}

/// |x|, or 1e150 for what is larger, infinite or NaN: of the largest, only angles are asked for.
MMS_INLINE double limited(double x) {
  const double m = magnitude(x);
  return m < 1e150 ? m : 1e150;
}
/// `r`, but for an argument with an infinite part its imaginary part is infinite (of r's sign), and
/// for one with a NaN both are NaN.
MMS_INLINE Complex of_limited(Complex z, Complex r) {
  const bool infinite = (magnitude(z.re) == kInf<double>) | (magnitude(z.im) == kInf<double>);
  const bool known = (z.re == z.re) & (z.im == z.im);
  const double im = infinite ? with_sign(kInf<double>, r.im) : r.im;
  return {known ? r.re : kNan<double>, known ? im : kNan<double>};
}

// The inverse functions as Kahan (1987), "Branch cuts for complex elementary functions": sums of
// products of square roots, of which no two terms ever cancel. They are computed in the first
// quadrant; the others are its mirror images.

/// Square root of a number whose parts are finite and no NaN, the imaginary one not below 0.
MMS_INLINE Complex root_in_range(Complex z) {
  const double x = magnitude(z.re);
  const double m = root(0.5 * (x + root(x * x + z.im * z.im)));
  const double n = m > 0 ? 0.5 * z.im / m : 0.0;
  return {z.re > 0 ? m : n, z.re > 0 ? n : m};
}

/// The square roots of 1 - z (of which the imaginary part is negated) and 1 + z, for |re z|, |im
/// z|.
struct Roots {
  Complex minus, plus;
  double height;  ///< |im asin z| = |im acos z|
};
MMS_INLINE Roots roots_of(Complex z) {
  const double x = limited(z.re), y = limited(z.im);
  const Complex a = root_in_range({1 - x, y}), b = root_in_range({1 + x, y});
  return {a, b, asinh_core(a.re * b.im + a.im * b.re)};
}
MMS_INLINE Complex asin_complex(Complex z) {
  const Roots r = roots_of(z);
  const double re = angle_core(limited(z.re), r.minus.re * r.plus.re + r.minus.im * r.plus.im);
  return of_limited(z, {with_sign(re, z.re), with_sign(r.height, z.im)});
}
MMS_INLINE Complex acos_complex(Complex z) {
  const Roots r = roots_of(z);
  const bool left = with_sign(1.0, z.re) < 0;
  const double re = 2 * angle_core(left ? r.plus.re : r.minus.re, left ? r.minus.re : r.plus.re);
  return of_limited(z, {re, with_sign(r.height, -z.im)});
}
/// Real part not below 0: acos turned by a quarter, on the side that the sign of y says.
MMS_INLINE Complex acosh_complex(Complex z) {
  const Complex a = acos_complex(z);
  return {magnitude(a.im), with_sign(a.re, z.im)};
}
MMS_INLINE Complex atanh_complex(Complex z) {
  const double x = limited(z.re), y = limited(z.im);
  const double re = 0.25 * log1p_positive(4 * x / fused(1 - x, 1 - x, y * y));
  const double im = 0.5 * angle_core(2 * y, fused(-y, y, (1 - x) * (1 + x)));
  const bool known = (z.re == z.re) & (z.im == z.im);
  return {known ? with_sign(re, z.re) : kNan<double>, known ? with_sign(im, z.im) : kNan<double>};
}

// MMS_COMPLEX(Name, angle, float body over a Reduction, double body): a kernel of one complex
// number. `angle` is the part of it that is one, 0 where none is.
#define MMS_COMPLEX(Name, angle, float_body, double_body)                                   \
  template <class R>                                                                        \
  struct Name {                                                                             \
    template <class Reduction>                                                              \
    [[gnu::always_inline]] static std::array<R, 2> body(R re, R im) {                       \
      const Complex z = {re, im};                                                           \
      if constexpr (kDouble<R>)                                                             \
        return pair<R>(double_body);                                                        \
      else                                                                                  \
        return pair<R>(float_body);                                                         \
    }                                                                                       \
    [[gnu::always_inline]] static std::array<R, 2> eval(R re, R im) {                       \
      return body<Usual>(re, im);                                                           \
    }                                                                                       \
    [[gnu::always_inline]] static bool rare([[maybe_unused]] R re, [[maybe_unused]] R im) { \
      return needs_large(R(angle));                                                         \
    }                                                                                       \
    static std::array<R, 2> eval_rare(R re, R im) { return body<Large>(re, im); }           \
  };
MMS_COMPLEX(ComplexLog, 0, log_complex(z), of_libm(__builtin_clog(libm(z))))
MMS_COMPLEX(ComplexSqrt, 0, sqrt_complex(z), of_libm(__builtin_csqrt(libm(z))))
MMS_COMPLEX(ComplexAsin, 0, asin_complex(z), of_libm(z, __builtin_casin(libm(z))))
MMS_COMPLEX(ComplexAcos, 0, acos_complex(z), of_libm(z, __builtin_cacos(libm(z))))
MMS_COMPLEX(ComplexAtan, 0, turned_right(atanh_complex(turned_left(z))),
            of_libm(z, __builtin_catan(libm(z))))
MMS_COMPLEX(ComplexAsinh, 0, turned_right(asin_complex(turned_left(z))),
            of_libm(z, __builtin_casinh(libm(z))))
MMS_COMPLEX(ComplexAcosh, 0, acosh_complex(z), of_libm(z, __builtin_cacosh(libm(z))))
MMS_COMPLEX(ComplexAtanh, 0, atanh_complex(z), of_libm(z, __builtin_catanh(libm(z))))
MMS_COMPLEX(ComplexExp, im, exp_complex<Reduction>(z), of_libm(__builtin_cexp(libm(z))))
MMS_COMPLEX(ComplexSin, re, turned_right(sinh_complex<Reduction>(turned_left(z))),
            turned_right(of_libm(__builtin_csinh(libm(turned_left(z))))))
MMS_COMPLEX(ComplexCos, re, cosh_complex<Reduction>(turned_left(z)),
            of_libm(__builtin_ccos(libm(z))))
MMS_COMPLEX(ComplexTan, re, turned_right(tanh_complex<Reduction>(turned_left(z))),
            of_libm(__builtin_ctan(libm(z))))
MMS_COMPLEX(ComplexSinh, im, sinh_complex<Reduction>(z), of_libm(__builtin_csinh(libm(z))))
MMS_COMPLEX(ComplexCosh, im, cosh_complex<Reduction>(z), of_libm(__builtin_ccosh(libm(z))))
MMS_COMPLEX(ComplexTanh, im, tanh_complex<Reduction>(z), of_libm(__builtin_ctanh(libm(z))))
#undef MMS_COMPLEX

template <class R>
struct ComplexPow {
  [[gnu::always_inline]] static std::array<R, 2> eval(R zr, R zi, R wr, R wi) {
    const Complex z = {zr, zi}, w = {wr, wi};
    if constexpr (kDouble<R>) {
      const bool edge = ((z.re == 0) & (z.im == 0)) | ((w.re == 0) & (w.im == 0));
      return pair<R>(edge ? pow_complex(z, w) : of_libm(__builtin_cpow(libm(z), libm(w))));
    }
    return pair<R>(pow_complex(z, w));
  }
};

/// z^n by repeated squaring in double, as PowI.
template <class R>
struct ComplexPowI {
  [[gnu::always_inline]] static std::array<R, 2> eval(R re, R im, std::int32_t n) {
    const std::uint32_t m = n < 0 ? 0u - std::uint32_t(n) : std::uint32_t(n);
    Complex base = {re, im}, r = {1, 0};
#pragma GCC unroll 32
    for (int k = 0; k < 32; ++k) {
      const Complex next = r * base;
      const bool use = (m >> k) & 1;
      r = {use ? next.re : r.re, use ? next.im : r.im};
      base = base * base;
    }
    const double squared = r.re * r.re + r.im * r.im;
    return pair<R>({n < 0 ? r.re / squared : r.re, n < 0 ? -r.im / squared : r.im});
  }
};

}  // namespace mms::stdlib::MMS_ISA
