// SPDX-License-Identifier: Apache-2.0
#include "renderer/displace.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "base/warp.h"

namespace mms::renderer {
namespace {

/// Triangles to be moved: what a script is told of each corner, and which way it goes.
struct Fine {
  std::vector<SurfacePoint> points;
  std::vector<Vec3d> directions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool smooth = true;
};

std::size_t pieces(double length, double edge) {
  return std::size_t(std::clamp(std::ceil(length / edge), 1.0, 1e5));
}

/// Rows from pole to pole, so that u and v run as on the sphere; the seam is there twice.
Fine cut(const Sphere& s, std::size_t rows) {
  const std::size_t columns = 2 * rows;
  Fine f;
  for (std::size_t j = 0; j <= rows; ++j)
    for (std::size_t i = 0; i <= columns; ++i) {
      const double phi = 2 * kPi<double> * double(i % columns) / double(columns);
      // Tangents at the poles are those a hair off, where u still means something.
      const double theta =
          std::clamp(kPi<double> * double(j) / double(rows), 1e-6, kPi<double> - 1e-6);
      const Vec3d n{std::cos(phi) * std::sin(theta), std::cos(theta),
                    -std::sin(phi) * std::sin(theta)};
      SurfacePoint p = surface_at(s, s.centre + s.axes.to_world(n) * s.radius);
      if (i == columns) p.uv[0] = 1;
      if (j == 0 || j == rows) {
        p.normal = p.geometric_normal = s.axes.t * (j == 0 ? 1.0 : -1.0);
        p.position = s.centre + p.normal * s.radius;
        p.uv[1] = j == 0 ? 0 : 1;
      }
      f.points.push_back(p);
      f.directions.push_back(p.normal);
      if (i == columns || j == rows) continue;
      const auto a = std::uint32_t(j * (columns + 1) + i), below = std::uint32_t(columns + 1);
      if (j + 1 < rows) f.triangles.push_back({a, a + below, a + below + 1});
      if (j > 0) f.triangles.push_back({a, a + below + 1, a + 1});
    }
  return f;
}

std::tuple<float, float, float> key(Vec3f p) { return {p.x, p.y, p.z}; }

/// Every triangle into n^2: neighbours agree on their edge. Corners move along the mean normal of
/// all triangles that meet there, so that edges do not come apart.
Fine cut(const Mesh& m, std::size_t n) {
  std::map<std::tuple<float, float, float>, Vec3d> normals;
  for (std::uint32_t t = 0; t < m.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const SurfacePoint p = surface_at(m, t, k == 1, k == 2);
      normals[key(m.positions[m.triangles[t][k]])] += p.normal * triangle_area(m, t);
    }
  Fine f;
  f.smooth = !m.normals.empty();
  for (std::uint32_t t = 0; t < m.triangles.size(); ++t) {
    Vec3d corner[3];
    for (int k = 0; k < 3; ++k) {
      corner[k] = normals[key(m.positions[m.triangles[t][k]])];
      const double l = length(corner[k]);
      corner[k] = l > 0 ? corner[k] / l : Vec3d{};
    }
    const auto first = std::uint32_t(f.points.size());
    const auto at = [&](std::size_t i, std::size_t j) {  // rows get shorter
      return first + std::uint32_t(i * (n + 1) - i * (i - 1) / 2 + j);
    };
    for (std::size_t i = 0; i <= n; ++i)
      for (std::size_t j = 0; i + j <= n; ++j) {
        const double u = double(j) / double(n), v = double(i) / double(n);
        f.points.push_back(surface_at(m, t, u, v));
        const Vec3d d = corner[0] * (1 - u - v) + corner[1] * u + corner[2] * v;
        f.directions.push_back(length(d) > 0 ? normalize(d) : f.points.back().normal);
        if (i + j < n) f.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
        if (i + j + 1 < n) f.triangles.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
      }
  }
  return f;
}

/// Mean normals of the triangles that meet at each corner, weighed by area.
void add_normals(Mesh& m, const std::vector<SurfacePoint>& before) {
  std::map<std::tuple<float, float, float>, Vec3d> sums;
  const auto place = [&](std::uint32_t i) { return key(Vec3f(before[i].position)); };
  for (const auto& [a, b, c] : m.triangles) {
    const Vec3d p(m.positions[a]);
    const Vec3d n = cross(Vec3d(m.positions[b]) - p, Vec3d(m.positions[c]) - p);
    for (const std::uint32_t i : {a, b, c}) sums[place(i)] += n;
  }
  for (std::uint32_t i = 0; i < before.size(); ++i) {
    const Vec3d n = sums[place(i)];
    m.normals.emplace_back(length(n) > 0 ? normalize(n) : before[i].normal);
  }
}

/// From `p` to the box.
double distance(const Bounds& b, Vec3d p) {
  const auto beyond = [](double low, double high, double x) {
    return std::max({low - x, x - high, 0.0});
  };
  return length(Vec3d{beyond(b.low.x, b.high.x, p.x), beyond(b.low.y, b.high.y, p.y),
                      beyond(b.low.z, b.high.z, p.z)});
}

class Displacer {
 public:
  Displacer(const SceneData& scene, const Compiled& compiled, const CameraRays& camera)
      : scene_(scene), scripts_(compiled), cluster_(sample_cluster(0.5)) {
    // At an angle from the middle of the picture, distance r, what is e long covers at most
    // e / (r cos^2 pixel_angle) pixels: the film is a plane. The corners have the least cosine.
    const double cosine = dot(Vec3d(camera.at(0, 0, 0.5, 0.5).direction), camera.forward());
    pixel_ = camera.pixel_angle() * cosine * cosine;
  }

  Result<Mesh> mesh_of(const Object& o) {
    if (o.displace > 0) return mesh_of(o, o.displace);
    // What `height` moves towards the camera needs shorter edges than what it was before.
    double nearest = distance(bounds(o.shape), scene_.camera.position);
    for (int round = 0;; ++round) {
      if (!(nearest > 0))
        return Error{o.name.empty() ? "displace_pixels" : o.name,
                     "the camera stands in the box around what it is to displace by pixels",
                     "state an edge in metres: `displace`"};
      // A sphere's triangles are halves of squares.
      const double longest = std::holds_alternative<Sphere>(o.shape) ? std::sqrt(2.0) : 1;
      Result<Mesh> mesh = mesh_of(o, o.displace_pixels * pixel_ * nearest / longest);
      if (!mesh) return mesh;
      Shape shape(std::move(*mesh));
      const double now = distance(bounds(shape), scene_.camera.position);
      if (now >= kNearEnough * nearest || round == kRounds) return std::get<Mesh>(std::move(shape));
      nearest = now;
    }
  }

 private:
  /// Rounds of finding how near an object comes, at most, and how well it needs to be known.
  static constexpr int kRounds = 4;
  static constexpr double kNearEnough = 0.99;

  Result<Mesh> mesh_of(const Object& o, double edge) {
    const vm::Descriptor& d = *scene_.surfaces[std::size_t(o.surface)].script;
    const Sphere* sphere = std::get_if<Sphere>(&o.shape);
    const std::size_t n = sphere ? pieces(kPi<double> * sphere->radius, edge)
                                 : pieces(longest_edge(std::get<Mesh>(o.shape)), edge);
    const std::size_t count = sphere ? 4 * n * n : std::get<Mesh>(o.shape).triangles.size() * n * n;
    if (count > kMostMicrotriangles)
      return Error{o.name.empty() ? "displace" : o.name,
                   fmt::format("{} triangles to displace, {} at most", count, kMostMicrotriangles),
                   o.displace > 0 ? "state a longer edge in `displace`"
                                  : "state more pixels in `displace_pixels`, or render fewer"};
    const Fine fine = sphere ? cut(*sphere, n) : cut(std::get<Mesh>(o.shape), n);
    const std::vector<double> heights = heights_of(o, d, edge, fine.points);
    Mesh m;
    for (std::size_t i = 0; i < fine.points.size(); ++i) {
      const SurfacePoint& p = fine.points[i];
      m.positions.emplace_back(p.position + fine.directions[i] * heights[i]);
      m.uvs.push_back({float(p.uv[0]), float(p.uv[1])});
    }
    for (const auto& t : fine.triangles) {
      m.triangles.push_back(t);
      if (!(triangle_area(m, std::uint32_t(m.triangles.size() - 1)) > 0)) m.triangles.pop_back();
    }
    if (fine.smooth) add_normals(m, fine.points);
    return m;
  }

  static double longest_edge(const Mesh& m) {
    double longest = 0;
    for (const auto& [a, b, c] : m.triangles) {
      const Vec3d p(m.positions[a]), q(m.positions[b]), r(m.positions[c]);
      longest = std::max({longest, length(q - p), length(r - q), length(p - r)});
    }
    return longest;
  }

  std::vector<double> heights_of(const Object& o, const vm::Descriptor& d, double edge,
                                 const std::vector<SurfacePoint>& points) {
    std::vector<double> heights;
    std::vector<ScriptPoint> batch;
    std::vector<const ScriptPoint*> lanes;
    while (heights.size() < points.size()) {
      const std::size_t first = heights.size();
      const std::size_t n = std::min(points.size() - first, std::size_t(scripts_.width()));
      batch.assign(n, {});
      lanes.clear();
      for (std::size_t i = 0; i < n; ++i) {
        ScriptPoint& p = batch[i];
        p.object = &o;
        p.cluster = &cluster_;
        p.surface = points[first + i];
        p.view = p.surface.normal;
        p.distance = 1;
        p.cone = edge;
        p.screen_x = p.surface.tangent;
        p.screen_y = p.surface.bitangent;
        lanes.push_back(&p);
      }
      scripts_.run(d, EntryKind::Displace, lanes);
      for (int i = 0; i < int(n); ++i) {
        const double h = scripts_.given_up(i) ? 0 : scripts_.real(d.displace.height, i);
        heights.push_back(std::isfinite(h) ? h : 0);
      }
    }
    return heights;
  }

  const SceneData& scene_;
  Scripts scripts_;
  Cluster cluster_;
  double pixel_;  ///< least width of a pixel, at 1 m
};

}  // namespace

bool any_displaced(const SceneData& scene) {
  return std::any_of(scene.objects.begin(), scene.objects.end(),
                     [](const Object& o) { return o.to_displace(); });
}

Result<SceneData> displaced(const SceneData& scene, const Compiled& compiled,
                            const CameraRays& camera) {
  Displacer displacer(scene, compiled, camera);
  SceneData result = scene;
  for (Object& o : result.objects) {
    const vm::Descriptor* d = scene.surfaces[std::size_t(o.surface)].script;
    if (!o.to_displace() || !d) continue;
    Result<Mesh> mesh = displacer.mesh_of(o);
    if (!mesh) return mesh.error();
    o.shape = std::move(*mesh);
    o.displaced = true;
  }
  return result;
}

}  // namespace mms::renderer
