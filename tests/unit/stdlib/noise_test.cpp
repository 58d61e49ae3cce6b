// SPDX-License-Identifier: Apache-2.0
// Noise: range, gradient, lattice, statistics, places far from the origin.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>

#include "tests/unit/stdlib/rows.h"

namespace mms::stdlib::testing {
namespace {

std::string formal(int n) { return n == 1 ? "real x" : "real[" + std::to_string(n) + "] p"; }
const vm::Builtin& perlin(int n) { return find("real perlin(" + formal(n) + ")"); }
const vm::Builtin& perlin_gradient(int n) {
  return find((n == 1 ? std::string("real") : "real[" + std::to_string(n) + "]") +
              " perlin_gradient(" + formal(n) + ")");
}

/// Largest projection of `d` on a lattice vector, from what the documentation of noise.h says of
/// those vectors.
double largest_projection(std::vector<double> d) {
  for (double& x : d) x = std::fabs(x);
  std::sort(d.begin(), d.end());
  switch (d.size()) {
    case 1:
      return d[0];
    case 2:
      return d[1] + std::tan(std::acos(-1.0) / 8) * d[0];
    case 3:
      return d[1] + d[2];
    default:
      return d[1] + d[2] + d[3];
  }
}

/// The largest value that unscaled noise can take at `p` in the unit cell.
double largest_value(const std::vector<double>& p) {
  const std::size_t n = p.size();
  double sum = 0;
  for (unsigned corner = 0; corner < (1u << n); ++corner) {
    double weight = 1;
    std::vector<double> d(n);
    for (std::size_t k = 0; k < n; ++k) {
      const bool far = corner >> k & 1;
      const double t = far ? p[k] : 1 - p[k];
      weight *= t * t * t * (t * (t * 6 - 15) + 10);
      d[k] = p[k] - far;
    }
    sum += weight * largest_projection(d);
  }
  return sum;
}

/// Climbs from the best point of a grid.
double largest_over_cell(int n) {
  const int steps = n == 1 ? 1000 : n == 2 ? 200 : n == 3 ? 40 : 12;
  std::vector<double> best(n), p(n);
  double most = 0;
  int total = 1;
  for (int k = 0; k < n; ++k) total *= steps / 2 + 1;
  for (int index = 0; index < total; ++index) {
    for (int k = 0, rest = index; k < n; ++k, rest /= steps / 2 + 1)
      p[k] = double(rest % (steps / 2 + 1)) / steps;
    if (const double v = largest_value(p); v > most) most = v, best = p;
  }
  for (double step = 1.0 / steps; step > 1e-7; step /= 2)
    for (bool better = true; better;) {
      better = false;
      for (int k = 0; k < n; ++k)
        for (double sign : {-1.0, 1.0}) {
          p = best;
          p[k] += sign * step;
          if (const double v = largest_value(p); v > most) most = v, best = p, better = true;
        }
    }
  return most;
}

TEST_CASE("perlin's scale makes the largest possible value 1, and never more") {
  // The scale shows in the slope at a lattice point, where the noise is its vector times the
  // offset: |gradient| is scale times the vector's length, 1.0824, sqrt 2, sqrt 3 for n = 2, 3, 4.
  const double length[] = {0, 0, std::sqrt(1 + std::pow(std::tan(std::acos(-1.0) / 8), 2)),
                           std::sqrt(2.0), std::sqrt(3.0)};
  for (int n = 2; n <= 4; ++n) {
    std::vector<Column<double>> origin(n, Column<double>{5.0});
    double squared = 0;
    for (const Column<double>& g : run<double>(perlin_gradient(n), origin)) squared += g[0] * g[0];
    const double scale = std::sqrt(squared) / length[n];
    const double largest = scale * largest_over_cell(n);
    CHECK(largest <= 1 - 1e-6);  // room for float's rounding
    CHECK(largest > 1 - 1e-5);
  }
  CHECK(largest_over_cell(1) == doctest::Approx(0.5));
}

TEST_CASE("perlin stays in [-1, 1] and uses most of it") {
  for (int n = 1; n <= 4; ++n) {
    const Column<float> v = run<float>(perlin(n), random_points<float>(n, 200000, 300))[0];
    const auto [low, high] = std::minmax_element(v.begin(), v.end());
    CHECK(*low >= -1);
    CHECK(*high <= 1);
    CHECK(*low < -0.6);
    CHECK(*high > 0.6);
    double mean = 0, square = 0;
    for (float x : v) mean += x / double(v.size()), square += double(x) * x / double(v.size());
    // Four standard errors; points share cells only for n = 1 (600 cells).
    CHECK(std::fabs(mean) < 4 * std::sqrt(square / (n == 1 ? 600 : double(v.size()))));
  }
}

TEST_CASE("perlin is 0 at lattice points, and continuous across cell faces up to its gradient") {
  for (int n = 1; n <= 4; ++n) {
    std::vector<Column<float>> lattice(n);
    std::mt19937 random(4);
    for (int i = 0; i < 1000; ++i)
      for (int k = 0; k < n; ++k) lattice[k].push_back(float(int(random() % 2001) - 1000));
    const Column<float> values = run<float>(perlin(n), lattice)[0];
    for (float v : values) CHECK(v == 0);
    auto below = random_points<double>(n, 2000, 50), above = below;
    for (std::size_t i = 0; i < 2000; ++i) {
      const int axis = int(i) % n;
      const double face = std::floor(below[axis][i]);
      below[axis][i] = face - 1e-9;
      above[axis][i] = face;
    }
    const auto a = run<double>(perlin_gradient(n), below),
               b = run<double>(perlin_gradient(n), above);
    // The second derivative is below 60 (quintic weights), so 1e-9 moves a gradient by 1e-7.
    for (std::size_t k = 0; k < a.size(); ++k)
      for (std::size_t i = 0; i < a[k].size(); ++i) CHECK(std::fabs(a[k][i] - b[k][i]) < 1e-7);
  }
}

TEST_CASE("perlin_gradient is the derivative of perlin") {
  const double h = 1e-4;
  for (int n = 1; n <= 4; ++n) {
    const auto p = random_points<double>(n, 3000, 40);
    const auto g = run<double>(perlin_gradient(n), p);
    const auto g32 = run<float>(perlin_gradient(n), random_points<float>(n, 3000, 40));
    for (int k = 0; k < n; ++k) {
      auto low = p, high = p;
      for (double& x : low[k]) x -= h;
      for (double& x : high[k]) x += h;
      const auto a = run<double>(perlin(n), low)[0], b = run<double>(perlin(n), high)[0];
      double worst = 0;
      // Central differences are off by h^2/6 times the third derivative, below 400 here, where no
      // face lies between; across a face by h times the jump of it.
      for (std::size_t i = 0; i < a.size(); ++i)
        worst = std::max(worst, std::fabs((b[i] - a[i]) / (2 * h) - g[k][i]));
      CHECK(worst < 1e-5);
      for (std::size_t i = 0; i < a.size(); ++i)
        if (std::fabs(p[k][i]) < 40) CHECK(std::fabs(g32[k][i] - g[k][i]) < 2e-3);
    }
  }
}

TEST_CASE("float and double noise agree, as far from the origin as floats hold the place") {
  for (int n = 1; n <= 4; ++n)
    for (double size : {1.0, 1e3, 1e5, 1e6}) {
      const auto p = random_points<float>(n, 2000, size);
      std::vector<Column<double>> q;
      for (const auto& column : p) q.emplace_back(column.begin(), column.end());
      const auto a = run<float>(perlin(n), p)[0];
      const auto b = run<double>(perlin(n), q)[0];
      // Inside a cell all is within a few ulp of 1, wherever the cell is.
      for (std::size_t i = 0; i < a.size(); ++i) CHECK(std::fabs(a[i] - b[i]) < 16 * 0x1p-24);
    }
}

TEST_CASE("beyond the range of the lattice noise is still finite and in range") {
  for (float x : {0x1p31f, -0x1p31f, 1e20f, -0x1.fffffep127f}) {
    const float v = call<float>(perlin(3), x, 0.3f, 0.6f);
    CHECK(std::fabs(v) <= 1);
    CHECK(call<float>(find("real cellnoise(real[2] p)"), x, 0.5f) < 1);
  }
  CHECK(std::isnan(call<float>(perlin(3), NAN, 0.3f, 0.6f)));
}

TEST_CASE("hash and cellnoise are uniform, also along the lattice") {
  for (int n = 1; n <= 4; ++n)
    for (const char* name : {"hash", "cellnoise"}) {
      const vm::Builtin& row = find("real " + std::string(name) + "(" + formal(n) + ")");
      INFO(row.signature);
      std::vector<Column<float>> p(n, Column<float>(65536));
      for (int i = 0; i < 65536; ++i)
        for (int k = 0; k < n; ++k)
          p[k][i] = float(n == 1   ? i
                          : n == 2 ? i >> (8 * k) & 255
                          : n == 3 ? i >> (5 * k) & 63
                                   : i >> (4 * k) & 15);
      const Column<float> v = run<float>(row, p)[0];
      for (float x : v) CHECK((x >= 0 && x < 1));
      // n = 3 repeats cells, so every count there is scaled by the repeats.
      if (n != 3) CHECK(chi_square(v) < 255 + 5 * 22.6);
      double product = 0;
      for (std::size_t i = 1; i < v.size(); ++i) product += (v[i] - 0.5) * (v[i - 1] - 0.5) * 12;
      CHECK(std::fabs(product / 65535) < 5 / 256.0);  // correlation of neighbours
    }
}

TEST_CASE("lattice vectors of neighbours are independent") {
  // Slopes at lattice points, multiplied with those one step away along each axis.
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Column<float>> p(3), q(3);
    for (int i = 0; i < 32768; ++i)
      for (int k = 0; k < 3; ++k) {
        p[k].push_back(float(i >> (5 * k) & 31));
        q[k].push_back(p[k].back() + float(k == axis));
      }
    const auto a = run<float>(perlin_gradient(3), p), b = run<float>(perlin_gradient(3), q);
    double dot = 0, square = 0;
    for (int k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < 32768; ++i)
        dot += double(a[k][i]) * b[k][i], square += double(a[k][i]) * a[k][i];
    // Correlation of 3 x 32768 products, of which two in three are not 0: five standard errors.
    CHECK(std::fabs(dot / square) < 5 / std::sqrt(65536.0));
  }
}

TEST_CASE(
    "cellnoise is constant in a cell, hash tells neighbours apart, -0 is 0, a NaN any other") {
  const vm::Builtin& cells = find("real cellnoise(real[3] p)");
  CHECK(call<float>(cells, 3.0f, -2.0f, 7.0f) == call<float>(cells, 3.99f, -1.01f, 7.5f));
  CHECK(call<float>(cells, 3.0f, -2.0f, 7.0f) != call<float>(cells, 3.0f, -2.01f, 7.0f));
  const vm::Builtin& hash = find("real hash(real x)");
  CHECK(call<float>(hash, 0.0f) == call<float>(hash, -0.0f));
  CHECK(call<float>(hash, float(NAN)) == call<float>(hash, -float(NAN)));
  CHECK(call<float>(hash, float(NAN)) == call<double>(hash, double(NAN)));
  CHECK(call<float>(hash, 1.0f) != call<float>(hash, 1.0000001f));
}

TEST_CASE("worley: distances, gradient and Voronoi cells belong together") {
  for (int n = 2; n <= 3; ++n) {
    const std::string f = "(" + formal(n) + ")";
    const auto p = random_points<double>(n, 20000, 30);
    const auto first = run<double>(find("real worley" + f), p)[0];
    const auto both = run<double>(find("real[2] worley_pair" + f), p);
    const auto g = run<double>(find("real[" + std::to_string(n) + "] worley_gradient" + f), p);
    const auto cell = run<double>(find("real voronoi" + f), p)[0];
    // The point itself: back along the gradient. There the distance is 0 and the cell the same.
    auto feature = p;
    for (int k = 0; k < n; ++k)
      for (std::size_t i = 0; i < first.size(); ++i) feature[k][i] -= g[k][i] * first[i];
    const auto at_feature = run<double>(find("real worley" + f), feature)[0];
    const auto cell_there = run<double>(find("real voronoi" + f), feature)[0];
    int far = 0, wrong = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      CHECK(both[0][i] == first[i]);
      CHECK(both[1][i] >= first[i]);
      double squared = 0;
      for (int k = 0; k < n; ++k) squared += g[k][i] * g[k][i];
      CHECK(squared == doctest::Approx(1));
      CHECK(at_feature[i] < 1e-7);
      wrong += cell_there[i] != cell[i];
      far += first[i] > 1;  // only then a point outside the searched cells can be nearer
    }
    CHECK(wrong == 0);
    // A gap needs a ball of radius 1 without points (rows' documentation calls it rare).
    CHECK(far < 20);
  }
}

}  // namespace
}  // namespace mms::stdlib::testing
