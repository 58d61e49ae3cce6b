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

}  // namespace mms::stdlib::MMS_ISA
