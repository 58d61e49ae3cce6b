// SPDX-License-Identifier: Apache-2.0
// Volumes that emit as lamps: densities, and pictures against closed forms.
#include "renderer/glows.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "base/hash.h"
#include "base/warp.h"
#include "scenes.h"
#include "tests/sanitized.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

namespace {

constexpr double kEven = 106.857 / 105.671;  ///< luminance of a spectrum of 1 (CIE 15, 1 nm rows)

double u01(std::uint64_t i) { return to_unit(mix64(i)); }

/// A ball of radius 1 around the origin that emits, as an even volume and as one that is asked for
/// place by place.
const char* const kGlows[] = {"volume a\n emission = 1.2;\nend\n",
                              "volume a\n emission = 3 * (1 - $object_position.y^2 - "
                              "$object_position.x^2 - $object_position.z^2);\nend\n"};

}  // namespace

TEST_CASE("directions to volumes: a density of 1 in all, and samples follow it") {
  const Glows both({{{0, 0, 3}, 1, 2}, {{0.5, 0, 4}, 2, 0.5}});
  for (const double z : {0.0, 2.5, 10.0}) {
    CAPTURE(z);
    const Vec3d from{0, 0, z};
    constexpr int n = 400000;
    const auto counts = [](Vec3d d) { return d.x + 0.1 * d.y > 0.03; };
    double all = 0, expected = 0, found = 0;
    int differ = 0;
    for (int i = 0; i < n; ++i) {
      const Glows::Sample s = both.sample(from, u01(2 * i), u01(2 * i + 1));
      differ += s.pdf != both.pdf(from, s.direction) || !(s.pdf > 0);
      found += counts(s.direction);
      // Its integral, over even points.
      const Vec3d d = square_to_sphere((i + 0.5) / n, std::fmod(i * std::numbers::phi, 1.0));
      const double part = both.pdf(from, d) * 4 * kPi<double> / n;
      all += part;
      if (counts(d)) expected += part;
    }
    CHECK(differ == 0);
    CHECK(std::abs(all - 1) < 5e-3);  // some 1e3 of the points fall into the narrowest cone
    CHECK(std::abs(found / n - expected) < 5 * std::sqrt(expected * (1 - expected) / n) + 5e-3);
  }
}

TEST_CASE("directions to one ball lie in its cone, next to it, in it and far away") {
  for (const double distance : {0.0, 0.999, 1.0, 1.002, 3.0, 1e6}) {
    CAPTURE(distance);
    const Glows one({{{distance, 0, 0}, 1, 1}});
    const double sine = 1 / distance;
    // 1 - cos of the cone, stable: sin^2 / (1 + cos).
    const double solid =
        distance > 1.001 ? 2 * kPi<double> * sine * sine / (1 + std::sqrt((1 - sine) * (1 + sine)))
                         : 4 * kPi<double>;
    for (int i = 0; i < 1000; ++i) {
      const Glows::Sample s = one.sample({0, 0, 0}, u01(2 * i), u01(2 * i + 1));
      CHECK(std::abs(length(s.direction) - 1) < 1e-14);
      CHECK(s.pdf == doctest::Approx(1 / solid).epsilon(1e-12));
    }
  }
}

TEST_CASE("a ball that shines lights the ground: as all of its light would from its centre") {
  // As with gravity: what a ball does is the same for all its light at the centre, where all of it
  // is above the horizon. 1.2 or 3 (1 - r^2) integrate to 1.6 pi.
  const std::string scene = R"({"camera": {"position": [4, 2, 0], "target": [0, 0, 0], "fov": 0.01},
    "materials": {"ground": {"matte": 0.5}}, "objects": [{"sphere": {}, "translate": [0, 3, 0],
    "volume": "a"}, {"quad": {"corner": [-9, 0, 9], "u": [18, 0, 0], "v": [0, 0, -18]},
    "surface": "ground"}]})";
  const double expected = kEven * 0.5 / kPi<double> * 1.6 * kPi<double> / 9;
  for (const char* script : kGlows) {
    const vm::Program p = compile(script);
    const Mean m = mean_luminance(run(p, scene_of(p, scene), options(16, 64)).film);
    CHECK(std::abs(m.value - expected) < 4 * m.error + 1e-4 * expected);
    // A sample that hits the ball's cone is off by what ways through it differ by, near 1; those
    // that are scattered alone hit it one time in ten or so.
    CHECK(m.error < m.value / std::sqrt(16 * 16 * 64));
  }
}

TEST_CASE("a fly in a ball that shines: half the sky is as bright as the way out") {
  const std::string scene =
      R"({"camera": {"position": [0.5, 0, 0], "target": [0, 0, 0], "fov": 0.01},
    "materials": {"fly": {"matte": 0.5}}, "objects": [{"sphere": {}, "volume": "a"},
    {"disc": {"center": [0, 0, 0], "normal": [1, 0, 0], "radius": 0.001}, "surface": "fly"}]})";
  for (const char* place : {"", " + 0 * $position.x"}) {
    const vm::Program p = compile(fmt::format("volume a\n emission = 2{};\nend\n", place));
    const Mean m = mean_luminance(run(p, scene_of(p, scene), options(16, 64)).film);
    // 2 times half of the way from the camera, and 2 R by an albedo of 0.5.
    CHECK(std::abs(m.value - kEven * (1 + 1)) < 4 * m.error + 1e-4);
  }
}

TEST_CASE(
    "where everything is as warm, everything is as bright: clouds and walls that emit what "
    "they absorb") {
  const std::string wall =
      "surface room\n bsdf = 0.5 * mix(matte(1), glossy(1, 200), 0.5); emission = 0.5;\n"
      " emission_function = translucent(1);\nend\n"
      "surface stone\n bsdf = matte(0.3); emission = 0.7;\nend\n";
  const std::string scene = R"({"camera": {"position": [1.2, 0.3, 0], "target": [0, 0, 0]},
    "objects": [{"sphere": {"radius": 3}, "surface": "room"}, {"sphere": {}, "volume": "a"},
    {"sphere": {"center": [0.5, 0, 0]}, "volume": "b"}, {"sphere": {"center": [0, -1, 0],
    "radius": 0.5}, "surface": "stone"}]})";
  for (const char* place : {"", " * (1 + perlin(3 * $position))"}) {
    const vm::Program p = compile(
        wall + fmt::format("volume a\n scattering = 2{0} * rgb(1, 0.8, 0.5); absorption = 0.7{0};\n"
                           " emission = 0.7{0};\nend\n"
                           "volume b\n scattering = 0.3; absorption = 0.4; emission = 0.4;\n"
                           " phase = henyey_greenstein(0.7);\nend\n",
                           place));
    const Mean m =
        mean_luminance(run(p, scene_of(p, scene), options(24, kSanitized ? 16 : 64)).film);
    CHECK(std::abs(m.value - kEven) < 4 * m.error + 3e-4);
  }
}
