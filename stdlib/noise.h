// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// Noise interpolated between the corners of unit cells, with its exact derivatives: gradient noise
/// (Perlin 2002) and value noise.

#include "stdlib/lattice.h"

namespace mms::stdlib::MMS_ISA {

// Range: with the weights w_c >= 0 of a cell's corners, |noise| is at most the sum of w_c m(d_c),
// where d_c is the offset from the corner and m the largest projection on a corner vector: the sum
// of the N - 1 largest |d| for N = 3, 4; the larger |d| plus 0.4142 times the other for N = 2; |d|
// for N = 1. Its largest values over a cell are 0.5, 0.7152626, 1.0363539, 1.5365824 (tests
// recompute them). The scales are the reciprocals less 2.5e-6 or more, for rounding.
template <class R, int N>
inline constexpr R kPerlinScale = R(N == 1   ? 1.999992
                                    : N == 2 ? 1.39808
                                    : N == 3 ? 0.964919
                                             : 0.650792);

/// What the corners of a cell share.
template <class R, int N>
struct Cell {
  Bits side[N][2];  ///< lattice coordinates of the lower and of the upper side along each axis
  R offset[N];      ///< from the lower corner, in [0, 1]
};
template <class R, int N, class Where>
MMS_INLINE Cell<R, N> cell_at(const R (&p)[N], const Where& where) {
  Cell<R, N> cell;
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) {
    const R f = floor_of(p[k]), wrapped = where.wrapped(k, f);
    cell.offset[k] = p[k] - f;
    cell.side[k][0] = lattice(wrapped);
    cell.side[k][1] = where.above(k, wrapped, cell.side[k][0]);
  }
  return cell;
}

// A corner has a value, which depends on the offset `d` from it, and a gradient.

/// A random slope through 0.
struct Slopes {
  template <class R, int N>
  static constexpr R kScale = kPerlinScale<R, N>;
  template <class R, int N>
  MMS_INLINE static Jet<R, N> corner(Bits h, const R (&d)[N]) {
    Jet<R, N> r;
    corner_vector(h, r.gradient);
    r.value = r.gradient[0] * d[0];
#pragma GCC unroll 4
    for (int k = 1; k < N; ++k) r.value = fused(r.gradient[k], d[k], r.value);
    return r;
  }
};
/// A random number in [-1, 1).
struct Levels {
  // Rounded weights may exceed 1 by an ulp.
  template <class R, int N>
  static constexpr R kScale = R(1 - 0x1p-20);
  template <class R, int N>
  MMS_INLINE static Jet<R, N> corner(Bits h, const R (&)[N]) {
    return {unit<R>(h) * 2 - 1, {}};
  }
};

/// Weights of the upper side along each axis (quintic), and their derivatives.
template <class R, int N>
struct Weights {
  R w[N], dw[N];
};

/// Interpolates axes K .. N-1 below the hash `h` of the coordinates before; `d` is the offset from
/// the corner that is being built.
template <class Corners, int K, class R, int N>
MMS_INLINE Jet<R, N> interpolate(const Cell<R, N>& cell, const Weights<R, N>& weights, Bits h,
                                 R (&d)[N]) {
  if constexpr (K == N) {
    return Corners::corner(finish(h), d);
  } else {
    d[K] = cell.offset[K];
    const Jet<R, N> a = interpolate<Corners, K + 1>(cell, weights, mix(h, cell.side[K][0]), d);
    d[K] = cell.offset[K] - 1;
    const Jet<R, N> b = interpolate<Corners, K + 1>(cell, weights, mix(h, cell.side[K][1]), d);
    const R w = weights.w[K];
    Jet<R, N> r;
    r.value = fused(w, b.value - a.value, a.value);
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k)
      r.gradient[k] = fused(w, b.gradient[k] - a.gradient[k], a.gradient[k]);
    r.gradient[K] = fused(weights.dw[K], b.value - a.value, r.gradient[K]);
    return r;
  }
}

/// Derivative of that order of the weight of the upper side, t^3 (6 t^2 - 15 t + 10).
template <class R>
MMS_INLINE R weight_derivative(R t, std::int32_t order) {
  const R d0 = t * t * t * fused(t, fused(t, R(6), R(-15)), R(10));
  const R d1 = 30 * (t * t) * fused(t, t - 2, R(1));
  const R d2 = 60 * t * fused(t, fused(t, R(2), R(-3)), R(1));
  const R d3 = fused(t, fused(t, R(360), R(-360)), R(60));
  const R d4 = fused(t, R(720), R(-360));
  const R low = order <= 0 ? d0 : order == 1 ? d1 : order == 2 ? d2 : d3;
  const R high = order == 4 ? d4 : order == 5 ? R(720) : R(0);
  return order < 4 ? low : high;
}

/// One axis of a mixed derivative: for the lower and the upper side, the weight's derivative of the
/// axis' order n, and n times that of order n - 1 (which Leibniz' rule wants for a linear factor).
template <class R>
struct AxisWeights {
  R same[2], less[2];
};
template <class R>
MMS_INLINE AxisWeights<R> axis_weights(R t, std::int32_t order) {
  const std::int32_t n = order > 0 ? order : 0;
  const R upper = weight_derivative(t, n), below = weight_derivative(t, n - 1) * R(n);
  return {{(n == 0 ? R(1) : R(0)) - upper, upper}, {(n == 1 ? R(1) : R(0)) - below, below}};
}

/// Sums the corners over axes K .. N-1. `all`: the product of the weights so far; `one[k]`: the
/// same with axis k taken at one order less.
template <class Corners, int K, class R, int N>
MMS_INLINE R mixed_sum(const Cell<R, N>& cell, const AxisWeights<R> (&w)[N], Bits h, R (&d)[N],
                       R all, const R (&one)[N]) {
  if constexpr (K == N) {
    const Jet<R, N> corner = Corners::corner(finish(h), d);
    R r = 0;
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) r = fused(corner.gradient[k], one[k], r);
    return fused(corner.value, all, r);
  } else {
    R sides[2];
#pragma GCC unroll 2
    for (int side = 0; side < 2; ++side) {
      R next[N];
#pragma GCC unroll 4
      for (int k = 0; k < N; ++k)
        next[k] = k == K ? all * w[K].less[side] : one[k] * w[K].same[side];
      d[K] = cell.offset[K] - R(side);
      sides[side] = mixed_sum<Corners, K + 1>(cell, w, mix(h, cell.side[K][side]), d,
                                              all * w[K].same[side], next);
    }
    return sides[0] + sides[1];
  }
}

/// Noise between corners of that sort; see NoiseCalls.
template <class Corners>
struct Interpolated {
  template <int N>
  static constexpr int kStep = 1;

  template <class R, int N, class Where>
  MMS_INLINE static Jet<R, N> jet(const R (&p)[N], const Where& where) {
    const Cell<R, N> cell = cell_at(p, where);
    Weights<R, N> weights;
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) {
      const R t = cell.offset[k];
      weights.w[k] = t * t * t * fused(t, fused(t, R(6), R(-15)), R(10));
      weights.dw[k] = 30 * (t * t) * fused(t, t - 2, R(1));
    }
    R d[N];
    Jet<R, N> r = interpolate<Corners, 0>(cell, weights, where.start(), d);
    constexpr R scale = Corners::template kScale<R, N>;
    r.value *= scale;
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) r.gradient[k] *= scale;
    return r;
  }

  template <class R, int N, class Where>
  MMS_INLINE static R mixed(const R (&p)[N], const Where& where, const std::int32_t (&order)[N]) {
    const Cell<R, N> cell = cell_at(p, where);
    AxisWeights<R> w[N];
    R d[N], one[N];
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) {
      w[k] = axis_weights(cell.offset[k], order[k]);
      one[k] = 0;
    }
    return mixed_sum<Corners, 0>(cell, w, where.start(), d, R(1), one) *
           Corners::template kScale<R, N>;
  }
};
using Perlin = Interpolated<Slopes>;
using ValueNoise = Interpolated<Levels>;

}  // namespace mms::stdlib::MMS_ISA
