// SPDX-License-Identifier: Apache-2.0
// Photometric files (IES LM-63): what they say, how they are mirrored, and what is wrong with bad
// ones.
#include "materials/photometry.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

using namespace mms;
using materials::Photometry;

namespace {

/// A file with these horizontal angles over vertical ones of 0, 90 and 180 degrees.
std::string file(const std::string& horizontal, int columns, const std::string& candela) {
  return "IESNA:LM-63-2002\r\n[TEST] made up\r\n[MANUFAC] nobody\r\nTILT=NONE\r\n2 1000 1.5 3 " +
         std::to_string(columns) + " 1 2 0.1 0.1 0\r\n0.5 1 40\r\n0 90 180\r\n" + horizontal +
         "\r\n" + candela + "\r\n";
}

Photometry read(const std::string& text) {
  auto p = Photometry::parse(text);
  REQUIRE_MESSAGE(p, p.error().what);
  return *p;
}

}  // namespace

TEST_CASE("a lamp that is alike all around") {
  const Photometry p = read(file("0", 1, "100 40 0"));
  CHECK(p.lumens() == 2000);
  CHECK(p.watts() == 40);
  CHECK(p.largest() == 75);  // times multiplier and ballast factor
  for (double h : {-1000.0, 0.0, 77.0, 360.0}) {
    CHECK(p.intensity(h, 0) == 75);
    CHECK(p.intensity(h, 45) == doctest::Approx(0.75 * 70));
    CHECK(p.intensity(h, 90) == doctest::Approx(30));
    CHECK(p.intensity(h, 180) == 0);
    CHECK(p.slope(h, 45).horizontal == 0);
    CHECK(p.slope(h, 45).vertical == doctest::Approx(-45.0 / 90));
  }
}

TEST_CASE("halves and quarters are mirrored") {
  struct Row {
    const char* horizontal;
    int columns;
    const char* candela;
    double at[8];  ///< at 0, 45, 90, ... degrees and the vertical angle of 90
  };
  // The value at 90 degrees of one column after the other.
  const Row rows[] = {{"0 90", 2, "0 10 0  0 30 0", {10, 20, 30, 20, 10, 20, 30, 20}},
                      {"0 90 180", 3, "0 10 0  0 30 0  0 50 0", {10, 20, 30, 40, 50, 40, 30, 20}},
                      {"90 180 270", 3, "0 10 0  0 30 0  0 50 0", {30, 20, 10, 20, 30, 40, 50, 40}},
                      {"0 90 180 270 360",
                       5,
                       "0 10 0  0 30 0  0 50 0  0 90 0  0 10 0",
                       {10, 20, 30, 40, 50, 70, 90, 50}}};
  for (const Row& row : rows) {
    const Photometry p = read(file(row.horizontal, row.columns, row.candela));
    for (int k = 0; k < 8; ++k)
      for (double turn : {-360.0, 0.0, 720.0}) {
        const double h = 45.0 * k + turn;
        CHECK_MESSAGE(p.intensity(h, 90) == doctest::Approx(0.75 * row.at[k]), row.horizontal, " ",
                      h);
        // The slope between two angles is the difference across.
        const double d = 1e-3, mid = h + 11;
        CHECK(p.slope(mid, 70).horizontal ==
              doctest::Approx((p.intensity(mid + d, 70) - p.intensity(mid - d, 70)) / (2 * d))
                  .epsilon(1e-6));
        CHECK(p.slope(mid, 70).vertical ==
              doctest::Approx((p.intensity(mid, 70 + d) - p.intensity(mid, 70 - d)) / (2 * d))
                  .epsilon(1e-6));
      }
  }
}

TEST_CASE("files of 1986 have no first line, commas part numbers, and a tilt is skipped") {
  const Photometry p = read(
      "ACME lamp\nTILT=INCLUDE\n1\n3\n0 45 90\n1.0 .95 .9\n1,-1,1,2,1,1,1,0,0,0\n1,1,+8.5\n0,90\n"
      "0\n3.5e1 1.0\n");
  CHECK(p.lumens() == -1);
  CHECK(p.watts() == 8.5);
  CHECK(p.intensity(0, 0) == 35);
  CHECK(p.intensity(0, 91) == 0);  // the file ends at 90
  CHECK(read("TILT=lamp.tlt\n1 1 1 1 1 1 1 0 0 0\n1 1 1\n0\n0\n7").intensity(5, 0) == 7);
}

TEST_CASE("what is wrong is told with its line") {
  const auto wrong = [](const std::string& text) {
    const auto p = Photometry::parse(text);
    CHECK(!p);
    return p ? std::string() : p.error().what;
  };
  CHECK(wrong("") == "line 1: there is no line `TILT=`");
  CHECK(wrong("hello\nworld\n") == "line 2: there is no line `TILT=`");
  CHECK(wrong("TILT=NONE\n1 1000 x") == "line 2: expected the multiplier of candela, found `x`");
  CHECK(wrong("TILT=NONE\n1 1000 1\n\n-3") ==
        "line 4: the number of vertical angles is not in 1 .. 10000");
  CHECK(wrong("TILT=NONE\n1 1000 1 3 1e9") ==
        "line 2: the number of horizontal angles is not in 1 .. 10000");
  CHECK(wrong("TILT=NONE\n1 1000 1 3 1 2") == "line 2: the photometric type is not 1 (type C)");
  CHECK(wrong("TILT=NONE\n1 1 0 1 1 1 1 0 0 0\n1 1 1") ==
        "line 3: multiplier times ballast factor is not above 0");
  const std::string good = file("0 90", 2, "1 2 3 4 5 6");
  for (std::size_t n = 0; n + 3 < good.size(); ++n)  // cut anywhere
    CHECK(wrong(good.substr(0, n)).starts_with("line "));
  CHECK(wrong(file("0 90", 2, "1 2 3 4 5")) == "line 9: the file ends before candela");
  CHECK(wrong(file("0 100", 2, "1 2 3 4 5 6")).starts_with("line 8: the horizontal angles"));
  CHECK(wrong(file("0 0", 2, "1 2 3 4 5 6")).starts_with("line 8: the horizontal angles"));
  CHECK(wrong(file("0", 1, "1 -2 3")) == "line 9: candela are below 0");
  CHECK(wrong(file("0", 1, "1 1e999 3")).starts_with("line 9: expected candela"));
  CHECK(wrong(file("0", 1, "1 nan 3")).starts_with("line 9: expected candela"));
}
