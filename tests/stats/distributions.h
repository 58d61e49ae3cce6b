// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Tail probabilities, and the level of a test among many. Everything is double and pure.

#include <cmath>
#include <limits>

namespace mms::stats {

/// Regularised upper incomplete gamma function Q(a, x), a > 0, x >= 0: its series below a + 1, its
/// continued fraction (Lentz) above; relative error about 1e-13 (Abramowitz and Stegun 6.5.29,
/// .31).
inline double gamma_q(double a, double x) {
  if (!(x > 0)) return 1;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < 10000 && term > sum * 1e-17; ++n) sum += term *= x / (a + n);
    return 1 - front * sum;
  }
  const double tiny = std::numeric_limits<double>::min() / 1e-17;
  double b = x + 1 - a, c = 1 / tiny, d = 1 / b, h = d;
  for (int n = 1; n < 10000; ++n) {
    const double k = n * (a - n);
    b += 2;
    d = k * d + b;
    d = 1 / (std::abs(d) < tiny ? tiny : d);
    c = b + k / c;
    if (std::abs(c) < tiny) c = tiny;
    h *= c * d;
    if (std::abs(c * d - 1) < 1e-15) break;
  }
  return front * h;
}

/// Probability that a chi-square variable of `freedom` degrees exceeds `statistic`.
inline double chi_square_tail(double statistic, int freedom) {
  return gamma_q(freedom / 2.0, statistic / 2);
}

/// Probability that a normal variable is further than |z| deviations from its mean.
inline double normal_two_sided(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

/// Level of each of `tests` independent tests for a false alarm in all of them at `level` (Sidak).
inline double sidak(double level, int tests) { return -std::expm1(std::log1p(-level) / tests); }

/// Mean and variance in one pass (Welford).
struct Moments {
  double n = 0, mean = 0, m2 = 0;
  void add(double x) {
    n += 1;
    const double d = x - mean;
    mean += d / n;
    m2 += d * (x - mean);
  }
  double variance() const { return n > 1 ? m2 / (n - 1) : 0; }
  double standard_error() const { return n > 1 ? std::sqrt(variance() / n) : 0; }
};

/// Two-sided p-value of "the mean is `expected`". `rounding` is an absolute error of the arithmetic
/// that is granted besides the statistical one.
inline double z_test(const Moments& m, double expected, double rounding = 0) {
  const double off = std::max(0.0, std::abs(m.mean - expected) - rounding);
  if (off == 0) return 1;
  const double e = m.standard_error();
  return e > 0 ? normal_two_sided(off / e) : 0;
}

}  // namespace mms::stats
