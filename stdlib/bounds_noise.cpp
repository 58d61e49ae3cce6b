// SPDX-License-Identifier: Apache-2.0
// Enclosures of noise. Over a box in few cells, gradient and value noise are enclosed cell by cell:
// once by the interpolation of their corners over intervals, once by the value at the centre and
// the gradient over the box (the mean value theorem), whichever is narrower at either end. Simplex
// noise is enclosed by its value and gradient at the centre and its strongest bend, or by its
// steepest slope.
#include "stdlib/bounds.h"
#include "stdlib/bounds_lattice.h"

#define MMS_ISA lattice_noise
#include "stdlib/noise.h"
#include "stdlib/simplex.h"

namespace mms::stdlib::bounds {

namespace {

using lattice_noise::Bits, lattice_noise::Endless, lattice_noise::Levels, lattice_noise::Slopes;

/// What the float kernels may miss the exact value by, absolutely: offsets and weights in a cell
/// are good to a few 2^-24, differences of corners amplify that less than 100 times. Tests measure
/// a tenth of these.
constexpr double kValueError = 0x1p-17, kGradientError = 0x1p-14;

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
  Bits side[N][2];
  Range offset[N], w[N], dw[N];
};

/// As lattice_noise::interpolate, over a box. A corner's value is linear in the offset.
template <class Corners, int K, int N>
RangeJet<N> interpolate(const CellBox<N>& cell, Bits h, Range (&d)[N]) {
  RangeJet<N> r;
  if constexpr (K == N) {
    const double at_corner[N] = {};
    const auto corner = Corners::corner(lattice_noise::finish(h), at_corner);
    r.value = {corner.value, corner.value};
    for (int k = 0; k < N; ++k) {
      r.value = r.value + scaled(d[k], corner.gradient[k]);
      r.gradient[k] = {corner.gradient[k], corner.gradient[k]};
    }
  } else {
    d[K] = cell.offset[K];
    const auto a = interpolate<Corners, K + 1>(cell, lattice_noise::mix(h, cell.side[K][0]), d);
    d[K] = {cell.offset[K].lo - 1, cell.offset[K].hi - 1};
    const auto b = interpolate<Corners, K + 1>(cell, lattice_noise::mix(h, cell.side[K][1]), d);
    r.value = blended(a.value, b.value, cell.w[K]);
    for (int k = 0; k < N; ++k) r.gradient[k] = blended(a.gradient[k], b.gradient[k], cell.w[K]);
    r.gradient[K] = r.gradient[K] + times(b.value - a.value, cell.dw[K]);
  }
  return r;
}

template <class Corners, int N, class Where>
RangeJet<N> over_cell(const double (&floors)[N], const Range (&offset)[N], const Where& where) {
  const auto sides = lattice_noise::cell_at(floors, where);
  CellBox<N> cell;
  for (int k = 0; k < N; ++k) {
    cell.side[k][0] = sides.side[k][0];
    cell.side[k][1] = sides.side[k][1];
    cell.offset[k] = offset[k];
    cell.w[k] = weights(offset[k]);
    cell.dw[k] = weight_slopes(offset[k]);
  }
  Range d[N];
  RangeJet<N> r = interpolate<Corners, 0>(cell, where.start(), d);
  // The mean value theorem.
  for (int k = 0; k < N; ++k) {
    const double c = 0.5 * (offset[k].lo + offset[k].hi);
    cell.offset[k] = {c, c};
    cell.w[k] = {weight(c), weight(c)};
    cell.dw[k] = {0, 0};
  }
  Range mean = interpolate<Corners, 0>(cell, where.start(), d).value;
  for (int k = 0; k < N; ++k) {
    const double half = 0.5 * (offset[k].hi - offset[k].lo);
    const double steepest = std::max(std::fabs(r.gradient[k].lo), std::fabs(r.gradient[k].hi));
    mean = {mean.lo - steepest * half, mean.hi + steepest * half};
  }
  r.value = {std::max(r.value.lo, mean.lo), std::min(r.value.hi, mean.hi)};
  return r;
}

/// Calls `f` with where the noise is, from the seed and the periods that stand behind the N
/// coordinates; not where they are not certain.
template <int N, class F>
void with_tiles(const Interval* in, int step, F f) {
  double period[N];
  for (int k = 0; k <= N; ++k)
    if (!in[N + k].is_point()) return;
  for (int k = 0; k < N; ++k) period[k] = in[N + 1 + k].lo;
  f(lattice_noise::tiled(static_cast<std::int32_t>(in[N].lo), period, step));
}

template <class Corners, int N, class Where>
void interpolated(const Interval* in, Interval* out, const Where& where) {
  Interval r = Interval::empty();
  const auto add = [&](const double(&floors)[N], const Range(&offset)[N]) {
    const Range v = over_cell<Corners>(floors, offset, where).value;
    r = join(r, {v.lo, v.hi, false});
  };
  if (!each_cell<N>(in, add)) return;
  constexpr double scale = Corners::template kScale<double, N>;
  out[0] = {r.lo * scale - kValueError, r.hi * scale + kValueError, out[0].nan};
}

template <class Corners, int N, class Where>
void interpolated_gradient(const Interval* in, Interval* out, const Where& where) {
  Interval r[N];
  std::fill(r, r + N, Interval::empty());
  const auto add = [&](const double(&floors)[N], const Range(&offset)[N]) {
    const RangeJet<N> j = over_cell<Corners>(floors, offset, where);
    for (int k = 0; k < N; ++k) r[k] = join(r[k], {j.gradient[k].lo, j.gradient[k].hi, false});
  };
  if (!each_cell<N>(in, add)) return;
  constexpr double scale = Corners::template kScale<double, N>;
  for (int k = 0; k < N; ++k)
    out[k] = {r[k].lo * scale - kGradientError, r[k].hi * scale + kGradientError, out[k].nan};
}

/// The middle of a box, and how far its corners are from it; false beyond the lattice.
template <int N>
bool middle(const Interval* in, double (&centre)[N], double& radius) {
  double radius2 = 0;
  for (int k = 0; k < N; ++k) {
    if (!(in[k].magnitude() < 0x1p28)) return false;
    centre[k] = 0.5 * (in[k].lo + in[k].hi);
    const double half = 0.5 * (in[k].hi - in[k].lo);
    radius2 += half * half;
  }
  radius = std::sqrt(radius2);
  return true;
}
template <int N>
double bend() {
  return lattice_noise::simplex_bend<N>(std::sqrt(lattice_noise::kReach2<double, N>));
}

/// Two bounds of what it is away from the middle: the steepest slope there is, and the slope in the
/// middle with the strongest bend there is.
template <int N, class Where>
void simplex(const Interval* in, Interval* out, const Where& where) {
  double centre[N], radius;
  if (!middle(in, centre, radius)) return;
  const auto jet = lattice_noise::Simplex::jet(centre, where);
  double near = 0.5 * bend<N>() * radius * radius;
  for (int k = 0; k < N; ++k) near += std::fabs(jet.gradient[k]) * 0.5 * (in[k].hi - in[k].lo);
  const double most = std::min(near, lattice_noise::kSimplexSlope<N> * radius) + kValueError;
  out[0] = {jet.value - most, jet.value + most, out[0].nan};
}
template <int N, class Where>
void simplex_gradient(const Interval* in, Interval* out, const Where& where) {
  double centre[N], radius;
  if (!middle(in, centre, radius)) return;
  const auto jet = lattice_noise::Simplex::jet(centre, where);
  const double most = bend<N>() * radius + kGradientError;
  for (int k = 0; k < N; ++k) out[k] = {jet.gradient[k] - most, jet.gradient[k] + most, out[k].nan};
}

/// Only an infinite coordinate makes noise a NaN.
template <int N>
void set_nan(const Interval* in, Interval* out, int results) {
  for (int k = 0; k < results; ++k) out[k].nan = !finite(in, N);
}

template <class Corners, int N>
void value(const Interval* in, Interval* out) {
  set_nan<N>(in, out, 1);
  interpolated<Corners, N>(in, out, Endless{});
}
template <class Corners, int N>
void value_of(const Interval* in, Interval* out) {
  set_nan<N>(in, out, 1);
  with_tiles<N>(in, 1, [&](const auto& where) { interpolated<Corners, N>(in, out, where); });
}
template <class Corners, int N>
void gradient(const Interval* in, Interval* out) {
  set_nan<N>(in, out, N);
  interpolated_gradient<Corners, N>(in, out, Endless{});
}
template <class Corners, int N>
void gradient_of(const Interval* in, Interval* out) {
  set_nan<N>(in, out, N);
  with_tiles<N>(in, 1,
                [&](const auto& where) { interpolated_gradient<Corners, N>(in, out, where); });
}
template <int N>
void simplex(const Interval* in, Interval* out) {
  set_nan<N>(in, out, 1);
  simplex<N>(in, out, Endless{});
}
template <int N>
void simplex_of(const Interval* in, Interval* out) {
  set_nan<N>(in, out, 1);
  with_tiles<N>(in, lattice_noise::Simplex::kStep<N>,
                [&](const auto& where) { simplex<N>(in, out, where); });
}

template <int N>
void simplex_gradient_of(const Interval* in, Interval* out) {
  set_nan<N>(in, out, N);
  with_tiles<N>(in, lattice_noise::Simplex::kStep<N>,
                [&](const auto& where) { simplex_gradient<N>(in, out, where); });
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

}  // namespace

void perlin1(const Interval* in, Interval* out) { value<Slopes, 1>(in, out); }
void perlin2(const Interval* in, Interval* out) { value<Slopes, 2>(in, out); }
void perlin3(const Interval* in, Interval* out) { value<Slopes, 3>(in, out); }
void perlin4(const Interval* in, Interval* out) { value<Slopes, 4>(in, out); }
void perlin_gradient1(const Interval* in, Interval* out) { gradient<Slopes, 1>(in, out); }
void perlin_gradient2(const Interval* in, Interval* out) { gradient<Slopes, 2>(in, out); }
void perlin_gradient3(const Interval* in, Interval* out) { gradient<Slopes, 3>(in, out); }
void perlin_gradient4(const Interval* in, Interval* out) { gradient<Slopes, 4>(in, out); }
void perlin_of1(const Interval* in, Interval* out) { value_of<Slopes, 1>(in, out); }
void perlin_of2(const Interval* in, Interval* out) { value_of<Slopes, 2>(in, out); }
void perlin_of3(const Interval* in, Interval* out) { value_of<Slopes, 3>(in, out); }
void perlin_of4(const Interval* in, Interval* out) { value_of<Slopes, 4>(in, out); }
void perlin_gradient_of1(const Interval* in, Interval* out) { gradient_of<Slopes, 1>(in, out); }
void perlin_gradient_of2(const Interval* in, Interval* out) { gradient_of<Slopes, 2>(in, out); }
void perlin_gradient_of3(const Interval* in, Interval* out) { gradient_of<Slopes, 3>(in, out); }
void perlin_gradient_of4(const Interval* in, Interval* out) { gradient_of<Slopes, 4>(in, out); }
void valuenoise1(const Interval* in, Interval* out) { value<Levels, 1>(in, out); }
void valuenoise2(const Interval* in, Interval* out) { value<Levels, 2>(in, out); }
void valuenoise3(const Interval* in, Interval* out) { value<Levels, 3>(in, out); }
void valuenoise4(const Interval* in, Interval* out) { value<Levels, 4>(in, out); }
void valuenoise_of1(const Interval* in, Interval* out) { value_of<Levels, 1>(in, out); }
void valuenoise_of2(const Interval* in, Interval* out) { value_of<Levels, 2>(in, out); }
void valuenoise_of3(const Interval* in, Interval* out) { value_of<Levels, 3>(in, out); }
void valuenoise_of4(const Interval* in, Interval* out) { value_of<Levels, 4>(in, out); }
void valuenoise_gradient_of1(const Interval* in, Interval* out) { gradient_of<Levels, 1>(in, out); }
void valuenoise_gradient_of2(const Interval* in, Interval* out) { gradient_of<Levels, 2>(in, out); }
void valuenoise_gradient_of3(const Interval* in, Interval* out) { gradient_of<Levels, 3>(in, out); }
void valuenoise_gradient_of4(const Interval* in, Interval* out) { gradient_of<Levels, 4>(in, out); }
void simplex1(const Interval* in, Interval* out) { (simplex<1>)(in, out); }
void simplex2(const Interval* in, Interval* out) { (simplex<2>)(in, out); }
void simplex3(const Interval* in, Interval* out) { (simplex<3>)(in, out); }
void simplex4(const Interval* in, Interval* out) { (simplex<4>)(in, out); }
void simplex_of1(const Interval* in, Interval* out) { simplex_of<1>(in, out); }
void simplex_of2(const Interval* in, Interval* out) { simplex_of<2>(in, out); }
void simplex_of3(const Interval* in, Interval* out) { simplex_of<3>(in, out); }
void simplex_of4(const Interval* in, Interval* out) { simplex_of<4>(in, out); }
void simplex_gradient_of1(const Interval* in, Interval* out) { simplex_gradient_of<1>(in, out); }
void simplex_gradient_of2(const Interval* in, Interval* out) { simplex_gradient_of<2>(in, out); }
void simplex_gradient_of3(const Interval* in, Interval* out) { simplex_gradient_of<3>(in, out); }
void simplex_gradient_of4(const Interval* in, Interval* out) { simplex_gradient_of<4>(in, out); }

void perlin_derivative1(const Interval* in, Interval* out) { perlin_derivative<1>(in, out); }
void perlin_derivative2(const Interval* in, Interval* out) { perlin_derivative<2>(in, out); }
void perlin_derivative3(const Interval* in, Interval* out) { perlin_derivative<3>(in, out); }
void perlin_derivative4(const Interval* in, Interval* out) { perlin_derivative<4>(in, out); }

}  // namespace mms::stdlib::bounds
