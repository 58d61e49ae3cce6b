// SPDX-License-Identifier: Apache-2.0
// Enclosures of the elementary functions: each is taken apart where it turns, jumps or ends.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "stdlib/bounds.h"
#include "stdlib/bounds_math.h"

namespace mms::stdlib::bounds {

using vm::Interval;

namespace {

constexpr double kInf = Interval::kInf;
constexpr double kPi = std::numbers::pi;

/// Where angles are too large to tell how they lie to multiples of pi.
constexpr double kLargestAngle = 0x1p20;

/// Whether some offset + k period lies in [lo, hi], or may.
bool holds_multiple(double lo, double hi, double offset, double period) {
  constexpr double slack = 1e-9;
  return std::ceil((lo - offset) / period - slack) <= std::floor((hi - offset) / period + slack);
}

/// A rising function on [from, to]; NaN below and above.
Interval rising_on(double (*f)(double), double from, double to, const Interval& x) {
  const double lo = std::max(x.lo, from), hi = std::min(x.hi, to);
  const bool outside = x.lo < from || x.hi > to;
  if (lo > hi) return {kInf, -kInf, true};
  return {f(lo), f(hi), outside};
}

Interval corners(double (*f)(double, double), const Interval& a, const Interval& b) {
  const double v[] = {f(a.lo, b.lo), f(a.lo, b.hi), f(a.hi, b.lo), f(a.hi, b.hi)};
  return {*std::min_element(v, v + 4), *std::max_element(v, v + 4), false};
}

Interval integer_step(double (*f)(double), const Interval& x) { return {f(x.lo), f(x.hi), false}; }

/// x^n of one n. The kernel multiplies up to 64 times, each time with a rounding error that the
/// next squaring doubles: |n| 2^-53 in the end.
Interval power(const Interval& x, double n) {
  const double m = std::fabs(n), slack = m > 0x1p16 ? m * 0x1p-52 : 0;
  const bool even = std::fmod(m, 2) == 0;
  Interval r;
  if (even) {
    const Interval a = magnitude(x);
    r = {std::pow(a.lo, m), std::pow(a.hi, m), false};
  } else {
    r = {std::pow(x.lo, m), std::pow(x.hi, m), false};
  }
  if (n < 0) {
    if (!even && r.contains(0)) return {-kInf, kInf, false};
    r = {1 / r.hi, 1 / r.lo, false};
  }
  const auto wider = [&](double v, double way) {
    return std::isinf(v) ? v : v + way * slack * std::fabs(v);
  };
  return {wider(r.lo, -1), wider(r.hi, 1), false};
}

}  // namespace

Interval magnitude(const Interval& x) {
  if (x.lo >= 0) return x;
  if (x.hi <= 0) return {-x.hi, -x.lo, x.nan};
  return {0, std::max(-x.lo, x.hi), x.nan};
}

Interval sine(const Interval& x) {
  const bool nan = x.contains_infinity();
  if (!(x.magnitude() <= kLargestAngle)) return {-1, 1, nan};
  const double a = std::sin(x.lo), b = std::sin(x.hi);
  return {holds_multiple(x.lo, x.hi, -kPi / 2, 2 * kPi) ? -1 : std::min(a, b),
          holds_multiple(x.lo, x.hi, kPi / 2, 2 * kPi) ? 1 : std::max(a, b), nan};
}
Interval cosine(const Interval& x) {
  const bool nan = x.contains_infinity();
  if (!(x.magnitude() <= kLargestAngle)) return {-1, 1, nan};
  const double a = std::cos(x.lo), b = std::cos(x.hi);
  return {holds_multiple(x.lo, x.hi, kPi, 2 * kPi) ? -1 : std::min(a, b),
          holds_multiple(x.lo, x.hi, 0, 2 * kPi) ? 1 : std::max(a, b), nan};
}

/// The cut along the negative x axis has an edge on either side of it, and -0 counts as below.
Interval angle(const Interval& y, const Interval& x) {
  if (x.lo <= 0 && y.contains(0)) return {-kPi, kPi, false};
  return corners(std::atan2, y, x);
}

Interval length(const Interval& x, const Interval& y) {
  const Interval a = magnitude(x), b = magnitude(y);
  Interval r{std::hypot(a.lo, b.lo), std::hypot(a.hi, b.hi), false};
  // Infinite even where the other is NaN.
  if ((x.nan && y.contains_infinity()) || (y.nan && x.contains_infinity())) r.hi = kInf;
  return r;
}

void sin(const Interval* in, Interval* out) { out[0] = sine(in[0]); }
void cos(const Interval* in, Interval* out) { out[0] = cosine(in[0]); }
void tan(const Interval* in, Interval* out) {
  const Interval& x = in[0];
  if (x.magnitude() <= kLargestAngle && !holds_multiple(x.lo, x.hi, kPi / 2, kPi))
    out[0] = {std::tan(x.lo), std::tan(x.hi), false};
}
void asin(const Interval* in, Interval* out) { out[0] = rising_on(std::asin, -1, 1, in[0]); }
void acos(const Interval* in, Interval* out) {
  const Interval r = rising_on([](double x) { return -std::acos(x); }, -1, 1, in[0]);
  out[0] = {-r.hi, -r.lo, r.nan};
}
void atan(const Interval* in, Interval* out) { out[0] = rising_on(std::atan, -kInf, kInf, in[0]); }
void atan2(const Interval* in, Interval* out) { out[0] = angle(in[0], in[1]); }
void sinh(const Interval* in, Interval* out) { out[0] = rising_on(std::sinh, -kInf, kInf, in[0]); }
void cosh(const Interval* in, Interval* out) {
  out[0] = rising_on(std::cosh, 0, kInf, magnitude(in[0]));
}
void tanh(const Interval* in, Interval* out) { out[0] = rising_on(std::tanh, -kInf, kInf, in[0]); }
void asinh(const Interval* in, Interval* out) {
  out[0] = rising_on(std::asinh, -kInf, kInf, in[0]);
}
void acosh(const Interval* in, Interval* out) { out[0] = rising_on(std::acosh, 1, kInf, in[0]); }
void atanh(const Interval* in, Interval* out) { out[0] = rising_on(std::atanh, -1, 1, in[0]); }
void exp(const Interval* in, Interval* out) { out[0] = rising_on(std::exp, -kInf, kInf, in[0]); }
void exp2(const Interval* in, Interval* out) { out[0] = rising_on(std::exp2, -kInf, kInf, in[0]); }
void expm1(const Interval* in, Interval* out) {
  out[0] = rising_on(std::expm1, -kInf, kInf, in[0]);
}
void log(const Interval* in, Interval* out) { out[0] = rising_on(std::log, 0, kInf, in[0]); }
void log2(const Interval* in, Interval* out) { out[0] = rising_on(std::log2, 0, kInf, in[0]); }
void log10(const Interval* in, Interval* out) { out[0] = rising_on(std::log10, 0, kInf, in[0]); }
void log1p(const Interval* in, Interval* out) { out[0] = rising_on(std::log1p, -1, kInf, in[0]); }
void sqrt(const Interval* in, Interval* out) { out[0] = rising_on(std::sqrt, 0, kInf, in[0]); }
void cbrt(const Interval* in, Interval* out) { out[0] = rising_on(std::cbrt, -kInf, kInf, in[0]); }
void hypot(const Interval* in, Interval* out) { out[0] = length(in[0], in[1]); }

/// For x >= 0, x^y is monotone in either argument. Below, only whole y have a value.
void pow(const Interval* in, Interval* out) {
  const Interval &x = in[0], &y = in[1];
  const Interval a = magnitude(x);
  Interval r = corners(std::pow, a, y);
  const bool pole = a.lo == 0 && y.lo < 0;  // -0 to an odd power has its own sign
  if (x.lo < 0) {
    const bool whole = y.is_point() && std::floor(y.lo) == y.lo && std::fabs(y.lo) < 0x1p31;
    if (whole)
      r = power(x, y.lo);
    else
      r = {-r.hi, r.hi, true};
  }
  if (pole) r = {-kInf, kInf, r.nan};
  if (x.nan || y.nan) r = join(r, Interval::point(1));  // 1^NaN and NaN^0
  out[0] = r;
}

void powi(const Interval* in, Interval* out) {
  const Interval &x = in[0], &n = in[1];
  constexpr double most = 64;  // values of n looked at one by one
  if (n.hi - n.lo <= most) {
    Interval r = Interval::empty();
    for (double k = n.lo; k <= n.hi; ++k) r = join(r, power(x, k));
    out[0] = r;
  } else {
    const Interval a = magnitude(x);
    if (a.lo == 0 && n.lo < 0) return;
    const Interval ends = join(power(a, n.lo), power(a, n.hi));
    out[0] = x.lo < 0 ? Interval{-ends.hi, ends.hi, false} : ends;
  }
  if (x.nan) out[0] = join(out[0], Interval::point(1));
}

/// Has the sign of a, and a smaller magnitude than b and no larger one than a.
void fmod(const Interval* in, Interval* out) {
  const Interval &a = in[0], &b = in[1];
  const double most = std::min(a.magnitude(), b.magnitude());
  out[0] = {a.lo < 0 ? -most : 0, a.hi > 0 ? most : 0, a.contains_infinity() || b.contains(0)};
  if (a.magnitude() < magnitude(b).lo) out[0] = {a.lo, a.hi, false};
}

void floor(const Interval* in, Interval* out) { out[0] = integer_step(std::floor, in[0]); }
void ceil(const Interval* in, Interval* out) { out[0] = integer_step(std::ceil, in[0]); }
void trunc(const Interval* in, Interval* out) { out[0] = integer_step(std::trunc, in[0]); }
void round(const Interval* in, Interval* out) { out[0] = integer_step(std::round, in[0]); }
void fract(const Interval* in, Interval* out) {
  const Interval& x = in[0];
  const double f = std::floor(x.lo);
  out[0] = {0, 1, x.contains_infinity()};
  if (!x.contains_infinity() && f == std::floor(x.hi)) out[0] = {x.lo - f, x.hi - f, false};
}
void abs(const Interval* in, Interval* out) { out[0] = magnitude(in[0]); }
void sign(const Interval* in, Interval* out) {
  const auto f = [](double x) { return double(x > 0) - double(x < 0); };
  out[0] = {f(in[0].lo), f(in[0].hi), false};
}

void min(const Interval* in, Interval* out) {
  out[0] = {std::min(in[0].lo, in[1].lo), std::min(in[0].hi, in[1].hi), false};
}
void max(const Interval* in, Interval* out) {
  out[0] = {std::max(in[0].lo, in[1].lo), std::max(in[0].hi, in[1].hi), false};
}
void clamp(const Interval* in, Interval* out) {
  const Interval &x = in[0], &low = in[1], &high = in[2];
  const auto f = [](double v, double l, double h) { return std::min(std::max(v, l), h); };
  Interval r{f(x.lo, low.lo, high.lo), f(x.hi, low.hi, high.hi), false};
  // An end that is NaN does not act.
  if (low.nan) r = join(r, Interval{std::min(x.lo, high.lo), std::min(x.hi, high.hi), false});
  if (high.nan) r = join(r, Interval{std::max(x.lo, low.lo), std::max(x.hi, low.hi), false});
  if (low.nan && high.nan) r = join(r, x);
  out[0] = r;
}

void abs_integer(const Interval* in, Interval* out) {
  constexpr double least = -2147483648.0;  // stays as it is
  const Interval x{std::max(in[0].lo, least + 1), in[0].hi, false};
  out[0] = x.has_number() ? magnitude(x) : Interval::empty();
  if (in[0].lo == least) out[0] = join(out[0], Interval::point(least));
}
void sign_integer(const Interval* in, Interval* out) { sign(in, out); }
void min_integer(const Interval* in, Interval* out) { min(in, out); }
void max_integer(const Interval* in, Interval* out) { max(in, out); }
void clamp_integer(const Interval* in, Interval* out) { clamp(in, out); }

}  // namespace mms::stdlib::bounds
