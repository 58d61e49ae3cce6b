// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// Noise over an integer lattice: gradient noise (Perlin 2002) with its exact gradient, white
/// noise, cellular noise (Worley 1996).
///
/// Lattice values come from an integer hash, not from tables, so there are no gathers, no period,
/// and the same bits everywhere. The position inside a cell is `x - floor(x)`, which is exact, so
/// nothing is lost far from the origin but what the argument itself cannot hold: write positions
/// near the origin where that matters. Beyond 2^31 cells the lattice no longer varies.

#include "stdlib/core.h"

namespace mms::stdlib::MMS_ISA {

using Bits = std::uint32_t;
inline constexpr Bits kSeed = 0x6d6d7331u;

/// One step of the lattice hash: takes coordinate `i` into `h`.
MMS_INLINE Bits mix(Bits h, Bits i) {
  h = (h ^ i) * 0x9e3779b1u;
  return h ^ (h >> 15);
}
/// Ends a hash; its high bits are the good ones.
MMS_INLINE Bits finish(Bits h) {
  h *= 0x85ebca77u;
  return h ^ (h >> 16);
}

/// A finished hash as a number in [0, 1): its top 24 bits.
template <class R>
MMS_INLINE R unit(Bits h) {
  return R(std::int32_t(h >> 8)) * R(0x1p-24);
}

/// Lattice coordinate of a floored number.
template <class R>
MMS_INLINE Bits lattice(R floored) {
  return Bits(std::int32_t(magnitude(floored) < R(0x1p31) ? floored : R(0)));
}

/// 1 with the sign in bit `bit` of h.
template <int bit, class R>
MMS_INLINE void set_sign(Bits h, R& x) {
  if constexpr (kDouble<R>)
    x = h & (1u << bit) ? -1.0 : 1.0;
  else
    x = bits<float>(0x3f800000u | ((h << (31 - bit)) & 0x80000000u));
}

/// A value and its gradient.
template <class R, int N>
struct Jet {
  R value;
  R gradient[N];
};

// Random vectors of a lattice point. Their lengths are what kPerlinScale assumes.
/// A slope in [-1, 1).
template <class R>
MMS_INLINE void corner_vector(Bits h, R (&g)[1]) {
  g[0] = unit<R>(h) * 2 - 1;
}
/// Eight directions, 45 degrees apart, off the axes by 22.5.
template <class R>
MMS_INLINE void corner_vector(Bits h, R (&g)[2]) {
  constexpr R c = R(0.41421356237309503);
  set_sign<31>(h, g[0]);
  set_sign<30>(h, g[1]);
  const bool swap = h & 0x20000000u;
  g[0] *= swap ? c : R(1);
  g[1] *= swap ? R(1) : c;
}
/// The twelve midpoints of a cube's edges; the coordinate that is zero by thirds of 28 bits.
template <class R>
MMS_INLINE void corner_vector(Bits h, R (&g)[3]) {
  set_sign<31>(h, g[0]);
  set_sign<30>(h, g[1]);
  set_sign<29>(h, g[2]);
  const Bits zero = (h & 0x0fffffffu) * 3 >> 28;
  g[0] = zero == 0 ? R(0) : g[0];
  g[1] = zero == 1 ? R(0) : g[1];
  g[2] = zero == 2 ? R(0) : g[2];
}
/// The 32 midpoints of a hypercube's edges.
template <class R>
MMS_INLINE void corner_vector(Bits h, R (&g)[4]) {
  set_sign<31>(h, g[0]);
  set_sign<30>(h, g[1]);
  set_sign<29>(h, g[2]);
  set_sign<28>(h, g[3]);
  const Bits zero = (h >> 26) & 3;
  g[0] = zero == 0 ? R(0) : g[0];
  g[1] = zero == 1 ? R(0) : g[1];
  g[2] = zero == 2 ? R(0) : g[2];
  g[3] = zero == 3 ? R(0) : g[3];
}

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
  Bits near[N];   ///< lattice coordinates of the lower corner
  R offset[N];    ///< from the lower corner, in [0, 1]
  R w[N], dw[N];  ///< weight of the upper side along each axis (quintic), its derivative
};

/// Interpolates axes K .. N-1 below the hash `h` of the coordinates before; `d` is the offset from
/// the corner that is being built.
template <int K, class R, int N>
MMS_INLINE Jet<R, N> interpolate(const Cell<R, N>& cell, Bits h, R (&d)[N]) {
  Jet<R, N> r;
  if constexpr (K == N) {
    corner_vector(finish(h), r.gradient);
    r.value = r.gradient[0] * d[0];
#pragma GCC unroll 4
    for (int k = 1; k < N; ++k) r.value = fused(r.gradient[k], d[k], r.value);
  } else {
    d[K] = cell.offset[K];
    const Jet<R, N> a = interpolate<K + 1>(cell, mix(h, cell.near[K]), d);
    d[K] = cell.offset[K] - 1;
    const Jet<R, N> b = interpolate<K + 1>(cell, mix(h, cell.near[K] + 1), d);
    r.value = fused(cell.w[K], b.value - a.value, a.value);
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k)
      r.gradient[k] = fused(cell.w[K], b.gradient[k] - a.gradient[k], a.gradient[k]);
    r.gradient[K] = fused(cell.dw[K], b.value - a.value, r.gradient[K]);
  }
  return r;
}

template <class R, int N>
MMS_INLINE Jet<R, N> perlin(const R (&p)[N]) {
  Cell<R, N> cell;
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) {
    const R f = floor_of(p[k]), t = p[k] - f;
    cell.near[k] = lattice(f);
    cell.offset[k] = t;
    cell.w[k] = t * t * t * fused(t, fused(t, R(6), R(-15)), R(10));
    cell.dw[k] = 30 * (t * t) * fused(t, t - 2, R(1));
  }
  R d[N];
  Jet<R, N> r = interpolate<0>(cell, kSeed, d);
  r.value *= kPerlinScale<R, N>;
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) r.gradient[k] *= kPerlinScale<R, N>;
  return r;
}

template <int N, class R, class... Rs>
MMS_INLINE R perlin_value(Rs... p) {
  const R q[] = {p...};
  return perlin<R, N>(q).value;
}
template <class R>
struct Perlin1 {
  [[gnu::always_inline]] static R eval(R x) { return perlin_value<1, R>(x); }
};
template <class R>
struct Perlin2 {
  [[gnu::always_inline]] static R eval(R x, R y) { return perlin_value<2, R>(x, y); }
};
template <class R>
struct Perlin3 {
  [[gnu::always_inline]] static R eval(R x, R y, R z) { return perlin_value<3, R>(x, y, z); }
};
template <class R>
struct Perlin4 {
  [[gnu::always_inline]] static R eval(R x, R y, R z, R t) {
    return perlin_value<4, R>(x, y, z, t);
  }
};
template <class R>
struct PerlinGradient1 {
  [[gnu::always_inline]] static R eval(R x) { return perlin<R, 1>({x}).gradient[0]; }
};
template <class R>
struct PerlinGradient2 {
  [[gnu::always_inline]] static std::array<R, 2> eval(R x, R y) {
    const auto j = perlin<R, 2>({x, y});
    return {j.gradient[0], j.gradient[1]};
  }
};
template <class R>
struct PerlinGradient3 {
  [[gnu::always_inline]] static std::array<R, 3> eval(R x, R y, R z) {
    const auto j = perlin<R, 3>({x, y, z});
    return {j.gradient[0], j.gradient[1], j.gradient[2]};
  }
};
template <class R>
struct PerlinGradient4 {
  [[gnu::always_inline]] static std::array<R, 4> eval(R x, R y, R z, R t) {
    const auto j = perlin<R, 4>({x, y, z, t});
    return {j.gradient[0], j.gradient[1], j.gradient[2], j.gradient[3]};
  }
};

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
template <int K, class R, int N>
MMS_INLINE R mixed(const Cell<R, N>& cell, const AxisWeights<R> (&w)[N], Bits h, R (&d)[N], R all,
                   const R (&one)[N]) {
  if constexpr (K == N) {
    R g[N], dot = 0, r = 0;
    corner_vector(finish(h), g);
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) {
      dot = fused(g[k], d[k], dot);
      r = fused(g[k], one[k], r);
    }
    return fused(dot, all, r);
  } else {
    R sides[2];
#pragma GCC unroll 2
    for (int side = 0; side < 2; ++side) {
      R next[N];
#pragma GCC unroll 4
      for (int k = 0; k < N; ++k)
        next[k] = k == K ? all * w[K].less[side] : one[k] * w[K].same[side];
      d[K] = cell.offset[K] - R(side);
      sides[side] =
          mixed<K + 1>(cell, w, mix(h, cell.near[K] + Bits(side)), d, all * w[K].same[side], next);
    }
    return sides[0] + sides[1];
  }
}

/// The derivative of `perlin` of order[k] along each axis k.
template <class R, int N>
MMS_INLINE R perlin_mixed(const R (&p)[N], const std::int32_t (&order)[N]) {
  Cell<R, N> cell;
  AxisWeights<R> w[N];
  R d[N], one[N];
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) {
    const R f = floor_of(p[k]);
    cell.near[k] = lattice(f);
    cell.offset[k] = p[k] - f;
    w[k] = axis_weights(cell.offset[k], order[k]);
    one[k] = 0;
  }
  return mixed<0>(cell, w, kSeed, d, R(1), one) * kPerlinScale<R, N>;
}
template <class R>
struct PerlinDerivative1 {
  [[gnu::always_inline]] static R eval(R x, std::int32_t i) { return perlin_mixed<R, 1>({x}, {i}); }
};
template <class R>
struct PerlinDerivative2 {
  [[gnu::always_inline]] static R eval(R x, R y, std::int32_t i, std::int32_t j) {
    return perlin_mixed<R, 2>({x, y}, {i, j});
  }
};
template <class R>
struct PerlinDerivative3 {
  [[gnu::always_inline]] static R eval(R x, R y, R z, std::int32_t i, std::int32_t j,
                                       std::int32_t k) {
    return perlin_mixed<R, 3>({x, y, z}, {i, j, k});
  }
};
template <class R>
struct PerlinDerivative4 {
  [[gnu::always_inline]] static R eval(R x, R y, R z, R t, std::int32_t i, std::int32_t j,
                                       std::int32_t k, std::int32_t l) {
    return perlin_mixed<R, 4>({x, y, z, t}, {i, j, k, l});
  }
};

}  // namespace mms::stdlib::MMS_ISA
