// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// How far a kernel's result is from the exact one.

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/unit/stdlib/rows.h"

namespace mms::stdlib::testing {

using L = long double;

/// Error in units in the last place of an R at `exact`; infinity counts as the power of two that
/// follows the largest number. 1e9 where one is NaN and the other is not, or a zero has the wrong
/// sign.
template <class R>
inline double ulp_error(R got, L exact) {
  if (exact != exact || got != got) return (exact != exact) == (got != got) ? 0 : 1e9;
  if (exact == 0 && got == 0) return std::signbit(exact) == std::signbit(got) ? 0 : 1e9;
  using Limits = std::numeric_limits<R>;
  const L end = ldexpl(1, Limits::max_exponent);
  L g = std::isinf(got) ? std::copysign(end, L(got)) : L(got);
  L e = fabsl(exact) > end ? std::copysign(end, exact) : exact;
  int exponent;
  frexpl(e, &exponent);
  if (fabsl(e) == end) --exponent;
  const int lowest = Limits::min_exponent;
  const L ulp = ldexpl(1, std::max(exponent, lowest) - Limits::digits);
  return double(fabsl(g - e) / ulp);
}

}  // namespace mms::stdlib::testing
