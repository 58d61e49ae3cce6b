// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Gauss-Legendre rules and adaptive integration over rectangles and intervals.

#include <array>
#include <cmath>
#include <numbers>

namespace mms {

/// Nodes and weights on [0, 1], by Newton's method on the Legendre polynomial.
template <int N>
struct GaussRule {
  std::array<double, N> x, w;

  GaussRule() {
    for (int i = 0; i < N; ++i) {
      double z = std::cos(std::numbers::pi * (i + 0.75) / (N + 0.5)), slope = 1;
      for (int k = 0; k < 100; ++k) {
        double p = 1, before = 0;
        for (int j = 0; j < N; ++j) {
          const double older = before;
          before = p;
          p = ((2 * j + 1) * z * before - j * older) / (j + 1);
        }
        slope = N * (z * p - before) / (z * z - 1);
        const double step = p / slope;
        z -= step;
        if (std::abs(step) < 1e-16) break;
      }
      x[i] = (1 - z) / 2;
      w[i] = 1 / ((1 - z * z) * slope * slope);
    }
  }
};

template <int N>
inline const GaussRule<N>& gauss() {
  static const GaussRule<N> rule;
  return rule;
}

/// Integral of `f(x)` over [a, b] by one rule.
template <int N, class F>
double integrate(F&& f, double a, double b) {
  double sum = 0;
  for (int i = 0; i < N; ++i) sum += gauss<N>().w[i] * f(a + (b - a) * gauss<N>().x[i]);
  return sum * (b - a);
}

/// The same, halving until two halves agree with the whole within `tolerance` (absolute).
template <class F>
double integrate_adaptive(F&& f, double a, double b, double tolerance, int depth = 40) {
  const double whole = integrate<8>(f, a, b), m = (a + b) / 2;
  const double halves = integrate<8>(f, a, m) + integrate<8>(f, m, b);
  if (depth == 0 || std::abs(whole - halves) <= tolerance) return halves;
  return integrate_adaptive(f, a, m, tolerance / 2, depth - 1) +
         integrate_adaptive(f, m, b, tolerance / 2, depth - 1);
}

struct Rectangle {
  double x0, x1, y0, y1;
};

/// Integral of `f(x, y)`: a rule of 4 by 4 points, quartering until the quarters agree with the
/// whole within `tolerance` (absolute; shared among quarters as its half, as errors do not align).
template <class F>
double integrate_adaptive(F&& f, const Rectangle& r, double tolerance, int depth = 10) {
  const auto rule = [&](const Rectangle& q) {
    double sum = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        sum += gauss<4>().w[i] * gauss<4>().w[j] *
               f(q.x0 + (q.x1 - q.x0) * gauss<4>().x[i], q.y0 + (q.y1 - q.y0) * gauss<4>().x[j]);
    return sum * (q.x1 - q.x0) * (q.y1 - q.y0);
  };
  const auto go = [&](const auto& self, const Rectangle& q, double whole, double tol,
                      int left) -> double {
    const double mx = (q.x0 + q.x1) / 2, my = (q.y0 + q.y1) / 2;
    const Rectangle parts[] = {
        {q.x0, mx, q.y0, my}, {mx, q.x1, q.y0, my}, {q.x0, mx, my, q.y1}, {mx, q.x1, my, q.y1}};
    double values[4], sum = 0;
    for (int i = 0; i < 4; ++i) sum += values[i] = rule(parts[i]);
    if (left == 0 || std::abs(sum - whole) <= tol) return sum;
    double refined = 0;
    for (int i = 0; i < 4; ++i) refined += self(self, parts[i], values[i], tol / 2, left - 1);
    return refined;
  };
  return go(go, r, rule(r), tolerance, depth);
}

}  // namespace mms
