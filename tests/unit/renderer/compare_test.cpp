// SPDX-License-Identifier: Apache-2.0
#include "renderer/compare.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "materials/colour.h"

using namespace mms::renderer;
using doctest::Approx;

namespace {

ReadPicture flat(std::array<float, 3> rgb, int width = 20, int height = 14) {
  return {width, height, std::vector(std::size_t(width * height), rgb), {}, {}, false};
}

Comparison compared(const ReadPicture& a, const ReadPicture& b, std::optional<Rect> part = {}) {
  const auto c = compare(a, b, {.curve = Curve::Srgb}, part);
  REQUIRE(bool(c));
  return *c;
}

}  // namespace

TEST_CASE("flat pictures differ as the formulas say") {
  const auto a = flat({0.6f, 0.4f, 0.8f}), b = flat({0.5f, 0.2f, 0.5f});
  const Comparison c = compared(a, b);
  // Thesis 7.1: 0.21 dR + 0.72 dG + 0.07 dB.
  CHECK(c[Measure::Rmse] == Approx(0.21 * 0.1 + 0.72 * 0.2 + 0.07 * 0.3).epsilon(1e-5));
  CHECK(c.channel[1] == Approx(0.2).epsilon(1e-5));
  CHECK(c.largest == Approx(0.3).epsilon(1e-5));
  CHECK(c[Measure::RelativeMse] ==
        Approx((0.01 / 0.26 + 0.04 / 0.05 + 0.09 / 0.26) / 3).epsilon(1e-5));
  const auto e = [](double v) { return mms::materials::srgb_encode(v); };
  const double shown =
      0.21 * (e(0.6) - e(0.5)) + 0.72 * (e(0.4) - e(0.2)) + 0.07 * (e(0.8) - e(0.5));
  CHECK(c[Measure::RmseShown] == Approx(shown).epsilon(1e-4));
  // Structural similarity of flat pictures is that of their means.
  const double la = 0.21 * e(0.6) + 0.72 * e(0.4) + 0.07 * e(0.8);
  const double lb = 0.21 * e(0.5) + 0.72 * e(0.2) + 0.07 * e(0.5);
  CHECK(c[Measure::Dssim] ==
        Approx(1 - (2 * la * lb + 1e-4) / (la * la + lb * lb + 1e-4)).epsilon(1e-4));
  CHECK_FALSE(c.z);
  CHECK(c.not_finite == 0);
  for (const float v : c.map) CHECK(double(v) == Approx(shown).epsilon(1e-4));
}

TEST_CASE("equal pictures do not differ, by any measure; the worst similarity is of opposites") {
  ReadPicture a = flat({0, 0, 0});
  std::mt19937 random(3);
  for (auto& p : a.rgb)
    for (float& v : p) v = float(random() % 1000) / 999;
  ReadPicture opposite = a;
  for (auto& p : opposite.rgb)
    for (float& v : p)
      v = float(mms::materials::srgb_decode(1 - mms::materials::srgb_encode(double(v))));
  const Comparison same = compared(a, a), other = compared(a, opposite);
  for (const MeasureInfo& m : measures()) {
    CAPTURE(m.name);
    CHECK(same[m.measure] < 1e-12);
    CHECK(other[m.measure] > 0.1);
  }
  CHECK(other[Measure::Dssim] > 1);  // the covariance is negative
}

TEST_CASE("only the part asked for is compared") {
  const auto a = flat({0.5f, 0.5f, 0.5f});
  ReadPicture b = a;
  b.rgb[3 * 20 + 7] = {1, 1, 1};
  CHECK(compared(a, b, Rect{0, 0, 7, 14})[Measure::Rmse] == 0);
  CHECK(compared(a, b, Rect{7, 3, 8, 4})[Measure::Rmse] == Approx(0.5));
  CHECK(compared(a, b)[Measure::Rmse] == Approx(0.5 / std::sqrt(280.0)));
  CHECK_FALSE(bool(compare(a, b, {}, Rect{0, 0, 21, 14})));
  CHECK_FALSE(bool(compare(a, b, {}, Rect{5, 5, 5, 6})));
  CHECK_FALSE(bool(compare(a, flat({0, 0, 0}, 14, 20), {})));
}

TEST_CASE("z is 1 for noise of the variance that is stated") {
  constexpr int kSide = 100;
  ReadPicture a = flat({0.5f, 0.5f, 0.5f}, kSide, kSide), b = a;
  std::mt19937 random(5);
  for (ReadPicture* p : {&a, &b}) {
    const double deviation = p == &a ? 0.03 : 0.04;
    std::normal_distribution<double> noise(0, deviation);
    for (auto& rgb : p->rgb) rgb.fill(float(0.5 + noise(random)));
    p->variance.assign(kSide * kSide, float(deviation * deviation));
  }
  // The mean of 10^4 squares has a relative deviation of sqrt(2 / 10^4), its root half of that.
  CHECK(*compared(a, b).z == Approx(1).epsilon(4 * 0.0071));
  for (auto& rgb : a.rgb) rgb[1] += 0.1f;  // luminance 0.0715, against 0.05
  CHECK(*compared(a, b).z > 1.6);
}

TEST_CASE("pixels that are not finite are counted where they differ, and left out") {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  auto a = flat({1, 1, 1}), b = a;
  a.rgb[0] = b.rgb[0] = {kInf, kInf, kInf};
  a.rgb[1] = {std::nanf(""), 0, 0};
  b.rgb[2] = {kInf, 0, 0};
  const Comparison c = compared(a, b);
  CHECK(c.not_finite == 2);
  CHECK(c[Measure::Rmse] == 0);
}
