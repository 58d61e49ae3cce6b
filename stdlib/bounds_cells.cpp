// SPDX-License-Identifier: Apache-2.0
// Enclosures of white and cellular noise. Distances to random points change no faster than the
// point moves.
#include <array>

#include "stdlib/bounds.h"
#include "stdlib/bounds_lattice.h"

#define MMS_ISA lattice_cells
#include "stdlib/cells.h"
#include "stdlib/worley.h"

namespace mms::stdlib::bounds {

namespace {

/// What the float kernels may miss the exact value by, absolutely; tests measure a tenth of it.
constexpr double kDistanceError = 0x1p-18;

template <int N, class Value>
void cells(const Interval* in, Interval* out, Value value) {
  Interval r = Interval::empty();
  out[0].nan = false;
  for (int k = 0; k < N; ++k)
    if (in[k].nan) return;  // which is in some cell
  if (each_cell<N>(in, [&](const double(&floors)[N], const Range(&)[N]) {
        r = join(r, Interval::point(value(floors)));
      }))
    out[0] = r;
}

/// Cell noise of a seed and periods, where those are certain.
template <int N, std::size_t... K>
void cells_of(const Interval* in, Interval* out, std::index_sequence<K...>) {
  using Calls = lattice_cells::CellCalls<double, std::index_sequence<K...>>;
  out[0].nan = false;
  for (int k = N; k <= 2 * N; ++k)
    if (!in[k].is_point()) return;
  const auto seed = static_cast<std::int32_t>(in[N].lo);
  cells<N>(in, out,
           [&](const double(&x)[N]) { return Calls::cell(x[K]..., seed, in[N + 1 + K].lo...); });
}

/// White noise is known at points only.
template <int N, class Value>
void hash(const Interval* in, Interval* out, Value value) {
  double x[N];
  out[0].nan = false;
  for (int k = 0; k < N; ++k) {
    if (!in[k].is_point()) return;
    x[k] = in[k].lo;
  }
  out[0] = Interval::point(value(x));
}

template <int N, std::size_t... K>
void hash_of(const Interval* in, Interval* out, std::index_sequence<K...>) {
  using Calls = lattice_cells::CellCalls<double, std::index_sequence<K...>>;
  out[0].nan = false;
  if (!in[N].is_point()) return;
  const auto seed = static_cast<std::int32_t>(in[N].lo);
  hash<N>(in, out, [&](const double(&x)[N]) { return Calls::hash(x[K]..., seed); });
}

/// Distances found at the centre move by at most the radius of the box. What is found is the
/// nearest point as long as that is within 1, the width of a cell; else it may be farther.
template <int N>
void worley(const Interval* in, Interval* out, int distances) {
  // A point in the cell itself, and one in the next cell on the nearer side.
  const double farthest[] = {std::sqrt(double(N)), std::sqrt(1.25 + N)};
  double centre[N], radius2 = 0;
  bool known = finite(in, N), beyond = false;
  for (int k = 0; k < N; ++k) {
    known &= !in[k].nan;
    beyond |= !(in[k].magnitude() < 0x1p30);
    centre[k] = 0.5 * (in[k].lo + in[k].hi);
    const double half = 0.5 * (in[k].hi - in[k].lo);
    radius2 += half * half;
  }
  for (int k = 0; k < distances; ++k) out[k].nan = false;
  if (!known) return;  // infinite where a coordinate is not a number
  for (int k = 0; k < distances; ++k) out[k] = {0, farthest[k] + kDistanceError, false};
  if (beyond || radius2 > N) return;
  const auto found = lattice_cells::nearest<double, N>(centre);
  const double radius = std::sqrt(radius2),
               at[] = {std::sqrt(found.first), std::sqrt(found.second)};
  for (int k = 0; k < distances; ++k) {
    out[k].lo = std::max(0.0, std::min(at[k], 1.0) - radius - kDistanceError);
    if (at[k] + radius <= 1) out[k].hi = at[k] + radius + kDistanceError;
  }
}

/// A way between a point and the middle of a cell that was searched is at most 2.5 along each axis.
template <int N>
void worley_found(const Interval* in, Interval* out, int points) {
  const Interval& jitter = in[2 * N + 1];
  const double most = (2.5 + 0.5 * jitter.magnitude()) * (1 + 0x1p-20);
  const bool number = finite(in, N) && !jitter.contains_infinity();
  for (int k = 0; k < points * N; ++k) out[k] = {-most, most, !number};
}

double minkowski(const double* way, int n, double exponent) {
  double sum = 0, most = 0;
  for (int k = 0; k < n; ++k) {
    most = std::max(most, std::fabs(way[k]));
    sum += std::pow(std::fabs(way[k]), std::max(exponent, 1.0));
  }
  return exponent > lattice_cells::kMostExponent ? most
                                                 : std::pow(sum, 1 / std::max(exponent, 1.0));
}

/// The ways from the three points that are nearest to `p`, by the kernel.
template <int N>
std::array<double, 3 * N> ways_at(const double (&p)[N], const Interval* in) {
  constexpr int kLanes = vm::kLaneMultiple;
  alignas(64) double reals[2 * N + 3][kLanes];
  alignas(64) std::int32_t seed[kLanes];
  alignas(64) double results[3 * N][kLanes];
  const void* from[2 * N + 3];
  void* to[3 * N];
  std::fill_n(seed, kLanes, static_cast<std::int32_t>(in[N].lo));
  for (int k = 0; k < 2 * N + 3; ++k) {
    std::fill_n(reals[k], kLanes, k < N ? p[k] : in[k].lo);
    from[k] = k == N ? static_cast<const void*>(seed) : reals[k];
  }
  for (int k = 0; k < 3 * N; ++k) to[k] = results[k];
  using lattice_cells::WorleyPart;
  lattice_cells::worley_kernel<double, N, WorleyPart::Ways, false>(from, to, kLanes);
  std::array<double, 3 * N> ways;
  for (int k = 0; k < 3 * N; ++k) ways[k] = results[k][0];
  return ways;
}

/// A way from a point that is the nearest one all over the box moves as p does; so do those of two
/// points that may change places. What is farther than 2 may not have been found.
template <int N>
void worley_ways(const Interval* in, Interval* out) {
  worley_found<N>(in, out, 3);
  double centre[N], half[N], move = 0;  // by Manhattan's distance, which is the largest
  for (int k = 0; k < N; ++k) {
    if (in[k].nan || !(in[k].magnitude() < 0x1p30)) return;
    centre[k] = 0.5 * (in[k].lo + in[k].hi);
    half[k] = std::max(in[k].hi - centre[k], centre[k] - in[k].lo);
    move += half[k];
  }
  for (int k = N; k < 2 * N + 3; ++k)
    if (!in[k].is_point()) return;
  if (move > 1 || in[2 * N + 1].magnitude() > 1) return;
  const auto ways = ways_at(centre, in);
  double d[3];
  for (int j = 0; j < 3; ++j)
    d[j] = std::min(minkowski(&ways[std::size_t(j * N)], N, in[2 * N + 2].lo), 2.0);
  const double enough = 2 * move + 1e-3;  // kernels compare powers that are not exact
  const bool first = d[1] - d[0] > enough, second = d[2] - d[1] > enough;
  for (int k = 0; k < N; ++k) {
    const auto moved = [&](double a, double b) {
      const double slack = half[k] + kDistanceError;
      return Interval{std::min(a, b) - slack, std::max(a, b) + slack, false};
    };
    const double a = ways[std::size_t(k)], b = ways[std::size_t(N + k)];
    if (first || second) out[k] = first ? moved(a, a) : moved(a, b);
    if (second) out[N + k] = first ? moved(b, b) : moved(a, b);
  }
}

}  // namespace

// A functor over one value type at N coordinates.
#define MMS_AT(N, Functor, ...) \
  [](const double(&x)[N]) { return lattice_cells::Functor<double>::eval(__VA_ARGS__); }
void hash1(const Interval* in, Interval* out) { hash<1>(in, out, MMS_AT(1, Hash1, x[0])); }
void hash2(const Interval* in, Interval* out) { hash<2>(in, out, MMS_AT(2, Hash2, x[0], x[1])); }
void hash3(const Interval* in, Interval* out) {
  hash<3>(in, out, MMS_AT(3, Hash3, x[0], x[1], x[2]));
}
void hash4(const Interval* in, Interval* out) {
  hash<4>(in, out, MMS_AT(4, Hash4, x[0], x[1], x[2], x[3]));
}
void cells1(const Interval* in, Interval* out) { cells<1>(in, out, MMS_AT(1, Cells1, x[0])); }
void cells2(const Interval* in, Interval* out) { cells<2>(in, out, MMS_AT(2, Cells2, x[0], x[1])); }
void cells3(const Interval* in, Interval* out) {
  cells<3>(in, out, MMS_AT(3, Cells3, x[0], x[1], x[2]));
}
void cells4(const Interval* in, Interval* out) {
  cells<4>(in, out, MMS_AT(4, Cells4, x[0], x[1], x[2], x[3]));
}
#undef MMS_AT
template <int N>
void cells_of(const Interval* in, Interval* out) {
  cells_of<N>(in, out, std::make_index_sequence<N>());
}
template <int N>
void hash_of(const Interval* in, Interval* out) {
  hash_of<N>(in, out, std::make_index_sequence<N>());
}
void hash_of1(const Interval* in, Interval* out) { hash_of<1>(in, out); }
void hash_of2(const Interval* in, Interval* out) { hash_of<2>(in, out); }
void hash_of3(const Interval* in, Interval* out) { hash_of<3>(in, out); }
void hash_of4(const Interval* in, Interval* out) { hash_of<4>(in, out); }
void cells_of1(const Interval* in, Interval* out) { cells_of<1>(in, out); }
void cells_of2(const Interval* in, Interval* out) { cells_of<2>(in, out); }
void cells_of3(const Interval* in, Interval* out) { cells_of<3>(in, out); }
void cells_of4(const Interval* in, Interval* out) { cells_of<4>(in, out); }

void worley_ways1(const Interval* in, Interval* out) { worley_ways<1>(in, out); }
void worley_ways2(const Interval* in, Interval* out) { worley_ways<2>(in, out); }
void worley_ways3(const Interval* in, Interval* out) { worley_ways<3>(in, out); }
void worley_ways4(const Interval* in, Interval* out) { worley_found<4>(in, out, 3); }
void worley_border1(const Interval* in, Interval* out) { worley_found<1>(in, out, 2); }
void worley_border2(const Interval* in, Interval* out) { worley_found<2>(in, out, 2); }
void worley_border3(const Interval* in, Interval* out) { worley_found<3>(in, out, 2); }
void worley_border4(const Interval* in, Interval* out) { worley_found<4>(in, out, 2); }

void worley2(const Interval* in, Interval* out) { worley<2>(in, out, 1); }
void worley3(const Interval* in, Interval* out) { worley<3>(in, out, 1); }
void worley_pair2(const Interval* in, Interval* out) { worley<2>(in, out, 2); }
void worley_pair3(const Interval* in, Interval* out) { worley<3>(in, out, 2); }

}  // namespace mms::stdlib::bounds
