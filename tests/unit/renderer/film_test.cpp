// SPDX-License-Identifier: Apache-2.0
#include "renderer/film.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/hash.h"

using namespace mms::renderer;

TEST_CASE("sums have the same bits in any order") {
  std::vector<std::array<double, 3>> samples;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const double u = mms::to_unit(mms::mix64(i));
    samples.push_back({std::exp2(40 * u - 20), std::exp2(30 * u - 20), -u});
  }
  PixelSums forwards, backwards;
  for (const auto& s : samples) add_sample(forwards, s);
  std::reverse(samples.begin(), samples.end());
  for (const auto& s : samples) add_sample(backwards, s);
  for (int k = 0; k < 3; ++k) CHECK((forwards.xyz[k] == backwards.xyz[k]));
  CHECK((forwards.luminance_square == backwards.luminance_square));
}

TEST_CASE("mean and variance are those of the textbook, in long double") {
  FilmSums film(1, 1);
  long double sum = 0, squares = 0;
  const int n = 5000;
  std::vector<double> ys;
  for (int i = 0; i < n; ++i) ys.push_back(100 + mms::to_unit(mms::mix64(std::uint64_t(i))));
  for (double y : ys) {
    add_sample(film.pixel(0, 0), {0, y, 0});
    sum += y;
  }
  const long double mean = sum / n;
  for (double y : ys) squares += (y - mean) * (y - mean);
  const Film f = film.develop();
  CHECK(f.xyz[0][1] == doctest::Approx(double(mean)).epsilon(1e-14));
  // The squares are kept to 2^-48 each and differ from n mean^2 by 1 part in 1e5 of them.
  CHECK(f.variance[0] == doctest::Approx(double(squares / (n - 1) / n)).epsilon(1e-9));
}

TEST_CASE(
    "what cannot be added is told apart, counts as a black sample, and leaves the sums alone") {
  PixelSums sums;
  CHECK(add_sample(sums, {1, 1, 1}) == SampleFate::Added);
  const PixelSums before = sums;
  CHECK(add_sample(sums, {std::nan(""), 0, 0}) == SampleFate::NotANumber);
  CHECK(add_sample(sums, {0, std::numeric_limits<double>::infinity(), 0}) == SampleFate::Infinite);
  CHECK(add_sample(sums, {0, 0, 1e30}) == SampleFate::Overflow);
  CHECK((sums.xyz[0] == before.xyz[0]));
  CHECK((sums.luminance_square == before.luminance_square));
  CHECK(sums.samples == 4);
}

TEST_CASE("a hundred million samples lose nothing") {
  PixelSums sums;
  add_sample(sums, {1, 1, 1});
  const PixelSums one = sums;
  for (int k = 0; k < 3; ++k) sums.xyz[k] = one.xyz[k] * 100000000;
  add_sample(sums, {0x1p-60, 0, 0});
  CHECK((sums.xyz[0] - one.xyz[0] * 100000000 == 16));  // 2^-60 in units of 2^-64
}
