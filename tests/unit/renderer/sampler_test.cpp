// SPDX-License-Identifier: Apache-2.0
#include "renderer/sampler.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/sanitized.h"

using namespace mms::renderer;

namespace {

/// Points in each elementary interval of sides 2^-d[0] x ... : all counts, by brute force.
std::pair<int, int> interval_counts(int m, std::array<int, 4> d, std::uint64_t first,
                                    bool scrambled, decltype(&nx4) sequence = nx4) {
  std::vector<int> count(std::size_t(1) << (d[0] + d[1] + d[2] + d[3]));
  for (std::uint64_t n = first; n < first + (1u << m); ++n) {
    std::size_t cell = 0;
    for (int k = 0; k < 4; ++k) {
      std::uint32_t x = sequence(n, k);
      if (scrambled) x = owen_scramble(x, 77u + std::uint32_t(k));
      cell = (cell << d[k]) | (d[k] > 0 ? x >> (32 - d[k]) : 0);
    }
    ++count[cell];
  }
  const auto [low, high] = std::minmax_element(count.begin(), count.end());
  return {*low, *high};
}

/// Calls `f` for every way to write `total` as a sum of four.
template <class F>
void compositions(int total, F f) {
  for (int a = 0; a <= total; ++a)
    for (int b = 0; a + b <= total; ++b)
      for (int c = 0; a + b + c <= total; ++c) f(std::array<int, 4>{a, b, c, total - a - b - c});
}

}  // namespace

TEST_CASE(
    "the sequence is a (1, 4)-sequence: every elementary interval of volume 2^(1-m) holds 2 "
    "of each 2^m points") {
  for (int m = 1; m <= 9; ++m)
    for (const std::uint64_t block : {0, 1, 5})
      compositions(m - 1, [&](std::array<int, 4> d) {
        const auto [low, high] = interval_counts(m, d, block << m, false);
        CHECK(low == 2);
        CHECK(high == 2);
      });
}

TEST_CASE("Sobol's is a (3, 4)-sequence, and its first two coordinates a (0, 2)-sequence") {
  for (int m = 3; m <= 9; ++m)
    for (const std::uint64_t block : {0, 1, 5}) {
      compositions(m - 3, [&](std::array<int, 4> d) {
        CHECK(interval_counts(m, d, block << m, false, sobol) == std::pair(8, 8));
      });
      for (int a = 0; a <= m; ++a)
        CHECK(interval_counts(m, {a, m - a, 0, 0}, block << m, true, sobol) == std::pair(1, 1));
    }
}

TEST_CASE("scrambling keeps the elementary intervals") {
  compositions(6, [&](std::array<int, 4> d) {
    const auto [low, high] = interval_counts(7, d, 0, true);
    CHECK(low == 2);
    CHECK(high == 2);
  });
}

TEST_CASE("a scrambled digit depends on the digits above it only, and is flipped half the time") {
  for (int digit = 0; digit < 32; ++digit) {
    int flips = 0;
    const int trials = 4096;
    for (int i = 0; i < trials; ++i) {
      const auto x = std::uint32_t(mms::mix64(std::uint64_t(i)));
      const auto seed = std::uint32_t(mms::mix64(std::uint64_t(i) + 999999));
      const std::uint32_t a = owen_scramble(x, seed);
      const std::uint32_t below = digit < 31 ? (1u << (31 - digit)) - 1 : 0;
      CHECK((owen_scramble(x ^ below, seed) & ~below) == (a & ~below));
      flips += ((a ^ x) >> (31 - digit)) & 1;
    }
    // Binomial, 5 sigma: sqrt(4096) / 2 * 5 = 160; 32 digits, so a false alarm in 1e5 seeds.
    CHECK(std::abs(flips - trials / 2) < 160);
  }
}

TEST_CASE(
    "numbers are in [0, 1) and evenly spread, for every coordinate, over pixels and samples") {
  for (int coordinate : {0, 1, 2, 3, 4, 5, 6, 11, 200}) {
    constexpr int kBins = 64, kPixels = 64, kSamples = 64;
    std::array<int, kBins> count{};
    for (int pixel = 0; pixel < kPixels; ++pixel)
      for (int s = 0; s < kSamples; ++s) {
        const float u = Sampler(3, pixel % 8, pixel / 8, std::uint64_t(s))(coordinate);
        REQUIRE(u >= 0);
        REQUIRE(u < 1);
        ++count[int(u * kBins)];
      }
    double chi2 = 0;
    const double expected = double(kPixels) * kSamples / kBins;
    for (int c : count) chi2 += (c - expected) * (c - expected) / expected;
    // 63 degrees of freedom: mean 63, deviation 11.2; 5 of them. Stratified ones fall far below.
    CHECK(chi2 < 63 + 5 * 11.2);
  }
}

TEST_CASE(
    "the first four coordinates of a pixel are stratified: 64 samples, one or two in each of 32") {
  for (int coordinate = 0; coordinate < 4; ++coordinate) {
    std::array<int, 32> count{};
    for (int s = 0; s < 64; ++s) ++count[int(Sampler(1, 5, 9, std::uint64_t(s))(coordinate) * 32)];
    for (int c : count) CHECK(c == 2);  // t = 1: intervals of 2^-5 hold exactly 2 of 2^6
  }
}

TEST_CASE(
    "any pair beyond is a (0, 2)-net of each 2^k samples, and pairs know nothing of another") {
  for (const Generator g : {Generator::Niederreiter, Generator::Sobol})
    for (const int pair : {4, 8, 10, 12, 40})
      for (const std::uint64_t first : {0, 64, 1 << 20})
        for (int a = 0; a <= 6; ++a) {
          std::array<int, 64> count{};
          for (std::uint64_t n = first; n < first + 64; ++n) {
            const Sampler s(9, 4, 2, n, g);
            const int column = int(s(pair) * float(1 << a));
            const int row = int(s(pair + 1) * float(64 >> a));
            ++count[std::size_t(column * (64 >> a) + row)];
          }
          CHECK(std::ranges::all_of(count, [](int c) { return c == 1; }));
        }
  // Of four samples each half gets one of 0 and 1 and one of 2 and 3: two ways to do that, which in
  // two pairs agree half of the time. Binomial, 5 sigma: sqrt(4096) / 2 * 5 = 160.
  for (const auto& [a, b] : {std::pair(4, 8), {8, 10}, {8, 16}}) {
    int same = 0;
    constexpr int kPixels = 4096;
    for (int pixel = 0; pixel < kPixels; ++pixel) {
      int split_a = 0, split_b = 0;
      for (int n = 0; n < 4; ++n) {
        const Sampler s(11, pixel, 0, std::uint64_t(n));
        split_a = split_a << 1 | (s(a) < 0.5f);
        split_b = split_b << 1 | (s(b) < 0.5f);
      }
      same += split_a == split_b || split_a == (split_b ^ 15);
    }
    CAPTURE(same);
    CHECK(std::abs(same - kPixels / 2) < 160);
  }
}

TEST_CASE("a sample replays alone, and seeds, pixels and samples differ") {
  const Sampler a(1, 2, 3, 4);
  CHECK(a(7) == Sampler(1, 2, 3, 4)(7));
  CHECK(a(7) != Sampler(2, 2, 3, 4)(7));
  CHECK(a(7) != Sampler(1, 3, 2, 4)(7));
  CHECK(a(7) != Sampler(1, 2, 3, 5)(7));
  CHECK(a.hashed(0, 1) != a.hashed(1, 0));
}

TEST_CASE("every generator is a function into [0, 1) of seed, pixel, sample and coordinate") {
  for (int g = 0; g < int(generators().size()); ++g) {
    CAPTURE(generators()[std::size_t(g)].name);
    CHECK(generator_named(generators()[std::size_t(g)].name) == Generator(g));
    double sum = 0;
    constexpr int n = 4096;
    for (int i = 0; i < n; ++i)
      for (int coordinate = 0; coordinate < 5; ++coordinate) {
        const float u = Sampler(1, 2, 3, std::uint64_t(i), Generator(g))(coordinate);
        REQUIRE(u >= 0);
        REQUIRE(u < 1);
        CHECK(u == Sampler(1, 2, 3, std::uint64_t(i), Generator(g))(coordinate));
        sum += u;
      }
    // The mean of 5 n numbers of variance 1 / 12: five deviations.
    CHECK(std::abs(sum / (5 * n) - 0.5) < 5 / std::sqrt(12.0 * 5 * n));
  }
}

namespace {

/// Slope of log error over log samples, least squares over 2^first to 2^last samples; the error is
/// the root mean square over independent pixels of an integral over [-1, 1]^4 that is 0, as a mean.
template <class F>
double slope(Generator generator, int first, int last, F f) {
  constexpr int kPixels = 32;
  std::vector<double> squares(std::size_t(last) + 1, 0.0);
  for (int pixel = 0; pixel < kPixels; ++pixel) {
    double sum = 0;
    for (int m = first, i = 0; m <= last; ++m) {
      for (; i < 1 << m; ++i) {
        const Sampler s(5, pixel, 0, std::uint64_t(i), generator);
        const auto x = [&](int coordinate) { return 2 * double(s(coordinate)) - 1 + 0x1p-24; };
        sum += f(x(0), x(1), x(2), x(3));
      }
      squares[std::size_t(m)] += std::pow(sum / (1 << m), 2);
    }
  }
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int m = first; m <= last; ++m) {
    const double y = 0.5 * std::log2(squares[std::size_t(m)] / kPixels);
    sx += m, sy += y, sxx += m * m, sxy += m * y;
  }
  const double n = last - first + 1;
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace

TEST_CASE("thesis Figure 3.3: a smooth integral in 2D and one with jumps in 4D, slopes of error") {
  const auto smooth = [](double x, double y, double, double) { return std::atan(x + y); };
  const auto jumps = [](double x, double y, double z, double w) {
    return std::copysign(std::exp(x * x + y * y + z * z + w * w), x * y * z * w);
  };
  const int last = mms::kSanitized ? 10 : 14;
  const double random2 = slope(Generator::Random, 4, last, smooth);
  const double random4 = slope(Generator::Random, 4, last, jumps);
  // 32 pixels leave an error's logarithm within 1 / sqrt(64) = 18 % of a factor e: 0.1 of slope.
  CHECK(std::abs(random2 + 0.5) < 0.1);
  CHECK(std::abs(random4 + 0.5) < 0.1);
  for (const Generator g : {Generator::Niederreiter, Generator::Sobol}) {
    const double smooth_slope = slope(g, 4, last, smooth);
    const double jumps_slope = slope(g, 7, last, jumps);
    INFO(generators()[std::size_t(g)].name, ": ", smooth_slope, " and ", jumps_slope);
    // Owen 1997: -3/2 for what is smooth, up to logarithms. The jumps lie on edges of elementary
    // intervals, so they keep it once there are enough points for four coordinates.
    CHECK(smooth_slope < -1.25);
    CHECK(jumps_slope < -0.9);
  }
}
