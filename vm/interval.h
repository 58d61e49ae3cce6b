// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Closed intervals that enclose what the float *and* the double machine compute.
///
/// One type stands for every slot of the machine: a real, an integer, a logic value (a subset of
/// {0, 1}) or a spectrum (all its wavelengths at once). The ends of a real are floats, held as
/// doubles: rounding to nearest is monotone, so with ends that are floats rounded outward, one
/// computation in double encloses the rounded results of both machines. Infinite ends belong to
/// the interval. The sign of a zero is not kept: an interval that holds 0 may hold -0.

#include <cstdint>
#include <limits>

#include "vm/program.h"

namespace mms::vm {

struct Interval {
  double lo = 0, hi = 0;
  bool nan = false;  ///< the value may also be NaN

  static constexpr double kInf = std::numeric_limits<double>::infinity();

  /// Every real, and NaN.
  static constexpr Interval whole() { return {-kInf, kInf, true}; }
  static constexpr Interval empty() { return {kInf, -kInf, false}; }
  static constexpr Interval point(double x) { return {x, x, false}; }
  /// Every value of a slot of that type.
  static Interval all(SlotType type);

  constexpr bool has_number() const { return lo <= hi; }
  constexpr bool is_empty() const { return !has_number() && !nan; }
  constexpr bool is_point() const { return lo == hi && !nan; }
  constexpr bool contains(double x) const { return x != x ? nan : lo <= x && x <= hi; }
  constexpr bool contains_infinity() const { return has_number() && (lo == -kInf || hi == kInf); }
  /// The largest magnitude; 0 where there is no number.
  double magnitude() const;
  double width() const { return has_number() ? hi - lo : 0; }

  friend constexpr bool operator==(const Interval&, const Interval&) = default;
};

/// The nearest float not above `x`, and not below it.
double float_below(double x);
double float_above(double x);
/// The interval of reals [lo, hi], its ends rounded outward to floats.
Interval reals(double lo, double hi, bool nan = false);
/// The same for a result that either machine may miss by `ulps` units of float in the last place.
Interval reals_within(double lo, double hi, double ulps, bool nan = false);
/// What a constant is in either machine.
Interval interval_of(const Constant& c);

Interval join(const Interval& a, const Interval& b);
/// What is in both.
Interval meet(const Interval& a, const Interval& b);
/// `a` taken to the next of a few landmarks where `b`, which holds it, has left it: a chain of
/// such steps is short.
Interval widened(const Interval& a, const Interval& b, SlotType type);

// Arithmetic of reals, as the machine's opcodes.
Interval add(const Interval& a, const Interval& b);
Interval sub(const Interval& a, const Interval& b);
Interval mul(const Interval& a, const Interval& b);
Interval square(const Interval& a);  ///< a * a of one and the same number
Interval div(const Interval& a, const Interval& b);
Interval mod(const Interval& a, const Interval& b);  ///< a - b floor(a / b)
Interval neg(const Interval& a);
Interval fma(const Interval& a, const Interval& b, const Interval& c);
/// a a + c of one and the same a.
Interval square_fma(const Interval& a, const Interval& c);
/// fma(b - a, t, a) of one and the same a, `difference` being what the machine has for b - a: for t
/// in [0, 1] it does not leave the hull of a and b.
Interval blend(const Interval& a, const Interval& b, const Interval& difference, const Interval& t);

// Arithmetic of integers, which wraps: an overflow is every integer.
Interval add_integers(const Interval& a, const Interval& b);
Interval sub_integers(const Interval& a, const Interval& b);
Interval mul_integers(const Interval& a, const Interval& b);
Interval mod_integers(const Interval& a, const Interval& b);
Interval neg_integer(const Interval& a);
Interval real_of_integer(const Interval& a);
Interval integer_of_real(const Interval& a);

// Comparisons give a logic value; NaN compares as in IEEE 754.
enum class Comparison : std::uint8_t { Less, LessEqual, Equal, NotEqual };
Interval compare(Comparison c, const Interval& a, const Interval& b);

Interval logic(bool can_be_false, bool can_be_true);
constexpr bool can_be_true(const Interval& l) { return l.hi >= 1; }
constexpr bool can_be_false(const Interval& l) { return l.lo <= 0; }

/// Narrows `a` and `b` to what they can be where the comparison comes out as `outcome`.
/// `integers` makes a strict comparison exclude the end.
void narrow(Comparison c, bool outcome, bool integers, Interval& a, Interval& b);

}  // namespace mms::vm
