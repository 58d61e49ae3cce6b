// SPDX-License-Identifier: Apache-2.0
// Light by way of balls, beside rays that are bent by Snell's law as vectors, surface by
// surface.
#include "renderer/caustics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <random>

#include "base/warp.h"
#include "renderer/cluster.h"
#include "scenes.h"
#include "tests/sanitized.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

namespace {

/// The textbook's Fresnel for light that comes from air.
double reflectance(double c, double n) {
  const double t = std::sqrt(1 - (1 - c * c) / (n * n));
  const double s = (c - n * t) / (c + n * t), p = (n * c - t) / (n * c + t);
  return (s * s + p * p) / 2;
}

Vec3d refract(Vec3d d, Vec3d normal, double eta) {
  const double c = -dot(d, normal), t2 = 1 - eta * eta * (1 - c * c);
  return d * eta + normal * (eta * c - std::sqrt(t2));
}

/// A ray that has met a sphere of radius 1 at the origin and index n.
struct Met {
  bool hit = false;
  double cosine = 0;  ///< where it enters
  Vec3d entry, exit;
  Vec3d mirrored, direction;  ///< unit, at once and behind the ball
};

Met meet(Vec3d from, Vec3d d, double n) {
  const double b = dot(from, d), square = b * b - dot(from, from) + 1;
  if (!(square > 0) || b > 0) return {};
  Met m;
  m.hit = true;
  m.entry = from + d * (-b - std::sqrt(square));
  m.cosine = -dot(d, m.entry);
  m.mirrored = d + m.entry * (2 * m.cosine);
  const Vec3d inside = refract(d, m.entry, 1 / n);
  m.exit = m.entry - inside * (2 * dot(inside, m.entry));
  m.direction = refract(inside, m.exit * -1.0, n);
  return m;
}

/// A ray from inside.
Met leave(Vec3d from, Vec3d d, double n) {
  const double b = dot(from, d);
  const Vec3d exit = from + d * (-b + std::sqrt(b * b - dot(from, from) + 1));
  const double inside = dot(d, exit), t2 = 1 - n * n * (1 - inside * inside);
  if (!(t2 > 0)) return {};
  Met m;
  m.hit = true;
  m.cosine = std::sqrt(t2);
  m.entry = m.exit = exit;
  m.direction = refract(d, exit * -1.0, n);
  return m;
}

/// A ray as it goes by a ball.
Met go(Course course, Vec3d from, Vec3d d, double n) {
  if (course == Course::Out || course == Course::OutPast) return leave(from, d, n);
  Met m = meet(from, d, n);
  if (course == Course::Mirrored) {
    m.exit = m.entry;
    m.direction = m.mirrored;
  }
  return m;
}

/// Of a ball that mirrors and lets light through.
BallOptics optics(double n) {
  BallOptics o;
  o.mirrors = true;
  o.index = float(n);
  return o;
}

/// Two points around a ball of radius 1 and its index.
struct Case {
  Vec3d from, to;
  double n;
};

enum class Where { Behind, Before, Inside };

Case draw(std::mt19937_64& random, Where where) {
  std::uniform_real_distribution<double> u(0, 1);
  const auto point = [&] {
    const double z = 2 * u(random) - 1, phi = 2 * kPi<double> * u(random), s = std::sqrt(1 - z * z);
    const double far = 1.01 + std::exp(5 * u(random) - 3);
    return Vec3d{s * std::cos(phi), s * std::sin(phi), z} * far;
  };
  const double depth = u(random);
  const Vec3d from = where == Where::Inside ? normalize(point()) * (0.995 * depth) : point();
  // Behind the ball light is gathered; before it, it is mirrored.
  const Vec3d to =
      normalize(point() * 0.7 + from * (where == Where::Before ? 1.0 : -1.0)) * length(point());
  return {from, to, 1.02 + 1.5 * u(random)};
}

/// What the ground at the origin, facing +y, gets from a disc of radiance 1 by way of a ball.
struct Ground {
  Vec3d ball;
  double radius, n;
  Vec3d lamp, facing;
  double lamp_radius;
  bool through = true;  ///< else off it, all of the light

  bool lights(Vec3d from, Vec3d d) const {
    const double down = dot(d, facing), t = dot(lamp - from, facing) / down;
    if (!(down < 0) || !(t > 0)) return false;
    const Vec3d off = from + d * t - lamp;
    return dot(off, off) < lamp_radius * lamp_radius;
  }

  /// Over the cone that the ball fills, by the middle of cells.
  double irradiance(int cells) const {
    const double distance = length(ball), cap = 1 - std::sqrt(1 - std::pow(radius / distance, 2));
    const Frame<double> axes = Frame<double>::around(ball / distance);
    double sum = 0;
    for (int i = 0; i < cells; ++i)
      for (int k = 0; k < 4 * cells; ++k) {
        const double z = 1 - cap * (i + 0.5) / cells, phi = kPi<double> * (k + 0.5) / (2 * cells);
        const double s = std::sqrt(1 - z * z);
        const Vec3d d = axes.to_world({s * std::cos(phi), s * std::sin(phi), z});
        const Met m = go(through ? Course::Through : Course::Mirrored, ball / -radius, d, n);
        if (!m.hit || !(d.y > 0)) continue;
        const double past = 1 - reflectance(m.cosine, n);
        if (lights(ball + m.exit * radius, m.direction)) sum += (through ? past * past : 1) * d.y;
      }
    return sum * cap * 2 * kPi<double> / (4.0 * cells * cells);
  }
};

}  // namespace

TEST_CASE("every ray by way of a ball is found, and goes where it says") {
  std::mt19937_64 random(1);
  int found[4] = {}, several = 0;
  for (int i = 0; i < (kSanitized ? 300 : 1500); ++i) {
    const Case c = draw(random, Where(i % 3));
    if (length(c.to) < 1.01) continue;
    const double n = float(c.n);
    std::array<BallRay, kMostBallRays> rays;
    const int count = rays_by({0, {}, 1}, optics(c.n), c.from, c.to, rays);
    const Vec3d axis = normalize(c.from), plane = normalize(cross(cross(axis, c.to), axis));
    const bool inside = length(c.from) < 1;
    // A ray's angle to the line to the centre, in its plane.
    const auto towards = [&](double a) { return axis * -std::cos(a) + plane * std::sin(a); };
    for (const bool mirrored : {false, true}) {
      if (inside && mirrored) continue;
      std::vector<double> angles;
      // Rays next to each other, or to where there are none, fall between two steps below.
      double nearest = 1;
      for (int k = 0; k < count; ++k) {
        if ((rays[k].course == Course::Mirrored) != mirrored) continue;
        const Vec3d d = normalize(rays[k].entry - c.from);
        const Met m = go(rays[k].course, c.from, d, n);
        REQUIRE(m.hit);
        CHECK(m.cosine == doctest::Approx(rays[k].cosine).epsilon(1e-6));
        CHECK(length(m.exit - rays[k].exit) < 1e-6);
        CHECK(dot(normalize(c.to - m.exit), m.direction) > 1 - 1e-11);
        if (inside) CHECK((dot(d, c.from) > 0) == (rays[k].course == Course::Out));
        const double angle = std::atan2(dot(d, plane), -dot(d, axis));
        nearest = std::min(nearest, inside ? rays[k].cosine * rays[k].cosine : rays[k].cosine);
        for (double other : angles) nearest = std::min(nearest, std::abs(angle - other));
        angles.push_back(angle);
        ++found[int(rays[k].course)];
      }
      several += angles.size() > 1;
      // On what side of the point rays pass it, over all that there are in the plane.
      constexpr int steps = 4000;
      const Course course = inside ? Course::Out : mirrored ? Course::Mirrored : Course::Through;
      double before = 0;
      std::size_t crossed = 0;
      bool any = false;
      for (int k = 0; k <= steps; ++k) {
        const double theta = kPi<double> * ((k + 0.5) / (steps + 1) - 0.5);
        const double angle = inside ? 2 * theta : std::asin(std::sin(theta) / length(c.from));
        const Met m = go(course, c.from, towards(angle), n);
        const Vec3d way = c.to - m.exit;
        const double side = dot(cross(way, m.direction), cross(axis, plane));
        crossed += m.hit && any && (side > 0) != (before > 0) && dot(way, m.direction) > 0;
        any = m.hit;
        before = side;
      }
      if (nearest > 5e-3) CHECK_MESSAGE(crossed == angles.size(), i);
    }
  }
  for (const int n : found) CHECK(n > (kSanitized ? 10 : 100));
  CHECK(several > (kSanitized ? 3 : 50));
}

TEST_CASE("how rays by way of a ball spread is the quotient of small differences") {
  std::mt19937_64 random(2);
  int cases[4] = {};
  for (int i = 0; i < 1500; ++i) {
    const Case c = draw(random, Where(i % 3));
    if (length(c.to) < 1.01) continue;
    const PolishedBall ball{0, {}, 1};
    std::array<BallRay, kMostBallRays> rays;
    const int count = rays_by(ball, optics(c.n), c.from, c.to, rays);
    for (int k = 0; k < count; ++k) {
      // The rim turns rays the faster the nearer they are to it.
      if (rays[k].cosine < 0.05) continue;
      const BallWay way{rays[k].course, c.n, rays[k].cosine};
      const Vec3d d = normalize(rays[k].entry - c.from);
      const Vec3d arriving = normalize(c.to - rays[k].exit);
      const Frame<double> around = Frame<double>::around(d);
      const auto lands = [&](Vec3d to) {
        const Met m = go(way.course, c.from, normalize(to), c.n);
        return m.exit + m.direction * (dot(c.to - m.exit, arriving) / dot(m.direction, arriving));
      };
      const double h = 1e-6;
      const Vec3d s = (lands(d + around.s * h) - lands(d - around.s * h)) / (2 * h);
      const Vec3d t = (lands(d + around.t * h) - lands(d - around.t * h)) / (2 * h);
      const double area = length(cross(s, t));
      const double spread = spread_by(ball, way, c.from, c.to);
      REQUIRE(spread > 0);
      const double size = length(c.from) + length(c.to);
      CHECK(std::abs(1 / spread - area) < 1e-4 * area + 1e-5 * size * size);
      ++cases[int(way.course)];
    }
  }
  for (const int n : cases) CHECK(n > 80);
}

TEST_CASE("next to the ball, on its axis, and at every scale rays and densities are finite") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> u(0, 1);
  const materials::Layout layout(vm::MaterialLayout{
      {{int(materials::Lobe::Mirror), {{vm::SlotType::Spectrum, true, 0}}, {}}}});
  const auto power = [&](double from, double to) {
    return std::pow(10, from + (to - from) * u(random));
  };
  const auto direction = [&] {
    const double z = 2 * u(random) - 1, phi = 2 * kPi<double> * u(random), s = std::sqrt(1 - z * z);
    return Vec3d{s * std::cos(phi), s * std::sin(phi), z};
  };
  int found = 0;
  for (int i = 0; i < (kSanitized ? 2000 : 100000); ++i) {
    const PolishedBall ball{0, direction() * power(-3, 3), power(-3, 3), &layout};
    const BallOptics o = optics(i % 4 == 0 ? 1.01001 : 1.01 + power(-3, 0.5));
    // A distance from the surface, inside or outside.
    const auto away = [&](bool inside) {
      return ball.radius * (inside ? 1 - std::min(1.0, power(-12, 0)) : 1 + power(-12, 8));
    };
    const Vec3d d = direction();
    const Vec3d from = ball.centre + d * away(i % 3 == 0);
    const Vec3d across =
        i % 2 ? direction() : d * (i % 5 ? 1.0 : -1.0) + direction() * power(-14, 0);
    SurfacePoint to;
    to.position = ball.centre + normalize(across) * away(false);
    to.geometric_normal = direction();
    std::array<BallRay, kMostBallRays> rays;
    const int count = rays_by(ball, o, from, to.position, rays);
    REQUIRE(count <= kMostBallRays);
    for (int k = 0; k < count; ++k) {
      const BallRay& ray = rays[std::size_t(k)];
      const BallWay way{ray.course, o.index, ray.cosine};
      const double sum = dot(ray.entry, ray.entry) + dot(ray.exit, ray.exit) + ray.cosine;
      CHECK(std::isfinite(sum));
      const double spread = spread_by(ball, way, from, to.position);
      const double density = density_by(ball, way, from, to, 1, normalize(ray.exit - to.position));
      CHECK_MESSAGE((spread >= 0 && std::isfinite(spread)), i);
      CHECK_MESSAGE((density >= 0 && std::isfinite(density)), i);
      ++found;
    }
  }
  CHECK(found > (kSanitized ? 500 : 30000));
}

TEST_CASE("light from endlessly far is what light from very far comes to") {
  const materials::Layout layout(vm::MaterialLayout{
      {{int(materials::Lobe::Mirror), {{vm::SlotType::Spectrum, true, 0}}, {}}}});
  const PolishedBall ball{0, {0.2, 0.1, -0.3}, 0.7, &layout};
  const Vec3d from{1.5, 0.4, 0.9};
  for (const BallWay& way : {BallWay{Course::Through, 1.5, 0.8}, BallWay{Course::Mirrored, 1, 0.6}})
    for (const Vec3d& direction :
         {normalize(Vec3d{-1, -0.3, 0.2}), normalize(Vec3d{0.2, 1, 0.5})}) {
      SurfacePoint far;
      far.position = ball.centre + direction * 1e5;
      far.geometric_normal = -direction;
      CHECK(far_density_by(ball, way, from, direction, 3) ==
            doctest::Approx(density_by(ball, way, from, far, 3, -direction)).epsilon(1e-4));
    }
}

TEST_CASE("the ground gets what rays through a clear ball bring, or off a mirror") {
  std::string script = "dielectric(1.5)";
  std::function<double(double)> index = [](double) { return 1.5; };
  constexpr int kCoarser = kSanitized ? 3 : 1;
  int cells = 600 / kCoarser;
  bool through = true;
  SUBCASE("of glass") {}
  SUBCASE("of glass that disperses") {
    script = "dielectric(1.35 + 5e-14 / ($wavelength * $wavelength))";
    index = [](double nm) { return 1.35 + 5e-14 / (nm * nm * 1e-18); };
    cells /= 8;
  }
  SUBCASE("off a mirror") {
    script = "mirror(1)";
    through = false;
  }
  const vm::Program p = compile("surface s bsdf = " + script + "; end\n");
  for (const double lamp_radius : {0.05, 0.6}) {
    const Vec3d ball{0.45, 0.5, 0};
    const double radius = 0.35;
    const Vec3d facing = normalize(through ? Vec3d{-1, -1.2, 0.05} : Vec3d{1, 0.05, 0.3});
    const Vec3d lamp = through ? facing * -2.5 : Vec3d{-1.5, 1, -0.4};
    const Scene s = scene_of(p, ground_by_ball(ball, radius, lamp, facing, lamp_radius));
    CAPTURE(lamp_radius);
    RenderOptions o = options(16, 1024 / (kCoarser * kCoarser));
    o.max_depth = through ? 2 : 1;  // less than it takes
    const Mean straight = mean_luminance(run(p, s, o).film);
    if (through) CHECK(straight.value == 0);

    constexpr int kClusters = 8;
    double expected = 0, at = 0, irradiance = 0;
    for (int c = 0; c < kClusters; ++c) {
      const Cluster cluster = sample_cluster((c + 0.5) / kClusters);
      Spectrumf light;
      for (int k = 0; k < kWavelengths; ++k) {
        const double n = index(cluster.lambda.nm[k]);
        if (n != at)
          irradiance =
              Ground{ball, radius, n, lamp, facing, lamp_radius, through}.irradiance(cells);
        at = n;
        light[k] = float(irradiance * 2 * 0.5 / kPi<double>);
      }
      expected += cluster.xyz(light * cluster.light({1, 1, 1}))[1] / (kClusters * kWavelengths);
    }
    ++o.max_depth;
    const Mean m = mean_luminance(run(p, s, o).film);
    INFO("mean ", m.value, " +- ", m.error, ", straight ", straight.value, ", expected ", expected);
    // Cells cut the lamp's edge to about a thousandth, and so near are the clusters' colours.
    CHECK(std::abs(m.value - straight.value - expected) <
          4 * std::hypot(m.error, straight.error) + 2e-3 * kCoarser * expected);
    CHECK(m.error < 0.005 * kCoarser * expected);
  }
}

constexpr const char* kDisperses = "1.4 + 3e-14 / ($wavelength * $wavelength)";

TEST_CASE("amid lamps of radiance 1 a ball that loses nothing is 1, whatever it is filled with") {
  std::string script, object;
  SUBCASE("a medium that scatters") {
    script = "volume v scattering = 2; phase = henyey_greenstein(0.4); end\n";
  }
  SUBCASE("one that varies from place to place") {
    script = "volume v scattering = 3 + 2 * $object_position.y; bound = 5; end\n";
  }
  SUBCASE("a white ball") {
    object = R"(, {"sphere": {"center": [0.2, 0.1, 0], "radius": 0.5}, "surface": "white"})";
  }
  std::string index = "1.5";
  SUBCASE("nothing, of glass that disperses") { index = kDisperses; }
  SUBCASE("a medium in glass that disperses") {
    script = "volume v scattering = 2; end\n";
    index = kDisperses;
  }
  const vm::Program p = compile("surface s bsdf = dielectric(" + index + "); end\n" + script);
  const Scene s = scene_of(p, R"({"camera": {"position": [0, 0.4, 3], "target": [0, 0, 0],
    "fov": 30}, "materials": {"lamp": {"matte": 0, "emission": 1}, "white": {"matte": 1}},
    "objects": [{"sphere": {"radius": 1}, "test": true},
    {"quad": {"corner": [-6, -6, -6], "u": [12, 0, 0], "v": [0, 12, 0]}, "surface": "lamp"},
    {"quad": {"corner": [-6, -6, 6], "u": [0, 12, 0], "v": [12, 0, 0]}, "surface": "lamp"},
    {"quad": {"corner": [-6, -6, -6], "u": [0, 12, 0], "v": [0, 0, 12]}, "surface": "lamp"},
    {"quad": {"corner": [6, -6, -6], "u": [0, 0, 12], "v": [0, 12, 0]}, "surface": "lamp"},
    {"quad": {"corner": [-6, -6, -6], "u": [0, 0, 12], "v": [12, 0, 0]}, "surface": "lamp"},
    {"quad": {"corner": [-6, 6, -6], "u": [12, 0, 0], "v": [0, 0, 12]}, "surface": "lamp"})" +
                                  object + "]}");
  const Mean m = mean_luminance(run(p, s, options(16, kSanitized ? 32 : 512)).film);
  INFO("mean ", m.value, " +- ", m.error);
  CHECK(std::abs(m.value - 1) < 4 * m.error + 1e-4);
  CHECK(m.error < 0.01);
}
