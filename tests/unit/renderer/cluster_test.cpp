// SPDX-License-Identifier: Apache-2.0
// Colour from eight wavelengths: how little of it is noise.
#include "renderer/cluster.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <utility>

#include "materials/colour.h"
#include "materials/spectra.h"
#include "scenes.h"
#include "tests/sanitized.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

TEST_CASE("one cluster sees white light as white: its luminance within 0.6 %, its colour 7.5 %") {
  double sum[3] = {}, squares[3] = {}, y = 0, yy = 0;
  constexpr int n = 4096;
  for (int i = 0; i < n; ++i) {
    const Cluster c = sample_cluster((i + 0.5) / n);
    const auto xyz = c.xyz(c.light({1, 1, 1}) * (1.0f / kWavelengths));
    const Vec3d rgb = materials::linear_srgb_of_xyz({xyz[0], xyz[1], xyz[2]});
    for (int k = 0; k < 3; ++k) sum[k] += rgb[k] / n, squares[k] += rgb[k] * rgb[k] / n;
    y += xyz[1] / n, yy += xyz[1] * xyz[1] / n;
  }
  // The white point of sRGB is rounded to four digits.
  for (int k = 0; k < 3; ++k) {
    CHECK(sum[k] == doctest::Approx(1).epsilon(5e-4));
    CHECK(std::sqrt(squares[k] - sum[k] * sum[k]) < 0.075);
  }
  CHECK(y == doctest::Approx(1).epsilon(1e-4));
  CHECK(std::sqrt(yy - y * y) < 0.006);
}

TEST_CASE("clusters of four: the same white, each wavelength in two lanes, more noise of colour") {
  double y = 0, red = 0, red4 = 0, red8 = 0;
  constexpr int n = 4096;
  const auto rgb = [](const Cluster& c) {
    const auto xyz = c.xyz(c.light({1, 1, 1}) * (1.0f / kWavelengths));
    return materials::linear_srgb_of_xyz({xyz[0], xyz[1], xyz[2]});
  };
  for (int i = 0; i < n; ++i) {
    const Cluster four = sample_cluster((i + 0.5) / n, 4);
    for (int k = 0; k < 4; ++k) CHECK(four.lambda.nm[k] == four.lambda.nm[k + 4]);
    y += dot(rgb(four), Vec3d{0.2126, 0.7152, 0.0722}) / n;
    red += rgb(four).x / n;
    red4 += std::pow(rgb(four).x - 1, 2) / n;
    red8 += std::pow(rgb(sample_cluster((i + 0.5) / n)).x - 1, 2) / n;
  }
  CHECK(y == doctest::Approx(1).epsilon(1e-3));
  CHECK(red == doctest::Approx(1).epsilon(1e-3));
  CHECK(std::sqrt(red4) > 2 * std::sqrt(red8));
}

namespace {

/// Mean squares over pixels of what pictures of some samples are off by from one of many: of red,
/// green and blue together, and of luminance.
std::pair<double, double> errors(const vm::Program& program, int samples) {
  const Scene s = builtin(program, "backlit");
  RenderOptions o = options(kSanitized ? 16 : 32, kSanitized ? 256 : 1024);
  const Film reference = run(program, s, o).film;
  o.samples = samples;
  o.seed = 12;
  const Film film = run(program, s, o).film;
  double colour = 0, luminance = 0;
  for (std::size_t i = 0; i < film.xyz.size(); ++i) {
    const auto rgb = [](const std::array<double, 3>& p) {
      return materials::linear_srgb_of_xyz({p[0], p[1], p[2]});
    };
    const Vec3d off = rgb(film.xyz[i]) - rgb(reference.xyz[i]);
    colour += dot(off, off) / 3;
    luminance += std::pow(film.xyz[i][1] - reference.xyz[i][1], 2);
  }
  return {colour, luminance};
}

}  // namespace

TEST_CASE("where all is grey, red, green and blue err as luminance alone does") {
  HandProgram grey, coloured;
  grey.matte("x", 0.5);
  // Nobody knows that it is grey.
  coloured.matte("x", 0.5).outputs[int(vm::Output::Material)].spectral = true;
  for (const int samples : {4, 16, 64}) {
    CAPTURE(samples);
    const auto [colour, luminance] = errors(grey.program, samples);
    CHECK(std::sqrt(colour / luminance) == doctest::Approx(1).epsilon(1e-3));
    const auto [all, bright] = errors(coloured.program, samples);
    CHECK(all < 1.1 * 1.1 * bright);
    CHECK(all > bright);  // or else what is compared is not the noise of colour
  }
}

TEST_CASE("of grey matter each lamp has its exact colour, whatever wavelengths are drawn") {
  const std::array<double, 3> lamps[] = {
      {1, 1, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {4.6, 5.0, 5.6}};
  // The oracle: sums over sixteenths of a nanometre of the published tables.
  const auto exact = [](const std::array<double, 3>& rgb) {
    Vec3d sum;
    double white = 0;
    for (double nm = 360; nm <= 830; nm += 0.0625) {
      const double red = materials::rgb_red(float(nm)), green = materials::rgb_green(float(nm));
      const double day = materials::illuminant_d65(float(nm));
      sum += materials::cie1931(nm) *
             (day * (rgb[0] * red + rgb[1] * green + rgb[2] * (1 - red - green)));
      white += materials::cie1931(nm).y * day;
    }
    return sum / white;
  };
  for (const auto& rgb : lamps) {
    const Vec3d want = exact(rgb);
    for (int i = 0; i < 1000; ++i) {
      const Cluster c = sample_cluster((i + 0.37) / 1000, kWavelengths, Matter::Grey);
      const auto xyz = c.xyz(c.light(rgb) * (1.0f / kWavelengths));
      for (int k = 0; k < 3; ++k)
        CHECK(xyz[std::size_t(k)] == doctest::Approx(want[k]).epsilon(1e-5).scale(length(want)));
    }
  }
}

TEST_CASE("numbers of clusters: digits of the place and of the hero take turns, none is lost") {
  CHECK(cluster_number(0.5f, 4) == 0.125);
  CHECK(cluster_number(0.0625f, 4) == 0.25);
  CHECK(cluster_number(0x1p-6f, 4) == 0x1p-6);
  CHECK(cluster_number(0) == 0);
  CHECK(cluster_number(0.5f) == 0.0625);  // the first digit: the place, by a sixteenth
  CHECK(cluster_number(0.25f) == 0.5);    // the second: the hero
  CHECK(cluster_number(0.125f) == 0.03125);
  CHECK(cluster_number(0x1p-24f) == 0x1p-24);
  CHECK(cluster_number(1 - 0x1p-24f) == 1 - 0x1p-24);
  double sum = 0;
  for (int i = 0; i < 256; ++i) sum += cluster_number(float(i) / 256) / 256;
  CHECK(sum == doctest::Approx(0.5 - 0.5 / 256));  // a permutation of i / 256
}
