// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The shapes of a scene, in world space: where a ray meets them, what the surface is like there,
/// and how to draw points of them. Spheres, quads, discs and boxes are met analytically in double
/// precision, so they show no facets; meshes are met by Embree.

#include <array>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "base/vec.h"

namespace mms::renderer {

/// From object to world space: turn, scale evenly, move.
struct Transform {
  Frame<double> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< where the object's x, y, z point
  double scale = 1;
  Vec3d move;

  Vec3d direction(Vec3d v) const { return axes.to_world(v); }
  Vec3d point(Vec3d p) const { return axes.to_world(p * scale) + move; }
  Vec3d inverse_point(Vec3d p) const { return axes.to_local(p - move) / scale; }
  /// How an object-space point changes for a world-space step.
  Vec3d inverse_step(Vec3d v) const { return axes.to_local(v) / scale; }
};

struct Sphere {
  Vec3d centre;
  double radius = 1;
  Frame<double> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< y is the pole that v runs from
};
/// Parallelogram `corner + a edge_u + b edge_v`, a and b in [0, 1]; normal along edge_u x edge_v.
struct Quad {
  Vec3d corner, edge_u, edge_v;
};
struct Disc {
  Vec3d centre;
  Frame<double> axes;  ///< normal n
  double radius = 1;
};
/// `u` and `v` run over each face from 0 to 1; on the sides v points along +y of the axes.
struct Box {
  Vec3d centre;
  Frame<double> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  ///< where its own x, y, z point
  Vec3d half{1, 1, 1};                                  ///< half of each edge
};
struct Mesh {
  std::vector<Vec3f> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Vec3f> normals;             ///< one a vertex, or none
  std::vector<std::array<float, 2>> uvs;  ///< one a vertex, or none
};
using Shape = std::variant<Sphere, Quad, Disc, Box, Mesh>;

/// Whether a shape that is no mesh has an inside.
inline bool open(const Shape& s) {
  return std::holds_alternative<Quad>(s) || std::holds_alternative<Disc>(s);
}

/// A point of a surface. Vectors are unit unless stated; normals point outwards (to the side the
/// winding shows), whatever side a ray comes from.
struct SurfacePoint {
  Vec3d position;
  double error = 0;  ///< bound on the distance of `position`, rounded to float, to the surface; m
  Vec3d geometric_normal, normal;  ///< of the geometry; interpolated
  Vec3d tangent, bitangent;        ///< orthonormal with `normal`; tangent along growing u
  std::array<double, 2> uv{};
  std::array<double, 2> uv_tangent{}, uv_bitangent{};  ///< change of uv for a unit step; 1/m
  Vec3d normal_tangent, normal_bitangent;              ///< shape operator; 1/m, any length
};

/// Distances along `o + t d` in (t_min, t_max) at which an analytic shape is met, ascending.
struct Roots {
  double t[2] = {0, 0};
  int count = 0;
};
Roots intersect(const Sphere& s, Vec3d o, Vec3d d, double t_min, double t_max);
Roots intersect(const Quad& s, Vec3d o, Vec3d d, double t_min, double t_max);
Roots intersect(const Disc& s, Vec3d o, Vec3d d, double t_min, double t_max);
Roots intersect(const Box& s, Vec3d o, Vec3d d, double t_min, double t_max);

/// The surface at `p`, a point near it; for a mesh at barycentrics (u, v) of a triangle.
SurfacePoint surface_at(const Sphere& s, Vec3d p);
SurfacePoint surface_at(const Quad& s, Vec3d p);
SurfacePoint surface_at(const Disc& s, Vec3d p);
SurfacePoint surface_at(const Box& s, Vec3d p);
SurfacePoint surface_at(const Mesh& s, std::uint32_t triangle, double u, double v);

/// `q` as multiples of the edges of a quad, of its part in the quad's plane.
std::array<double, 2> along_edges(const Quad& s, Vec3d q);

/// Area, m^2.
double area(const Shape& s);
double triangle_area(const Mesh& m, std::uint32_t triangle);

/// A point of the surface; spread evenly by area, but over the triangles of a mesh by number.
SurfacePoint sample_surface(const Shape& s, double u, double v);

/// The same without what only scripts ask for: on spheres, quads and discs uv and tangents are 0.
SurfacePoint sample_place(const Shape& s, double u, double v);
/// Likewise, the point next to `p`.
SurfacePoint place_at(const Sphere& s, Vec3d p);
SurfacePoint place_at(const Quad& s, Vec3d p);
SurfacePoint place_at(const Disc& s, Vec3d p);
/// Adds what they leave out.
SurfacePoint complete(const Shape& s, const SurfacePoint& place);

/// Whether `p` is inside a closed shape; for a mesh by counting the triangles above it.
bool contains(const Shape& s, Vec3d p);

/// Box around a shape.
struct Bounds {
  Vec3d low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  void add(Vec3d p);
  void add(const Bounds& b);
  Vec3d centre() const { return (low + high) * 0.5; }
  double radius() const { return length(high - low) * 0.5; }
};
Bounds bounds(const Shape& s);
bool overlap(const Bounds& a, const Bounds& b);

/// Where a ray that leaves `p` towards `d` starts, so that it cannot meet the surface it left:
/// moved along the geometric normal by more than the point's error.
Vec3f ray_origin(const SurfacePoint& p, Vec3d d);

}  // namespace mms::renderer
