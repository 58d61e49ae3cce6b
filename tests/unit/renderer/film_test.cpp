// SPDX-License-Identifier: Apache-2.0
#include "renderer/film.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "base/hash.h"

using namespace mms::renderer;

namespace {

double unit(std::uint64_t i) { return mms::to_unit(mms::mix64(i)); }

/// Samples of many magnitudes, anywhere on a film.
std::vector<FilmSample> some_samples(int width, int height, int count) {
  std::vector<FilmSample> samples;
  for (int k = 0; k < count; ++k) {
    const auto i = std::uint64_t(k) * 8;
    const double u = unit(i + 2);
    samples.push_back({width * unit(i),
                       height * unit(i + 1),
                       std::uint32_t(k % 40),
                       {std::exp2(40 * u - 20), std::exp2(30 * u - 20), -u}});
  }
  return samples;
}

bool same(const FilmSums& a, const FilmSums& b) {
  const auto equal = [](auto x, auto y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end());
  };
  bool all = equal(a.pixels(), b.pixels());
  for (int i = 0; i < 5; ++i) all &= equal(a.block(i), b.block(i));
  return all;
}

FilmSums one_pixel() { return {1, 1, FilterShape::Box}; }

FilmSample sample(double x, double y, double z) { return {0.5, 0.5, 0, {x, y, z}}; }

}  // namespace

TEST_CASE("sums have the same bits in any order and through any parts, with every filter") {
  for (const FilterInfo& filter : filters()) {
    CAPTURE(filter.name);
    const int width = 37, height = 21;
    std::vector<FilmSample> samples = some_samples(width, height, 3000);
    FilmSums forwards(width, height, filter.shape), backwards = forwards, merged = forwards;
    for (const FilmSample& s : samples) forwards.add(s);
    std::reverse(samples.begin(), samples.end());
    for (const FilmSample& s : samples) backwards.add(s);
    CHECK(same(forwards, backwards));
    // Parts: vertical strips, each with all that its samples can reach.
    for (int x0 : {24, 0, 12, 36}) {
      const int x1 = std::min(x0 + 12, width);
      FilmSums part(width, height, filter.shape,
                    {std::max(0, x0 - 1), 0, std::min(width, x1 + 1), height});
      for (const FilmSample& s : samples)
        if (s.x >= x0 && s.x < x1) part.add(s);
      merged.merge(part);
    }
    CHECK(same(forwards, merged));
    FilmSums more = forwards;
    more.add(samples[0]);
    CHECK_FALSE(same(forwards, more));
  }
}

TEST_CASE("a sample of every pixel's neighbourhood is one of one pixel with the box") {
  FilmSums film(3, 3, FilterShape::Box);
  for (double y : {0.0, 0.5, 0.999})
    for (double x : {1.0, 1.5, 1.999}) film.add({x, 1 + y, 0, {1, 1, 1}});
  CHECK(film.pixel(1, 1).samples == 9);
  CHECK(std::int64_t(film.pixel(1, 1).weight) == 9 << 24);
  for (const PixelSums& p : film.pixels())
    if (&p != &film.pixel(1, 1)) CHECK(p.weight == 0);
}

TEST_CASE("filters are the curves that they are called after") {
  // Integrals along one axis: 1; by erf, less the rectangle below its end; mean of the window.
  const double sigma = 0.5, r = 1.5, end = std::exp(-r * r / (2 * sigma * sigma));
  const double bell = sigma * std::sqrt(2 * std::acos(-1)) * std::erf(r / (sigma * std::sqrt(2)));
  const double expected[] = {1, (bell - 2 * r * end) / (1 - end), 3 * 0.35875};
  for (const FilterInfo& info : filters()) {
    CAPTURE(info.name);
    CHECK(filter_named(info.name) == info.shape);
    const Filter f(info.shape);
    // Weights are kept to 2^-12, so each is off by 2^-13 at most, or by 2^-12 where 1 is the least.
    const double along = expected[int(info.shape)];
    CHECK(std::abs(std::sqrt(f.integral()) - along) < 2 * info.radius * 0x1p-12);
    for (double d = 0; d < info.radius - 0.05; d += 0.05) CHECK(f.weight(d) >= f.weight(d + 0.05));
    CHECK(std::abs(f.weight(0) - 4096) <= 1);
    CHECK(f.weight(std::nextafter(info.radius, 0)) >= 1);
  }
  CHECK_FALSE(filter_named("tent"));
  CHECK(Filter(FilterShape::Box).sharing() == doctest::Approx(1).epsilon(1e-12));
  // Harris 1978, table 1: the equivalent noise bandwidth of the window is 2.00 bins.
  const double sharing = Filter(FilterShape::BlackmanHarris).sharing();
  CHECK(std::sqrt(sharing) == doctest::Approx(3 / 2.00).epsilon(0.005));
}

TEST_CASE("a constant picture is constant to the edge, and sharing is what variance falls by") {
  for (const FilterInfo& info : filters()) {
    CAPTURE(info.name);
    const int side = 64, n = 16;
    FilmSums constant(side, side, info.shape), noisy = constant;
    for (int k = 0; k < side * side * n; ++k) {
      const auto i = std::uint64_t(k) * 4;
      const double x = k % side + unit(i), y = k / side % side + unit(i + 1);
      const auto number = std::uint32_t(k / side / side);
      constant.add({x, y, number, {0.25, 0.5, 2}});
      noisy.add({x, y, number, {0, unit(i + 2), 0}});
    }
    for (const auto& xyz : constant.develop().xyz) {
      CHECK(xyz[0] == doctest::Approx(0.25).epsilon(1e-12));
      CHECK(xyz[2] == doctest::Approx(2).epsilon(1e-12));
    }
    const Film film = noisy.develop();
    double spread = 0, stated = 0;
    int inside = 0;
    for (int y = 2; y < side - 2; ++y)
      for (int x = 2; x < side - 2; ++x, ++inside) {
        const double d = film.xyz[std::size_t(y * side + x)][1] - 0.5;
        spread += d * d;
        stated += film.variance[std::size_t(y * side + x)];
      }
    // 3600 pixels, of which neighbours share: four standard errors of a sum of 3600 / 9 squares,
    // and the noise of weights (one part in n) that the formula leaves out.
    CHECK(spread / stated == doctest::Approx(1).epsilon(4 * std::sqrt(2.0 / (inside / 9)) + 0.06));
  }
}

TEST_CASE("mean and variance are those of the textbook, in long double") {
  FilmSums film = one_pixel();
  long double sum = 0, squares = 0;
  const int n = 5000;
  std::vector<double> ys;
  for (int i = 0; i < n; ++i) ys.push_back(100 + unit(std::uint64_t(i)));
  for (double y : ys) {
    film.add(sample(0, y, 0));
    sum += y;
  }
  const long double mean = sum / n;
  for (double y : ys) squares += (y - mean) * (y - mean);
  const Film f = film.develop();
  CHECK(f.xyz[0][1] == doctest::Approx(double(mean)).epsilon(1e-13));
  // The squares are kept to 2^-40 each and differ from n mean^2 by 1 part in 1e5 of them.
  CHECK(f.variance[0] == doctest::Approx(double(squares / (n - 1) / n)).epsilon(1e-9));
}

TEST_CASE("what cannot be added is told apart, counts as black, and leaves the sums alone") {
  FilmSums film = one_pixel();
  CHECK(film.add(sample(1, 1, 1)) == SampleFate::Added);
  const PixelSums before = film.pixel(0, 0);
  CHECK(film.add(sample(std::nan(""), 0, 0)) == SampleFate::NotANumber);
  CHECK(film.add(sample(0, std::numeric_limits<double>::infinity(), 0)) == SampleFate::Infinite);
  CHECK(film.add(sample(0, 0, 1e30)) == SampleFate::Overflow);
  const PixelSums after = film.pixel(0, 0);
  CHECK((after.xyz[0] == before.xyz[0]));
  CHECK((after.luminance_square == before.luminance_square));
  CHECK(after.weight == 4 * before.weight);
  CHECK(after.samples == 4);
  CHECK(after.dropped == 3);
}

TEST_CASE("the brightest and the darkest sample both count in sums of many") {
  FilmSums film = one_pixel();
  const double brightest = std::nextafter(0x1p32, 0);
  const int n = 100000;
  for (int i = 0; i < n; ++i) film.add(sample(brightest, brightest, brightest));
  film.add(sample(0x1p-40, 0x1p-40, 0x1p-40));
  // n (2^32 - 2^-21) 2^64 + 2^24: a double has 53 digits, the largest product 96 and n 17 more.
  const Int128 expected = ((Int128(1) << 72) - (Int128(1) << 19)) * (Int128(n) << 24) + (1 << 24);
  CHECK((film.pixel(0, 0).xyz[0] == expected));
  CHECK((film.pixel(0, 0).luminance_square > 0));
  // Squares of as many samples as a render may have still fit: none is above 2^38.
  CHECK(double(film.pixel(0, 0).luminance_square) == doctest::Approx(n * 0x1p102).epsilon(1e-12));
}

TEST_CASE("each block of samples is as large as all before it") {
  std::uint32_t begin = 0;
  for (int b = 0; b < 23; ++b) {
    CHECK(block_of(begin) == b);
    CHECK(block_of(block_end(b) - 1) == b);
    if (b > 0) CHECK(block_end(b) == 2 * begin);
    begin = block_end(b);
  }
}
