// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// White noise, and noise from one random point in each cell (Worley 1996). Hashes as in noise.h.

#include "stdlib/lattice.h"

namespace mms::stdlib::MMS_ISA {

/// The bits of a float for hashing: -0 counts as 0, and every NaN as one (which NaN an operation
/// gives is the processor's choice).
MMS_INLINE Bits bits_of(float x) { return x == x ? bits<Bits>(x + 0.0f) : Bits(0x7fc00000u); }
/// Hash of the numbers themselves, as floats in either machine.
template <class R, class... Rs>
MMS_INLINE Bits hash_of(Rs... x) {
  Bits h = kSeed ^ Bits(sizeof...(x));
  ((h = mix(h, bits_of(float(x)))), ...);
  return finish(h);
}
/// Hash of the unit cell that holds a point.
template <class R, class... Rs>
MMS_INLINE Bits cell_hash(Rs... x) {
  Bits h = kSeed;
  ((h = mix(h, lattice(floor_of(x)))), ...);
  return finish(h);
}

template <class R>
struct Hash1 {
  [[gnu::always_inline]] static R eval(R x) { return unit<R>(hash_of<R>(x)); }
};
template <class R>
struct Hash2 {
  [[gnu::always_inline]] static R eval(R x, R y) { return unit<R>(hash_of<R>(x, y)); }
};
template <class R>
struct Hash3 {
  [[gnu::always_inline]] static R eval(R x, R y, R z) { return unit<R>(hash_of<R>(x, y, z)); }
};
template <class R>
struct Hash4 {
  [[gnu::always_inline]] static R eval(R x, R y, R z, R t) {
    return unit<R>(hash_of<R>(x, y, z, t));
  }
};
template <class R>
struct Cells1 {
  [[gnu::always_inline]] static R eval(R x) { return unit<R>(cell_hash<R>(x)); }
};
template <class R>
struct Cells2 {
  [[gnu::always_inline]] static R eval(R x, R y) { return unit<R>(cell_hash<R>(x, y)); }
};
template <class R>
struct Cells3 {
  [[gnu::always_inline]] static R eval(R x, R y, R z) { return unit<R>(cell_hash<R>(x, y, z)); }
};
template <class R>
struct Cells4 {
  [[gnu::always_inline]] static R eval(R x, R y, R z, R t) {
    return unit<R>(cell_hash<R>(x, y, z, t));
  }
};

/// White and cell noise with a seed, over the axes K...
template <class R, class Axes>
struct CellCalls;
template <class R, std::size_t... K>
struct CellCalls<R, std::index_sequence<K...>> {
  static constexpr int N = sizeof...(K);
  [[gnu::always_inline]] static R hash(Each<K, R>... p, std::int32_t seed) {
    Bits h = start_of(seed) ^ Bits(N);
    ((h = mix(h, bits_of(float(p)))), ...);
    return unit<R>(finish(h));
  }
  [[gnu::always_inline]] static R cell(Each<K, R>... p, std::int32_t seed, Each<K, R>... period) {
    const Tiled<R, N> where = tiled<R, N>(seed, {period...}, 1);
    Bits h = where.start();
    ((h = mix(h, lattice(where.wrapped(K, floor_of(p))))), ...);
    return unit<R>(finish(h));
  }
};

/// The nearest two of the random points: squared distances, and the ways from them.
template <class R, int N>
struct Nearest {
  R first = kInf<R>, second = kInf<R>;
  R offset[N] = {}, second_offset[N] = {};
  Bits id = 0;
};

/// Looks at the cells around on axes K .. N-1. `d` is the way from the corner of the cell that is
/// looked at.
template <int K, class R, int N>
MMS_INLINE void look(const Bits (&cell)[N], const R (&position)[N], Bits h, R (&d)[N],
                     Nearest<R, N>& best) {
  if constexpr (K == N) {
    // One random number for each axis from one hash.
    Bits point = finish(h);
    R way[N], squared = 0;
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) {
      way[k] = d[k] - unit<R>(point);
      squared = fused(way[k], way[k], squared);
      point *= 0xc2b2ae3du;
      point ^= point >> 15;
    }
    const bool nearer = squared < best.first;
    const R rest = nearer ? best.first : squared;
    const bool second = rest < best.second;
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) {
      const R rest_way = nearer ? best.offset[k] : way[k];
      best.second_offset[k] = second ? rest_way : best.second_offset[k];
    }
    best.second = second ? rest : best.second;
    best.first = nearer ? squared : best.first;
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) best.offset[k] = nearer ? way[k] : best.offset[k];
    best.id = nearer ? point : best.id;
  } else {
#pragma GCC unroll 4
    for (int i = -1; i <= 1; ++i) {
      d[K] = position[K] - R(i);
      look<K + 1>(cell, position, mix(h, cell[K] + Bits(i)), d, best);
    }
  }
}

template <class R, int N>
MMS_INLINE Nearest<R, N> nearest(const R (&p)[N]) {
  Bits cell[N];
  R position[N], d[N];
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) {
    const R f = floor_of(p[k]);
    cell[k] = lattice(f);
    position[k] = p[k] - f;
  }
  Nearest<R, N> best;
  look<0>(cell, position, kSeed, d, best);
  return best;
}

template <class R>
struct Worley2 {
  [[gnu::always_inline]] static R eval(R x, R y) { return root(nearest<R, 2>({x, y}).first); }
};
template <class R>
struct Worley3 {
  [[gnu::always_inline]] static R eval(R x, R y, R z) {
    return root(nearest<R, 3>({x, y, z}).first);
  }
};
template <class R>
struct WorleyPair2 {
  [[gnu::always_inline]] static std::array<R, 2> eval(R x, R y) {
    const auto n = nearest<R, 2>({x, y});
    return {root(n.first), root(n.second)};
  }
};
template <class R>
struct WorleyPair3 {
  [[gnu::always_inline]] static std::array<R, 2> eval(R x, R y, R z) {
    const auto n = nearest<R, 3>({x, y, z});
    return {root(n.first), root(n.second)};
  }
};
template <class R>
struct WorleyGradient2 {
  [[gnu::always_inline]] static std::array<R, 2> eval(R x, R y) {
    const auto n = nearest<R, 2>({x, y});
    const R s = n.first > 0 ? 1 / root(n.first) : R(0);
    return {n.offset[0] * s, n.offset[1] * s};
  }
};
template <class R>
struct WorleyGradient3 {
  [[gnu::always_inline]] static std::array<R, 3> eval(R x, R y, R z) {
    const auto n = nearest<R, 3>({x, y, z});
    const R s = n.first > 0 ? 1 / root(n.first) : R(0);
    return {n.offset[0] * s, n.offset[1] * s, n.offset[2] * s};
  }
};
template <class R>
struct WorleySecondGradient2 {
  [[gnu::always_inline]] static std::array<R, 2> eval(R x, R y) {
    const auto n = nearest<R, 2>({x, y});
    const R s = 1 / root(n.second);
    return {n.second_offset[0] * s, n.second_offset[1] * s};
  }
};
template <class R>
struct WorleySecondGradient3 {
  [[gnu::always_inline]] static std::array<R, 3> eval(R x, R y, R z) {
    const auto n = nearest<R, 3>({x, y, z});
    const R s = 1 / root(n.second);
    return {n.second_offset[0] * s, n.second_offset[1] * s, n.second_offset[2] * s};
  }
};
template <class R>
struct Voronoi2 {
  [[gnu::always_inline]] static R eval(R x, R y) {
    return unit<R>(finish(nearest<R, 2>({x, y}).id));
  }
};
template <class R>
struct Voronoi3 {
  [[gnu::always_inline]] static R eval(R x, R y, R z) {
    return unit<R>(finish(nearest<R, 3>({x, y, z}).id));
  }
};

}  // namespace mms::stdlib::MMS_ISA
