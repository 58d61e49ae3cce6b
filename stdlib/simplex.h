// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// Simplex noise (Perlin 2001), with its exact derivatives: random slopes at the vertices of
/// simplices, each faded out by the fourth power of a paraboloid before the next simplices but one.
///
/// Cubes are skewed along their diagonal by 1/3, which in space makes the simplices what they are
/// in Perlin's paper and in the plane and in 4 dimensions nearly so; for then the lattice repeats
/// along every axis after 3 cells, and the place in a cell is found from floor(x) without loss far
/// from the origin. Beyond 2^29 cells the lattice no longer varies.

#include "stdlib/lattice.h"

namespace mms::stdlib::MMS_ISA {

/// Squared radius of a vertex' influence: at most the squared distance to the far faces of its
/// simplices, 1/2 between two inner vertices and 1 / (1 + 2 F + N F^2) from the first or last one,
/// where F = 1/3 is the skew.
template <class R, int N>
inline constexpr R kReach2 = N == 1   ? R(1)
                             : N == 4 ? R(9.0 / 19)
                                      : R(0.5);

// Range: |noise| is at most the sum over the vertices of (reach^2 - d^2)^4 m(d), m as for
// kPerlinScale. The scales are the reciprocals of the largest sums, less 2.5e-6 or more, for
// rounding (tests recompute them).
template <class R, int N>
inline constexpr R kSimplexScale = R(N == 1   ? 3.160481
                                     : N == 2 ? 94.80502
                                     : N == 3 ? 76.88044
                                              : 80.06626);

/// No component of the gradient is larger: the sum over N + 1 vertices of the largest of
/// |g| (m^4 + 8 m^3 d^2), which is 1.2596 |g| reach^8 at d^2 = reach^2 / 7, and a hundredth.
template <int N>
inline constexpr double kSimplexSlope = N == 1   ? 8.1
                                        : N == 2 ? 24.6
                                        : N == 3 ? 34.7
                                                 : 44.5;

/// No second derivative along any direction is larger: of a vertex' part it is at most |g| (48 m^2
/// d^3 + 24 m^3 d), which is below 8.45 |g| reach^7, at d = 0.51 reach; `root_of_reach2` is reach.
template <int N>
constexpr double simplex_bend(double root_of_reach2) {
  return kSimplexSlope<N> * (8.45 / 1.2596) / root_of_reach2;
}

/// The simplex that holds a point.
template <class R, int N>
struct SimplexCell {
  static constexpr int kSkew = N == 1 ? 0 : 1;                  ///< in thirds
  static constexpr R kBack = N == 1 ? R(0) : R(1.0 / (N + 3));  ///< unskews a sum
  Bits base[N];  ///< skewed lattice coordinates of the first vertex
  R offset[N];   ///< of the point from it
  int rank[N];   ///< how many axes come after this one on the way to the last vertex

  /// The lattice coordinates of vertex c of 0 .. N, and the offset of the point from it.
  MMS_INLINE void vertex(int c, Bits (&i)[N], R (&d)[N]) const {
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) {
      const bool on = rank[k] >= N - c;
      i[k] = base[k] + Bits(on);
      d[k] = offset[k] - (on ? R(1) : R(0)) + kBack * R(c);
    }
  }
};

template <class R, int N, class Where>
MMS_INLINE SimplexCell<R, N> simplex_at(const R (&p)[N], const Where& where) {
  using S = SimplexCell<R, N>;
  S s;
  R t[N], sum = 0;
  Bits total = 0;
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) {
    const R f = floor_of(p[k]), wrapped = where.wrapped(k, f);
    t[k] = p[k] - f;
    sum += t[k];
    s.base[k] = lattice(magnitude(wrapped) < R(0x1p29) ? wrapped : R(0));
    total += s.base[k];
  }
  // A third of the sum of whole coordinates is whole but for `rest`.
  const std::int32_t quotient = std::int32_t(total) / 3, left = std::int32_t(total) - 3 * quotient;
  const std::int32_t third = S::kSkew * (left < 0 ? quotient - 1 : quotient);
  const R rest = R(S::kSkew * (left < 0 ? left + 3 : left));
  const R shift = (S::kSkew * sum + rest) * R(1.0 / 3);
  R skewed = 0;
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) {
    const R h = t[k] + shift, f = floor_of(h);
    s.base[k] += Bits(third) + lattice(f);
    s.offset[k] = h - f;
    skewed += s.offset[k];
  }
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) {
    s.rank[k] = 0;
#pragma GCC unroll 4
    for (int j = 0; j < N; ++j)
      if (j != k) s.rank[k] += s.offset[k] > s.offset[j] || (s.offset[k] == s.offset[j] && k < j);
  }
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) s.offset[k] -= S::kBack * skewed;
  return s;
}

/// Hash of a vertex, the same for those that are a period apart.
template <int N>
MMS_INLINE Bits vertex_hash(const Bits (&i)[N], const Endless& where) {
  Bits h = where.start();
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) h = mix(h, i[k]);
  return finish(h);
}
template <class R, int N>
MMS_INLINE Bits vertex_hash(const Bits (&i)[N], const Tiled<R, N>& where) {
  // The vertex lies at i - (sum of i) / (N + 3), and at most a cell outside the periods; one period
  // along an axis is a third of it along all in the skewed lattice, and itself along that axis.
  constexpr int each = N == 1 ? 1 : N + 3;
  Bits total = 0, moved[N], all = 0;
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) total += i[k];
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) {
    const std::int32_t at = std::int32_t(each * i[k] - (N == 1 ? 0 : total));
    const Bits period = Bits(std::int32_t(where.period[k]));
    const Bits by = at < 0 ? period : at >= std::int32_t(each * period) ? 0 - period : Bits(0);
    moved[k] = i[k] + by;
    all += N == 1 ? 0 : Bits(std::int32_t(by) / 3);
  }
  Bits h = where.start();
#pragma GCC unroll 4
  for (int k = 0; k < N; ++k) h = mix(h, moved[k] + all);
  return finish(h);
}

/// How the derivative of that order along one axis of F(reach^2 - d^2) is made of the derivatives
/// of F: `part[j]` times the j-th. Those from the fifth on are 0 for a fourth power.
template <class R>
struct RadialDerivative {
  R part[5];
};
/// By d^(a+1) F = -2 (d d^a + a d^(a-1)) F', which is how Hermite polynomials come about.
template <class R>
MMS_INLINE RadialDerivative<R> radial_derivative(R d, std::int32_t order) {
  RadialDerivative<R> last = {}, now = {{R(1), R(0), R(0), R(0), R(0)}};
  for (std::int32_t a = 0; a < order && a < 9; ++a) {
    RadialDerivative<R> next = {};
    for (int j = 1; j < 5; ++j)
      next.part[j] = -2 * fused(d, now.part[j - 1], R(a) * last.part[j - 1]);
    last = now;
    now = next;
  }
  return now;
}
/// The derivative of order[k] along each axis of (reach^2 - d^2)^4, the difference being m >= 0.
template <class R, int N>
MMS_INLINE R fade_derivative(const R (&d)[N], R m, const std::int32_t (&order)[N]) {
  R product[5] = {R(1)};
  for (int k = 0; k < N; ++k) {
    const RadialDerivative<R> axis = radial_derivative(d[k], order[k]);
    for (int j = 4; j >= 0; --j) {
      R sum = 0;
      for (int i = 0; i <= j; ++i) sum = fused(product[i], axis.part[j - i], sum);
      product[j] = sum;
    }
  }
  const R m2 = m * m;
  const R power[5] = {m2 * m2, 4 * m2 * m, 12 * m2, 24 * m, R(24)};
  R sum = 0;
  for (int j = 0; j < 5; ++j) sum = fused(product[j], power[j], sum);
  return sum;
}

struct Simplex {
  /// Periods are whole multiples of it.
  template <int N>
  static constexpr int kStep = N == 1 ? 1 : 3;

  template <class R, int N, class Where>
  MMS_INLINE static Jet<R, N> jet(const R (&p)[N], const Where& where) {
    const SimplexCell<R, N> cell = simplex_at(p, where);
    Jet<R, N> r = {};
#pragma GCC unroll 5
    for (int c = 0; c <= N; ++c) {
      Bits i[N];
      R d[N], g[N], m = kReach2<R, N>, slope = 0;
      cell.vertex(c, i, d);
      corner_vector(vertex_hash(i, where), g);
#pragma GCC unroll 4
      for (int k = 0; k < N; ++k) {
        m = fused(-d[k], d[k], m);
        slope = fused(g[k], d[k], slope);
      }
      m = m > 0 ? m : R(0);
      const R m2 = m * m, m4 = m2 * m2, fall = -8 * (m2 * m) * slope;
      r.value = fused(m4, slope, r.value);
#pragma GCC unroll 4
      for (int k = 0; k < N; ++k) r.gradient[k] = fused(m4, g[k], fused(fall, d[k], r.gradient[k]));
    }
    r.value *= kSimplexScale<R, N>;
#pragma GCC unroll 4
    for (int k = 0; k < N; ++k) r.gradient[k] *= kSimplexScale<R, N>;
    return r;
  }

  /// Not for speed: lane by lane, in loops.
  template <class R, int N, class Where>
  [[gnu::noinline]] static R mixed(const R (&p)[N], const Where& where,
                                   const std::int32_t (&order)[N]) {
    const SimplexCell<R, N> cell = simplex_at(p, where);
    R sum = 0;
    for (int c = 0; c <= N; ++c) {
      Bits i[N];
      R d[N], g[N], m = kReach2<R, N>, slope = 0;
      cell.vertex(c, i, d);
      corner_vector(vertex_hash(i, where), g);
      for (int k = 0; k < N; ++k) {
        m = fused(-d[k], d[k], m);
        slope = fused(g[k], d[k], slope);
      }
      if (!(m > 0)) continue;
      // Leibniz' rule with a factor that is linear.
      sum = fused(slope, fade_derivative(d, m, order), sum);
      for (int k = 0; k < N; ++k) {
        if (order[k] <= 0) continue;
        std::int32_t less[N];
        for (int j = 0; j < N; ++j) less[j] = order[j] - (j == k);
        sum = fused(R(order[k]) * g[k], fade_derivative(d, m, less), sum);
      }
    }
    return sum * kSimplexScale<R, N>;
  }
};

}  // namespace mms::stdlib::MMS_ISA
