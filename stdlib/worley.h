// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// Cellular noise (Worley 1996) in its general form: the three nearest of random points, one in
/// each unit cell, by any of Minkowski's distances, with jitter, seed and periods; and the
/// neighbour across the nearest border of the Voronoi cells.
///
/// Two cells on either side are searched along each axis (in 4 dimensions two along one axis at a
/// time), so that what is found is nearest, but for points farther away than 2 (there 1.4): that
/// hardly happens. The search goes cell by cell over a few lanes, for it is too long to be unrolled
/// as other kernels are. Hashes as in cells.h, so that with jitter 1 these are its points.

#include "stdlib/lattice.h"

namespace mms::stdlib::MMS_ISA {

/// For choosing among points: good to a few roundings of numbers near one.
MMS_INLINE float rough_log2(float x) { return log2_float(x); }
MMS_INLINE double rough_log2(double x) { return __builtin_log2(x); }
MMS_INLINE float rough_exp2(float x) { return exp2_float(x); }
MMS_INLINE double rough_exp2(double x) { return __builtin_exp2(x); }

/// What a power by `exponent` of Minkowski's distance is, over that of the largest part. By
/// themselves powers leave the range of float where exponents are large.
template <class R, int N>
MMS_INLINE R powers_over(R largest, const R (&way)[N], R exponent) {
  const R least = R(0x1p-60) * largest;  // nothing beside it; also for a way that is no number
  R powers = 0;
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) {
    const R size = magnitude(way[k]);
    powers += rough_exp2(exponent * rough_log2((size > least ? size : least) / largest));
  }
  return powers;
}

/// Exponents of Minkowski's distances beyond this one count as infinite.
inline constexpr float kMostExponent = 64;

/// Which distances a few lanes ask for.
enum class Metrics { Euclidean, Simple, Any };

/// A comparison of distances by `exponent`: grows with the distance.
template <Metrics metrics, class R, int N>
MMS_INLINE R distance_key(const R (&way)[N], R exponent) {
  R squares = 0, sum = 0, largest = 0;
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) {
    const R size = magnitude(way[k]);
    squares = fused(way[k], way[k], squares);
    sum += size;
    largest = size > largest ? size : largest;
  }
  if constexpr (metrics == Metrics::Euclidean) return squares;
  R other = 0;
  if constexpr (metrics == Metrics::Any) {  // the binary logarithm of the distance
    R some = R(0x1p-100);
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) some = magnitude(way[k]) > some ? magnitude(way[k]) : some;
    other = rough_log2(some) + rough_log2(powers_over(some, way, exponent)) / exponent;
  }
  const R key = exponent == 1 ? sum : exponent > R(kMostExponent) ? largest : other;
  return exponent == 2 ? squares : key;
}

/// A search for the points around a few lanes.
template <class R, int N>
struct WorleySearch {
  static constexpr int kLanes = vm::kLaneMultiple, kSides = 5, kFound = 3;
  using Reals = R[kLanes];
  using Hashes = Bits[kLanes];

  alignas(64) Reals position[N];  ///< in the cell
  Reals floors[N], periods[N];    ///< of the cell, within the periods
  Hashes side[N][kSides];         ///< lattice coordinates around
  Hashes start;                   ///< of the seed
  Reals jitter, exponent;
  Reals best[kFound];                  ///< keys of the nearest, in order
  std::int32_t index[kFound][kLanes];  ///< whose cells they are in: 3 bits an axis

  /// Lattice coordinate of the cell `by` cells above on axis k.
  MMS_INLINE Bits coordinate(int k, int l, R by) const {
    Tiled<R, 1> where;
    where.period[0] = periods[k][l];
    return lattice(where.wrapped(0, floors[k][l] + by));
  }

  /// From the arguments (p, seed, period, jitter, exponent), the last where it is one.
  MMS_INLINE void load(const void* const* in, int first, bool has_exponent) {
    const auto real = [&](int k, int l) { return static_cast<const R*>(in[k])[first + l]; };
    for (int k = 0; k < N; ++k) {
#pragma GCC ivdep
      for (int l = 0; l < kLanes; ++l) {
        const R x = real(k, l), f = floor_of(x);
        position[k][l] = x - f;
        periods[k][l] = whole_period(real(N + 1 + k, l), R(1));
        Tiled<R, 1> where;
        where.period[0] = periods[k][l];
        floors[k][l] = where.wrapped(0, f);
      }
      for (int i = 0; i < kSides; ++i) {
#pragma GCC ivdep
        for (int l = 0; l < kLanes; ++l) side[k][i][l] = coordinate(k, l, R(i - 2));
      }
    }
    for (int l = 0; l < kLanes; ++l) {
      start[l] = start_of(static_cast<const std::int32_t*>(in[N])[first + l]);
      jitter[l] = real(2 * N + 1, l);
      const R e = has_exponent ? real(2 * N + 2, l) : R(2);
      exponent[l] = e > 1 ? e : R(1);
      for (int j = 0; j < kFound; ++j) best[j][l] = kInf<R>, index[j][l] = 0;
    }
  }

  MMS_INLINE Metrics metrics() const {
    bool euclidean = true, simple = true;
    for (int l = 0; l < kLanes; ++l) {
      const R e = exponent[l];
      euclidean &= e == 2;
      simple &= (e == 2) | (e == 1) | (e > R(kMostExponent));
    }
    return euclidean ? Metrics::Euclidean : simple ? Metrics::Simple : Metrics::Any;
  }

  /// What jitter moves the point with that finished hash by, times it.
  MMS_INLINE static void shifts(Bits point, R (&shift)[N]) {
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) {
      shift[k] = unit<R>(point) - R(0.5);
      point *= 0xc2b2ae3du;
      point ^= point >> 15;
    }
  }

  /// Calls `see(l, cell, shift, way)` for all lanes and cells on axes K .. N-1; `cell` is as
  /// `index`, `way` leads from the cell's point, which has that shift, to the lane's; `at` to its
  /// middle.
  template <int K, class See>
  MMS_INLINE void visit(const Hashes& h, int cell, int far, R (&at)[N], See see) const {
    for (int i = 0; i < kSides; ++i) {
      const bool beyond = i == 0 || i == kSides - 1;
      if (N == 4 && beyond && far > 0) continue;
      at[K] = R(i - 2) + R(0.5);
      const int here = cell | i << (3 * K);
      if constexpr (K + 1 < N) {
        Hashes next;
#pragma GCC ivdep
        for (int l = 0; l < kLanes; ++l) next[l] = mix(h[l], side[K][i][l]);
        visit<K + 1>(next, here, far + beyond, at, see);
      } else {
#pragma GCC ivdep
        for (int l = 0; l < kLanes; ++l) {
          R shift[N], way[N];
          shifts(finish(mix(h[l], side[K][i][l])), shift);
#pragma GCC unroll 4
          for (int k = 0; k < N; ++k) way[k] = fused(-jitter[l], shift[k], position[k][l] - at[k]);
          see(l, here, shift, way);
        }
      }
    }
  }

  template <Metrics metrics>
  [[gnu::noinline]] void find_by() {
    R at[N];
    visit<0>(
        start, 0, 0, at,
        [this](int l, int cell, const R(&)[N], const R(&way)[N]) __attribute__((always_inline)) {
          const R key = distance_key<metrics>(way, exponent[l]);
          const R a = best[0][l], b = best[1][l], c = best[2][l];
          const std::int32_t i = index[0][l], j = index[1][l], k = index[2][l];
          const bool first = key < a, second = key < b, third = key < c;
          best[0][l] = first ? key : a;
          best[1][l] = first ? a : second ? key : b;
          best[2][l] = second ? b : third ? key : c;
          index[0][l] = first ? cell : i;
          index[1][l] = first ? i : second ? cell : j;
          index[2][l] = second ? j : third ? cell : k;
        });
  }
  MMS_INLINE void find() {
    const Metrics m = metrics();
    if (m == Metrics::Euclidean)
      find_by<Metrics::Euclidean>();
    else if (m == Metrics::Simple)
      find_by<Metrics::Simple>();
    else
      find_by<Metrics::Any>();
  }

  /// Where the middle of the cell of that index is on axis k.
  MMS_INLINE static R middle_of(std::int32_t cell, int k) {
    return R((cell >> (3 * k) & 7) - 2) + R(0.5);
  }

  /// Hash of the point that was found in the cell of that index, and the way from the cell's
  /// middle.
  MMS_INLINE Bits found(std::int32_t cell, int l, R (&middle)[N]) const {
    Bits h = start[l];
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) {
      h = mix(h, coordinate(k, l, middle_of(cell, k) - R(0.5)));
      middle[k] = position[k][l] - middle_of(cell, k);
    }
    return finish(h);
  }

  /// The way from the j-th point that was found, its shift, and its hash.
  MMS_INLINE Bits way_of(int j, int l, R (&shift)[N], R (&way)[N]) const {
    R middle[N];
    const Bits h = found(index[j][l], l, middle);
    shifts(h, shift);
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) way[k] = fused(-jitter[l], shift[k], middle[k]);
    return h;
  }

  /// Puts the neighbour across the nearest border of the nearest point's cell into index[1]. Steps
  /// between points are of their shifts, whose differences are exact: those of points that are near
  /// each other would be lost in the ways.
  [[gnu::noinline]] void find_border() {
    find_by<Metrics::Euclidean>();
    Reals nearest[N], nearest_shift[N], cell_of[N];
    for (int l = 0; l < kLanes; ++l) {
      R shift[N], way[N];
      way_of(0, l, shift, way);
      for (int k = 0; k < N; ++k) {
        nearest[k][l] = way[k];
        nearest_shift[k][l] = shift[k];
        cell_of[k][l] = middle_of(index[0][l], k);
      }
      best[1][l] = kInf<R>;
    }
    R at[N];
    visit<0>(
        start, 0, 0, at,
        [&](int l, int cell, const R(&shift)[N], const R(&way)[N]) __attribute__((always_inline)) {
          R apart = 0,
            along = 0;  // of the two points; twice the distance to the border, times that
#pragma GCC unroll 4
          for (int k = 0; k < N; ++k) {
            const R step = fused(-jitter[l], shift[k] - nearest_shift[k][l], cell_of[k][l] - at[k]);
            apart = fused(step, step, apart);
            along = fused(step, way[k] + nearest[k][l], along);
          }
          const R key = along / root(apart), b = best[1][l];
          const std::int32_t j = index[1][l];
          const bool nearer = (cell != index[0][l]) & (key < b);
          best[1][l] = nearer ? key : b;
          index[1][l] = nearer ? cell : j;
        });
  }
};

/// What a row gives of the points found.
enum class WorleyPart { Ways, Shifts, Number, Distances, Squares };

template <class R, int N>
MMS_INLINE R square_of(const R (&way)[N]) {
  R sum = 0;
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) sum += way[k] * way[k];
  return sum;
}

/// Minkowski's distance, in the order of `minkowski` (worley.mms) where that takes no powers.
template <Metrics metrics, class R, int N>
MMS_INLINE R distance_of(const R (&way)[N], R exponent) {
  R sum = 0, largest = 0;
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) {
    const R size = magnitude(way[k]);
    sum += size;
    largest = size > largest ? size : largest;
  }
  R other = largest;
  if constexpr (metrics == Metrics::Any) {
    const R powers = powers_over(largest, way, exponent);
    const R all = largest * rough_exp2(rough_log2(powers) / exponent);
    other = (largest > 0) & !(exponent > R(kMostExponent)) ? all : largest;
  }
  const R simple = exponent == 1 ? sum : other;
  return exponent == 2 ? root(square_of(way)) : simple;
}

/// The kernel of a row: N ways (or shifts) of each of the points, what is made of them, or the
/// nearest one's number.
template <class R, int N, WorleyPart part, bool border>
inline void worley_kernel(const void* const* in, void* const* out, int lanes) {
  using Search = WorleySearch<R, N>;
  constexpr int points = part == WorleyPart::Number ? 1 : border ? 2 : 3;
  Search s;
  for (int first = 0; first < lanes; first += Search::kLanes) {
    s.load(in, first, !border);
    if constexpr (border)
      s.find_border();
    else
      s.find();
    [[maybe_unused]] const bool any = s.metrics() == Metrics::Any;
    for (int j = 0; j < points; ++j) {
#pragma GCC ivdep
      for (int l = 0; l < Search::kLanes; ++l) {
        const auto put = [ out, at = first + l ](int k, R value) __attribute__((always_inline)) {
          static_cast<R*>(out[k])[at] = value;
        };
        R shift[N], way[N];
        const Bits h = s.way_of(j, l, shift, way);
        if constexpr (part == WorleyPart::Number) {
          put(0, unit<R>(finish(h ^ kSeed)));
        } else if constexpr (part == WorleyPart::Squares) {
          put(j, square_of(way));
        } else if constexpr (part == WorleyPart::Distances) {
          const R exponent = s.exponent[l];
          put(j, any ? distance_of<Metrics::Any>(way, exponent)
                     : distance_of<Metrics::Simple>(way, exponent));
        } else {
#pragma GCC unroll 4
          for (int k = 0; k < N; ++k)
            put(j * N + k, part == WorleyPart::Shifts ? shift[k] : way[k]);
        }
      }
    }
  }
}

/// The kernel of the distance to the border.
template <class R, int N>
inline void worley_edge_kernel(const void* const* in, void* const* out, int lanes) {
  using Search = WorleySearch<R, N>;
  Search s;
  for (int first = 0; first < lanes; first += Search::kLanes) {
    s.load(in, first, false);
    s.find_border();
    for (int l = 0; l < Search::kLanes; ++l) {
      // Infinite: nothing was found, for places are no numbers.
      const R edge = R(0.5) * s.best[1][l];
      const R number = edge < kInf<R> ? edge : kNan<R>;
      static_cast<R*>(out[0])[first + l] = edge < 0 ? R(0) : number;
    }
  }
}

}  // namespace mms::stdlib::MMS_ISA
