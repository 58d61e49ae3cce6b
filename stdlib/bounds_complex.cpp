// SPDX-License-Identifier: Apache-2.0
// Enclosures of complex functions, put together from those of real ones: a rectangle around the
// image of a rectangle. Formulas as in complex.h.
#include <algorithm>
#include <cmath>

#include "stdlib/bounds.h"
#include "stdlib/bounds_math.h"

namespace mms::stdlib::bounds {

using vm::Interval;

namespace {

/// Beyond this in magnitude, intermediate results may overflow.
constexpr double kLargest = 1e150;

/// Products of ends in double; 0 times infinity is the limit 0 and, for the machine, NaN.
Interval times(const Interval& a, const Interval& b) {
  const auto product = [](double x, double y) { return x == 0 || y == 0 ? 0 : x * y; };
  const double v[] = {product(a.lo, b.lo), product(a.lo, b.hi), product(a.hi, b.lo),
                      product(a.hi, b.hi)};
  const bool nan = a.nan || b.nan || (a.contains(0) && b.contains_infinity()) ||
                   (b.contains(0) && a.contains_infinity());
  return {*std::min_element(v, v + 4), *std::max_element(v, v + 4), nan};
}
/// a / b for b > 0.
Interval over(const Interval& a, const Interval& b) {
  const double v[] = {a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi};
  return {*std::min_element(v, v + 4), *std::max_element(v, v + 4), a.nan};
}
Interval plus(const Interval& a, const Interval& b) {
  return {a.lo + b.lo, a.hi + b.hi, a.nan || b.nan};
}
Interval minus(const Interval& a) { return {-a.hi, -a.lo, a.nan}; }
Interval wider(const Interval& a, double slack) { return {a.lo - slack, a.hi + slack, a.nan}; }

Interval exponential(const Interval& x) { return {std::exp(x.lo), std::exp(x.hi), false}; }
Interval hyperbolic_sine(const Interval& x) { return {std::sinh(x.lo), std::sinh(x.hi), false}; }
Interval hyperbolic_cosine(const Interval& x) {
  const Interval a = magnitude(x);
  return {std::cosh(a.lo), std::cosh(a.hi), false};
}

/// Infinite parts may become NaN in one of the machines; together with NaN, libm makes numbers of
/// them as C99 Annex G says, of either sign.
void with_infinities(const Interval* in, Interval* out) {
  const bool infinite = in[0].contains_infinity() || in[1].contains_infinity();
  const bool nan = in[0].nan || in[1].nan;
  for (int k = 0; k < 2 && infinite; ++k) {
    out[k].nan = true;
    if (nan) out[k] = Interval::whole();
  }
}

/// sinh(x + iy).
void sinh_of(const Interval& x, const Interval& y, Interval& re, Interval& im) {
  re = times(hyperbolic_sine(x), cosine(y));
  im = times(hyperbolic_cosine(x), sine(y));
}
void cosh_of(const Interval& x, const Interval& y, Interval& re, Interval& im) {
  re = times(hyperbolic_cosine(x), cosine(y));
  im = times(hyperbolic_sine(x), sine(y));
}
/// tanh(x + iy) = (sinh 2x + i sin 2y) / (cosh 2x + cos 2y); nothing is known near its poles.
void tanh_of(const Interval& x0, const Interval& y, Interval& re, Interval& im) {
  constexpr double flat = 600, near_pole = 1e-4;
  const Interval x{std::clamp(2 * x0.lo, -flat, flat), std::clamp(2 * x0.hi, -flat, flat), false};
  const Interval y2{2 * y.lo, 2 * y.hi, false};
  Interval d = plus(hyperbolic_cosine(x), cosine(y2));
  d = wider(d, 1e-15);
  if (d.lo < near_pole) return;
  const double slack = 1e-15 / near_pole;
  d = {d.lo * (1 - slack), d.hi * (1 + slack), d.nan};
  re = over(hyperbolic_sine(x), d);
  im = over(sine(y2), d);
}

/// e^(x + iy) of a modulus and an angle.
void polar_of(const Interval& modulus, const Interval& phi, Interval* out) {
  out[0] = times(modulus, cosine(phi));
  out[1] = times(modulus, sine(phi));
}

/// Rounding of a sum of two moduli, relative.
constexpr double kRounding = 0x1p-50;

bool ordinary(const Interval* in) {
  return !in[0].nan && !in[1].nan && in[0].magnitude() < kLargest && in[1].magnitude() < kLargest;
}
/// With the sign of y, or either of them.
Interval with_sign(const Interval& r, const Interval& y) {
  return y.lo > 0 ? r : y.hi < 0 ? minus(r) : join(r, minus(r));
}
/// asin(x + iy): with a = (|z + 1| + |z - 1|) / 2 the sine of the real part is x / a, and the
/// imaginary part has the sign of y and acosh(a) as its magnitude.
void asin_of(const Interval& x, const Interval& y, Interval& re, Interval& magnitude_of_im) {
  const Interval one = Interval::point(1);
  Interval a = plus(length(plus(x, one), y), length(plus(x, minus(one)), y));
  a = {std::max(1.0, 0.5 * a.lo * (1 - kRounding)), 0.5 * a.hi * (1 + kRounding), false};
  const Interval s = over(x, a);
  const auto angle_of = [](double v) { return std::asin(std::clamp(v, -1.0, 1.0)); };
  re = {angle_of(s.lo - kRounding * std::fabs(s.lo)), angle_of(s.hi + kRounding * std::fabs(s.hi)),
        false};
  magnitude_of_im = {std::acosh(a.lo), std::acosh(a.hi), false};
}
/// atanh(z) = (log(1 + z) - log(1 - z)) / 2. The real part is the logarithm of the quotient of both
/// lengths: far out, that of logarithms of each would cancel.
void atanh_of(const Interval& x, const Interval& y, Interval& re, Interval& im) {
  constexpr double half_pi = 1.5707963267948966;
  const Interval one = Interval::point(1), up = plus(one, x), down = plus(one, minus(x));
  const Interval a = length(up, y), b = length(down, y);
  re = wider({0.5 * std::log(a.lo / b.hi), 0.5 * std::log(a.hi / b.lo), false}, kRounding);
  const Interval phi = plus(angle(y, up), minus(angle(minus(y), down)));
  im = wider({std::max(0.5 * phi.lo, -half_pi), std::min(0.5 * phi.hi, half_pi), false}, kRounding);
}

}  // namespace

void complex_exp(const Interval* in, Interval* out) {
  polar_of(exponential(in[0]), in[1], out);
  with_infinities(in, out);
}
void complex_log(const Interval* in, Interval* out) {
  const Interval r = length(in[0], in[1]);
  // log |z| near 1 keeps an absolute error of the modulus' own rounding.
  out[0] = wider({std::log(r.lo), std::log(r.hi), false}, 0x1p-51);
  out[1] = angle(in[1], in[0]);
}
/// The real part is sqrt((|z| + x) / 2): rising in x and |y|; the imaginary part has the sign of y
/// and the magnitude sqrt((|z| - x) / 2), falling in x.
void complex_sqrt(const Interval* in, Interval* out) {
  const Interval &x = in[0], &y = in[1], a = magnitude(y);
  // Without cancellation: the smaller of the two parts is |y| / 2 over the larger.
  const auto part = [](double along, double across) {
    if (std::isinf(across)) return across;
    if (std::isinf(along)) return along > 0 ? along : 0.0;
    const double large = std::sqrt(0.5 * (std::hypot(along, across) + std::fabs(along)));
    if (along >= 0) return large;
    return large > 0 ? 0.5 * across / large : 0.0;
  };
  out[0] = {part(x.lo, a.lo), part(x.hi, a.hi), false};
  const double up = std::max(y.hi, 0.0), down = std::max(-y.lo, 0.0);
  if (y.lo > 0)
    out[1] = {part(-x.hi, y.lo), part(-x.lo, y.hi), false};
  else if (y.hi < 0)
    out[1] = {-part(-x.lo, -y.lo), -part(-x.hi, -y.hi), false};
  else  // either sign of zero
    out[1] = {-part(-x.lo, down), part(-x.lo, up), false};
  with_infinities(in, out);
  // What the float kernel makes of NaN: infinite parts win, else the part that is divided is 0.
  if (x.nan || y.nan)
    for (int k = 0; k < 2; ++k) out[k] = join(out[k], Interval::point(0));
  if (x.nan && y.contains_infinity()) out[0].hi = Interval::kInf;
  if (y.nan && x.lo == -Interval::kInf) out[1] = Interval::whole();
}

void complex_sinh(const Interval* in, Interval* out) {
  sinh_of(in[0], in[1], out[0], out[1]);
  with_infinities(in, out);
}
void complex_cosh(const Interval* in, Interval* out) {
  cosh_of(in[0], in[1], out[0], out[1]);
  with_infinities(in, out);
}
void complex_tanh(const Interval* in, Interval* out) {
  tanh_of(in[0], in[1], out[0], out[1]);
  with_infinities(in, out);
}
// Of iz = -y + ix: sin z = -i sinh(iz), cos z = cosh(iz), tan z = -i tanh(iz).
void complex_sin(const Interval* in, Interval* out) {
  Interval im;
  sinh_of(minus(in[1]), in[0], im, out[0]);
  out[1] = minus(im);
  with_infinities(in, out);
}
void complex_cos(const Interval* in, Interval* out) {
  cosh_of(minus(in[1]), in[0], out[0], out[1]);
  with_infinities(in, out);
}
void complex_tan(const Interval* in, Interval* out) {
  Interval im = Interval::whole();
  tanh_of(minus(in[1]), in[0], im, out[0]);
  out[1] = minus(im);
  with_infinities(in, out);
}

void complex_asin(const Interval* in, Interval* out) {
  if (!ordinary(in)) return;
  Interval im;
  asin_of(in[0], in[1], out[0], im);
  out[1] = with_sign(im, in[1]);
}
void complex_acos(const Interval* in, Interval* out) {
  if (!ordinary(in)) return;
  constexpr double half_pi = 1.5707963267948966;
  Interval re, im;
  asin_of(in[0], in[1], re, im);
  out[0] = wider({half_pi - re.hi, half_pi - re.lo, false}, kRounding);
  out[1] = minus(with_sign(im, in[1]));
}
// asinh z = -i asin(iz), acosh z = i acos z or -i acos z, whichever has a real part of 0 or more.
void complex_asinh(const Interval* in, Interval* out) {
  if (!ordinary(in)) return;
  Interval re, im;
  asin_of(minus(in[1]), in[0], re, im);
  out[0] = with_sign(im, in[0]);
  out[1] = minus(re);
}
void complex_acosh(const Interval* in, Interval* out) {
  if (!ordinary(in)) return;
  Interval acos[2] = {out[0], out[1]}, re;
  complex_acos(in, acos);
  asin_of(in[0], in[1], re, out[0]);
  out[1] = with_sign(acos[0], in[1]);
}
void complex_atanh(const Interval* in, Interval* out) {
  if (ordinary(in)) atanh_of(in[0], in[1], out[0], out[1]);
}
// atan z = -i atanh(iz).
void complex_atan(const Interval* in, Interval* out) {
  if (!ordinary(in)) return;
  Interval im;
  atanh_of(minus(in[1]), in[0], im, out[0]);
  out[1] = minus(im);
}

void complex_pow(const Interval* in, Interval* out) {
  const Interval &u = in[2], &v = in[3];
  const Interval r = length(in[0], in[1]);
  if (r.lo == 0 || u.contains_infinity() || v.contains_infinity() || r.contains_infinity()) return;
  const Interval log_r{std::log(r.lo), std::log(r.hi), false}, phi = angle(in[1], in[0]);
  const double slack =
      1e-14 * (1 + (u.magnitude() + v.magnitude()) * (log_r.magnitude() + phi.magnitude()));
  const Interval re = plus(times(u, log_r), minus(times(v, phi)));
  const Interval im = plus(times(u, phi), times(v, log_r));
  const Interval modulus = exponential(wider(re, slack));
  if (modulus.hi > kLargest) return;
  polar_of(modulus, wider(im, slack), out);
  if (u.contains(0) && v.contains(0)) {
    out[0] = join(out[0], Interval::point(1));
    out[1] = join(out[1], Interval::point(0));
  }
}

void complex_powi(const Interval* in, Interval* out) {
  const Interval& n = in[2];
  const double most = n.magnitude();
  const Interval r = length(in[0], in[1]);
  if (in[0].nan || in[1].nan || n.hi - n.lo > 64) return;
  const Interval phi = angle(in[1], in[0]);
  Interval re = Interval::empty(), im = re;
  for (double k = n.lo; k <= n.hi; ++k) {
    const double a = std::pow(r.lo, k), b = std::pow(r.hi, k);
    const Interval modulus{std::min(a, b), std::max(a, b), false};
    // Squares of both may be taken on the way.
    if (modulus.hi > kLargest || (k < 0 && modulus.lo < 1 / kLargest)) return;
    Interval z[2];
    polar_of(modulus, wider(times(phi, Interval::point(k)), 1e-15 * (1 + std::fabs(4 * k))), z);
    re = join(re, z[0]);
    im = join(im, z[1]);
  }
  // Each product has an error relative to the modulus, not to its parts.
  const double slack = (most + 8) * 0x1p-50 * std::max(re.magnitude(), im.magnitude());
  const double modulus = std::hypot(re.magnitude(), im.magnitude());
  out[0] = wider(re, slack + modulus * (most + 8) * 0x1p-50);
  out[1] = wider(im, slack + modulus * (most + 8) * 0x1p-50);
}

}  // namespace mms::stdlib::bounds
