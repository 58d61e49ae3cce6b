// SPDX-License-Identifier: Apache-2.0
// Colour and spectra against published chromaticities and tables.
#include "materials/colour.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "materials/optical_tables.h"
#include "materials/spectra.h"
#include "tests/stats/distributions.h"
#include "tests/stats/random.h"

using namespace mms;
using namespace mms::materials;

namespace {

struct Chromaticity {
  double x, y;
};

template <class F>
Chromaticity chromaticity(F f) {
  const Vec3d v = xyz_of_spectrum(f);
  const double s = v.x + v.y + v.z;
  return {v.x / s, v.y / s};
}

}  // namespace

TEST_CASE("chromaticities of white") {
  const auto e = chromaticity([](double) { return 1.0; });
  CHECK(std::abs(e.x - 1.0 / 3) < 5e-5);
  CHECK(std::abs(e.y - 1.0 / 3) < 5e-5);
  // CIE 15: D65 (0.31272, 0.32903), A (0.44758, 0.40745).
  const auto d = chromaticity(illuminant_d65);
  CHECK(std::abs(d.x - 0.31272) < 5e-5);
  CHECK(std::abs(d.y - 0.32903) < 5e-5);
  const auto a = chromaticity(illuminant_a);
  CHECK(std::abs(a.x - 0.44758) < 5e-5);
  CHECK(std::abs(a.y - 0.40745) < 5e-5);
  CHECK(illuminant_d65(560) == doctest::Approx(1).epsilon(1e-9));
  CHECK(xyz_of_spectrum([](double l) {
          return illuminant_d65(l) / illuminant_d65_luminance();
        }).y == doctest::Approx(1));
  CHECK(cie1931_integral().y == doctest::Approx(106.857).epsilon(1e-5));
}

TEST_CASE("black bodies") {
  // The Planckian locus of the CIE 1931 observer (Wyszecki and Stiles 1982, table 1(3.11) and the
  // equal tables of CIE 15): four digits.
  const double locus[][3] = {{1000, 0.6528, 0.3444}, {2000, 0.5267, 0.4133},
                             {2856, 0.4475, 0.4074}, {4000, 0.3805, 0.3768},
                             {6500, 0.3135, 0.3237}, {10000, 0.2807, 0.2884}};
  for (const auto& row : locus) {
    const auto c = chromaticity([&](double l) { return planck(l, row[0]); });
    // The locus is tabulated with c2 = 1.4388e-2: one unit of its last digit.
    CHECK_MESSAGE(std::abs(c.x - row[1]) < 1.5e-4, row[0], ": ", c.x);
    CHECK_MESSAGE(std::abs(c.y - row[2]) < 1.5e-4, row[0], ": ", c.y);
  }
  // Stefan and Boltzmann: pi times the integral over wavelength.
  double sum = 0;
  for (double l = 100; l < 1e6; l *= 1.001) sum += planck(l * std::sqrt(1.001), 3000.0) * l * 0.001;
  CHECK(sum * std::numbers::pi == doctest::Approx(5.670374419e-8 * 81e12).epsilon(1e-4));
}

TEST_CASE("Planck in float") {
  double worst = 0;
  for (float t : {1.0f, 20.0f, 100.0f, 300.0f, 310.0f, 1000.0f, 6500.0f, 1e5f, 1e9f, 1e20f})
    for (float l : {360.0f, 555.5f, 830.0f, 1e4f, 1e6f}) {
      const long double x = 1.438776877503934e7L / l / t;
      const long double truth = 1.191042972397188e20L / std::pow((long double)l, 5) / std::expm1(x);
      const float got = planck(l, t);
      CHECK(std::isfinite(got));
      if (truth < 1e-36L || truth > 1e38L) continue;
      // Below, x up to about 130 is known to 1.5 ulp: exp turns that into 130 1.5 6e-8.
      worst = std::max(worst, double(std::abs(got - truth) / truth));
      CHECK_MESSAGE(std::abs(got - truth) < 1.5e-5L * truth, t, " ", l);
    }
  MESSAGE("planck in float: largest relative error ", worst);
  CHECK(planck(500.0f, 0.0f) == 0);
  CHECK(planck(500.0f, -5.0f) == 0);
}

TEST_CASE("the RGB basis") {
  for (double l = 360; l <= 830; l += 0.5) {
    const double r = rgb_red(l), g = rgb_green(l), b = 1 - (r + g);
    CHECK(r >= 0);
    CHECK(g >= 0);
    CHECK(b >= 0);
    // White is 1 exactly: r + g + (1 - (r + g)).
    CHECK((r + g) + b == 1);
  }
  CHECK(rgb_red(400.0) == 0.165);
  CHECK(rgb_red(500.0) == 0);
  CHECK(rgb_red(700.0) == 1);
  CHECK(rgb_green(480.0) == doctest::Approx(0.416).epsilon(0.01));
  CHECK(rgb_green(550.0) == 1);
  // Thesis (6.1): lit by D65, a colour comes back with its hue: the order of its channels.
  const Vec3d colours[] = {{0.8, 0.2, 0.1}, {0.1, 0.7, 0.3}, {0.1, 0.2, 0.9},
                           {0.6, 0.5, 0.1}, {0.5, 0.1, 0.6}, {0.4, 0.4, 0.4}};
  double worst = 0;
  for (const Vec3d& c : colours) {
    const Vec3d xyz = xyz_of_spectrum([&](double l) {
      const double r = rgb_red(l), g = rgb_green(l);
      return (c.x * r + c.y * g + c.z * (1 - (r + g))) * illuminant_d65(l) /
             illuminant_d65_luminance();
    });
    const Vec3d back = linear_srgb_of_xyz(xyz);
    for (int i = 0; i < 3; ++i) {
      worst = std::max(worst, std::abs(back[i] - c[i]));
      for (int k = 0; k < 3; ++k)
        if (c[i] > c[k] + 0.05) CHECK(back[i] > back[k]);
    }
  }
  MESSAGE("RGB to spectrum and back under D65: largest channel error ", worst);
}

TEST_CASE("sRGB") {
  // The matrix from the standard's primaries and white, solved here.
  const double p[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
  const Vec3d white{0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290};
  Vec3d column[3];
  for (int i = 0; i < 3; ++i) column[i] = {p[i][0] / p[i][1], 1, (1 - p[i][0] - p[i][1]) / p[i][1]};
  const double det = dot(column[0], cross(column[1], column[2]));
  for (int i = 0; i < 3; ++i) {
    const double s = dot(white, cross(column[(i + 1) % 3], column[(i + 2) % 3])) / det;
    const Vec3d unit{i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
    const Vec3d got = xyz_of_linear_srgb(unit);
    CHECK(length(got - column[i] * s) < 1e-12);
    CHECK(length(linear_srgb_of_xyz(got) - unit) < 1e-12);
  }
  for (double v : {0.0, 0.001, 0.0031308, 0.01, 0.5, 1.0})
    CHECK(srgb_decode(srgb_encode(v)) == doctest::Approx(v).epsilon(1e-9));
  CHECK(srgb_encode(0.5) == doctest::Approx(0.735357).epsilon(1e-5));
}

TEST_CASE("tone mapping is finite, keeps luminance and the order of channels") {
  stats::Random random(4);
  for (int i = 0; i < 20000; ++i) {
    const double scale = std::pow(10, random.between(-8, 8));
    const Vec3d in = cie1931(random.between(370, 780)) * random.next() +
                     cie1931(random.between(370, 780)) * random.next();
    const Vec3d xyz = in * scale;
    const Vec3d out = tone_map(xyz, 1.3, 0.9);
    const double y = map_luminance(xyz.y, 1.3, 0.9);
    for (int k = 0; k < 3; ++k) {
      CHECK(out[k] >= 0);
      CHECK(out[k] <= 1);
    }
    CHECK(std::abs(xyz_of_linear_srgb(out).y - y) < 1e-12);
    const Vec3d rgb = linear_srgb_of_xyz(xyz);
    for (int k = 0; k < 3; ++k)
      if (rgb[k] > rgb[(k + 1) % 3]) CHECK(out[k] >= out[(k + 1) % 3] - 1e-12);
  }
  CHECK(tone_map({0, 0, 0}, 1, 1) == Vec3d{});
  CHECK(tone_map({1, NAN, 1}, 1, 1) == Vec3d{});
  CHECK(tone_map({NAN, 1, 1}, 1, 1) == Vec3d{});
  CHECK(tone_map({1e300, INFINITY, 1e300}, 1, 1) == Vec3d{1, 1, 1});
  double before = -1;
  for (double y = 1e-6; y < 1e6; y *= 1.1) {
    const double mapped = map_luminance(y, 1, 1.2);
    CHECK(mapped >= before);
    before = mapped;
  }
  CHECK(map_luminance(1, 1, 1) == doctest::Approx(0.5));
}

TEST_CASE("samples of a cluster estimate XYZ") {
  stats::Moments y;
  Vec3d sum;
  for (int i = 0; i < 4000; ++i) {
    const Vec3d v = xyz_of_cluster(sample_wavelengths((i + 0.5) / 4000), Spectrumf(1.0f));
    sum += v / 4000;
    y.add(v.y);
  }
  const Vec3d whole = xyz_of_spectrum([](double) { return 1.0; });
  // Stratified over one period of the cluster: the error is that of float wavelengths and tables.
  CHECK(length(sum - whole) < 1e-3);
}

TEST_CASE("optical tables") {
  for (const OpticalTable& t : optical_tables) {
    INFO(t.name);
    REQUIRE(t.rows >= 2);
    CHECK(t.nm[0] >= OpticalTable::kFirstNm);
    CHECK(t.nm[t.rows - 1] < OpticalTable::kFirstNm + OpticalTable::kCells);
    for (int k = 0; k + 1 < t.rows; ++k) {
      const double a = t.nm[k], b = t.nm[k + 1], middle = (a + b) / 2;
      REQUIRE(a < b);
      CHECK(t.at(a) == t.value[k]);
      CHECK(t.at(middle) == doctest::Approx((t.value[k] + t.value[k + 1]) / 2));
      CHECK(t.slope(middle) == doctest::Approx((t.value[k + 1] - t.value[k]) / (b - a)));
    }
    const double first = t.value[0], last = t.value[t.rows - 1];
    CHECK(t.at(100) == first);
    CHECK(t.at(-1e300) == first);
    CHECK(t.at(5000) == last);
    CHECK(t.at(std::numeric_limits<double>::infinity()) == last);
    CHECK(t.at(std::nan("")) == first);
    CHECK(t.slope(100) == 0);
    CHECK(t.slope(5000) == 0);
  }
}

TEST_CASE("refractive indices by formula") {
  // Schott's published indices of N-BK7 at the d, F and C lines.
  const double sb[] = {1.03961212, 0.231792344, 1.01046945};
  const double sc[] = {0.00600069867, 0.0200179144, 103.560653};
  CHECK(sellmeier(587.5618, sb, sc) == doctest::Approx(1.51680).epsilon(5e-6));
  CHECK(sellmeier(486.1327, sb, sc) == doctest::Approx(1.52238).epsilon(5e-6));
  CHECK(sellmeier(656.2725, sb, sc) == doctest::Approx(1.51432).epsilon(5e-6));
  CHECK(cauchy(500.0, 1.5, 0.004) == doctest::Approx(1.516));
}
