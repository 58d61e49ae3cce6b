// SPDX-License-Identifier: Apache-2.0
// Directions to where rough balls show lamps: their density, and light that comes along them beside
// a quadrature over the ball and the lamp.
#include "renderer/lamp_images.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/warp.h"
#include "materials/bsdf.h"
#include "scenes.h"
#include "tests/sanitized.h"
#include "tests/stats/chi_square.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

namespace {

/// A script that compiles, its scene, and the lights of that.
struct Stage {
  vm::Program program;
  Scene scene;
  Compiled compiled;
  Lights lights;
  std::vector<GlossyBall> balls;

  Stage(const std::string& surfaces, const std::string& objects,
        const std::vector<double>& radiance)
      : program(compile(surfaces)),
        scene(scene_of(program, R"({"camera": {"position": [0, 2, 5], "target": [0, 0, 0]},
          "materials": {"lamp": {"matte": 0, "emission": 1}}, "objects": [)" +
                                    objects + "]}")),
        compiled(program),
        lights(scene.data(), radiance),
        balls(glossy_balls(scene.data(), compiled)) {}
};

constexpr const char* kBall = R"({"sphere": {"center": [0, 1, 0], "radius": 1}, "surface": "s"})";

double alpha_of(const std::string& bsdf) {
  const Stage s("surface s bsdf = " + bsdf + "; end\n", kBall, {0.0});
  return s.balls.empty() ? 0 : s.balls[0].alpha;
}

/// What the ground at the origin, facing +y, gets from a disc of radiance 1 by way of a ball that
/// scatters by GGX: over the middles of cells of the cone that the ball fills, and of the disc.
double irradiance_by(Vec3d ball, double radius, double roughness, Vec3d lamp, Vec3d facing,
                     double lamp_radius, int cells) {
  const materials::Layout layout(vm::MaterialLayout{{{int(materials::Lobe::Microfacet),
                                                      {{vm::SlotType::Spectrum, true, 0},
                                                       {vm::SlotType::Real, true, 0},
                                                       {vm::SlotType::Real, true, 0}},
                                                      {}}}});
  std::vector<double> params(std::size_t(layout.param_count()), 1.0);
  params[kWavelengths] = roughness;
  params[kWavelengths + 1] = 0;
  const materials::Bsdf<double> bsdf(layout, params.data());
  const double distance = length(ball), cap = 1 - std::sqrt(1 - std::pow(radius / distance, 2));
  const Frame<double> axes = Frame<double>::around(ball / distance),
                      disc = Frame<double>::around(facing);
  const int rings = 8, spokes = 16;
  double sum = 0;
  for (int i = 0; i < cells; ++i)
    for (int k = 0; k < 4 * cells; ++k) {
      const double z = 1 - cap * (i + 0.5) / cells, phi = kPi<double> * (k + 0.5) / (2 * cells);
      const double s = std::sqrt(1 - z * z);
      const Vec3d d = axes.to_world({s * std::cos(phi), s * std::sin(phi), z});
      if (!(d.y > 0)) continue;
      const double along = dot(ball, d);
      const double t = along - std::sqrt(radius * radius - dot(ball, ball) + along * along);
      const Vec3d place = d * t, n = (place - ball) / radius;
      const Frame<double> frame = Frame<double>::around(n);
      double radiance = 0;
      for (int a = 0; a < rings; ++a)
        for (int b = 0; b < spokes; ++b) {
          const double r = lamp_radius * std::sqrt((a + 0.5) / rings),
                       turn = 2 * kPi<double> * (b + 0.5) / spokes;
          const Vec3d to =
              lamp + disc.to_world({r * std::cos(turn), r * std::sin(turn), 0}) - place;
          const double d2 = dot(to, to);
          const Vec3d w = to / std::sqrt(d2);
          if (!(dot(w, n) > 0) || !(dot(w, facing) < 0)) continue;
          radiance +=
              bsdf.eval(frame.to_local(-d), frame.to_local(w), materials::Mode::Radiance)[0] *
              dot(w, n) * -dot(w, facing) / d2;
        }
      sum += radiance / (rings * spokes) * kPi<double> * lamp_radius * lamp_radius * d.y;
    }
  return sum * cap * 2 * kPi<double> / (4.0 * cells * cells);
}

}  // namespace

TEST_CASE("the width that a ball scatters by is that of its facets") {
  CHECK(alpha_of("microfacet(1, 0.4)") == doctest::Approx(0.16).epsilon(0.1));
  CHECK(alpha_of("conductor(0.2, 3.4, 0.2)") == doctest::Approx(0.04).epsilon(0.1));
  // tan^2 of the median facet is alpha^2 ln 2
  CHECK(alpha_of("beckmann(1, 0.3)") ==
        doctest::Approx(0.09 * std::sqrt(std::log(2))).epsilon(0.1));
}

TEST_CASE(
    "balls that mirror, let light through, are matte or differ from place to place show none") {
  for (const char* bsdf : {"mirror(1)", "dielectric(1.5, 0.3)", "matte(0.5)", "microfacet(1, 0.9)",
                           "microfacet(1, 0.3 + 0.1 * $uv.x)"}) {
    INFO(bsdf);
    CHECK(alpha_of(bsdf) == 0);
  }
  const Stage quad(
      "surface s bsdf = microfacet(1, 0.3); end\n",
      R"({"quad": {"corner": [0, 0, 0], "u": [1, 0, 0], "v": [0, 1, 0]}, "surface": "s"})", {0.0});
  CHECK(quad.balls.empty());
}

TEST_CASE("directions to images follow their density") {
  const Stage s(
      "surface s bsdf = microfacet(1, 0.3); end\nsurface t bsdf = conductor(0.2, 3, 0.5); end\n",
      std::string(kBall) + R"(,
    {"sphere": {"center": [2.5, 0.5, 0.5], "radius": 0.5}, "surface": "t"},
    {"disc": {"center": [-3, 4, 2], "normal": [3, -4, -2], "radius": 1.5}, "surface": "lamp"},
    {"quad": {"corner": [1, 3, -2], "u": [0.5, 0, 0], "v": [0, 0.2, 0.4]}, "surface": "lamp"},
    {"sphere": {"center": [0, 5, 3], "radius": 0.3}, "surface": "lamp"})",
      {0.0, 0.0, 2.0, 5.0, 7.0});
  REQUIRE(s.balls.size() == 2);
  for (const Vec3d& from :
       {Vec3d{1.5, 0, 1.5}, Vec3d{-0.3, 0, 0.2}, Vec3d{1.3, 0, 0.4}, Vec3d{30, 0, 10}}) {
    const LampImages images(s.balls, s.lights, from, {0, 1, 0});
    REQUIRE(images.chance() > 0);
    stats::ChiSquareTest test;
    test.sample = [&](stats::Random& random) -> std::optional<Vec3d> {
      const double u = random.next(), v = random.next();
      return images.sample(u, v);
    };
    test.pdf = [&](Vec3d d) { return images.pdf(d); };
    test.axis = normalize(Vec3d{0, 1, 0} - from);
    const stats::ChiSquareResult r = stats::chi_square(test);
    INFO(from.x, ": ", r.report());
    CHECK(std::abs(r.mass - 1) < 2e-3);
    CHECK(r.passed(1e-4));
  }
}

TEST_CASE("at every scale directions and densities are finite") {
  stats::Random random(5);
  const auto power = [&](double low, double high) {
    return std::pow(10, low + (high - low) * random.next());
  };
  const auto direction = [&] {
    const double z = 2 * random.next() - 1, phi = 2 * kPi<double> * random.next();
    const double s = std::sqrt(1 - z * z);
    return Vec3d{s * std::cos(phi), s * std::sin(phi), z};
  };
  const Stage s("surface s bsdf = microfacet(1, 0.3); end\n", std::string(kBall) + R"(,
    {"disc": {"center": [-3, 4, 2], "normal": [3, -4, -2], "radius": 1.5}, "surface": "lamp"})",
                {0.0, 2.0});
  int images_found = 0;
  for (int i = 0; i < (kSanitized ? 2'000 : 50'000); ++i) {
    GlossyBall ball = s.balls[0];
    ball.alpha = power(-7, -0.4);
    const Vec3d from =
        ball.polished.centre + direction() * (i % 4 ? 1 + power(-12, 6) : 1 - power(-12, 0));
    const LampImages images(std::span(&ball, 1), s.lights, from, direction());
    REQUIRE((images.chance() >= 0 && images.chance() <= 1));
    if (images.chance() == 0) continue;
    ++images_found;
    const Vec3d d = images.sample(random.next(), random.next());
    CHECK(std::abs(length(d) - 1) < 1e-9);
    CHECK((images.pdf(d) > 0 && std::isfinite(images.pdf(d))));
    const double elsewhere = images.pdf(direction());
    CHECK((elsewhere >= 0 && std::isfinite(elsewhere)));
  }
  CHECK(images_found > (kSanitized ? 200 : 5'000));
}

TEST_CASE("the ground gets what a rough ball sends on from a lamp") {
  for (const auto& [roughness, lamp_radius] : {std::pair{0.25, 0.5}, {0.4, 0.05}, {0.55, 0.3}}) {
    CAPTURE(roughness);
    const vm::Program p =
        compile(fmt::format("surface s bsdf = microfacet(1, {}); end\n", roughness));
    const Vec3d ball{0.45, 0.5, 0}, facing = normalize(Vec3d{1, -0.1, 0.3}), lamp{-1.5, 1, -0.4};
    const double radius = 0.35;
    const Scene s = scene_of(p, ground_by_ball(ball, radius, lamp, facing, lamp_radius));
    RenderOptions o = options(16, kSanitized ? 32 : 1024);
    o.max_depth = 1;
    const Mean straight = mean_luminance(run(p, s, o).film);
    o.max_depth = 2;
    const Mean m = mean_luminance(run(p, s, o).film);
    const int cells = kSanitized ? 16 : 64;
    const double expected =
        irradiance_by(ball, radius, roughness, lamp, facing, lamp_radius, cells) * 2 * 0.5 /
        kPi<double>;
    INFO("by the ball ", m.value - straight.value, " +- ", std::hypot(m.error, straight.error),
         ", expected ", expected);
    CHECK(std::abs(m.value - straight.value - expected) <
          4 * std::hypot(m.error, straight.error) + (kSanitized ? 3e-2 : 2e-3) * expected);
    if (!kSanitized) CHECK(m.error < 0.01 * expected);
  }
}

TEST_CASE("between lamps of radiance 1 rough and matte balls that lose nothing are 1") {
  const vm::Program p = compile("surface s bsdf = microfacet(1, 0.4); end\n");
  // Four walls that close a tetrahedron around all.
  std::string walls;
  for (const Vec3d& n : {Vec3d{1, 1, 1}, Vec3d{1, -1, -1}, Vec3d{-1, 1, -1}, Vec3d{-1, -1, 1}}) {
    const Frame<double> f = Frame<double>::around(normalize(n));
    const Vec3d u = f.s * 60.0, v = f.t * 60.0, corner = n * 4.0 - (u + v) / 2;
    // u x v faces inwards
    walls +=
        fmt::format(R"(, {{"quad": {{"corner": [{}, {}, {}], "u": [{}, {}, {}], "v": [{}, {}, {}]}},
      "surface": "lamp"}})",
                    corner.x, corner.y, corner.z, v.x, v.y, v.z, u.x, u.y, u.z);
  }
  const Scene s = scene_of(p, R"({"camera": {"position": [0, 0, 5], "target": [0, 0, 0], "fov": 40},
    "materials": {"lamp": {"matte": 0, "emission": 1}, "white": {"matte": 1}},
    "objects": [{"sphere": {"center": [-0.6, 0, 0], "radius": 0.6}, "test": true},
    {"sphere": {"center": [0.8, 0.2, 0.2], "radius": 0.7}, "surface": "white"})" +
                                  walls + "]}");
  RenderOptions o = options(16, kSanitized ? 32 : 512);
  o.max_depth = 64;
  const Mean m = mean_luminance(run(p, s, o).film);
  INFO("mean ", m.value, " +- ", m.error);
  // The table of what facets lose is good to 1e-4 at one bounce.
  CHECK(std::abs(m.value - 1) < 4 * m.error + 2e-4);
  CHECK(m.error < 2e-3);
}
