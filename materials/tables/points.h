// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Integrals of what is known by its values at Chebyshev's points. Nothing here is used when
/// rendering.

#include <array>
#include <cstddef>

#include "materials/chebyshev.h"

namespace mms::materials::tables {

/// What the values at the points are multiplied with for an integral of their polynomial, from
/// those integrals of t_k.
template <std::size_t N>
std::array<double, N> point_weights(const std::array<double, N>& moments) {
  std::array<double, N> weights;
  for (std::size_t i = 0; i < N; ++i) {
    const auto t = chebyshev_terms<N>(chebyshev_points<N>()[i]);
    weights[i] = -moments[0] / N;
    for (std::size_t k = 0; k < N; ++k) weights[i] += moments[k] * t[k] * 2 / N;
  }
  return weights;
}

}  // namespace mms::materials::tables
