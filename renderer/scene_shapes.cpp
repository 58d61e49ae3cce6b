// SPDX-License-Identifier: Apache-2.0
// The shapes that a scene file can write: docs/scene.md.
#include <cmath>
#include <filesystem>
#include <numeric>

#include "base/warp.h"
#include "renderer/scene_node.h"

namespace mms::renderer {
namespace {

Vec3d centre_of(const Node& s) { return s.has("center") ? s["center"].vec3() : Vec3d{}; }

Shape sphere(const Node& s, const Transform& t, const std::string&) {
  s.keys({"center", "radius"});
  return Sphere{t.point(centre_of(s)), s.number_or("radius", 1, 1e-9, 1e9) * t.scale, t.axes};
}

Shape quad(const Node& s, const Transform& t, const std::string&) {
  s.keys({"corner", "u", "v"});
  const Vec3d u = s["u"].direction(), v = s["v"].direction();
  if (!(length(cross(u, v)) > 1e-12)) s.fail("`u` and `v` are parallel");
  return Quad{t.point(s["corner"].vec3()), t.direction(u) * t.scale, t.direction(v) * t.scale};
}

Shape disc(const Node& s, const Transform& t, const std::string&) {
  s.keys({"center", "normal", "radius"});
  const Vec3d normal = s.has("normal") ? s["normal"].direction() : Vec3d{0, 1, 0};
  return Disc{t.point(centre_of(s)), Frame<double>::around(normalize(t.direction(normal))),
              s.number_or("radius", 1, 1e-9, 1e9) * t.scale};
}

Shape box(const Node& s, const Transform& t, const std::string&) {
  s.keys({"center", "size"});
  const Vec3d size = s.has("size") ? s["size"].vec3(1e-9, 1e9) : Vec3d{2, 2, 2};
  return Box{t.point(centre_of(s)), t.axes, size * (0.5 * t.scale)};
}

/// A mesh whose corners stand in the scene itself.
Mesh written_mesh(const Node& n, const Transform& t) {
  n.keys({"positions", "triangles", "normals", "uvs"});
  Mesh m;
  for (const Node& p : n["positions"].elements()) m.positions.emplace_back(t.point(p.vec3()));
  const auto one_each = [&](const char* key, std::size_t count) {
    if (count != m.positions.size())
      n[key].fail(fmt::format("{} entries for {} positions", count, m.positions.size()));
  };
  if (n.has("normals")) {
    for (const Node& p : n["normals"].elements())
      m.normals.emplace_back(t.direction(normalize(p.direction())));
    one_each("normals", m.normals.size());
  }
  if (n.has("uvs")) {
    for (const Node& p : n["uvs"].elements()) {
      const auto [u, v] = p.pair();
      m.uvs.push_back({float(u), float(v)});
    }
    one_each("uvs", m.uvs.size());
  }
  for (const Node& triangle : n["triangles"].elements()) {
    std::array<std::uint32_t, 3> corners{};
    const std::vector<Node> e = triangle.elements();
    if (e.size() != 3) triangle.fail(fmt::format("expected 3 corners, found {}", e.size()));
    for (int k = 0; k < 3; ++k) {
      const double corner = e[k].number(0, double(m.positions.size()) - 1);
      if (corner != std::floor(corner)) e[k].fail("expected the number of a position");
      corners[k] = std::uint32_t(corner);
    }
    m.triangles.push_back(corners);
    if (!(triangle_area(m, std::uint32_t(m.triangles.size() - 1)) > 0))
      triangle.fail("a triangle without area");
  }
  if (m.triangles.empty()) n["triangles"].fail("the mesh has no triangle");
  return m;
}

Shape mesh(const Node& n, const Transform& t, const std::string& folder) {
  if (n.is_object()) return written_mesh(n, t);
  Result<Mesh> mesh = load_mesh(in_folder(n.text(), folder), t);
  if (!mesh) n.fail(mesh.error());
  return std::move(*mesh);
}

/// Corners flatter than this are smoothed over.
constexpr double kSmoothCosine = 0.8;

/// Normals at both ends of each stretch of a profile: halfway to the neighbour's where the corner
/// is flat.
std::vector<std::array<Vec3d, 2>> profile_normals(const std::vector<Vec3d>& points) {
  std::vector<Vec3d> own;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3d along = points[i + 1] - points[i];
    own.push_back(normalize(Vec3d{along.y, -along.x, 0}));
  }
  const auto blend = [&](std::size_t i, std::size_t with) {
    return dot(own[i], own[with]) > kSmoothCosine ? normalize(own[i] + own[with]) : own[i];
  };
  std::vector<std::array<Vec3d, 2>> normals;
  for (std::size_t i = 0; i < own.size(); ++i)
    normals.push_back({blend(i, i > 0 ? i - 1 : i), blend(i, std::min(i + 1, own.size() - 1))});
  return normals;
}

/// A profile of [radius, height] turned about the y axis; u runs around, v along the profile.
Shape lathe(const Node& s, const Transform& t, const std::string&) {
  s.keys({"profile", "segments"});
  const int segments = int(s.number_or("segments", 128, 3, 4096));
  std::vector<Vec3d> points;
  for (const Node& n : s["profile"].elements()) {
    const auto [radius, height] = n.pair();
    if (!(radius >= 0)) n.fail("a radius below 0");
    points.push_back({radius, height, 0});
    if (points.size() > 1 && !(length(points.back() - points[points.size() - 2]) > 1e-9))
      n.fail("the same point twice");
  }
  if (points.size() < 2) s["profile"].fail("a profile has at least two points");
  const std::vector<std::array<Vec3d, 2>> normals = profile_normals(points);
  Mesh m;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    for (int k = 0; k <= segments; ++k) {
      const double turn = 2 * kPi<double> * (k % segments) / segments;
      const auto turned = [&](Vec3d p) {
        return Vec3d{p.x * std::sin(turn), p.y, p.x * std::cos(turn)};
      };
      const auto first = std::uint32_t(m.positions.size());
      for (int end = 0; end < 2; ++end) {
        m.positions.emplace_back(t.point(turned(points[i + end])));
        m.normals.emplace_back(t.direction(turned(normals[i][end])));
        m.uvs.push_back({float(k) / float(segments), float(i + end) / float(points.size() - 1)});
      }
      if (k == segments) continue;
      for (const auto& corners : {std::array<std::uint32_t, 3>{first, first + 2, first + 3},
                                  {first, first + 3, first + 1}}) {
        // At the axis one of the two is a point.
        if (points[i + (corners[1] == first + 2 ? 0 : 1)].x > 0) m.triangles.push_back(corners);
      }
    }
  return m;
}

/// A tube along a knot that winds around a torus; u runs along the knot, v around the tube.
Shape knot(const Node& s, const Transform& t, const std::string&) {
  s.keys({"windings", "radius", "tube", "segments"});
  const auto [p, q] = s.has("windings") ? s["windings"].pair() : std::array{2.0, 3.0};
  const auto whole = [](double x) { return x >= 1 && x <= 50 && x == std::floor(x); };
  if (!whole(p) || !whole(q) || std::gcd(int(p), int(q)) != 1)
    s["windings"].fail("expected two whole numbers in [1, 50] without a common divisor");
  const double radius = s.number_or("radius", 1, 1e-6, 1e6);
  const double tube = s.number_or("tube", 0.2 * radius, 1e-6, 1e6);
  const int segments = int(s.number_or("segments", 64, 3, 1024));
  const int along = 12 * segments;
  Mesh m;
  for (int i = 0; i <= along; ++i) {
    const double a = 2 * kPi<double> * (i % along) / along;
    // Around the torus p times, through its hole q times; `radius` is the farthest it goes.
    const double cp = std::cos(p * a), sp = std::sin(p * a);
    const double cq = std::cos(q * a), sq = std::sin(q * a);
    const double far = 2 + cq, size = radius / 3;
    const Vec3d centre{size * far * cp, size * sq, size * far * sp};
    const Vec3d tangent =
        normalize(Vec3d{-q * sq * cp - p * far * sp, q * cq, -q * sq * sp + p * far * cp});
    const Vec3d out{cq * cp, sq, cq * sp};  // of the torus: at a right angle to the tangent
    const Vec3d side = cross(tangent, out);
    for (int k = 0; k <= segments; ++k) {
      const double b = 2 * kPi<double> * (k % segments) / segments;
      const Vec3d n = out * std::cos(b) + side * std::sin(b);
      m.positions.emplace_back(t.point(centre + n * tube));
      m.normals.emplace_back(t.direction(n));
      m.uvs.push_back({float(i) / float(along), float(k) / float(segments)});
      if (i == along || k == segments) continue;
      const auto here = std::uint32_t(m.positions.size() - 1), next = here + segments + 1;
      m.triangles.push_back({here, next + 1, next});
      m.triangles.push_back({here, here + 1, next + 1});
    }
  }
  return m;
}

struct ShapeKey {
  const char* key;
  Shape (*parse)(const Node&, const Transform&, const std::string& folder);
};

constexpr ShapeKey kShapes[] = {{"sphere", sphere}, {"quad", quad}, {"disc", disc}, {"box", box},
                                {"lathe", lathe},   {"knot", knot}, {"mesh", mesh}};

}  // namespace

std::vector<std::string> shape_keys() {
  std::vector<std::string> keys;
  for (const ShapeKey& s : kShapes) keys.emplace_back(s.key);
  return keys;
}

std::string in_folder(const std::string& path, const std::string& folder) {
  const std::filesystem::path p = path;
  return (p.is_absolute() || folder.empty() ? p : std::filesystem::path(folder) / p).string();
}

Shape parse_shape(const Node& object, const Transform& transform, const std::string& folder) {
  const ShapeKey* found = nullptr;
  int count = 0;
  for (const ShapeKey& s : kShapes)
    if (object.has(s.key)) found = &s, ++count;
  if (count != 1) object.fail("an object has one of " + join(shape_keys()));
  return found->parse(object[found->key], transform, folder);
}

}  // namespace mms::renderer
