// SPDX-License-Identifier: Apache-2.0
// Tables of text files: what is read, what is refused and how it is told, and the curve between
// the rows against a sum written out here.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "materials/curve.h"
#include "vm/interval.h"

using namespace mms;
using vm::ImageAsk;
using vm::ImageUse;

namespace {

ImageUse use_of(const std::string& unit = "nm", const std::string& column = "") {
  return {"t.csv", std::string(vm::kCurveFilter), "", unit, column, ""};
}

std::shared_ptr<const vm::Image> read(std::string_view text, const ImageUse& use = use_of()) {
  auto curve = materials::read_curve(text, use);
  REQUIRE_MESSAGE(curve, curve.error().what);
  return *curve;
}

double at(const vm::Image& curve, double metres, ImageAsk ask = ImageAsk::Curve) {
  double result = 0;
  const double* const in = &metres;
  double* const out = &result;
  curve.look_up64(ask, &in, &out, 1);
  return result;
}

std::string refused(std::string_view text, const ImageUse& use = use_of()) {
  const auto curve = materials::read_curve(text, use);
  REQUIRE(!curve);
  CHECK(curve.error().where == "t.csv");
  CHECK(!curve.error().hint.empty());
  return curve.error().what;
}

}  // namespace

TEST_CASE("tables: separators, remarks, byte order marks and names of columns") {
  for (const char* text :
       {"400,1\n500,3\n", "400 1\n500 3", "400\t1\r\n500\t3\r\n", "400;1\n500;3\n",
        "  400 , 1\n\n# remark\n500,3 # remark\n", "\xef\xbb\xbfnm,value\n400,1\n500,3\n",
        "// remark\n400.0,+1\n5e2,3e0\n", "\"nm\" \"value\"\n400 1\n500 3\n"}) {
    CAPTURE(text);
    const auto curve = read(text);
    CHECK(at(*curve, 450e-9) == doctest::Approx(2).epsilon(1e-12));
  }
}

TEST_CASE("tables: units, columns by place and by name, and several tables in a file") {
  CHECK(at(*read("0.4 1\n0.5 3", use_of("um")), 450e-9) == doctest::Approx(2).epsilon(1e-12));
  CHECK(at(*read("400e-9 1\n500e-9 3", use_of("m")), 450e-9) == doctest::Approx(2).epsilon(1e-12));
  const char* columns = "nm,n,k\n400,1,5\n500,3,7\n";
  CHECK(at(*read(columns), 450e-9) == doctest::Approx(2));
  CHECK(at(*read(columns, use_of("nm", "n")), 450e-9) == doctest::Approx(2));
  CHECK(at(*read(columns, use_of("nm", "k")), 450e-9) == doctest::Approx(6));
  CHECK(at(*read(columns, use_of("nm", "2")), 450e-9) == doctest::Approx(6));
  CHECK(at(*read(columns, use_of("nm", "0")), 450e-9) == doctest::Approx(450));
  // As databases of refractive indices write them: n, then k at wavelengths of its own.
  const char* two = "wl,n\n0.4,1\n0.5,3\n\nwl,k\n0.3,5\n0.6,8\n";
  CHECK(at(*read(two, use_of("um", "n")), 450e-9) == doctest::Approx(2));
  CHECK(at(*read(two, use_of("um", "k")), 450e-9) == doctest::Approx(6.5));
}

TEST_CASE("tables: straight between rows, level outside, with slopes, floats and bounds") {
  const double nm[] = {380, 401.5, 402, 555, 700, 780}, value[] = {0.5, -1, 2, 0.25, 0.75, 0.1};
  std::string text;
  for (int k = 0; k < 6; ++k) text += std::to_string(nm[k]) + "," + std::to_string(value[k]) + "\n";
  const auto curve = read(text);
  // The rows' bends, each from its place on: another form than the interpolation that is tested.
  const auto expected = [&](double x) {
    double sum = value[0];
    for (int k = 0; k < 5; ++k)
      sum += (value[k + 1] - value[k]) *
             std::min(std::max((x - nm[k]) / (nm[k + 1] - nm[k]), 0.0), 1.0);
    return sum;
  };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> anywhere(300, 900);
  for (int i = 0; i < 2000; ++i) {
    const double a = anywhere(random), b = i % 2 ? a + 1 : anywhere(random);
    const double lo = std::min(a, b), hi = std::max(a, b);
    // A step between rows is 6 for each nm: 10^-9 of a wavelength is 5e-6 of the value.
    CHECK(at(*curve, a * 1e-9) == doctest::Approx(expected(a)).epsilon(1e-8));
    const float narrow = float(a * 1e-9);
    const float* const in = &narrow;
    float found = 0;
    float* const out = &found;
    curve->look_up(ImageAsk::Curve, &in, &out, 1);
    CHECK(double(found) == double(float(at(*curve, double(narrow)))));
    const double h = 1e-4;
    double bend = 1e9;
    for (const double row : nm) bend = std::min(bend, std::abs(a - row));
    if (bend > 2 * h)
      CHECK(at(*curve, a * 1e-9, ImageAsk::CurveSlope) * 1e-9 ==
            doctest::Approx((expected(a + h) - expected(a - h)) / (2 * h)).epsilon(1e-6));
    for (const ImageAsk ask : {ImageAsk::Curve, ImageAsk::CurveSlope}) {
      const vm::Interval box{lo * 1e-9, hi * 1e-9, false};
      vm::Interval bounds;
      curve->enclose(ask, &box, &bounds);
      double least = 1e30, most = -1e30;
      for (int s = 0; s <= 40; ++s) {
        const double y = at(*curve, std::lerp(lo, hi, s / 40.0) * 1e-9, ask);
        least = std::min(least, y);
        most = std::max(most, y);
        CHECK(bounds.contains(y));
      }
      if (i % 2 && ask == ImageAsk::Curve) {  // and no wider than a step's change of the samples
        CHECK(bounds.lo > least - 0.16);
        CHECK(bounds.hi < most + 0.16);
      }
    }
  }
  CHECK(at(*curve, 0) == 0.5);
  CHECK(at(*curve, -1) == 0.5);
  CHECK(at(*curve, std::numeric_limits<double>::quiet_NaN()) == 0.5);
  CHECK(at(*curve, std::numeric_limits<double>::infinity()) == 0.1);
  double low, high;
  curve->range(low, high);
  CHECK((low == -1 && high == 2));
}

TEST_CASE("tables: what is broken is told with its line, and what to try") {
  CHECK(refused("400,1\n4x0,2\n") == "is broken: line 2: `4x0` is no number");
  CHECK(refused("400,1\n450,nan\n") == "is broken: line 2: `nan` is no number");
  CHECK(refused("400;0,5\n500;0,7\n") == "is broken: line 1: `0,5` is no number");
  CHECK(refused("400,1\n\n450\n") == "is broken: line 3: there is a wavelength, and no value");
  CHECK(refused("400,1\n450,,2\n") == "is broken: line 2: `` is no number");
  CHECK(refused("400,1\n450,1,2\n") == "is broken: line 2: there are 3 numbers, and 2 above");
  CHECK(refused("450,1\n400,1\n") == "is broken: line 2: the wavelength 400 comes after 450");
  CHECK(refused("") == "has no rows");
  CHECK(refused("wavelength value\n# none\n") == "has no rows");
  CHECK(refused("0.4,1\n0.5,2\n") == "has no wavelength of light: it goes from 0.4 to 0.5 nm");
  CHECK(refused("nm,n\n400,1\n500,2\n", use_of("nm", "k")) == "has no column `k`");
  CHECK(refused("400,1\n500,2\n", use_of("nm", "2")) == "has no column `2`");
  CHECK(refused(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16)) == "has no rows");
}
