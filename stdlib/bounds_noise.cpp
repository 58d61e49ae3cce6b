// SPDX-License-Identifier: Apache-2.0
// Enclosures of noise. Over a box in few cells, gradient noise is enclosed cell by cell: once by
// the interpolation of its corners over intervals, once by its value at the centre and its
// gradient over the box (the mean value theorem), whichever is narrower at either end. Distances to
// random points change no faster than the point moves.
#include <algorithm>
#include <cmath>

#include "stdlib/bounds.h"
#include "stdlib/bounds_math.h"

#define MMS_ISA lattice_noise
#include "stdlib/cells.h"

namespace mms::stdlib::bounds {

using vm::Interval;

namespace {

using lattice_noise::Bits;

/// Cells that are looked at one by one; a box over more of them gets the range.
constexpr double kMostCells = 64;

/// What the float kernels may miss the exact value by, absolutely: offsets and weights in a cell
/// are good to a few 2^-24, differences of corners amplify that less than 100 times. Tests measure
/// a tenth of these.
constexpr double kValueError = 0x1p-17, kGradientError = 0x1p-14, kDistanceError = 0x1p-18;

struct Range {
  double lo, hi;
};
Range operator+(Range a, Range b) { return {a.lo + b.lo, a.hi + b.hi}; }
Range operator-(Range a, Range b) { return {a.lo - b.hi, a.hi - b.lo}; }
Range scaled(Range a, double s) {
  return s >= 0 ? Range{a.lo * s, a.hi * s} : Range{a.hi * s, a.lo * s};
}
/// For a factor that is not negative.
Range times(Range a, Range factor) {
  return {a.lo * (a.lo >= 0 ? factor.lo : factor.hi), a.hi * (a.hi >= 0 ? factor.hi : factor.lo)};
}
/// a (1 - w) + b w for w in [0, 1]: linear in w, so its extremes are at the ends of w.
Range blended(Range a, Range b, Range w) {
  const auto at = [](double x, double y, double u) { return x + (y - x) * u; };
  return {std::min(at(a.lo, b.lo, w.lo), at(a.lo, b.lo, w.hi)),
          std::max(at(a.hi, b.hi, w.lo), at(a.hi, b.hi, w.hi))};
}

double weight(double t) { return t * t * t * (t * (6 * t - 15) + 10); }
double weight_slope(double t) { return 30 * t * t * (1 - t) * (1 - t); }
Range weights(Range t) { return {weight(t.lo), weight(t.hi)}; }
Range weight_slopes(Range t) {
  const double a = weight_slope(t.lo), b = weight_slope(t.hi);
  return {std::min(a, b), t.lo <= 0.5 && 0.5 <= t.hi ? 1.875 : std::max(a, b)};
}

template <int N>
struct RangeJet {
  Range value;
  Range gradient[N];
};

/// Part of one cell.
template <int N>
struct CellBox {
  Bits near[N];
  Range offset[N], w[N], dw[N];
};

/// As lattice_noise::interpolate, over a box.
template <int K, int N>
RangeJet<N> interpolate(const CellBox<N>& cell, Bits h, Range (&d)[N]) {
  RangeJet<N> r;
  if constexpr (K == N) {
    double g[N];
    lattice_noise::corner_vector(lattice_noise::finish(h), g);
    r.value = {0, 0};
    for (int k = 0; k < N; ++k) {
      r.value = r.value + scaled(d[k], g[k]);
      r.gradient[k] = {g[k], g[k]};
    }
  } else {
    d[K] = cell.offset[K];
    const RangeJet<N> a = interpolate<K + 1>(cell, lattice_noise::mix(h, cell.near[K]), d);
    d[K] = {cell.offset[K].lo - 1, cell.offset[K].hi - 1};
    const RangeJet<N> b = interpolate<K + 1>(cell, lattice_noise::mix(h, cell.near[K] + 1), d);
    r.value = blended(a.value, b.value, cell.w[K]);
    for (int k = 0; k < N; ++k) r.gradient[k] = blended(a.gradient[k], b.gradient[k], cell.w[K]);
    r.gradient[K] = r.gradient[K] + times(b.value - a.value, cell.dw[K]);
  }
  return r;
}

template <int N>
RangeJet<N> over_cell(const double (&floors)[N], const Range (&offset)[N]) {
  CellBox<N> cell;
  for (int k = 0; k < N; ++k) {
    cell.near[k] = lattice_noise::lattice(floors[k]);
    cell.offset[k] = offset[k];
    cell.w[k] = weights(offset[k]);
    cell.dw[k] = weight_slopes(offset[k]);
  }
  Range d[N];
  RangeJet<N> r = interpolate<0>(cell, lattice_noise::kSeed, d);
  // The mean value theorem.
  for (int k = 0; k < N; ++k) {
    const double c = 0.5 * (offset[k].lo + offset[k].hi);
    cell.offset[k] = {c, c};
    cell.w[k] = {weight(c), weight(c)};
    cell.dw[k] = {0, 0};
  }
  Range mean = interpolate<0>(cell, lattice_noise::kSeed, d).value;
  for (int k = 0; k < N; ++k) {
    const double half = 0.5 * (offset[k].hi - offset[k].lo);
    const double steepest = std::max(std::fabs(r.gradient[k].lo), std::fabs(r.gradient[k].hi));
    mean = {mean.lo - steepest * half, mean.hi + steepest * half};
  }
  r.value = {std::max(r.value.lo, mean.lo), std::min(r.value.hi, mean.hi)};
  return r;
}

bool finite(const Interval* in, int n) {
  for (int k = 0; k < n; ++k)
    if (in[k].contains_infinity()) return false;
  return true;
}

/// Calls `f(floors, offset ranges)` for each cell of the box; false where there are too many, or
/// beyond the lattice.
template <int N, class F>
bool each_cell(const Interval* in, F f) {
  double first[N], last[N], at[N];
  double cells = 1;
  for (int k = 0; k < N; ++k) {
    if (!(in[k].magnitude() < 0x1p30)) return false;
    at[k] = first[k] = std::floor(in[k].lo);
    last[k] = std::floor(in[k].hi);
    cells *= last[k] - first[k] + 1;
  }
  if (cells > kMostCells) return false;
  for (;;) {
    Range offset[N];
    for (int k = 0; k < N; ++k)
      offset[k] = {std::max(in[k].lo - at[k], 0.0), std::min(in[k].hi - at[k], 1.0)};
    f(at, offset);
    int k = 0;
    while (k < N && ++at[k] > last[k]) {
      at[k] = first[k];
      ++k;
    }
    if (k == N) return true;
  }
}

template <int N>
void perlin(const Interval* in, Interval* out) {
  Interval r = Interval::empty();
  const auto add = [&](const double(&floors)[N], const Range(&offset)[N]) {
    const Range v = over_cell<N>(floors, offset).value;
    r = join(r, {v.lo, v.hi, false});
  };
  out[0].nan = !finite(in, N);
  if (!each_cell<N>(in, add)) return;
  constexpr double scale = lattice_noise::kPerlinScale<double, N>;
  out[0] = {r.lo * scale - kValueError, r.hi * scale + kValueError, false};
}

template <int N>
void perlin_gradient(const Interval* in, Interval* out) {
  Interval r[N];
  std::fill(r, r + N, Interval::empty());
  const auto add = [&](const double(&floors)[N], const Range(&offset)[N]) {
    const RangeJet<N> j = over_cell<N>(floors, offset);
    for (int k = 0; k < N; ++k) r[k] = join(r[k], {j.gradient[k].lo, j.gradient[k].hi, false});
  };
  const bool known = each_cell<N>(in, add);
  constexpr double scale = lattice_noise::kPerlinScale<double, N>;
  for (int k = 0; k < N; ++k) {
    out[k].nan = !finite(in, N);
    if (known) out[k] = {r[k].lo * scale - kGradientError, r[k].hi * scale + kGradientError, false};
  }
}

/// The largest magnitudes of a weight's derivatives, the weight's own first; 0 from the sixth on.
double most_of_weight(int order) {
  constexpr double most[] = {1, 1.875, 5.7735026918962582, 60, 360, 720};
  return order < 6 ? most[order] : 0;
}

/// The sum over the corners, each with its vector's components and offsets in [-1, 1], all weights
/// at their largest: Leibniz' rule as in lattice_noise::perlin_mixed.
template <int N>
void perlin_derivative(const Interval* in, Interval* out) {
  double most = 0;
  int order[N];
  const auto clamped = [](double n) { return static_cast<int>(std::clamp(n, 0.0, 8.0)); };
  const auto add = [&](auto self, int axis) -> void {
    if (axis < N) {
      for (int n = clamped(in[N + axis].lo); n <= clamped(in[N + axis].hi); ++n) {
        order[axis] = n;
        self(self, axis + 1);
      }
      return;
    }
    double all = N, one = 0;
    for (int k = 0; k < N; ++k) all *= most_of_weight(order[k]);
    for (int k = 0; k < N; ++k) {
      if (order[k] == 0) continue;
      double product = order[k] * most_of_weight(order[k] - 1);
      for (int j = 0; j < N; ++j)
        if (j != k) product *= most_of_weight(order[j]);
      one += product;
    }
    most = std::max(most, all + one);
  };
  add(add, 0);
  constexpr double slack = 1 + 1e-5;
  most *= (1 << N) * lattice_noise::kPerlinScale<double, N> * slack;
  out[0] = {-most, most, !finite(in, N)};
}

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
  const auto found = lattice_noise::nearest<double, N>(centre);
  const double radius = std::sqrt(radius2),
               at[] = {std::sqrt(found.first), std::sqrt(found.second)};
  for (int k = 0; k < distances; ++k) {
    out[k].lo = std::max(0.0, std::min(at[k], 1.0) - radius - kDistanceError);
    if (at[k] + radius <= 1) out[k].hi = at[k] + radius + kDistanceError;
  }
}

}  // namespace

void perlin1(const Interval* in, Interval* out) { perlin<1>(in, out); }
void perlin2(const Interval* in, Interval* out) { perlin<2>(in, out); }
void perlin3(const Interval* in, Interval* out) { perlin<3>(in, out); }
void perlin4(const Interval* in, Interval* out) { perlin<4>(in, out); }
void perlin_gradient1(const Interval* in, Interval* out) { perlin_gradient<1>(in, out); }
void perlin_gradient2(const Interval* in, Interval* out) { perlin_gradient<2>(in, out); }
void perlin_gradient3(const Interval* in, Interval* out) { perlin_gradient<3>(in, out); }
void perlin_gradient4(const Interval* in, Interval* out) { perlin_gradient<4>(in, out); }

void perlin_derivative1(const Interval* in, Interval* out) { perlin_derivative<1>(in, out); }
void perlin_derivative2(const Interval* in, Interval* out) { perlin_derivative<2>(in, out); }
void perlin_derivative3(const Interval* in, Interval* out) { perlin_derivative<3>(in, out); }
void perlin_derivative4(const Interval* in, Interval* out) { perlin_derivative<4>(in, out); }

// A functor over one value type at N coordinates.
#define MMS_AT(N, Functor, ...) \
  [](const double(&x)[N]) { return lattice_noise::Functor<double>::eval(__VA_ARGS__); }
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

void worley2(const Interval* in, Interval* out) { worley<2>(in, out, 1); }
void worley3(const Interval* in, Interval* out) { worley<3>(in, out, 1); }
void worley_pair2(const Interval* in, Interval* out) { worley<2>(in, out, 2); }
void worley_pair3(const Interval* in, Interval* out) { worley<3>(in, out, 2); }

}  // namespace mms::stdlib::bounds
