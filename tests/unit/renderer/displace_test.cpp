// SPDX-License-Identifier: Apache-2.0
#include "renderer/displace.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "base/warp.h"
#include "scenes.h"
#include "tests/sanitized.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

namespace {

Mesh displaced_mesh(const vm::Program& p, const std::string& object) {
  const Scene s = scene_of(p, R"({"objects": [{"test": true, )" + object + "}]}");
  const Compiled compiled(p);
  Result<SceneData> r = displaced(s.data(), compiled, CameraRays(s.data().camera, 64, 64));
  REQUIRE_MESSAGE(bool(r), (r ? "" : r.error().what));
  CHECK(r->objects[0].displaced);
  return std::get<Mesh>(r->objects[0].shape);
}

/// Edges with other than two triangles: none in a closed mesh.
int open_edges(const Mesh& m) {
  using Point = std::tuple<float, float, float>;
  std::map<std::pair<Point, Point>, int> count;
  const auto at = [&](std::uint32_t i) {
    return Point{m.positions[i].x, m.positions[i].y, m.positions[i].z};
  };
  for (const auto& t : m.triangles)
    for (int k = 0; k < 3; ++k) {
      const Point a = at(t[k]), b = at(t[(k + 1) % 3]);
      if (a != b) ++count[std::minmax(a, b)];
    }
  int open = 0;
  for (const auto& [edge, n] : count) open += n != 2;
  return open;
}

}  // namespace

TEST_CASE("a ball's corners move by the height at their place, and it stays closed") {
  const vm::Program p =
      compile("surface s\n height = 0.2 * cos(2 * pi * $uv.x) * sin(pi * $uv.y);\nend\n");
  const Mesh m =
      displaced_mesh(p, R"("sphere": {"radius": 2}, "translate": [1, 0, 0], "displace": 0.1)");
  CHECK(m.triangles.size() > 8000);
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    const Vec3d r = Vec3d(m.positions[i]) - Vec3d{1, 0, 0};
    const double u = m.uvs[i][0], v = m.uvs[i][1];
    const double height = 0.2 * std::cos(2 * kPi<double> * u) * std::sin(kPi<double> * v);
    CHECK(length(r) == doctest::Approx(2 + height).epsilon(1e-5));
  }
  for (std::uint32_t t = 0; t < m.triangles.size(); ++t) {
    const SurfacePoint s = surface_at(m, t, 0.3, 0.3);
    CHECK(dot(s.geometric_normal, s.position - Vec3d{1, 0, 0}) > 0);
  }
  CHECK(open_edges(m) == 0);
}

TEST_CASE("a sheet becomes the graph of its height, with the normals of the graph") {
  const vm::Program p = compile("surface s\n height = 0.1 * sin(6 * $object_position.x);\nend\n");
  const Mesh m =
      displaced_mesh(p, R"("displace": 0.02, "mesh": {"triangles": [[0, 1, 2], [0, 2, 3]],
      "positions": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]],
      "normals": [[0, 0, 1], [0, 0, 1], [0, 0, 1], [0, 0, 1]]})");
  double worst = 1;
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    const Vec3f q = m.positions[i];
    CHECK(q.z == doctest::Approx(0.1 * std::sin(6 * q.x)).epsilon(1e-5));
    if (q.x < 0.02 || q.x > 0.98 || q.y < 0.02 || q.y > 0.98) continue;  // one-sided at the rim
    const Vec3d n = normalize(Vec3d{-0.6 * std::cos(6 * double(q.x)), 0, 1});
    worst = std::min(worst, dot(n, Vec3d(m.normals[i])));
  }
  // Chords of 0.014 m turn by at most 3.6 * 0.014 = 0.05 rad; their mean errs by a share of it.
  CHECK(worst > std::cos(0.05));
}

TEST_CASE("a box of flat triangles is displaced without gaps at its edges") {
  const vm::Program p = compile("surface s\n height = 0.1;\nend\n");
  const Mesh m = displaced_mesh(p, R"("displace": 0.3, "mesh": {"positions":
      [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]],
      "triangles": [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]})");
  CHECK(m.normals.empty());
  CHECK(m.triangles.size() == 4 * 100);
  CHECK(open_edges(m) == 0);
}

TEST_CASE("a displaced ball is seen as large as it is, is not bumped again, and keeps energy") {
  const vm::Program p = compile("surface s\n bsdf = matte(1); height = 0.5;\nend\n");
  const std::string scene = R"({"environment": {"constant": 1}, "camera": {"position": [0, 0, 9],
      "target": [0, 0, 0], "fov": 30}, "objects": [{"sphere": {}, "test": true, "displace": 0.05}]})";
  const Rendered r = run(p, scene_of(p, scene), options(32, kSanitized ? 16 : 64));
  // White in even light: it vanishes but for paths lost where normals and facets disagree.
  const Mean m = mean_luminance(r.film);
  CHECK(std::abs(m.value - 1) < 4 * m.error + 2e-3);
  // Rays: one for the camera, four more under a sky alone for each that meets the ball of radius
  // 1.5, whose disc fills tan^2(asin(1.5 / 9)) pi of the view's (2 tan 15)^2.
  const double share = kPi<double> * std::pow(std::tan(std::asin(1.5 / 9)), 2) /
                       std::pow(2 * std::tan(kPi<double> / 12), 2);
  const double met = double(r.report.rays) / double(r.report.paths) - 1;
  CHECK(met / 4 == doctest::Approx(share).epsilon(0.03));
}

namespace {

constexpr double kAway = 6;  ///< of the camera, on the z axis

/// The scene's ball displaced to a fraction of a pixel, and the camera that it is for.
struct Seen {
  CameraRays camera;
  Mesh mesh;
  /// Where a point lies in the picture, in pixels.
  std::array<double, 2> at(Vec3d p) const {
    const double scale = 1 / ((kAway - p.z) * camera.pixel_angle());
    return {p.x * scale, p.y * scale};
  }
};
Seen seen(const vm::Program& p, double pixels, int side) {
  const Scene s = scene_of(
      p, fmt::format(R"({{"camera": {{"position": [0, 0, {}], "target": [0, 0, 0], "fov": 30}},
      "objects": [{{"test": true, "sphere": {{}}, "displace_pixels": {}}}]}})",
                     kAway, pixels));
  const CameraRays camera(s.data().camera, side, side);
  Result<SceneData> r = displaced(s.data(), Compiled(p), camera);
  REQUIRE_MESSAGE(bool(r), (r ? "" : r.error().what));
  return {camera, std::get<Mesh>(r->objects[0].shape)};
}

}  // namespace

TEST_CASE("edges in pixels: none is longer where the moved ball is seen, and not much shorter") {
  const vm::Program p = compile("surface s\n height = 0.4;\nend\n");
  for (const double pixels : {0.5, 2.0}) {
    const Seen s = seen(p, pixels, kSanitized ? 16 : 48);
    double longest = 0;
    for (const auto& t : s.mesh.triangles)
      for (int k = 0; k < 3; ++k) {
        const auto a = s.at(Vec3d(s.mesh.positions[t[k]]));
        const auto b = s.at(Vec3d(s.mesh.positions[t[(k + 1) % 3]]));
        longest = std::max(longest, std::hypot(a[0] - b[0], a[1] - b[1]));
      }
    // A ball 1.4 times as large has edges as much longer. The nearest point lies in the middle of
    // the picture, where cos^2 of its corners, 1 / (1 + 2 tan^2 15), is not needed.
    CHECK(longest < 1.4 * pixels);
    CHECK(longest > 0.8 * 1.4 * pixels / (1 + 2 * std::pow(std::tan(kPi<double> / 12), 2)));
  }
}

TEST_CASE("the outline of a ball with waves is that of the closed form, to the stated fraction") {
  const vm::Program p = compile("surface s\n height = 0.1 * cos(8 * pi * $uv.y);\nend\n");
  constexpr double kFraction = 0.5;
  const Seen s = seen(p, kFraction, kSanitized ? 24 : 64);
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.1 + kPi<double> * i / 4;
    const auto along = [&](const std::array<double, 2>& q) {
      return q[0] * std::cos(angle) + q[1] * std::sin(angle);
    };
    double found = 0, truth = 0;
    for (const Vec3f& q : s.mesh.positions) found = std::max(found, along(s.at(Vec3d(q))));
    const int n = kSanitized ? 200 : 500;  // of the closed form: far denser than the mesh
    for (int j = 0; j <= n; ++j)
      for (int k = 0; k < n; ++k) {
        const double theta = kPi<double> * j / n, phi = 2 * kPi<double> * k / n;
        const double r = 1 + 0.1 * std::cos(8 * theta);
        truth = std::max(truth, along(s.at(Vec3d{std::cos(phi) * std::sin(theta), std::cos(theta),
                                                 std::sin(phi) * std::sin(theta)} *
                                           r)));
      }
    CHECK(std::abs(found - truth) < kFraction);
  }
}

TEST_CASE(
    "pixels that would need too many triangles, or have no size, are told before any is made") {
  const vm::Program p = compile("surface s\n height = 0.1;\nend\n");
  const auto error_of = [&](const char* camera, int side) {
    const Scene s = scene_of(p, fmt::format(R"({{"camera": {{"position": {}, "target": [0, 0, 0]}},
        "objects": [{{"test": true, "sphere": {{}}, "displace_pixels": 0.1}}]}})",
                                            camera));
    const auto r = displaced(s.data(), Compiled(p), CameraRays(s.data().camera, side, side));
    REQUIRE_FALSE(bool(r));
    return r.error();
  };
  CHECK(error_of("[0, 0, 3]", 4096).hint.find("displace_pixels") != std::string::npos);
  CHECK(error_of("[0, 0, 0.5]", 64).hint.find("in metres") != std::string::npos);
}

TEST_CASE("what cannot be displaced is told") {
  const vm::Program p = compile("surface s\n height = 0.5;\nend\n");
  const Result<SceneData> disc =
      parse_scene(p, {}, R"({"objects": [{"disc": {}, "test": true, "displace": 0.1}]})", "s", "");
  REQUIRE_FALSE(bool(disc));
  CHECK(disc.error().where == "s: objects[0].displace");
  const Result<SceneData> both = parse_scene(
      p, {},
      R"({"objects": [{"sphere": {}, "test": true, "displace": 0.1, "displace_pixels": 1}]})", "s",
      "");
  REQUIRE_FALSE(bool(both));
  CHECK(both.error().where == "s: objects[0].displace_pixels");
  const auto grey = [&](const std::string& asked) {
    SceneSource source;
    source.surface = asked;
    return parse_scene(p, source, R"({"materials": {"grey": {"matte": 0.5}},
        "objects": [{"sphere": {}, "test": true, "surface": "grey", "displace_pixels": 1}]})",
                       "s", "");
  };
  REQUIRE_FALSE(bool(grey("")));
  CHECK(grey("").error().where == "s: objects[0].displace_pixels");
  CHECK(grey("").error().what == "a material of the scene has no `height` to displace by");
  CHECK(bool(grey("s")));
  const Scene fine =
      scene_of(p, R"({"objects": [{"sphere": {}, "test": true, "displace": 1e-5}]})");
  const Result<SceneData> r =
      displaced(fine.data(), Compiled(p), CameraRays(fine.data().camera, 64, 64));
  REQUIRE_FALSE(bool(r));
  CHECK(r.error().hint.find("longer edge") != std::string::npos);
}
