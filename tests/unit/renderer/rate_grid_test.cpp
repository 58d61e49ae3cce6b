// SPDX-License-Identifier: Apache-2.0
#include "renderer/rate_grid.h"

#include <doctest/doctest.h>

#include <cmath>

#include <fmt/format.h>

#include "base/hash.h"
#include "base/warp.h"
#include "scenes.h"
#include "tests/sanitized.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

namespace {

double u01(std::uint64_t i) { return to_unit(mix64(i)); }

const std::string kNarrow =
    R"({"camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 0.01},
    "environment": {"constant": 1}, "objects": [{"sphere": {}, "test": true}]})";

std::string dark_narrow() {
  std::string scene = kNarrow;
  return scene.replace(scene.find("\"constant\": 1"), 13, "\"constant\": 0");
}

}  // namespace

TEST_CASE("a ray stops where the depth is used up: against small steps through the cells") {
  constexpr int n = 5;
  std::vector<float> values;
  for (int i = 0; i < n * n * n; ++i)  // a third of the cells is empty
    values.push_back(i % 3 == 0 ? 0.0f : float(4 * u01(std::uint64_t(i))));
  Bounds box;
  box.low = {-1, 0, 2};
  box.high = {1, 1.5, 6};
  const RateGrid grid(box, n, values);
  CHECK(grid.largest() < 4);
  for (std::uint64_t i = 1; i < 300; ++i) {
    const Vec3d inside{2 * u01(7 * i) - 1, 1.5 * u01(7 * i + 1), 2 + 4 * u01(7 * i + 2)};
    const Vec3d d = i % 10 == 0 ? Vec3d{0, 0, 1} : square_to_sphere(u01(7 * i + 3), u01(7 * i + 4));
    const Vec3d o = inside - d * 3.0;
    const double from = 3, to = 3 + 2 * u01(7 * i + 5), depth = 2 * u01(7 * i + 6);
    const RateGrid::Event c = grid.next(o, d, from, to, depth);
    double sum = 0;
    constexpr int steps = 20000;
    const double end = std::min(c.t, to), h = (end - from) / steps;
    for (int k = 0; k < steps; ++k) sum += double(grid.at(o + d * (from + h * (k + 0.5)))) * h;
    // Each of at most 15 planes falls into one step, whose value errs by at most 4.
    const double tolerance = 15 * 4 * h;
    if (std::isfinite(c.t)) {
      CHECK(std::abs(sum - depth) < tolerance);
      CHECK(c.rate > 0);
      CHECK(c.t <= to);
    } else {
      CHECK(sum < depth + tolerance);
    }
  }
}

TEST_CASE("a volume that varies within the cells: half of the collisions are with nothing") {
  // 0.4 (1 + sin 200 z) integrates to 0.8 over z in [-1, 1], the sine being odd.
  const vm::Program fog =
      compile("volume a\n absorption = 0.4 * (1 + sin(200 * $object_position.z));\nend\n");
  check_mean(run(fog, scene_of(fog, kNarrow), options(16, 64)).film, std::exp(-0.8));
  const vm::Program cloud =
      compile("volume a\n scattering = (1 + sin(200 * $position.x)) * rgb(1, 0.6, 0.2);\nend\n");
  check_mean(run(cloud, builtin(cloud, "furnace"), options(24, kSanitized ? 16 : 64)).film, 1);
}

TEST_CASE("a thin cloud with a dense core is crossed in few steps, whatever bound is stated") {
  // Density exp(-40 r^2) of a turned and moved ball: its optical depth along the diameter is
  // 8 sqrt(pi / 40) erf(sqrt 40), and erf is 1 to 17 digits.
  const std::string density =
      "absorption = 8 * exp(-40 * dot($object_position, $object_position));";
  const std::string scene = R"({"camera": {"position": [3, 1, 7], "target": [3, 1, 0], "fov": 0.01},
    "environment": {"constant": 1}, "objects": [{"sphere": {}, "translate": [3, 1, 0],
    "rotate": [20, 30, 40], "test": true}]})";
  for (const char* bound : {"", " bound = 8;", " bound = 100;"}) {
    const vm::Program p = compile("volume a\n " + density + bound + "\nend\n");
    const Rendered r = run(p, scene_of(p, scene), options(16, 64));
    check_mean(r.film, std::exp(-8 * std::sqrt(kPi<double> / 40)));
    CHECK(r.report.denser_samples == 0);
    // A bound of 8 alone would take 16 samples across; the cells along the axis sum to about 3.
    CHECK(r.report.medium_samples < 6 * r.report.paths);
  }
}

TEST_CASE("light of a volume that removes none or little is found too") {
  const vm::Program p = compile(
      "volume a\n absorption = select 0.5, if $object_position.z > 0; 0.0 otherwise; end; "
      "emission = 0.25;\nend\n");
  // From the front: 0.25 (1 - exp(-0.5)) / 0.5 of the dense half, and 0.25 exp(-0.5) through it.
  const double expected = 0.25 * (1 - std::exp(-0.5)) / 0.5 + 0.25 * std::exp(-0.5);
  const Mean m = mean_luminance(run(p, scene_of(p, dark_narrow()), options(16, 256)).film);
  CHECK(std::abs(m.value - expected * 106.857 / 105.671) < 4 * m.error + 1e-4);
}

TEST_CASE("a volume that only emits shines: the integral along the ray") {
  // 3 z^2 over z in [-1, 1]; with a bound of what it removes or without.
  for (const char* bound : {"", "bound = 0.1;"}) {
    const vm::Program p =
        compile(fmt::format("volume a\n emission = 3 * $object_position.z^2; {}\nend\n", bound));
    const Mean m = mean_luminance(run(p, scene_of(p, dark_narrow()), options(16, 256)).film);
    CHECK(std::abs(m.value - 2 * 106.857 / 105.671) < 4 * m.error + 1e-4);
    // Light is asked for at some 4.6 places of a ray, in proportion to how bright it may be there.
    // Independent ones would leave a deviation of 1 / sqrt(4.6) of a sample, even steps a quarter.
    CHECK(m.error < 0.2 * m.value / std::sqrt(16 * 16 * 256));
  }
}

TEST_CASE("volumes that shine where they overlap, also inside of one that absorbs evenly") {
  const vm::Program p = compile(
      "volume a\n emission = (1 + $position.z) / 2;\nend\n"
      "volume b\n emission = 2 * max($position.z, 0.0);\nend\n"
      "volume c\n absorption = 0.5;\nend\n");
  // With a = 1/2: the integrals of (1 + z) / 2 exp(-a (1 - z)) from -1 to 1, and of
  // 2 z exp(-a (1 - z)) from 0 to 1.
  const double first = (2 / 0.5 - (1 - std::exp(-1.0)) / 0.25) / 2;
  const double second = 2 * (1 / 0.5 - (1 - std::exp(-0.5)) / 0.25);
  for (const bool dims : {false, true}) {
    std::string scene = dark_narrow();
    const std::string ball = R"({"sphere": {}, "test": true})";
    scene.replace(scene.find(ball), ball.size(),
                  std::string(R"({"sphere": {}, "volume": "a"}, {"sphere": {}, "volume": "b"})") +
                      (dims ? R"(, {"sphere": {}, "volume": "c"})" : ""));
    const Mean m = mean_luminance(run(p, scene_of(p, scene), options(16, 256)).film);
    const double expected = dims ? first + second : 2.0;
    CHECK(std::abs(m.value - expected * 106.857 / 105.671) < 4 * m.error + 2e-4);
  }
}
