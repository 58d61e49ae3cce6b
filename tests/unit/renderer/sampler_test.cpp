// SPDX-License-Identifier: Apache-2.0
#include "renderer/sampler.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace mms::renderer;

namespace {

/// Points in each elementary interval of sides 2^-d[0] x ... : all counts, by brute force.
std::pair<int, int> interval_counts(int m, std::array<int, 4> d, std::uint64_t first,
                                    bool scrambled) {
  std::vector<int> count(std::size_t(1) << (d[0] + d[1] + d[2] + d[3]));
  for (std::uint64_t n = first; n < first + (1u << m); ++n) {
    std::size_t cell = 0;
    for (int k = 0; k < 4; ++k) {
      std::uint32_t x = nx4(n, k);
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

TEST_CASE("a sample replays alone, and seeds, pixels and samples differ") {
  const Sampler a(1, 2, 3, 4);
  CHECK(a(7) == Sampler(1, 2, 3, 4)(7));
  CHECK(a(7) != Sampler(2, 2, 3, 4)(7));
  CHECK(a(7) != Sampler(1, 3, 2, 4)(7));
  CHECK(a(7) != Sampler(1, 2, 3, 5)(7));
  CHECK(a.hashed(0, 1) != a.hashed(1, 0));
}
