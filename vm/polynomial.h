// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Cubics in one value, for enclosures: where a value occurs several times, as in the smooth step
/// t t (3 - 2 t), its polynomial tells how far it really goes.

#include "vm/interval.h"

namespace mms::vm {

/// c0 + c1 x + c2 x^2 + c3 x^3 of one value x, as the machines compute it: `error` bounds what
/// rounding does to it over x's interval.
struct Polynomial {
  static constexpr int kTerms = 4;
  double c[kTerms] = {};
  double error = 0;

  static Polynomial constant(const Interval& value);
  static Polynomial identity() { return {{0, 1, 0, 0}, 0}; }

  int degree() const;
  /// Sum of |c_k| x^k for |x| <= `size`.
  double magnitude(double size) const;
  /// The range over `x`, with the errors.
  Interval range(const Interval& x) const;
};

/// Of operands rounded as the machine rounds, over |x| <= `size`. A product's degree may be at most
/// 3.
Polynomial negative(const Polynomial& a);
Polynomial sum(const Polynomial& a, const Polynomial& b, double size);
Polynomial product(const Polynomial& a, const Polynomial& b, double size);

}  // namespace mms::vm
