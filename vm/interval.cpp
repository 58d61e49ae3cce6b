// SPDX-License-Identifier: Apache-2.0
#include "vm/interval.h"

#include <algorithm>
#include <cmath>

namespace mms::vm {
namespace {

constexpr double kInf = Interval::kInf;
constexpr double kLeastInteger = -2147483648.0, kMostInteger = 2147483647.0;
constexpr Interval kIntegers{kLeastInteger, kMostInteger, false};

/// Ends of a hull, of which an undefined candidate (0 inf, inf / inf) gives nothing.
struct Hull {
  double lo = kInf, hi = -kInf;
  void add(double x) {
    if (x != x) return;
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
};

/// x y, where 0 times infinity is the limit 0.
double product(double x, double y) { return x == 0 || y == 0 ? 0 : x * y; }

Hull products(const Interval& a, const Interval& b) {
  Hull h;
  for (const double x : {a.lo, a.hi})
    for (const double y : {b.lo, b.hi}) h.add(product(x, y));
  return h;
}

bool zero_times_infinity(const Interval& a, const Interval& b) {
  return (a.contains(0) && b.contains_infinity()) || (b.contains(0) && a.contains_infinity());
}

/// Sum of ends; where infinities cancel, the end that is always safe.
double sum_low(double a, double b) { return std::isnan(a + b) ? -kInf : a + b; }
double sum_high(double a, double b) { return std::isnan(a + b) ? kInf : a + b; }

bool infinities_cancel(double a_lo, double a_hi, double b_lo, double b_hi) {
  return (a_lo == -kInf && b_hi == kInf) || (a_hi == kInf && b_lo == -kInf);
}

Interval sum(double a_lo, double a_hi, const Interval& b, bool nan) {
  return reals(sum_low(a_lo, b.lo), sum_high(a_hi, b.hi),
               nan || b.nan || infinities_cancel(a_lo, a_hi, b.lo, b.hi));
}

Hull squares(const Interval& a) {
  Hull h;
  h.add(a.lo * a.lo);
  h.add(a.hi * a.hi);
  if (a.contains(0)) h.add(0);
  return h;
}

/// Nothing to compute with: only NaN, if that.
bool no_numbers(const Interval& a, const Interval& b) { return !a.has_number() || !b.has_number(); }
Interval only_nan(bool nan) {
  Interval r = Interval::empty();
  r.nan = nan;
  return r;
}

Interval integers(double lo, double hi) {
  return lo < kLeastInteger || hi > kMostInteger ? kIntegers : Interval{lo, hi, false};
}

/// The least of a few landmarks above x.
double landmark_above(double x, SlotType type) {
  for (const double l : {-1.0, 0.0, 1.0, 256.0})
    if (x <= l) return l;
  return type == SlotType::Integer ? kMostInteger : kInf;
}

}  // namespace

Interval Interval::all(SlotType type) {
  switch (type) {
    case SlotType::Integer:
      return kIntegers;
    case SlotType::Logic:
      return {0, 1, false};
    case SlotType::Real:
    case SlotType::Spectrum:
      break;
  }
  return whole();
}

double Interval::magnitude() const {
  return has_number() ? std::max(std::fabs(lo), std::fabs(hi)) : 0;
}

double float_below(double x) {
  const float f = static_cast<float>(x);
  return f > x ? std::nextafterf(f, -std::numeric_limits<float>::infinity()) : f;
}
double float_above(double x) { return -float_below(-x); }

Interval reals(double lo, double hi, bool nan) { return {float_below(lo), float_above(hi), nan}; }

Interval reals_within(double lo, double hi, double ulps, bool nan) {
  // A result that is rounded once needs no slack; within 0.51 ulp there are only the two floats
  // around the exact result, and libm's own error in double is far below the slack.
  const auto slack = [ulps](double x) {
    if (std::isinf(x) || ulps <= 0.5) return 0.0;
    if (ulps <= 0.51) return std::fabs(x) * 0x1p-49;
    return (ulps + 1e-6) * std::max(std::fabs(x) * 0x1p-23, 0x1p-149);
  };
  return lo <= hi ? reals(lo - slack(lo), hi + slack(hi), nan) : only_nan(nan);
}

Interval interval_of(const Constant& c) {
  if (c.type != SlotType::Real) return Interval::point(c.integer);
  Hull h;
  h.add(static_cast<double>(c.f32));
  h.add(c.f64);
  return reals(h.lo, h.hi, std::isnan(c.f32) || std::isnan(c.f64));
}

Interval join(const Interval& a, const Interval& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi), a.nan || b.nan};
}
Interval meet(const Interval& a, const Interval& b) {
  const Interval r{std::max(a.lo, b.lo), std::min(a.hi, b.hi), a.nan && b.nan};
  return r.has_number() ? r : only_nan(r.nan);
}

Interval widened(const Interval& a, const Interval& b, SlotType type) {
  Interval r = b;
  if (type == SlotType::Logic || !a.has_number()) return r;
  if (b.hi > a.hi) r.hi = landmark_above(b.hi, type);
  if (b.lo < a.lo) r.lo = -landmark_above(-b.lo, type);
  if (type == SlotType::Integer && r.lo == -kMostInteger) r.lo = kLeastInteger;
  return r;
}

Interval add(const Interval& a, const Interval& b) {
  if (no_numbers(a, b)) return only_nan(a.nan || b.nan);
  return sum(a.lo, a.hi, b, a.nan);
}
Interval neg(const Interval& a) { return {-a.hi, -a.lo, a.nan}; }
Interval sub(const Interval& a, const Interval& b) { return add(a, neg(b)); }

Interval mul(const Interval& a, const Interval& b) {
  if (no_numbers(a, b)) return only_nan(a.nan || b.nan);
  const Hull h = products(a, b);
  return reals(h.lo, h.hi, a.nan || b.nan || zero_times_infinity(a, b));
}
Interval square(const Interval& a) {
  if (!a.has_number()) return a;
  const Hull h = squares(a);
  return reals(h.lo, h.hi, a.nan);
}

Interval div(const Interval& a, const Interval& b) {
  if (no_numbers(a, b)) return only_nan(a.nan || b.nan);
  const bool nan = a.nan || b.nan || (a.contains(0) && b.contains(0)) ||
                   (a.contains_infinity() && b.contains_infinity());
  if (b.contains(0)) return {-kInf, kInf, nan};
  Hull h;
  for (const double x : {a.lo, a.hi})
    for (const double y : {b.lo, b.hi}) h.add(x / y);
  return h.lo <= h.hi ? reals(h.lo, h.hi, nan) : Interval{-kInf, kInf, nan};
}

/// The product of floats is exact in double.
Interval fma(const Interval& a, const Interval& b, const Interval& c) {
  if (no_numbers(a, b) || !c.has_number()) return only_nan(a.nan || b.nan || c.nan);
  const Hull h = products(a, b);
  return sum(h.lo, h.hi, c, a.nan || b.nan || zero_times_infinity(a, b));
}
Interval square_fma(const Interval& a, const Interval& c) {
  if (no_numbers(a, c)) return only_nan(a.nan || c.nan);
  const Hull h = squares(a);
  return sum(h.lo, h.hi, c, a.nan);
}

Interval blend(const Interval& a, const Interval& b, const Interval& difference,
               const Interval& t) {
  const Interval plain = fma(difference, t, a);
  const bool convex = t.has_number() && t.lo >= 0 && t.hi <= 1 && a.has_number() &&
                      b.has_number() && !a.contains_infinity() && !b.contains_infinity();
  if (!convex) return plain;
  // a (1 - t) + b t; what the machine's difference misses by rounding comes in times t.
  const auto at = [](double x, double y, double u) { return x * (1 - u) + y * u; };
  const double slack = 0x1.001p-24 * difference.magnitude() * t.hi +
                       0x1p-48 * (a.magnitude() + b.magnitude()) + 0x1p-149;
  const Interval hull =
      reals(std::min(at(a.lo, b.lo, t.lo), at(a.lo, b.lo, t.hi)) - slack,
            std::max(at(a.hi, b.hi, t.lo), at(a.hi, b.hi, t.hi)) + slack, plain.nan);
  return meet(plain, hull);
}

/// The quotient is rounded before it is floored, so near a multiple of b the result can lie outside
/// [0, b) by what the rounding of the quotient is times b: |a| 2^-24 at most, or |b| 2^-150 where
/// it is below the normal floats.
Interval mod(const Interval& a, const Interval& b) {
  if (no_numbers(a, b)) return only_nan(a.nan || b.nan);
  if (b.contains(0) || a.contains_infinity() || b.contains_infinity()) return Interval::whole();
  if (b.hi < 0) {
    // Mirroring both operands mirrors the result.
    return neg(mod(neg(a), neg(b)));
  }
  const Interval quotient = div(a, b);
  const double first = std::floor(quotient.lo), last = std::floor(quotient.hi);
  if (quotient.contains_infinity()) return Interval::whole();
  const double slack = a.magnitude() * 0x1p-23 + b.hi * 0x1p-148;
  const Interval range = reals(-slack, b.hi + slack, a.nan || b.nan);
  if (first != last) return range;
  // The whole number is not always a float; as one it is what the float machine has.
  const Interval whole = reals(first, first);
  Interval r = fma(neg(b), whole, a);
  r.nan = a.nan || b.nan;
  return r;
}

Interval add_integers(const Interval& a, const Interval& b) {
  return integers(a.lo + b.lo, a.hi + b.hi);
}
Interval sub_integers(const Interval& a, const Interval& b) {
  return integers(a.lo - b.hi, a.hi - b.lo);
}
Interval mul_integers(const Interval& a, const Interval& b) {
  const Hull h = products(a, b);
  return integers(h.lo, h.hi);
}
Interval neg_integer(const Interval& a) { return integers(-a.hi, -a.lo); }
Interval mod_integers(const Interval& a, const Interval& b) {
  Interval r = Interval::point(0);
  if (b.hi > 0) {
    if (b.is_point() && std::floor(a.lo / b.lo) == std::floor(a.hi / b.lo)) {
      const double base = b.lo * std::floor(a.lo / b.lo);
      return {a.lo - base, a.hi - base, false};
    }
    r.hi = b.hi - 1;
    if (b.lo > 0 && a.lo >= 0) r.hi = std::min(r.hi, a.hi);
  }
  if (b.lo < 0) r.lo = b.lo + 1;
  return r;
}
Interval real_of_integer(const Interval& a) { return reals(a.lo, a.hi); }
Interval integer_of_real(const Interval& a) {
  const auto cut = [](double x) { return std::clamp(std::trunc(x), kLeastInteger, kMostInteger); };
  Interval r = Interval::empty();
  if (a.has_number()) r = {cut(a.lo), cut(a.hi), false};
  return a.nan ? join(r, Interval::point(0)) : r;
}

Interval logic(bool can_be_false, bool can_be_true) {
  return {can_be_false ? 0.0 : 1.0, can_be_true ? 1.0 : 0.0, false};
}

Interval compare(Comparison c, const Interval& a, const Interval& b) {
  const bool nan = a.nan || b.nan;
  if (c == Comparison::NotEqual) {
    const Interval equal = compare(Comparison::Equal, a, b);
    return {1 - equal.hi, 1 - equal.lo, false};
  }
  if (no_numbers(a, b)) return logic(true, false);
  switch (c) {
    case Comparison::Less:
      return logic(nan || a.hi >= b.lo, a.lo < b.hi);
    case Comparison::LessEqual:
      return logic(nan || a.hi > b.lo, a.lo <= b.hi);
    default:
      break;
  }
  const bool same = a.is_point() && b.is_point() && a.lo == b.lo;
  return logic(!same, a.lo <= b.hi && b.lo <= a.hi);
}

namespace {

/// a < b or a <= b holds, for numbers: cuts a from above and b from below. `cut_a`, `cut_b`: what
/// may be cut, because the comparison says something of it.
void narrow_order(bool strict_integers, Interval& a, Interval& b, bool cut_a, bool cut_b) {
  const double gap = strict_integers ? 1 : 0;
  const double a_hi = std::min(a.hi, b.hi - gap), b_lo = std::max(b.lo, a.lo + gap);
  if (cut_a) a.hi = a_hi;
  if (cut_b) b.lo = b_lo;
}

void without_numbers_that_clash(Interval& a) {
  if (!a.has_number()) a = only_nan(a.nan);
}

}  // namespace

void narrow(Comparison c, bool outcome, bool integers, Interval& a, Interval& b) {
  if (c == Comparison::NotEqual) return narrow(Comparison::Equal, !outcome, integers, a, b);
  if (no_numbers(a, b)) return;
  if (c == Comparison::Equal) {
    if (!outcome) return;
    a.nan = b.nan = false;
    a = b = meet(a, b);
    return;
  }
  const bool less = c == Comparison::Less;
  if (outcome) {
    a.nan = b.nan = false;
    narrow_order(integers && less, a, b, true, true);
  } else {
    // Where the other side is NaN, the comparison says nothing of this one.
    const bool cut_a = !b.nan, cut_b = !a.nan;
    narrow_order(integers && !less, b, a, cut_b, cut_a);
  }
  without_numbers_that_clash(a);
  without_numbers_that_clash(b);
}

}  // namespace mms::vm
