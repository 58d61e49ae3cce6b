// SPDX-License-Identifier: Apache-2.0
// Every kind of smooth noise, with seeds and periods: range, smoothness, gradient, repetition.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>

#include "tests/sanitized.h"
#include "tests/unit/stdlib/rows.h"

namespace mms::stdlib::testing {
namespace {

constexpr const char* kKinds[] = {"perlin", "valuenoise", "simplex"};

/// The rows of a kind in n dimensions.
struct Kind {
  std::string name;
  int n;
  std::string vector() const { return n == 1 ? "real" : "real[" + std::to_string(n) + "]"; }
  std::string at() const { return vector() + (n == 1 ? " x" : " p"); }
  std::string of() const { return at() + ", integer seed, " + vector() + " period"; }
  const vm::Builtin& plain() const { return find("real " + name + "(" + at() + ")"); }
  const vm::Builtin& value() const { return find("real " + name + "(" + of() + ")"); }
  const vm::Builtin& gradient() const {
    return find(vector() + " " + name + "_gradient(" + of() + ")");
  }
};

template <class F>
void for_each_kind(F f) {
  for (const char* name : kKinds)
    for (int n = 1; n <= 4; ++n) {
      const Kind kind{name, n};
      CAPTURE(kind.value().signature);
      f(kind);
    }
}

template <class R>
using Columns = std::vector<Column<R>>;

/// Points with a seed and periods behind them.
template <class R>
Columns<R> with(const Columns<R>& p, int seed, std::vector<double> periods = {}) {
  Columns<R> in = p;
  in.emplace_back(p[0].size(), R(seed));
  for (std::size_t k = 0; k < p.size(); ++k)
    in.emplace_back(p[0].size(), periods.empty() ? R(0) : R(periods[k]));
  return in;
}

const std::vector<double> kPeriods = {6, 3, 9, 12};

constexpr int kCount = kSanitized ? 4000 : 100000;

TEST_CASE("noise: seed 0 without period is the noise without seed, bit for bit") {
  for_each_kind([](const Kind& kind) {
    const auto p = random_points<float>(kind.n, kCount, 300);
    CHECK(run<float>(kind.plain(), p) == run<float>(kind.value(), with(p, 0)));
  });
}

TEST_CASE("noise stays in [-1, 1], uses most of it, and has mean 0") {
  for_each_kind([](const Kind& kind) {
    for (const int seed : {0, 1, -77}) {
      const auto p = random_points<float>(kind.n, kCount, 3000);
      const Column<float> v = run<float>(kind.value(), with(p, seed))[0];
      double most = 0, mean = 0, square = 0;
      for (float x : v) {
        most = std::max(most, std::fabs(double(x)));
        mean += x / double(v.size());
        square += double(x) * x / double(v.size());
      }
      CHECK(most <= 1);
      CHECK(most > 0.5);
      // Five standard errors; for n = 1 points share 6000 cells, of which neighbours are related.
      const double independent = kind.n == 1 ? std::min<double>(kCount, 2000) : kCount / 2.0;
      CHECK(std::fabs(mean) < 5 * std::sqrt(square / independent));
    }
  });
}

/// Largest projection of `d` on a lattice vector, from what lattice.h says of those vectors.
double largest_projection(std::vector<double> d) {
  for (double& x : d) x = std::fabs(x);
  std::sort(d.begin(), d.end());
  double sum = 0;
  for (std::size_t k = d.size() < 3 ? 0 : 1; k < d.size(); ++k)
    sum += d.size() == 2 && k == 0 ? std::tan(std::acos(-1.0) / 8) * d[0] : d[k];
  return sum;
}

double reach2(std::size_t n) { return n == 1 ? 1 : n == 4 ? 9.0 / 19 : 0.5; }

/// The largest value that unscaled simplex noise can take at skewed coordinates `h` in [0, 1].
double largest_value(std::vector<double> h) {
  std::sort(h.rbegin(), h.rend());
  const std::size_t n = h.size();
  const double back = n == 1 ? 0 : 1.0 / double(n + 3);
  double total = 0, sum = 0;
  for (double x : h) total += x;
  for (std::size_t c = 0; c <= n; ++c) {
    std::vector<double> d(n);
    double m = reach2(n);
    for (std::size_t k = 0; k < n; ++k) {
      d[k] = h[k] - (k < c) - back * (total - double(c));
      m -= d[k] * d[k];
    }
    if (m > 0) sum += std::pow(m, 4) * largest_projection(d);
  }
  return sum;
}

/// Climbs from the best of random places, several times.
double largest_over_simplex(int n) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  double most = 0;
  for (int start = 0; start < 40; ++start) {
    std::vector<double> best(n), p(n);
    double value = 0;
    const auto look = [&] {
      const double v = largest_value(p);
      const bool better = v > value;
      if (better) value = v, best = p;
      return better;
    };
    for (int i = 0; i < 200; ++i) {
      for (double& x : p) x = unit(random);
      look();
    }
    for (double step = 0.1; step > 1e-8; step /= 2)
      for (int still = 0; still < 20; ++still) {
        for (int k = 0; k < n; ++k)
          p[k] = std::clamp(best[k] + step * (2 * unit(random) - 1), 0.0, 1.0);
        if (look()) still = -1;
      }
    most = std::max(most, value);
  }
  return most;
}

TEST_CASE("simplex's scale makes the largest possible value 1, and never more") {
  // At a lattice point only its own vector acts: |gradient| is scale times reach^8 times its
  // length.
  const double length[] = {0, 0, std::sqrt(1 + std::pow(std::tan(std::acos(-1.0) / 8), 2)),
                           std::sqrt(2.0), std::sqrt(3.0)};
  for (int n = 2; n <= 4; ++n) {
    const Kind kind{"simplex", n};
    double squared = 0;
    const Columns<double> origin(n, Column<double>{0.0});
    for (const auto& g : run<double>(kind.gradient(), with(origin, 3))) squared += g[0] * g[0];
    const double scale = std::sqrt(squared) / length[n] / std::pow(reach2(n), 4);
    const double largest = scale * largest_over_simplex(n);
    CHECK(largest <= 1 - 1e-6);  // room for float's rounding
    CHECK(largest > 1 - 1e-5);
  }
  CHECK(largest_over_simplex(1) * 3.160481 == doctest::Approx(1).epsilon(1e-5));
}

TEST_CASE("noise: the gradient is the derivative, with seeds and periods") {
  const double h = 1e-4;
  for_each_kind([&](const Kind& kind) {
    const int n = kind.n, count = kSanitized ? 500 : 3000;
    const auto p = random_points<double>(n, count, 40);
    const auto g = run<double>(kind.gradient(), with(p, 5, kPeriods));
    for (int k = 0; k < n; ++k) {
      auto low = p, high = p;
      for (double& x : low[k]) x -= h;
      for (double& x : high[k]) x += h;
      const auto a = run<double>(kind.value(), with(low, 5, kPeriods))[0],
                 b = run<double>(kind.value(), with(high, 5, kPeriods))[0];
      double worst = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        worst = std::max(worst, std::fabs((b[i] - a[i]) / (2 * h) - g[k][i]));
      // h^2 / 6 times the third derivative, which is below 2000: 120 for quintic weights, for
      // simplices 4 d^3 / reach^3 of the slope of a peak.
      CHECK(worst < 5e-6);
    }
  });
}

TEST_CASE("noise: value and gradient are continuous, between cells and simplices and at the seam") {
  for_each_kind([](const Kind& kind) {
    const int n = kind.n, count = kSanitized ? 1000 : 20000;
    // Along lines that cross faces of cells (every third), and any others, which cross faces of
    // simplices; wherever the step of 1e-7 crosses one, a jump shows.
    auto p = random_points<double>(n, count, 20);
    for (int i = 0; i < count; i += 3) p[i % n][i] = std::floor(p[i % n][i]) - 0.5e-7;
    for (int i = 1; i < count; i += 3)
      for (int k = 1; k < n; ++k) p[k][i] = p[0][i] - 0.5e-7 + std::floor(p[k][i]);
    auto q = p;
    for (int i = 0; i < count; ++i) q[i % n][i] += 1e-7;
    const auto a = run<double>(kind.value(), with(p, 2, kPeriods))[0],
               b = run<double>(kind.value(), with(q, 2, kPeriods))[0];
    const auto ga = run<double>(kind.gradient(), with(p, 2, kPeriods)),
               gb = run<double>(kind.gradient(), with(q, 2, kPeriods));
    double value_jump = 0, gradient_jump = 0;
    for (int i = 0; i < count; ++i) {
      value_jump = std::max(value_jump, std::fabs(a[i] - b[i]));
      for (int k = 0; k < n; ++k)
        gradient_jump = std::max(gradient_jump, std::fabs(ga[k][i] - gb[k][i]));
    }
    // The rows state slopes up to 45; second derivatives stay below 500.
    CHECK(value_jump < 45e-7);
    CHECK(gradient_jump < 500e-7);
    CHECK(gradient_jump > 0);
  });
}

TEST_CASE("noise repeats after its period, bit for bit, and not before") {
  for_each_kind([](const Kind& kind) {
    const int n = kind.n;
    // Places are multiples of 1/256, so moving them by whole cells is exact.
    auto p = random_points<float>(n, 2000, 20);
    for (auto& column : p)
      for (float& x : column) x = std::floor(x * 256) / 256;
    const auto here = run<float>(kind.value(), with(p, 9, kPeriods));
    const auto slope = run<float>(kind.gradient(), with(p, 9, kPeriods));
    for (int k = 0; k < n; ++k)
      for (const int times : {-1, 1, 7}) {
        auto moved = p;
        for (float& x : moved[k]) x += float(times * kPeriods[k]);
        CHECK(run<float>(kind.value(), with(moved, 9, kPeriods)) == here);
        CHECK(run<float>(kind.gradient(), with(moved, 9, kPeriods)) == slope);
      }
    // A third of a period away it is something else, and one axis' period is not another's.
    auto moved = p;
    for (float& x : moved[0]) x += float(kPeriods[0] / 3);
    const auto other = run<float>(kind.value(), with(moved, 9, kPeriods))[0];
    int equal = 0;
    for (std::size_t i = 0; i < other.size(); ++i) equal += other[i] == here[0][i];
    CHECK(equal < 20);
    // What is not a multiple of what the kind can repeat after is rounded to it.
    const double step = kind.name == "simplex" && n > 1 ? 3 : 1;
    std::vector<double> near = kPeriods;
    for (double& period : near) period += 0.4 * step;
    CHECK(run<float>(kind.value(), with(p, 9, near)) == here);
  });
}

TEST_CASE("noises of different seeds have nothing to do with one another") {
  for_each_kind([](const Kind& kind) {
    const auto p = random_points<float>(kind.n, kCount, kind.n == 1 ? 100000 : 1000);
    const Column<float> a = run<float>(kind.value(), with(p, 0))[0];
    for (const int seed : {1, 2, -1, 1 << 20}) {
      const Column<float> b = run<float>(kind.value(), with(p, seed))[0];
      double product = 0, square = 0;
      for (std::size_t i = 0; i < a.size(); ++i)
        product += double(a[i]) * b[i], square += double(a[i]) * a[i];
      // Points share no cells, or few (4e5 of n = 1's 2e5 cells at most count half): five standard
      // errors.
      CHECK(std::fabs(product / square) < 5 / std::sqrt(kCount / 4.0));
    }
  });
}

TEST_CASE("float and double noise agree wherever floats hold the place, with periods too") {
  for_each_kind([](const Kind& kind) {
    for (double size : {1.0, 1e3, 1e5, 1e6}) {
      const auto p = random_points<float>(kind.n, 2000, size);
      Columns<double> q;
      for (const auto& column : p) q.emplace_back(column.begin(), column.end());
      for (const auto& periods : {std::vector<double>{}, kPeriods}) {
        const auto a = run<float>(kind.value(), with(p, 4, periods))[0];
        const auto b = run<double>(kind.value(), with(q, 4, periods))[0];
        double worst = 0;
        for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::fabs(a[i] - b[i]));
        // A few ulp of 1 in offsets and weights, wherever the cell is; a simplex' offsets are off
        // by four roundings, which its slope of up to 45 multiplies.
        CHECK(worst < (kind.name == "simplex" ? 64 : 16) * 0x1p-24);
      }
    }
  });
}

TEST_CASE("hash and cellnoise of a seed are uniform along the lattice and over seeds, and repeat") {
  for (int n = 1; n <= 4; ++n) {
    const Kind hash{"hash", n}, cells{"cellnoise", n};
    const vm::Builtin& hash_row = find("real hash(" + hash.at() + ", integer seed)");
    CAPTURE(hash_row.signature);
    Columns<float> p(n, Column<float>(65536));
    for (int i = 0; i < 65536; ++i)
      for (int k = 0; k < n; ++k) {
        const int from = k * 16 / n, to = (k + 1) * 16 / n;  // the bits of i that axis k counts
        p[k][i] = float(i >> from & ((1 << (to - from)) - 1));
      }
    auto seeded = p;
    seeded.emplace_back(65536, 12.0f);
    CHECK(chi_square(run<float>(hash_row, seeded)[0]) < 255 + 5 * 22.6);
    CHECK(chi_square(run<float>(cells.value(), with(p, 12))[0]) < 255 + 5 * 22.6);
    // One place, many seeds.
    auto one = with(Columns<float>(n, Column<float>(65536, 0.5f)), 0);
    for (int i = 0; i < 65536; ++i) one[n][i] = float(i - 32768);
    CHECK(chi_square(run<float>(cells.value(), one)[0]) < 255 + 5 * 22.6);
    one.resize(n + 1);
    CHECK(chi_square(run<float>(hash_row, one)[0]) < 255 + 5 * 22.6);
    CHECK(run<float>(cells.value(), with(p, 0)) == run<float>(cells.plain(), p));
    auto moved = p;
    for (float& x : moved[n - 1]) x -= float(kPeriods[n - 1]);
    CHECK(run<float>(cells.value(), with(p, 3, kPeriods)) ==
          run<float>(cells.value(), with(moved, 3, kPeriods)));
  }
}

}  // namespace
}  // namespace mms::stdlib::testing
