// SPDX-License-Identifier: Apache-2.0
#include "renderer/shape.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/hash.h"
#include "base/warp.h"
#include "renderer/accel.h"

using namespace mms;
using namespace mms::renderer;

namespace {

double u01(std::uint64_t i) { return to_unit(mix64(i)); }

Vec3d random_direction(std::uint64_t i) { return square_to_sphere(u01(2 * i), u01(2 * i + 1)); }

Mesh tetrahedron() {
  Mesh m;
  m.positions = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  m.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  for (Vec3f p : m.positions) m.normals.push_back(normalize(p));
  m.uvs = {{0.f, 0.f}, {1.f, 0.f}, {0.f, 1.f}, {1.f, 1.f}};
  return m;
}

}  // namespace

TEST_CASE("a sphere is met where the closed form says, near and 1e6 radii away") {
  for (const double away : {3.0, 1e3, 1e6}) {
    const Sphere s{{away, 0, 0}, 1, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const double h = 0.6;  // the ray passes the centre at this height
    const Roots r = intersect(s, {0, h, 0}, {1, 0, 0}, 0, 1e30);
    REQUIRE(r.count == 2);
    CHECK(r.t[0] == doctest::Approx(away - 0.8).epsilon(1e-15));
    CHECK(r.t[1] == doctest::Approx(away + 0.8).epsilon(1e-15));
    CHECK(intersect(s, {0, 1.0001, 0}, {1, 0, 0}, 0, 1e30).count == 0);
  }
}

TEST_CASE("derivatives of a sphere's point agree with central differences along its tangents") {
  const Sphere s{{0.3, -2, 5}, 1.7, {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};
  for (std::uint64_t i = 1; i < 200; ++i) {
    const SurfacePoint p = surface_at(s, s.centre + random_direction(i) * s.radius);
    if (std::abs(dot(p.normal, s.axes.t)) > 0.98) continue;  // near the poles u bends too fast
    const double h = 1e-5;
    const auto step = [&](Vec3d d) {
      return std::pair(surface_at(s, p.position + d * h), surface_at(s, p.position - d * h));
    };
    for (const bool along_tangent : {true, false}) {
      const Vec3d d = along_tangent ? p.tangent : p.bitangent;
      const auto [b, a] = step(d);
      const Vec3d dn = (b.normal - a.normal) / (2 * h);
      const Vec3d expected = along_tangent ? p.normal_tangent : p.normal_bitangent;
      CHECK(length(dn - expected) < 1e-8);  // h^2 times third derivatives below 10, and 1e-16 / h
      const auto& duv = along_tangent ? p.uv_tangent : p.uv_bitangent;
      if (std::abs(b.uv[0] - a.uv[0]) < 0.5) {
        CHECK((b.uv[0] - a.uv[0]) / (2 * h) == doctest::Approx(duv[0]).epsilon(1e-5));
        CHECK((b.uv[1] - a.uv[1]) / (2 * h) == doctest::Approx(duv[1]).epsilon(1e-5));
      }
    }
    CHECK(dot(cross(p.normal, p.tangent), p.bitangent) == doctest::Approx(1));
    CHECK(p.uv_tangent[0] > 0);  // u grows along the tangent
  }
}

TEST_CASE("derivatives of uv on a mesh agree with differences inside a triangle") {
  const Mesh m = tetrahedron();
  const double u = 0.3, v = 0.25, h = 1e-6;
  for (std::uint32_t t = 0; t < 4; ++t) {
    const SurfacePoint p = surface_at(m, t, u, v);
    CHECK(dot(p.geometric_normal, p.position) > 0);  // wound outwards
    // Change along an edge of the triangle: uv and normal are followed through the barycentrics,
    // and must agree with the derivatives applied to the edge's part in the tangent plane where the
    // shading normal is that of the geometry.
    Mesh flat = m;
    flat.normals.clear();
    const SurfacePoint f = surface_at(flat, t, u, v);
    for (const auto& [du, dv] : {std::pair(h, 0.0), std::pair(0.0, h)}) {
      const SurfacePoint q = surface_at(flat, t, u + du, v + dv),
                         o = surface_at(flat, t, u - du, v - dv);
      const Vec3d step = q.position - o.position;
      for (int k = 0; k < 2; ++k)
        CHECK(dot(step, f.tangent) * f.uv_tangent[k] + dot(step, f.bitangent) * f.uv_bitangent[k] ==
              doctest::Approx(q.uv[k] - o.uv[k]).epsilon(1e-8));
    }
    CHECK(std::abs(dot(p.tangent, p.normal)) < 1e-12);
    CHECK(std::abs(dot(p.normal_tangent, p.normal)) < 1e-12);
  }
}

TEST_CASE(
    "points of a surface stay within their stated error when rounded, and rays start beyond it") {
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double away = std::exp2(20 * u01(7 * i) - 5);
    const Sphere s{random_direction(3 * i) * away,
                   std::exp2(10 * u01(11 * i) - 5),
                   {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const SurfacePoint p = surface_at(s, s.centre + random_direction(5 * i) * s.radius);
    const Vec3d rounded{Vec3f(p.position)};
    CHECK(std::abs(length(rounded - s.centre) - s.radius) <= p.error);
    if (p.error > 0.01 * s.radius) continue;  // smaller than float resolves out there
    const Vec3d d = random_direction(13 * i);
    const Vec3d o{ray_origin(p, d)};
    // Outwards the ray must not meet the sphere again; inwards exactly once.
    if (dot(d, p.geometric_normal) > 0.05) CHECK(intersect(s, o, d, 0, 1e30).count == 0);
    if (dot(d, p.geometric_normal) < -0.05) CHECK(intersect(s, o, d, 0, 1e30).count == 1);
  }
}

TEST_CASE("inside and outside of closed shapes") {
  const Shape mesh = tetrahedron();
  const Shape ball = Sphere{};
  CHECK(contains(mesh, {0, 0, 0}));
  CHECK_FALSE(contains(mesh, {1, 1, -1}));
  CHECK(contains(ball, {0.5, 0.5, 0.5}));
  CHECK_FALSE(contains(ball, {0.6, 0.6, 0.6}));
}

TEST_CASE("crossings keep the nearest, each once, and know when there were more") {
  Crossings c;
  for (int i = 0; i < 40; ++i) c.add({0, std::uint32_t(i), float((i * 7) % 40), 0, 0});
  c.add({0, 0, 0.0f, 0, 0});  // there already: the filter may report a primitive twice
  CHECK(c.count == kMaxCrossings);
  CHECK(c.overflow);
  for (int i = 0; i < c.count; ++i) CHECK(c.hits[i].t == float(i));
}

TEST_CASE("a turned box is met where six planes are, and its inside is between them") {
  const Box b{{0.3, -1, 2}, Frame<double>::around(normalize(Vec3d{1, 2, -0.5})), {0.5, 1.5, 2}};
  const auto depth = [&](Vec3d p) {  // above 0 inside
    const Vec3d l = b.axes.to_local(p - b.centre);
    return std::min({b.half.x - std::abs(l.x), b.half.y - std::abs(l.y), b.half.z - std::abs(l.z)});
  };
  int met = 0;
  for (std::uint64_t i = 1; i < 2000; ++i) {
    const Vec3d o = b.centre + random_direction(i) * 6.0;
    const Vec3d d = normalize(b.centre + random_direction(i + 5000) * 1.5 - o);
    const Roots r = intersect(b, o, d, 0, 1e30);
    double deepest = -1e9;
    for (int k = 0; k <= 400; ++k) deepest = std::max(deepest, depth(o + d * (0.03 * k)));
    // A step of the march may miss what is under half of it deep.
    if (deepest > 0) CHECK(r.count == 2);
    if (r.count == 0) CHECK(deepest < 0.015);
    for (int k = 0; k < r.count; ++k) {
      ++met;
      const Vec3d at = o + d * r.t[k];
      CHECK(std::abs(depth(at)) < 1e-12);
      const SurfacePoint s = surface_at(b, at);
      CHECK(length(s.position - at) < 1e-12);
      CHECK(depth(at - s.normal * 1e-6) > 0);
      CHECK(dot(cross(s.tangent, s.bitangent), s.normal) == doctest::Approx(1));
      CHECK(dot(s.normal, d) * (k == 0 ? -1 : 1) > 0);
      const SurfacePoint next = surface_at(b, at + s.tangent * 1e-6);
      if (dot(next.normal, s.normal) > 0.5)
        CHECK((next.uv[0] - s.uv[0]) / 1e-6 == doctest::Approx(s.uv_tangent[0]).epsilon(1e-4));
    }
    CHECK(contains(b, o) == (depth(o) > 0));
    CHECK(contains(b, b.centre + random_direction(i) * 0.5) ==
          (depth(b.centre + random_direction(i) * 0.5) > 0));
  }
  CHECK(met > 1000);
}

TEST_CASE("points drawn of a box are spread evenly over its faces") {
  const Box b{{}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0.5, 1, 2}};
  CHECK(area(Shape(b)) == doctest::Approx(2 * (1 * 2 + 2 * 4 + 4 * 1)));
  const int n = 60000;
  int faces[3] = {0, 0, 0}, upper = 0, quarter = 0;
  for (int i = 0; i < n; ++i) {
    const SurfacePoint s =
        sample_surface(b, u01(2 * std::uint64_t(i)), u01(2 * std::uint64_t(i) + 1));
    for (int k = 0; k < 3; ++k) faces[k] += std::abs(s.normal[k]) > 0.5;
    upper += s.normal.x + s.normal.y + s.normal.z > 0;
    quarter += s.uv[0] < 0.5 && s.uv[1] < 0.5;
  }
  // Binomial: 5 standard deviations, sqrt(60000 p (1 - p)) is at most 123.
  CHECK(std::abs(faces[0] - n * 8 / 14) < 620);
  CHECK(std::abs(faces[1] - n * 4 / 14) < 620);
  CHECK(std::abs(faces[2] - n * 2 / 14) < 620);
  CHECK(std::abs(upper - n / 2) < 620);
  CHECK(std::abs(quarter - n / 4) < 620);
}
