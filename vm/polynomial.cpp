// SPDX-License-Identifier: Apache-2.0
#include "vm/polynomial.h"

#include <algorithm>
#include <cmath>

namespace mms::vm {
namespace {

/// Half a float in the last place, and the least float: an operation's own rounding.
constexpr double kUnit = 0x1.0001p-24, kLeast = 0x1p-149;

/// Adds the rounding of a result that is at most `size` but for the errors so far.
void rounded(Polynomial& p, double size) { p.error += kUnit * (size + p.error) + kLeast; }

}  // namespace

Polynomial Polynomial::constant(const Interval& value) {
  return {{0.5 * (value.lo + value.hi), 0, 0, 0}, 0.5 * (value.hi - value.lo)};
}

int Polynomial::degree() const {
  int d = kTerms - 1;
  while (d > 0 && c[d] == 0) --d;
  return d;
}

double Polynomial::magnitude(double size) const {
  double m = 0;
  for (int k = kTerms; k-- > 0;) m = m * size + std::fabs(c[k]);
  return m;
}

Interval Polynomial::range(const Interval& x) const {
  const auto at = [&](double t) { return c[0] + t * (c[1] + t * (c[2] + t * c[3])); };
  double lo = std::min(at(x.lo), at(x.hi)), hi = std::max(at(x.lo), at(x.hi));
  const auto turn = [&](double t) {
    if (!(x.lo < t && t < x.hi)) return;
    lo = std::min(lo, at(t));
    hi = std::max(hi, at(t));
  };
  // Zeros of c1 + 2 c2 t + 3 c3 t^2, without cancellation.
  const double q = c[2] * c[2] - 3 * c[1] * c[3];
  if (c[3] == 0) {
    if (c[2] != 0) turn(-0.5 * c[1] / c[2]);
  } else if (q >= 0) {
    const double s = -(c[2] + std::copysign(std::sqrt(q), c[2]));
    turn(s / (3 * c[3]));
    if (s != 0) turn(c[1] / s);
  }
  // Near a turn the value is flat, so what a turn is off by does not count.
  const double slack = error + 0x1p-46 * magnitude(x.magnitude());
  return reals(lo - slack, hi + slack);
}

Polynomial negative(const Polynomial& a) {
  Polynomial r = a;
  for (double& v : r.c) v = -v;
  return r;
}

Polynomial sum(const Polynomial& a, const Polynomial& b, double size) {
  Polynomial r;
  for (int k = 0; k < Polynomial::kTerms; ++k) r.c[k] = a.c[k] + b.c[k];
  r.error = a.error + b.error;
  rounded(r, r.magnitude(size));
  return r;
}

Polynomial product(const Polynomial& a, const Polynomial& b, double size) {
  Polynomial r;
  for (int i = 0; i < Polynomial::kTerms; ++i)
    for (int k = 0; i + k < Polynomial::kTerms; ++k) r.c[i + k] += a.c[i] * b.c[k];
  const double m = a.magnitude(size), n = b.magnitude(size);
  r.error = a.error * n + b.error * m + a.error * b.error;
  rounded(r, m * n);
  return r;
}

}  // namespace mms::vm
