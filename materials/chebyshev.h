// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Chebyshev's polynomials over [0, 1], and points to know functions by: what is nearly a
/// polynomial is nearly the one through its values there. Pure.

#include <array>
#include <cmath>
#include <cstddef>

#include "base/warp.h"

namespace mms::materials {

/// t_k(x) for each degree k below N.
template <std::size_t N, class R>
inline std::array<R, N> chebyshev_terms(R x) {
  const R u = 2 * x - 1;
  std::array<R, N> t{1, u};
  for (std::size_t k = 2; k < N; ++k) t[k] = 2 * u * t[k - 1] - t[k - 2];
  return t;
}

/// Where the polynomial of degree N is 0, from 1 down. Sums over them of two others' products, of
/// degrees below N, vanish.
template <std::size_t N>
inline const std::array<double, N>& chebyshev_points() {
  static const auto points = [] {
    std::array<double, N> x;
    for (std::size_t i = 0; i < N; ++i)
      x[i] = (1 + std::cos(kPi<double> * (double(i) + 0.5) / N)) / 2;
    return x;
  }();
  return points;
}

/// What values at the points are multiplied with for that of their polynomial at `x`.
template <std::size_t N, class R>
inline std::array<R, N> chebyshev_weights(R x) {
  static const auto at_points = [] {  // [point][k]
    std::array<std::array<R, N>, N> terms;
    for (std::size_t i = 0; i < N; ++i) terms[i] = chebyshev_terms<N>(R(chebyshev_points<N>()[i]));
    return terms;
  }();
  const auto there = chebyshev_terms<N>(x);
  std::array<R, N> weights;
  for (std::size_t i = 0; i < N; ++i) {
    weights[i] = -1;
    for (std::size_t k = 0; k < N; ++k) weights[i] += 2 * there[k] * at_points[i][k];
    weights[i] /= R(N);
  }
  return weights;
}

/// [to][from]: what values at `From` points are multiplied with for those of their polynomial at
/// `To` points.
template <std::size_t To, std::size_t From>
inline const std::array<std::array<double, From>, To>& chebyshev_transfer() {
  static const auto matrix = [] {
    std::array<std::array<double, From>, To> a;
    for (std::size_t m = 0; m < To; ++m) a[m] = chebyshev_weights<From>(chebyshev_points<To>()[m]);
    return a;
  }();
  return matrix;
}

}  // namespace mms::materials
