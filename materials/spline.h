// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Cubic B-splines over uniform grids: what tables are read with. n nodes on [0, 1] have n + 2
/// coefficients; the curve is twice differentiable. Pure; allocates nothing.

#include <algorithm>

#include "materials/weighted_rows.h"

namespace mms::materials {

/// The four coefficients that `x` in [0, 1] depends on, and their weights, which sum to 1.
template <class R>
struct Stencil {
  int first = 0;
  R weight[4] = {};

  bool operator==(const Stencil&) const = default;

  /// Outside [0, 1], and where `x` is not a number, the nearer end holds.
  static Stencil at(R x, int nodes) {
    const R u = (x > 0 ? std::min(x, R(1)) : R(0)) * R(nodes - 1);
    Stencil s;
    s.first = std::min(int(u), nodes - 2);
    const R t = u - R(s.first), v = 1 - t;
    s.weight[0] = v * v * v / 6;
    s.weight[1] = (4 + t * t * (3 * t - 6)) / 6;
    s.weight[2] = (4 + v * v * (3 * v - 6)) / 6;
    s.weight[3] = t * t * t / 6;
    return s;
  }
};

/// Coefficients along one axis.
constexpr int coefficients(int nodes) { return nodes + 2; }

/// The table's value; the last stencil's axis is the innermost. `stride` is of one step of the
/// first axis and given for each axis but the last.
template <class T, class R>
inline R interpolate(const T* table, const Stencil<R>& a) {
  const T* p = table + a.first;
  return a.weight[0] * R(p[0]) + a.weight[1] * R(p[1]) + a.weight[2] * R(p[2]) +
         a.weight[3] * R(p[3]);
}
template <class T, class R, class... Rest>
inline R interpolate(const T* table, const Stencil<R>& a, int stride, const Rest&... rest) {
  R sum = 0;
  for (int k = 0; k < 4; ++k)
    sum += a.weight[k] * interpolate(table + (a.first + k) * stride, rest...);
  return sum;
}

/// `visit(first, weight)` for the rows of a table whose innermost axis is one of many numbers.
/// `stride` is given for every axis.
template <class R, class Visit>
inline void visit_rows(const Visit& visit, int first, R weight) {
  visit(first, weight);
}
template <class R, class Visit, class... Rest>
inline void visit_rows(const Visit& visit, int first, R weight, const Stencil<R>& a, int stride,
                       const Rest&... rest) {
  for (int k = 0; k < 4; ++k)
    visit_rows(visit, first + (a.first + k) * stride, weight * a.weight[k], rest...);
}

/// Adds `weight` times what the table holds for each of `terms` numbers.
template <class R, class... Axes>
inline void add_terms(R* sums, int terms, const float* table, R weight, const Axes&... axes) {
  WeightedRows<R, 1 << sizeof...(Axes)> rows;  // four along each of half as many axes
  visit_rows([&](int first, R by) { rows.add(first, by); }, 0, weight, axes...);
  add_rows(sums, terms, table, rows);
}

}  // namespace mms::materials
