// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// What every noise over an integer lattice is made of: hashes of lattice points, random vectors,
/// periods, and the calls that rows make.
///
/// Lattice values come from an integer hash, not from tables, so there are no gathers, no period
/// unless one is asked for, and the same bits everywhere. The position inside a cell is
/// `x - floor(x)`, which is exact, so nothing is lost far from the origin but what the argument
/// itself cannot hold: write positions near the origin where that matters. Beyond 2^31 cells the
/// lattice no longer varies.

#include <utility>

#include "stdlib/core.h"
#include "vm/builtin.h"

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

/// The one lattice of a noise without seed and period.
struct Endless {
  MMS_INLINE static Bits start() { return kSeed; }
  /// The floored coordinate within the period.
  template <class R>
  MMS_INLINE static R wrapped(int, R floored) {
    return floored;
  }
  /// The lattice coordinate one above.
  template <class R>
  MMS_INLINE static Bits above(int, R, Bits near) {
    return near + 1;
  }
};

/// A whole number of cells that is a multiple of `step`; 0, which is no period, if it rounds to
/// less than one, is no number or too large to be exact.
template <class R>
MMS_INLINE R whole_period(R period, R step) {
  const R cells = floor_of(period / step + R(0.5)) * step;
  return (cells >= step) & (cells <= R(0x1p23)) ? cells : R(0);
}

/// Where a lattice starts anew for each seed; that of seed 0 is kSeed.
MMS_INLINE Bits start_of(std::int32_t seed) {
  Bits h = Bits(seed) * 0x9e3779b1u;
  h = (h ^ h >> 15) * 0x85ebca77u;
  return kSeed ^ h ^ h >> 13;
}

/// A lattice of its own for each seed, that repeats.
template <class R, int N>
struct Tiled {
  Bits h;
  R period[N];  ///< whole numbers; 0 where there is none
  MMS_INLINE Bits start() const { return h; }
  MMS_INLINE R wrapped(int axis, R floored) const {
    const R size = period[axis];
    const R rest = fused(-floor_of(floored / size), size, floored);  // the quotient may be 1 off
    const R inside = rest < 0 ? rest + size : rest >= size ? rest - size : rest;
    return size > 0 ? inside : floored;
  }
  MMS_INLINE Bits above(int axis, R wrapped, Bits near) const {
    return (period[axis] > 0) & (wrapped + 1 == period[axis]) ? Bits(0) : near + 1;
  }
};
/// `step`: what periods of the kind of noise are multiples of.
template <class R, int N>
MMS_INLINE Tiled<R, N> tiled(std::int32_t seed, const R (&period)[N], int step) {
  Tiled<R, N> t;
  t.h = start_of(seed);
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) t.period[k] = whole_period(period[k], R(step));
  return t;
}

/// One of as many arguments as there are axes.
template <std::size_t, class T>
using Each = T;

/// The functions of a row for a kind of noise over the axes K...: a Kind has `jet(p, where)`, its
/// value and gradient, `mixed(p, where, order)`, the derivative of order[k] along each axis k, and
/// `kStep<N>` as in `tiled`.
template <class Kind, class R, class Axes>
struct NoiseCalls;
template <class Kind, class R, std::size_t... K>
struct NoiseCalls<Kind, R, std::index_sequence<K...>> {
  static constexpr int N = sizeof...(K);
  using Vector = std::conditional_t<N == 1, R, std::array<R, N>>;

  [[gnu::always_inline]] static R value(Each<K, R>... p) {
    return Kind::jet({p...}, Endless{}).value;
  }
  [[gnu::always_inline]] static Vector gradient(Each<K, R>... p) {
    return vector(Kind::jet({p...}, Endless{}));
  }
  [[gnu::always_inline]] static R mixed(Each<K, R>... p, Each<K, std::int32_t>... order) {
    return Kind::mixed({p...}, Endless{}, {order...});
  }
  [[gnu::always_inline]] static R value_of(Each<K, R>... p, std::int32_t seed,
                                           Each<K, R>... period) {
    return Kind::jet({p...}, where(seed, {period...})).value;
  }
  [[gnu::always_inline]] static Vector gradient_of(Each<K, R>... p, std::int32_t seed,
                                                   Each<K, R>... period) {
    return vector(Kind::jet({p...}, where(seed, {period...})));
  }
  [[gnu::always_inline]] static R mixed_of(Each<K, R>... p, std::int32_t seed, Each<K, R>... period,
                                           Each<K, std::int32_t>... order) {
    return Kind::mixed({p...}, where(seed, {period...}), {order...});
  }

 private:
  MMS_INLINE static Tiled<R, N> where(std::int32_t seed, const R (&period)[N]) {
    return tiled(seed, period, Kind::template kStep<N>);
  }
  MMS_INLINE static Vector vector(const Jet<R, N>& j) { return {j.gradient[K]...}; }
};

/// A row of this module with its kernels.
constexpr vm::Builtin kernels(vm::Builtin row, vm::Kernel f32, vm::Kernel f64) {
  row.module = "noise";
  row.f32 = f32;
  row.f64 = f64;
  return row;
}

/// Rows of a kind of noise in N dimensions: each takes what the row says and adds the kernels of
/// the call of that name.
template <class Kind, std::size_t N>
struct NoiseRow {
  template <class R>
  using Calls = NoiseCalls<Kind, R, std::make_index_sequence<N>>;

  static constexpr vm::Builtin value(const vm::Builtin& row) {
    return kernels(row, vm::kernel_of<&Calls<float>::value>, vm::kernel_of<&Calls<double>::value>);
  }
  static constexpr vm::Builtin gradient(const vm::Builtin& row) {
    return kernels(row, vm::kernel_of<&Calls<float>::gradient>,
                   vm::kernel_of<&Calls<double>::gradient>);
  }
  static constexpr vm::Builtin mixed(const vm::Builtin& row) {
    return kernels(row, vm::kernel_of<&Calls<float>::mixed>, vm::kernel_of<&Calls<double>::mixed>);
  }
  static constexpr vm::Builtin value_of(const vm::Builtin& row) {
    return kernels(row, vm::kernel_of<&Calls<float>::value_of>,
                   vm::kernel_of<&Calls<double>::value_of>);
  }
  static constexpr vm::Builtin gradient_of(const vm::Builtin& row) {
    return kernels(row, vm::kernel_of<&Calls<float>::gradient_of>,
                   vm::kernel_of<&Calls<double>::gradient_of>);
  }
  static constexpr vm::Builtin mixed_of(const vm::Builtin& row) {
    return kernels(row, vm::kernel_of<&Calls<float>::mixed_of>,
                   vm::kernel_of<&Calls<double>::mixed_of>);
  }
};

}  // namespace mms::stdlib::MMS_ISA
