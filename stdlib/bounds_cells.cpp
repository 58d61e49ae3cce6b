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

using lattice_cells::WorleyPart;

/// What a kernel makes of `p` and the arguments behind it, `arguments` in all, which are points.
template <int N, int results>
std::array<double, results> worley_at(const double (&p)[N], const Interval* in, int arguments,
                                      vm::Kernel kernel) {
  constexpr int kLanes = vm::kLaneMultiple, kMost = 2 * N + 3;
  alignas(64) double reals[kMost][kLanes];
  alignas(64) std::int32_t seed[kLanes];
  alignas(64) double columns[results][kLanes];
  const void* from[kMost];
  void* to[results];
  std::fill_n(seed, kLanes, static_cast<std::int32_t>(in[N].lo));
  for (int k = 0; k < arguments; ++k) {
    std::fill_n(reals[k], kLanes, k < N ? p[k] : in[k].lo);
    from[k] = k == N ? static_cast<const void*>(seed) : reals[k];
  }
  for (int k = 0; k < results; ++k) to[k] = columns[k];
  kernel(from, to, kLanes);
  std::array<double, results> r;
  for (int k = 0; k < results; ++k) r[std::size_t(k)] = columns[k][0];
  return r;
}

/// The ways from the three points that are nearest to `p`.
template <int N>
std::array<double, 3 * N> ways_at(const double (&p)[N], const Interval* in) {
  return worley_at<N, 3 * N>(p, in, 2 * N + 3,
                             lattice_cells::worley_kernel<double, N, WorleyPart::Ways, false>);
}

/// A box of places whose other arguments are points.
template <int N>
struct WorleyBox {
  double centre[N], half[N];
  bool known = false;  ///< whether it is one, and jitter leaves points in their cells
  WorleyBox(const Interval* in, int arguments) {
    for (int k = 0; k < N; ++k) {
      if (in[k].nan || !(in[k].magnitude() < 0x1p30)) return;
      centre[k] = 0.5 * (in[k].lo + in[k].hi);
      half[k] = std::max(in[k].hi - centre[k], centre[k] - in[k].lo);
    }
    for (int k = N; k < arguments; ++k)
      if (!in[k].is_point()) return;
    known = in[2 * N + 1].magnitude() <= 1;
  }
};

/// How far a point surely is in whose cell nothing is looked for: 2 along an axis; in 4 dimensions
/// 1 along two of them.
double worley_reach(int n, double exponent) {
  if (n < 4) return 2;
  return exponent > lattice_cells::kMostExponent ? 1 : std::pow(2, 1 / std::max(exponent, 1.0));
}

/// Distances of the nearest three points by Minkowski. Let F be that of the k-th nearest of all,
/// and f of those that are looked for, cells around p: f >= F, and f = F where F is below the
/// reach. By the triangle inequality F(x) <= F(c) + |x - c|, for the k points that c has are that
/// near to x at most; so F and min(F, reach) change no faster than the place moves, by that metric.
/// Hence with r the length of half the box: f >= min(f(c), reach) - r, and f <= f(c) + r where that
/// is below the reach. Else f is at most as far as the points of these cells can be: in p's own,
/// then in those on the nearer side along an axis, then along another; in one dimension on the
/// other side.
template <int N>
void worley_lengths(const Interval* in, Interval* out) {
  const double least = std::max(in[2 * N + 2].lo, 1.0);  // exponent; distances shrink with it
  const bool number = finite(in, N) && !in[2 * N + 1].contains_infinity();
  const bool within = in[2 * N + 1].magnitude() <= 1;
  double corner[N], beyond[N];
  std::fill_n(corner, N, 1.0);
  std::fill_n(beyond, N, 1.0);
  beyond[0] = 1.5;
  const double far = N * (2.5 + 0.5 * in[2 * N + 1].magnitude()) * (1 + 0x1p-20);
  const double exponent = std::isnan(least) || in[2 * N + 2].nan ? 1 : least;
  const double second = minkowski(beyond, N, exponent);
  const double most[] = {minkowski(corner, N, exponent), second, N == 1 ? 2 : second};
  for (int j = 0; j < 3; ++j) out[j] = {0, within ? most[j] + kDistanceError : far, !number};
  const WorleyBox<N> box(in, 2 * N + 3);
  if (!box.known) return;
  const auto f =
      worley_at<N, 3>(box.centre, in, 2 * N + 3,
                      lattice_cells::worley_kernel<double, N, WorleyPart::Distances, false>);
  const double r = minkowski(box.half, N, exponent), reach = worley_reach(N, exponent);
  for (int j = 0; j < 3; ++j) {
    const double at = f[std::size_t(j)];
    out[j].lo = std::max(0.0, std::min(at, reach) - r - kDistanceError);
    if (at + r < reach) out[j].hi = std::min(out[j].hi, at + r + kDistanceError);
  }
}

/// Squares of Euclid's distances, where they are what is searched by.
template <int N>
void worley_squared(const Interval* in, Interval* out) {
  worley_lengths<N>(in, out);
  const bool euclidean = in[2 * N + 2] == Interval::point(2);
  for (int j = 0; j < 3; ++j) {
    // Another metric's lengths are at most N times as far apart.
    const double lo = euclidean ? out[j].lo : 0, hi = euclidean ? out[j].hi : N * out[j].hi;
    out[j] = {lo * lo, hi * hi, out[j].nan};
  }
}

/// The distance e to the nearest border between Voronoi cells is one to a set of points: it changes
/// no faster than the place moves. A neighbour across a border at e has its point within F1 + 2 e,
/// for the border's point is as far from it as from the nearest one; so what is found, e' >= e, is
/// e where F1 + 2 e' is below the reach, and e is at least (reach - F1) / 2 where it is not. And e'
/// is at most the mean of F1 and F2, for that is how far a border is on the way to a point, or
/// less.
template <int N>
void worley_edge(const Interval* in, Interval* out) {
  const bool number = finite(in, N) && in[2 * N + 1].magnitude() < 0x1p60;  // squares are numbers
  const double far = 2 * N * (2.5 + 0.5 * in[2 * N + 1].magnitude());
  const bool within = in[2 * N + 1].magnitude() <= 1;
  const double most = std::sqrt(1.25 + N) + kDistanceError;
  out[0] = {0, within ? most : far, !number};
  const WorleyBox<N> box(in, 2 * N + 2);
  if (!box.known) return;
  const auto ways = worley_at<N, 2 * N>(
      box.centre, in, 2 * N + 2, lattice_cells::worley_kernel<double, N, WorleyPart::Ways, true>);
  const auto e =
      worley_at<N, 1>(box.centre, in, 2 * N + 2, lattice_cells::worley_edge_kernel<double, N>)[0];
  const double f = minkowski(ways.data(), N, 2), reach = worley_reach(N, 2);
  const double r = minkowski(box.half, N, 2);
  // The nearest point is the right one all over the box.
  if (f + r < reach) out[0].lo = std::max(0.0, std::min(e, 0.5 * (reach - f)) - r - kDistanceError);
  if (f + 2 * e + 3 * r < reach) out[0].hi = std::min(most, e + r + kDistanceError);
}

/// A way from a point that is the nearest one all over the box moves as p does; so do those of two
/// points that may change places. What is beyond the reach may not have been found.
template <int N>
void worley_ways(const Interval* in, Interval* out) {
  worley_found<N>(in, out, 3);
  const WorleyBox<N> box(in, 2 * N + 3);
  double move = 0;  // by Manhattan's distance, which is the largest
  for (int k = 0; k < N && box.known; ++k) move += box.half[k];
  if (!box.known || move > 1) return;
  const auto ways = ways_at(box.centre, in);
  const double reach = worley_reach(N, in[2 * N + 2].lo);
  double d[3];
  for (int j = 0; j < 3; ++j)
    d[j] = std::min(minkowski(&ways[std::size_t(j * N)], N, in[2 * N + 2].lo), reach);
  const double enough = 2 * move + 1e-3;  // kernels compare powers that are not exact
  const bool first = d[1] - d[0] > enough, second = d[2] - d[1] > enough;
  for (int k = 0; k < N; ++k) {
    const auto moved = [&](double a, double b) {
      const double slack = box.half[k] + kDistanceError;
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
void worley_ways4(const Interval* in, Interval* out) { worley_ways<4>(in, out); }
void worley_nearest1(const Interval* in, Interval* out) { worley_lengths<1>(in, out); }
void worley_nearest2(const Interval* in, Interval* out) { worley_lengths<2>(in, out); }
void worley_nearest3(const Interval* in, Interval* out) { worley_lengths<3>(in, out); }
void worley_nearest4(const Interval* in, Interval* out) { worley_lengths<4>(in, out); }
void worley_squares1(const Interval* in, Interval* out) { worley_squared<1>(in, out); }
void worley_squares2(const Interval* in, Interval* out) { worley_squared<2>(in, out); }
void worley_squares3(const Interval* in, Interval* out) { worley_squared<3>(in, out); }
void worley_squares4(const Interval* in, Interval* out) { worley_squared<4>(in, out); }
void worley_edge1(const Interval* in, Interval* out) { worley_edge<1>(in, out); }
void worley_edge2(const Interval* in, Interval* out) { worley_edge<2>(in, out); }
void worley_edge3(const Interval* in, Interval* out) { worley_edge<3>(in, out); }
void worley_edge4(const Interval* in, Interval* out) { worley_edge<4>(in, out); }
void worley_border1(const Interval* in, Interval* out) { worley_found<1>(in, out, 2); }
void worley_border2(const Interval* in, Interval* out) { worley_found<2>(in, out, 2); }
void worley_border3(const Interval* in, Interval* out) { worley_found<3>(in, out, 2); }
void worley_border4(const Interval* in, Interval* out) { worley_found<4>(in, out, 2); }

void worley2(const Interval* in, Interval* out) { worley<2>(in, out, 1); }
void worley3(const Interval* in, Interval* out) { worley<3>(in, out, 1); }
void worley_pair2(const Interval* in, Interval* out) { worley<2>(in, out, 2); }
void worley_pair3(const Interval* in, Interval* out) { worley<3>(in, out, 2); }

}  // namespace mms::stdlib::bounds
