// SPDX-License-Identifier: Apache-2.0
#include "renderer/light_tree.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/hash.h"
#include "base/warp.h"
#include "renderer/lights.h"
#include "tests/sanitized.h"
#include "tests/stats/chi_square.h"

using namespace mms;
using namespace mms::renderer;

namespace {

double u01(std::uint64_t i) { return to_unit(mix64(i)); }

/// `n` small discs over a square of 20 m at height 3, facing down, of powers 1 to 16.
std::vector<LightExtent> ceiling(int n) {
  std::vector<LightExtent> lights;
  for (int i = 0; i < n; ++i) {
    const auto k = std::uint64_t(4 * i);
    LightExtent l;
    l.box = bounds(
        Disc{{20 * u01(k) - 10, 3, 20 * u01(k + 1) - 10}, Frame<double>::around({0, -1, 0}), 0.01});
    l.power = std::exp2(4 * u01(k + 2));
    l.facing = {0, -1, 0};
    lights.push_back(l);
  }
  return lights;
}

/// What a small flat light sends to `from`.
double exact(const LightExtent& l, Vec3d from) {
  const Vec3d to = from - l.box.centre();
  return l.power * std::max(0.0, dot(to, l.facing)) / std::pow(dot(to, to), 1.5);
}

}  // namespace

TEST_CASE("probabilities of a tree of lights add up to one, near, far, between and behind") {
  const std::vector<LightExtent> lights = ceiling(777);
  const LightTree tree(lights);
  for (const Vec3d from : {Vec3d{0, 0, 0}, Vec3d{3, 2.9, -4}, Vec3d{500, 80, 3}, Vec3d{1, 3, 1}}) {
    double sum = 0;
    for (int i = 0; i < 777; ++i) sum += tree.probability(i, from);
    CHECK(sum == doctest::Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("lights are drawn as often as their probability says, and numbers are used up evenly") {
  const std::vector<LightExtent> lights = ceiling(100);
  const LightTree tree(lights);
  const Vec3d from{2, 0.5, -3};
  const int n = kSanitized ? 20000 : 200000;
  std::vector<double> drawn(100, 0.0);
  double rest = 0;
  for (int i = 0; i < n; ++i) {
    const LightTree::Drawn d = tree.sample(from, u01(std::uint64_t(i)));
    CHECK(d.probability == doctest::Approx(tree.probability(d.light, from)));
    REQUIRE(d.rest >= 0);
    REQUIRE(d.rest < 1);
    drawn[std::size_t(d.light)] += 1;
    rest += d.rest;
  }
  std::vector<std::pair<double, double>> cells;
  for (int i = 0; i < 100; ++i)
    cells.emplace_back(n * tree.probability(i, from), drawn[std::size_t(i)]);
  CHECK(stats::pearson(cells).passed(1e-4));
  CHECK(std::abs(rest / n - 0.5) < 5 / std::sqrt(12.0 * n));
}

TEST_CASE("among 4096 lights the tree's choice needs a tenth of what a choice by power needs") {
  // The second moment of e_i / p_i over the square of the mean: 1 for the ideal choice, and samples
  // needed grow with what exceeds it, here 0.1 to 1.5 by the tree and 9 to 154 by power.
  const int n = 4096;
  const std::vector<LightExtent> lights = ceiling(n);
  const LightTree tree(lights);
  double power = 0;
  for (const LightExtent& l : lights) power += l.power;
  for (const Vec3d from : {Vec3d{0, 2, 0}, Vec3d{7, 1, -8}, Vec3d{-3, 2.7, 4}}) {
    double mean = 0, by_tree = 0, by_power = 0;
    for (int i = 0; i < n; ++i) {
      const double e = exact(lights[std::size_t(i)], from);
      mean += e;
      by_tree += e * e / tree.probability(i, from);
      by_power += e * e * power / lights[std::size_t(i)].power;
    }
    INFO("tree ", by_tree / (mean * mean), ", power ", by_power / (mean * mean));
    CHECK(by_power - mean * mean > 10 * (by_tree - mean * mean));
  }
}

TEST_CASE(
    "a light that faces away is never drawn by the tree, and one at the point itself may be") {
  std::vector<LightExtent> lights = ceiling(3);
  lights[1].facing = {0, 1, 0};
  const LightTree tree(lights);
  CHECK(tree.probability(1, {0, 0, 0}) < 1e-3);
  const LightTree::Drawn d = tree.sample(lights[0].box.centre(), 0.3);
  CHECK(std::isfinite(d.probability));
  CHECK(d.probability > 0);
}

TEST_CASE("a picture of the sky: directions follow their density, whatever it is turned by") {
  EnvironmentImage image{"", 8, 4, {}};
  for (int i = 0; i < 32; ++i) {
    const float v = i == 13 ? 50.0f : i % 7 == 0 ? 0.0f : float(i % 5);
    image.rgb.push_back({v, v, v});
  }
  SceneData s;
  s.surfaces.emplace_back();
  s.objects.emplace_back();
  s.environment.image = image;
  s.environment.radiance = {1, 1, 1};
  for (const double turn : {0.0, 0.7}) {
    s.environment.rotation = turn;
    const Lights lights(s, {0.0});
    stats::ChiSquareTest test;
    test.sample = [&](stats::Random& random) -> std::optional<Vec3d> {
      const double u = random.next(), v = random.next();
      return lights.sample(Vec3d{0, 0, 0}, u, v).direction;
    };
    test.pdf = [&](Vec3d d) { return lights.pdf_environment(Vec3d{0, 0, 0}, d); };
    test.axis = {0, 1, 0};
    // Under sanitizers too: from fewer the mass is not known within 1e-3.
    test.count = stats::sample_count(100'000);
    test.pilot = 8192;
    test.cells = 64;
    const stats::ChiSquareResult r = stats::chi_square(test);
    INFO(r.report());
    // The sky is not all black anywhere that blending reaches: nothing but it is drawn.
    CHECK(std::abs(r.mass - 1) < 1e-3);
    CHECK(r.passed(1e-4));
  }
}
