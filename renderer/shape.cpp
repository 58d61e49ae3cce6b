// SPDX-License-Identifier: Apache-2.0
#include "renderer/shape.h"

#include <algorithm>
#include <limits>

#include "base/warp.h"

namespace mms::renderer {
namespace {

constexpr double kFloatEpsilon = 0x1p-24;  // half a unit in the last place of 1

double largest(Vec3d v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

double& component(Vec3d& v, int k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }

void keep(Roots& r, double t, double t_min, double t_max) {
  if (t > t_min && t < t_max) r.t[r.count++] = t;
}

/// Cross product where nothing cancels: of vectors that are far from parallel.
Vec3d plain_cross(Vec3d a, Vec3d b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Tangents from the derivatives of the point by u and v (any length, on the geometry), made
/// orthonormal with the normal; and the change of uv along them.
void set_tangents(SurfacePoint& s, Vec3d dp_du, Vec3d dp_dv) {
  const Vec3d along = dp_du - s.normal * dot(s.normal, dp_du);
  const double l2 = dot(along, along);
  s.tangent = l2 > 1e-12 ? along / std::sqrt(l2) : Frame<double>::around(s.normal).s;
  s.bitangent = plain_cross(s.normal, s.tangent);
  // Least squares: the step that (du, dv) makes in the tangent plane.
  const double a = dot(dp_du, s.tangent), b = dot(dp_dv, s.tangent);
  const double c = dot(dp_du, s.bitangent), d = dot(dp_dv, s.bitangent);
  const double det = a * d - b * c;
  if (det == 0) return;
  s.uv_tangent = {d / det, -c / det};
  s.uv_bitangent = {-b / det, a / det};
}

void set_flat(SurfacePoint& s, Vec3d n) { s.geometric_normal = s.normal = n; }

/// Rounding a point to float moves each coordinate by half a unit in the last place; sqrt(3)
/// of them at most, and 2 for the rays' own arithmetic.
double rounding_error(Vec3d p) { return 4 * kFloatEpsilon * largest(p); }

}  // namespace

std::array<double, 2> along_edges(const Quad& s, Vec3d q) {
  const double uu = dot(s.edge_u, s.edge_u), vv = dot(s.edge_v, s.edge_v);
  const double uv = dot(s.edge_u, s.edge_v), qu = dot(q, s.edge_u), qv = dot(q, s.edge_v);
  const double scale = 1 / (uu * vv - uv * uv);
  return {(qu * vv - qv * uv) * scale, (qv * uu - qu * uv) * scale};
}

Roots intersect(const Sphere& s, Vec3d o, Vec3d d, double t_min, double t_max) {
  const Vec3d oc = o - s.centre;
  const double a = dot(d, d), b = dot(oc, d);
  // Distance of the line to the centre, by the foot of the perpendicular: no cancellation between
  // b^2 and 4ac for a small sphere far away.
  const Vec3d foot = oc - d * (b / a);
  const double quarter = s.radius * s.radius - dot(foot, foot);
  Roots r;
  if (!(quarter > 0)) return r;
  const double half = std::sqrt(quarter / a);
  const double mid = -b / a;
  keep(r, mid - half, t_min, t_max);
  keep(r, mid + half, t_min, t_max);
  return r;
}

Roots intersect(const Quad& s, Vec3d o, Vec3d d, double t_min, double t_max) {
  Roots r;
  const Vec3d n = plain_cross(s.edge_u, s.edge_v);
  const double dn = dot(d, n);
  if (dn == 0) return r;
  const double t = dot(s.corner - o, n) / dn;
  if (!(t > t_min && t < t_max)) return r;
  const auto [a, b] = along_edges(s, o + d * t - s.corner);
  if (a >= 0 && a <= 1 && b >= 0 && b <= 1) keep(r, t, t_min, t_max);
  return r;
}

Roots intersect(const Disc& s, Vec3d o, Vec3d d, double t_min, double t_max) {
  Roots r;
  const double dn = dot(d, s.axes.n);
  if (dn == 0) return r;
  const double t = dot(s.centre - o, s.axes.n) / dn;
  const Vec3d p = o + d * t - s.centre;
  if (dot(p, p) <= s.radius * s.radius) keep(r, t, t_min, t_max);
  return r;
}

Roots intersect(const Box& s, Vec3d o, Vec3d d, double t_min, double t_max) {
  const Vec3d lo = s.axes.to_local(o - s.centre), ld = s.axes.to_local(d);
  double in = -1e300, out = 1e300;  // where the ray enters the last slab, and leaves the first
  for (int k = 0; k < 3; ++k) {
    const double half = s.half[k];
    if (ld[k] == 0) {
      if (std::abs(lo[k]) > half) return {};
      continue;
    }
    const double a = (-half - lo[k]) / ld[k], b = (half - lo[k]) / ld[k];
    in = std::max(in, std::min(a, b));
    out = std::min(out, std::max(a, b));
  }
  Roots r;
  if (!(in < out)) return r;
  keep(r, in, t_min, t_max);
  keep(r, out, t_min, t_max);
  return r;
}

SurfacePoint place_at(const Sphere& s, Vec3d p) {
  SurfacePoint r;
  const Vec3d n = normalize(p - s.centre);
  r.position = s.centre + n * s.radius;
  r.error = rounding_error(r.position);
  set_flat(r, n);
  return r;
}

SurfacePoint place_at(const Quad& s, Vec3d p) {
  SurfacePoint r;
  const Vec3d n = normalize(plain_cross(s.edge_u, s.edge_v));
  r.position = p - n * dot(n, p - s.corner);
  r.error = rounding_error(r.position);
  set_flat(r, n);
  return r;
}

SurfacePoint place_at(const Disc& s, Vec3d p) {
  SurfacePoint r;
  r.position = p - s.axes.n * dot(s.axes.n, p - s.centre);
  r.error = rounding_error(r.position);
  set_flat(r, s.axes.n);
  return r;
}

SurfacePoint surface_at(const Sphere& s, Vec3d p) {
  SurfacePoint r = place_at(s, p);
  const Vec3d n = r.normal;
  // v from the pole +y, u around it from +x towards -z (so that u, v and the outside agree).
  const Vec3d l{dot(n, s.axes.s), dot(n, s.axes.t), dot(n, s.axes.n)};
  const double phi = std::atan2(-l.z, l.x);
  const double ring = std::hypot(l.x, l.z);
  r.uv = {phi < 0 ? phi / (2 * kPi<double>)+1 : phi / (2 * kPi<double>),
          std::atan2(ring, l.y) / kPi<double>};
  const double c = ring > 0 ? l.x / ring : 1, z = ring > 0 ? -l.z / ring : 0;
  const Vec3d around{-z, 0, -c};
  const Vec3d down{c * l.y, -ring, -z * l.y};
  // Held off the pole, where u turns infinitely fast.
  const double turn = 2 * kPi<double> * s.radius * std::max(ring, 1e-6);
  set_tangents(r, s.axes.to_world(around) * turn, s.axes.to_world(down) * (kPi<double> * s.radius));
  r.normal_tangent = r.tangent / s.radius;
  r.normal_bitangent = r.bitangent / s.radius;
  return r;
}

SurfacePoint surface_at(const Quad& s, Vec3d p) {
  SurfacePoint r = place_at(s, p);
  r.uv = along_edges(s, p - s.corner);
  set_tangents(r, s.edge_u, s.edge_v);
  return r;
}

SurfacePoint surface_at(const Disc& s, Vec3d p) {
  SurfacePoint r = place_at(s, p);
  const Vec3d q = p - s.centre;
  r.uv = {0.5 + 0.5 * dot(q, s.axes.s) / s.radius, 0.5 + 0.5 * dot(q, s.axes.t) / s.radius};
  set_tangents(r, s.axes.s * (2 * s.radius), s.axes.t * (2 * s.radius));
  return r;
}

SurfacePoint surface_at(const Box& s, Vec3d p) {
  SurfacePoint r;
  Vec3d l = s.axes.to_local(p - s.centre);
  int face = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(l[k]) * s.half[face] > std::abs(l[face]) * s.half[k]) face = k;
  const double side = l[face] < 0 ? -1 : 1;
  component(l, face) = side * s.half[face];
  r.position = s.centre + s.axes.to_world(l);
  r.error = rounding_error(r.position);
  Vec3d n, u, v;  // u x v = n
  component(n, face) = side;
  if (face == 0) u.z = -side, v.y = 1;
  if (face == 1) u.x = 1, v.z = -side;
  if (face == 2) u.x = side, v.y = 1;
  const double half_u = std::abs(dot(u, s.half)), half_v = std::abs(dot(v, s.half));
  r.uv = {0.5 + 0.5 * dot(u, l) / half_u, 0.5 + 0.5 * dot(v, l) / half_v};
  set_flat(r, s.axes.to_world(n));
  set_tangents(r, s.axes.to_world(u) * (2 * half_u), s.axes.to_world(v) * (2 * half_v));
  return r;
}

SurfacePoint surface_at(const Mesh& m, std::uint32_t triangle, double u, double v) {
  SurfacePoint r;
  const auto [ia, ib, ic] = m.triangles[triangle];
  const Vec3d a(m.positions[ia]), b(m.positions[ib]), c(m.positions[ic]);
  const Vec3d ab = b - a, ac = c - a;
  r.position = a + ab * u + ac * v;
  // Embree meets the triangle in float, with vertices taken relative to the ray's origin, which
  // is at most the triangle's size away when a ray leaves the triangle itself.
  const double size = std::max(largest(ab), largest(ac));
  r.error = rounding_error(r.position) +
            8 * kFloatEpsilon * (std::max({largest(a), largest(b), largest(c)}) + size);
  const Vec3d n = cross(ab, ac);
  r.geometric_normal = normalize(n);
  r.normal = r.geometric_normal;
  Vec3d dn_ab, dn_ac;
  if (!m.normals.empty()) {
    const Vec3d na(m.normals[ia]), nb(m.normals[ib]), nc(m.normals[ic]);
    const Vec3d sum = na * (1 - u - v) + nb * u + nc * v;
    const double l = length(sum);
    if (l > 1e-12) {
      r.normal = sum / l;
      if (dot(r.normal, r.geometric_normal) < 0) r.normal = -r.normal;
      dn_ab = (nb - na) / l, dn_ac = (nc - na) / l;
    }
  }
  // Without texture coordinates the barycentrics stand in for them.
  std::array<double, 2> ta{0, 0}, tb{1, 0}, tc{0, 1};
  if (!m.uvs.empty()) {
    const auto get = [&](std::uint32_t i) {
      return std::array<double, 2>{m.uvs[i][0], m.uvs[i][1]};
    };
    ta = get(ia), tb = get(ib), tc = get(ic);
  }
  for (int k = 0; k < 2; ++k) r.uv[k] = ta[k] * (1 - u - v) + tb[k] * u + tc[k] * v;
  const double u1 = tb[0] - ta[0], v1 = tb[1] - ta[1], u2 = tc[0] - ta[0], v2 = tc[1] - ta[1];
  const double det = u1 * v2 - u2 * v1;
  Vec3d dp_du = ab, dp_dv = ac;
  if (det != 0) {
    dp_du = (ab * v2 - ac * v1) / det;
    dp_dv = (ac * u1 - ab * u2) / det;
  }
  set_tangents(r, dp_du, dp_dv);
  // Shape operator: a world step is a combination of the edges (by the dual basis), and the
  // normal changes with them; only its part in the tangent plane turns a unit normal.
  const double nn = dot(n, n);
  if (nn > 0 && !m.normals.empty()) {
    const auto along = [&](Vec3d step) {
      const double da = dot(cross(step, ac), n) / nn, db = dot(cross(ab, step), n) / nn;
      const Vec3d dn = dn_ab * da + dn_ac * db;
      return dn - r.normal * dot(dn, r.normal);
    };
    r.normal_tangent = along(r.tangent);
    r.normal_bitangent = along(r.bitangent);
  }
  return r;
}

double triangle_area(const Mesh& m, std::uint32_t triangle) {
  const auto [a, b, c] = m.triangles[triangle];
  const Vec3d p(m.positions[a]);
  return 0.5 * length(cross(Vec3d(m.positions[b]) - p, Vec3d(m.positions[c]) - p));
}

namespace {
struct AreaOf {
  double operator()(const Sphere& s) const { return 4 * kPi<double> * s.radius * s.radius; }
  double operator()(const Quad& s) const { return length(cross(s.edge_u, s.edge_v)); }
  double operator()(const Disc& s) const { return kPi<double> * s.radius * s.radius; }
  double operator()(const Box& s) const {
    return 8 * (s.half.x * s.half.y + s.half.y * s.half.z + s.half.z * s.half.x);
  }
  double operator()(const Mesh& m) const {
    double sum = 0;
    for (std::uint32_t i = 0; i < m.triangles.size(); ++i) sum += triangle_area(m, i);
    return sum;
  }
};

struct BoundsOf {
  Bounds operator()(const Sphere& s) const { return around(s.centre, s.radius); }
  Bounds operator()(const Disc& s) const { return around(s.centre, s.radius); }
  Bounds operator()(const Quad& s) const {
    Bounds b;
    for (double u : {0.0, 1.0})
      for (double v : {0.0, 1.0}) b.add(s.corner + s.edge_u * u + s.edge_v * v);
    return b;
  }
  Bounds operator()(const Box& s) const {
    Bounds b;
    for (int corner = 0; corner < 8; ++corner)
      b.add(s.centre +
            s.axes.to_world({corner & 1 ? s.half.x : -s.half.x, corner & 2 ? s.half.y : -s.half.y,
                             corner & 4 ? s.half.z : -s.half.z}));
    return b;
  }
  Bounds operator()(const Mesh& m) const {
    Bounds b;
    for (Vec3f p : m.positions) b.add(Vec3d(p));
    return b;
  }
  static Bounds around(Vec3d c, double r) {
    Bounds b;
    b.add(c - Vec3d{r, r, r});
    b.add(c + Vec3d{r, r, r});
    return b;
  }
};
}  // namespace

namespace {

/// Whether the ray from `p` along `d` meets the triangle.
bool meets(Vec3d p, Vec3d d, Vec3d a, Vec3d b, Vec3d c) {
  const Vec3d ab = b - a, ac = c - a, h = cross(d, ac);
  const double det = dot(ab, h);
  if (det == 0) return false;
  const Vec3d s = p - a, q = cross(s, ab);
  const double u = dot(s, h) / det, v = dot(d, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && dot(ac, q) / det > 0;
}

}  // namespace

bool contains(const Shape& shape, Vec3d p) {
  if (const Sphere* s = std::get_if<Sphere>(&shape)) return length(p - s->centre) < s->radius;
  if (const Box* s = std::get_if<Box>(&shape)) {
    const Vec3d l = s->axes.to_local(p - s->centre);
    return std::abs(l.x) < s->half.x && std::abs(l.y) < s->half.y && std::abs(l.z) < s->half.z;
  }
  const Mesh* m = std::get_if<Mesh>(&shape);
  if (!m) return false;
  const Vec3d d = normalize(Vec3d{0.36, 0.83, 0.42});  // unlikely to run along an edge
  bool inside = false;
  for (const auto& [a, b, c] : m->triangles)
    inside ^= meets(p, d, Vec3d(m->positions[a]), Vec3d(m->positions[b]), Vec3d(m->positions[c]));
  return inside;
}

namespace {

/// A face drawn by its area: what is left of `u` is spent on the place within it.
SurfacePoint sample_box(const Box& s, double u, double v) {
  const double areas[3] = {s.half.y * s.half.z, s.half.z * s.half.x, s.half.x * s.half.y};
  double x = u * 2 * (areas[0] + areas[1] + areas[2]);
  int face = 0;
  while (face < 2 && x >= 2 * areas[face]) x -= 2 * areas[face++];
  const bool high = x >= areas[face];
  const double rest = std::clamp(x / areas[face] - (high ? 1 : 0), 0.0, 1.0);
  Vec3d l;
  component(l, face) = high ? s.half[face] : -s.half[face];
  component(l, (face + 1) % 3) = (2 * rest - 1) * s.half[(face + 1) % 3];
  component(l, (face + 2) % 3) = (2 * v - 1) * s.half[(face + 2) % 3];
  return surface_at(s, s.centre + s.axes.to_world(l));
}

}  // namespace

SurfacePoint sample_place(const Shape& shape, double u, double v) {
  if (const Sphere* s = std::get_if<Sphere>(&shape))
    return place_at(*s, s->centre + square_to_sphere(u, v) * s->radius);
  if (const Quad* q = std::get_if<Quad>(&shape))
    return place_at(*q, q->corner + q->edge_u * u + q->edge_v * v);
  if (const Disc* d = std::get_if<Disc>(&shape)) {
    const Vec3d p = square_to_disc(u, v) * d->radius;
    return place_at(*d, d->centre + d->axes.s * p.x + d->axes.t * p.y);
  }
  if (const Box* b = std::get_if<Box>(&shape)) return sample_box(*b, u, v);
  const Mesh& m = std::get<Mesh>(shape);
  const double n = double(m.triangles.size()) * u;
  const auto triangle = std::min(std::uint32_t(n), std::uint32_t(m.triangles.size() - 1));
  const double r = std::sqrt(n - triangle);
  return surface_at(m, triangle, r * (1 - v), r * v);
}

SurfacePoint complete(const Shape& shape, const SurfacePoint& place) {
  return std::visit(
      [&]<class S>(const S& s) {
        if constexpr (std::is_same_v<S, Mesh> || std::is_same_v<S, Box>)
          return place;
        else
          return surface_at(s, place.position);
      },
      shape);
}

SurfacePoint sample_surface(const Shape& shape, double u, double v) {
  return complete(shape, sample_place(shape, u, v));
}

double area(const Shape& s) { return std::visit(AreaOf{}, s); }
Bounds bounds(const Shape& s) { return std::visit(BoundsOf{}, s); }

void Bounds::add(Vec3d p) {
  low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

void Bounds::add(const Bounds& b) {
  add(b.low);
  add(b.high);
}

bool overlap(const Bounds& a, const Bounds& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

Vec3f ray_origin(const SurfacePoint& p, Vec3d d) {
  const double side = dot(d, p.geometric_normal) < 0 ? -1 : 1;
  return Vec3f(p.position + p.geometric_normal * (side * 2 * p.error));
}

}  // namespace mms::renderer
