// SPDX-License-Identifier: Apache-2.0
#include "renderer/lights.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/hash.h"
#include "base/warp.h"
#include "renderer/flight.h"
#include "renderer/light_places.h"

using namespace mms;
using namespace mms::renderer;

namespace {

double u01(std::uint64_t i) { return to_unit(mix64(i)); }

SceneData scene_with(Shape shape) {
  SceneData s;
  s.surfaces.emplace_back();
  Object o;
  o.shape = std::move(shape);
  s.objects.push_back(std::move(o));
  s.camera.target = {0, 0, 0};
  return s;
}

/// Mean of 1 / pdf over drawn directions: the solid angle that the light fills, with its error.
struct Estimate {
  double value, error;
};
Estimate solid_angle(const Lights& lights, const Receiver& from, bool front_only) {
  const int n = 200000;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const LightSample s =
        lights.sample(from, u01(2 * std::uint64_t(i)), u01(2 * std::uint64_t(i) + 1));
    if (!(s.pdf > 0)) continue;
    if (front_only && dot(s.direction, s.surface.geometric_normal) > 0) continue;
    CHECK(s.pdf == doctest::Approx(lights.pdf(from, s.object, s.surface)));
    sum += 1 / s.pdf;
    squares += 1 / (s.pdf * s.pdf);
  }
  const double mean = sum / n;
  return {mean, std::sqrt((squares / n - mean * mean) / n)};
}

}  // namespace

TEST_CASE("a disc on its axis fills 2 pi (1 - h / sqrt(h^2 + r^2))") {
  const SceneData s = scene_with(Disc{{0, 2, 0}, Frame<double>::around({0, -1, 0}), 1.5});
  const Estimate e = solid_angle(Lights(s, {1.0}), Vec3d{0, 0, 0}, false);
  CHECK(std::abs(e.value - 2 * kPi<double> * (1 - 2 / 2.5)) < 4 * e.error);
}

TEST_CASE("a square seen from its axis fills 4 asin(a^2 / (a^2 + h^2)), half edge a") {
  const SceneData s = scene_with(Quad{{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}});
  const Estimate e = solid_angle(Lights(s, {1.0}), Vec3d{0, 0, 0}, false);
  CHECK(std::abs(e.value - 4 * std::asin(1.0 / 5)) < 4 * e.error);
}

TEST_CASE("what is matte draws the same solid angles, above and below its horizon") {
  const Receiver matte(Vec3d{0, 0, 0}, {{0.6f, 0.8f, 0}, true});
  const SceneData disc = scene_with(Disc{{0, 2, 0}, Frame<double>::around({0, -1, 0}), 1.5});
  const Estimate d = solid_angle(Lights(disc, {1.0}), matte, false);
  CHECK(std::abs(d.value - 2 * kPi<double> * (1 - 2 / 2.5)) < 4 * d.error);
  const SceneData quad = scene_with(Quad{{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}});
  const Estimate q = solid_angle(Lights(quad, {1.0}), matte, false);
  CHECK(std::abs(q.value - 4 * std::asin(1.0 / 5)) < 4 * q.error);
  const SceneData ball = scene_with(Sphere{{-1, 1, 0}, 1, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  const Estimate b = solid_angle(Lights(ball, {1.0}), matte, true);
  CHECK(std::abs(b.value - 2 * kPi<double> * (1 - std::sqrt(0.5))) < 4 * b.error);
}

TEST_CASE("two triangles of a mesh fill what the square does, whatever their sizes") {
  Mesh m;
  m.positions = {{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, 1}, {0, 2, 1}};
  m.triangles = {{0, 1, 2}, {0, 2, 4}, {0, 4, 3}};
  const SceneData s = scene_with(m);
  const Estimate e = solid_angle(Lights(s, {1.0}), Vec3d{0, 0, 0}, false);
  CHECK(std::abs(e.value - 4 * std::asin(1.0 / 5)) < 4 * e.error);
}

TEST_CASE(
    "a sphere fills 2 pi (1 - sqrt(1 - (r/d)^2)) from outside, exactly, and 4 pi from inside") {
  const SceneData s = scene_with(Sphere{{0, 3, 0}, 1, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  const Lights lights(s, {1.0});
  const Estimate out = solid_angle(lights, Vec3d{0, 0, 0}, true);
  CHECK(out.value == doctest::Approx(2 * kPi<double> * (1 - std::sqrt(8.0) / 3)).epsilon(1e-9));
  const Estimate in = solid_angle(lights, Vec3d{0.2, 3.1, -0.3}, false);
  CHECK(std::abs(in.value - 4 * kPi<double>) < 4 * in.error);
}

TEST_CASE("a picture's density integrates to one, and sampling follows it") {
  EnvironmentImage image{"", 8, 4, {}};
  for (int i = 0; i < 32; ++i) {
    const float v = i == 13 ? 50.0f : float(i % 5);
    image.rgb.push_back({v, v, v});
  }
  SceneData s = scene_with(Sphere{});
  s.environment.image = image;
  s.environment.radiance = {1, 1, 1};
  s.environment.rotation = 0.7;
  const Lights lights(s, {0.0});
  REQUIRE(lights.any());
  double integral = 0, expected = 0, found = 0;
  const int n = 400000;
  const auto in_cap = [](Vec3d d) { return dot(d, normalize(Vec3d{0.3, 0.5, -0.8})) > 0.6; };
  for (int i = 0; i < n; ++i) {
    const double u = u01(2 * std::uint64_t(i)), v = u01(2 * std::uint64_t(i) + 1);
    const Vec3d d = square_to_sphere(u, v);
    const double pdf = lights.pdf_environment(Vec3d{0, 0, 0}, d) * 4 * kPi<double>;
    integral += pdf / n;
    expected += in_cap(d) ? pdf / n : 0;
    const LightSample drawn = lights.sample(Vec3d{0, 0, 0}, u, v);
    REQUIRE(drawn.object == kEnvironment);
    CHECK(drawn.pdf > 0);
    found += in_cap(drawn.direction) ? 1.0 / n : 0;
  }
  // The density is at most about 40 times the even one: deviation of the mean below 3 / sqrt(n).
  CHECK(integral == doctest::Approx(1).epsilon(0.02));
  CHECK(std::abs(found - expected) < 0.02);
}

TEST_CASE("with several lights, few or many, choices and places still integrate to the sum") {
  SceneData s = scene_with(Quad{{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}});
  std::vector<double> radiance{1.0};
  int more = 0;
  SUBCASE("few: weighed at each point") { more = 5; }
  SUBCASE("many: in a tree") { more = 40; }
  for (int i = 0; i < more; ++i) {
    Object o;
    o.shape = Disc{{double(i + 2), 1, 0}, Frame<double>::around({-1, 0, 0}), 0.1};
    s.objects.push_back(std::move(o));
    radiance.push_back(0.5 * i);
  }
  const Lights lights(s, radiance);
  const Vec3d from{0.1, 0, 0.2};
  // The share of the square's light: mean of its 1 / pdf over all draws.
  const int n = 400000;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const LightSample d =
        lights.sample(from, u01(2 * std::uint64_t(i)), u01(2 * std::uint64_t(i) + 1));
    if (d.object != 0 || !(d.pdf > 0)) continue;
    sum += 1 / d.pdf;
    squares += 1 / (d.pdf * d.pdf);
  }
  // Quadrature of cos / d^2 over the square.
  double expected = 0;
  for (int a = 0; a < 400; ++a)
    for (int b = 0; b < 400; ++b) {
      const Vec3d to = Vec3d{-1 + (a + 0.5) / 200, 2, -1 + (b + 0.5) / 200} - from;
      expected += 2 / std::pow(dot(to, to), 1.5) / 40000;
    }
  const double mean = sum / n;
  CHECK(std::abs(mean - expected) < 4 * std::sqrt((squares / n - mean * mean) / n) + 1e-5);
}

TEST_CASE("only what emits is a light, and an even environment is left to scattering") {
  SceneData s = scene_with(Sphere{});
  s.environment.radiance = {1, 1, 1};
  const Lights lights(s, {0.0});
  CHECK_FALSE(lights.any());
  CHECK(lights.pdf_environment(Vec3d{0, 0, 0}, {0, 1, 0}) == 0);
  CHECK(lights.pdf(Vec3d{0, 0, 3}, 0, surface_at(Sphere{}, {0, 0, 1})) == 0);
}

TEST_CASE("light is drawn by where a surface faces, and by each light alone where each is drawn") {
  // Two squares of 2 m, 2 m above and below: what faces up sees the upper one.
  SceneData s = scene_with(Quad{{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}});
  Object below;
  below.shape = Quad{{-1, -2, -1}, {0, 0, 2}, {2, 0, 0}};
  s.objects.push_back(std::move(below));
  const Lights lights(s, {1.0, 1.0});
  const Receiver up{{0.1, 0, 0.2}, {{0, 1, 0}}};
  const int n = 20000;
  int upper = 0;
  for (int i = 0; i < n; ++i) {
    const double u = u01(2 * std::uint64_t(i)), v = u01(2 * std::uint64_t(i) + 1);
    const LightSample d = lights.sample(up, u, v);
    CHECK(d.pdf == doctest::Approx(lights.pdf(up, d.object, d.surface)));
    upper += d.object == 0;
    const Receiver each{up.position, {{0, 1, 0}, false, 1}};
    const LightSample one = lights.sample_one(0, each, u, v);
    CHECK(one.object == 0);
    CHECK(one.pdf == doctest::Approx(lights.pdf(each, 0, one.surface)));
  }
  // A tenth of the choices is even: one in twenty goes down, give or take 5 standard deviations.
  CHECK(std::abs(upper - 0.95 * n) < 5 * std::sqrt(0.95 * 0.05 * n));
}

TEST_CASE("weights of the two ways to find a light add up to one, for any densities") {
  for (std::uint64_t i = 0; i < 100; ++i) {
    Carried c;
    double scattering = 0, light = 0;
    const double density = std::exp2(40 * u01(3 * i) - 20);
    for (int k = 0; k < kWavelengths; ++k) {
      c.pdf[k] = float(u01(1000 + 8 * i + k));
      c.light_pdf[k] = float(u01(9000 + 8 * i + k));
      scattering += c.pdf[k];
      light += density * c.light_pdf[k];
    }
    // What each contributes is 1 over its density, weighed: its density takes that out again.
    const Estimator e = Estimator::Clustered;
    const double sum = c.weighted(Technique::Scattering, density, e)[0] * scattering +
                       c.weighted(Technique::Light, density, e)[0] * light;
    CHECK(sum == doctest::Approx(1).epsilon(1e-6));
  }
  Carried alone;
  CHECK(alone.weighted(Technique::Scattering, 0, Estimator::Clustered)[0] ==
        doctest::Approx(1.0 / kWavelengths));
}

namespace {

/// Means over drawn places and over a grid: what follows a density has the mean of the grid
/// weighed by it.
template <class Density>
void check_places(const Density& density, bool disc) {
  constexpr int kGrid = 400, kDrawn = 400000;
  const auto moment = [](double x, double y) { return x + 0.3 * y + x * x - 0.7 * x * y; };
  double area = 0, mass = 0, expected = 0;
  for (int i = 0; i < kGrid; ++i)
    for (int j = 0; j < kGrid; ++j) {
      double x = (i + 0.5) / kGrid, y = (j + 0.5) / kGrid;
      if (disc) {
        const Vec3d p = square_to_disc(x, y);  // preserves area
        x = p.x, y = p.y;
      }
      const double d = density.at(x, y) / (kGrid * kGrid);
      area += 1.0 / (kGrid * kGrid);
      mass += d;
      expected += d * moment(x, y);
    }
  CHECK(mass == doctest::Approx(area).epsilon(2e-5));
  double sum = 0, squares = 0;
  for (int i = 0; i < kDrawn; ++i) {
    const Place p = density.sample(u01(2 * std::uint64_t(i)), u01(2 * std::uint64_t(i) + 1));
    if (disc ? p.x * p.x + p.y * p.y > 1 + 1e-12 : std::min(p.x, p.y) < 0 || std::max(p.x, p.y) > 1)
      FAIL("a place outside");
    const double m = moment(p.x, p.y);
    sum += m;
    squares += m * m;
  }
  const double mean = sum / kDrawn;
  CHECK(std::abs(mean - expected) <
        4 * std::sqrt((squares / kDrawn - mean * mean) / kDrawn) + 2e-5);
}

/// Light that a matte receiver draws from a lamp of radiance 1: irradiance over pi, and the
/// standard deviation of one draw.
Estimate irradiance(const Lights& lights, const Receiver& from) {
  const int n = 200000;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const LightSample s =
        lights.sample_one(0, from, u01(2 * std::uint64_t(i)), u01(2 * std::uint64_t(i) + 1));
    if (!(s.pdf > 0)) continue;
    const double f = std::max(0.0, dot(s.direction, from.normal)) / (kPi<double> * s.pdf);
    sum += f;
    squares += f * f;
  }
  const double mean = sum / n;
  return {mean, std::sqrt(squares / n - mean * mean)};
}

}  // namespace

TEST_CASE("places drawn on squares and discs follow their densities, which have the mean 1") {
  check_places(SquareDensity([](double x, double y) { return 1 + 3 * x * x + y; }), false);
  check_places(SquareDensity([](double x, double y) { return x > 0.7 && y > 0.7 ? 5.0 : 0.0; }),
               false);
  check_places(SquareDensity([](double, double) { return 0.0; }), false);
  check_places(DiscDensity(1, 0.7, 0.4, -0.2), true);
  check_places(DiscDensity(0.2, 3, 0, 0), true);
  check_places(DiscDensity(1, 0, 9, 9), true);
  check_places(DiscDensity(0, 0, 1, 0), true);
}

TEST_CASE("what is matte draws places of a lamp by what it gets from there") {
  // Irradiance of a tilted receiver by quadrature over the lamp; lamps of half a radian and more.
  const double tilt = 0.6;
  const Receives matte{{float(std::sin(tilt)), float(std::cos(tilt)), 0}, true};
  const Vec3d at{0.1, 0, 0.2}, normal(matte.normal);
  Shape shape;
  double expected = 0;
  constexpr int kGrid = 500;
  SUBCASE("square") {
    shape = Quad{{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}};
    for (int i = 0; i < kGrid; ++i)
      for (int j = 0; j < kGrid; ++j) {
        const Vec3d to = Vec3d{-1 + (i + 0.5) * 2 / kGrid, 2, -1 + (j + 0.5) * 2 / kGrid} - at;
        const double d2 = dot(to, to);
        expected += 4 * std::max(0.0, dot(to, normal)) * 2 / (d2 * d2) / (kGrid * kGrid);
      }
  }
  SUBCASE("disc") {
    shape = Disc{{0.5, 2, 0}, Frame<double>::around({0, -1, 0}), 0.9};
    for (int i = 0; i < kGrid; ++i)
      for (int j = 0; j < kGrid; ++j) {
        const Vec3d p = square_to_disc((i + 0.5) / kGrid, (j + 0.5) / kGrid) * 0.9;
        const Vec3d to = Vec3d{0.5 + p.x, 2, p.y} - at;
        const double d2 = dot(to, to);
        expected +=
            kPi<double> * 0.81 * std::max(0.0, dot(to, normal)) * 2 / (d2 * d2) / (kGrid * kGrid);
      }
  }
  SUBCASE("sphere: as of a disc of its outline, cosine in the middle times sin^2") {
    shape = Sphere{{0.1, 2, 0.2}, 0.9, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    expected = kPi<double> * std::cos(tilt) * 0.81 / 4;
  }
  SUBCASE("square that is half below the horizon") {
    shape = Quad{{-2.5, 0.5, -1}, {2, 0, 0}, {0, 2, 0}};
    for (int i = 0; i < kGrid; ++i)
      for (int j = 0; j < kGrid; ++j) {
        const Vec3d to = Vec3d{-2.5 + (i + 0.5) * 2 / kGrid, 0.5 + (j + 0.5) * 2 / kGrid, -1} - at;
        const double d2 = dot(to, to);
        expected += 4 * std::max(0.0, dot(to, normal)) * 1.2 / (d2 * d2) / (kGrid * kGrid);
      }
  }
  const SceneData s = scene_with(shape);
  const Lights lights(s, {1.0});
  const Estimate e = irradiance(lights, {at, matte});
  CHECK(std::abs(e.value - expected / kPi<double>) <
        4 * e.error / std::sqrt(2e5) + 1e-5 * expected);
  // All but what is matte draws them evenly: that deviates twice as much.
  const Estimate even = irradiance(lights, {at, {matte.normal, false}});
  CHECK(2 * e.error < even.error);
}

TEST_CASE("to draw places by what comes from them is never much worse than evenly") {
  for (int i = 0; i < 60; ++i) {
    const auto u = [i](int k) { return u01(std::uint64_t(1000 * i + k)); };
    const Frame<double> axes = Frame<double>::around(square_to_sphere(u(0), u(1)));
    const Vec3d centre = square_to_sphere(u(2), u(3)) * (1 + 2 * u(4));
    Shape shape = Sphere{centre, 1, axes};
    if (i % 3 == 1) shape = Disc{centre, axes, 1};
    if (i % 3 == 2) {
      const Vec3d a = axes.s * (0.3 + u(5)), b = axes.t * (0.2 + u(6)) + axes.s * (u(7) - 0.5);
      shape = Quad{centre - (a + b) * 0.5, a, b};
    }
    const SceneData s = scene_with(shape);
    const Lights lights(s, {1.0});
    const Vec3f normal(square_to_sphere(u(8), u(9)));
    const Estimate by = irradiance(lights, {Vec3d{}, {normal, true}});
    const Estimate even = irradiance(lights, {Vec3d{}, {normal, false}});
    INFO("lamp " << i << ", mean " << even.value);
    CHECK(by.error <= 1.1 * even.error + 1e-6);
    CHECK(std::abs(by.value - even.value) < 5 * (by.error + even.error) / std::sqrt(2e5) + 1e-9);
  }
}
