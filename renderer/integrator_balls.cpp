// SPDX-License-Identifier: Apache-2.0
// Light by way of polished balls (renderer/caustics.h): for vertices that drew it, and the density
// of that where scattering led a path the same way.
#include <algorithm>

#include "renderer/scatterer.h"

namespace mms::renderer {
namespace {

/// Numbers for rays by balls, beside the streams of flights.
constexpr std::uint32_t kBallStream = 0xffffffff;

}  // namespace

/// Density, per steradian, of drawing the light that a path has met at `v` from where it was last
/// scattered, by the way that it took.
double Integrator::light_density(const Vertex& v) const {
  const Detour& d = paths_[v.from->path].detour;
  const int object = v.from->hit.object;
  if (d.ball < 0) return world_.lights.pdf(v.from->left(), object, v.point.surface);
  if (d.inside) return 0;
  return density_by(world_.balls[d.ball], way(v.from->path, d), Vec3d(d.origin), v.point.surface,
                    world_.lights.pdf(d.left(), object, v.point.surface), v.point.view) /
         rays_out(v.from->path, v.point.surface.position);
}

/// The same of the environment, for a flight that has left the scene.
double Integrator::environment_density(const Flight& f, Vec3d direction) const {
  const Detour& d = paths_[f.path].detour;
  if (d.ball < 0) return world_.lights.pdf_environment(f.left(), direction);
  if (d.inside) return 0;
  const PolishedBall& ball = world_.balls[d.ball];
  return far_density_by(ball, way(f.path, d), Vec3d(d.origin), direction,
                        world_.lights.pdf_environment(d.left(), direction)) /
         rays_out(f.path, far_point(ball, direction));
}

/// Among how many rays one is drawn where a path has left a ball from inside, or 1.
int Integrator::rays_out(int path, Vec3d to) const {
  const Detour& d = paths_[path].detour;
  if (d.course == Course::Mirrored || d.course == Course::Through) return 1;
  std::array<BallRay, kMostBallRays> rays;
  return std::max(
      1, rays_by(world_.balls[d.ball], optics_[at_ball(path, d.ball)], Vec3d(d.origin), to, rays));
}

/// What is known of the way by a ball, if a path goes on along one.
Integrator::Detour Integrator::next_detour(const Vertex& v, const Sampled& sampled) const {
  if (!sampled.specular || world_.balls.empty()) return {};
  const Flight& f = *v.from;
  const int ball = world_.ball_of(f.hit.object);
  if (ball < 0) return {};
  const Vec3d n = v.point.surface.geometric_normal;
  const double in = dot(v.point.view, n);
  const bool crosses = (dot(sampled.wi, n) < 0) == (in > 0);
  Detour d = paths_[f.path].detour;
  if (d.ball >= 0) {
    if (d.ball != ball || !d.inside || in > 0 || !crosses) return {};
    d.inside = false;
    return d;
  }
  const BallOptics& optics = optics_[at_ball(f.path, ball)];
  if (!(f.carried.light_pdf.max() > 0) || !(crosses ? optics.index > 0 : optics.mirrors)) return {};
  if (in > 0) {
    if (!world_.balls[ball].from_outside) return {};
    return {ball,      crosses ? Course::Through : Course::Mirrored, crosses, float(in), f.origin,
            f.receives};
  }
  if (!crosses) return {};
  const bool outwards = dot(Vec3d(f.origin) - world_.balls[ball].centre, Vec3d(f.direction)) > 0;
  return {ball,     outwards ? Course::Out : Course::OutPast,
          false,    float(dot(sampled.wi, n)),
          f.origin, f.receives};
}

/// The shadow rays that go by way of a ball: first to where they leave it.
void Integrator::connect_by(int number, const Vertex& v, const Scatterer& s,
                            const LightSample& light) {
  Path& p = paths_[v.from->path];
  const PolishedBall& ball = world_.balls[std::size_t(number)];
  const std::size_t at = at_ball(v.from->path, number);
  const bool far = light.object == kEnvironment;
  const Vec3d from = v.point.surface.position,
              to = far ? far_point(ball, light.direction) : light.surface.position;
  const bool inside = length(from - ball.centre) < ball.radius;
  BallOptics optics = optics_[at];
  if (!optics.any() || !(inside || ball.from_outside)) return;
  const float u = inside || optics.mirrors ? p.sampler.hashed(kBallStream, p.choices++) : 0;
  if (!inside && optics.mirrors) optics.mirrors = u < mirror_share(ball, from);
  std::array<BallRay, kMostBallRays> found;
  std::span<const BallRay> rays(found.data(), std::size_t(rays_by(ball, optics, from, to, found)));
  // Of those from inside one is taken: a path may have one shadow ray on its way.
  const double among = inside ? double(rays.size()) : 1;
  if (inside && !rays.empty())
    rays = rays.subspan(std::min(std::size_t(u * among), rays.size() - 1), 1);
  for (const BallRay& ray : rays) {
    const int events = ray.course == Course::Through ? 2 : 1;
    if (p.depth + events > world_.max_depth) continue;
    const Vec3d direction = normalize(ray.entry - from);
    Sampled towards = s.evaluate(v.point, direction);
    if (towards.f.is_black()) continue;
    const BallShare share =
        share_of(ball, &ball_params_[at * std::size_t(world_.compiled.max_params())], optics, ray);
    towards.f *= share.f;
    const BallWay way{ray.course, optics.index, ray.cosine};
    LightSample beyond = light;
    if (far) {
      beyond.pdf = far_density_by(ball, way, from, light.direction, light.pdf) / among;
    } else {
      beyond.direction = normalize(to - ray.exit);
      beyond.pdf = density_by(ball, way, from, light.surface, light.pdf, -beyond.direction) / among;
    }
    if (towards.f.is_black() || !(beyond.pdf > 0)) continue;
    const Sphere sphere{ball.centre, ball.radius};
    const SurfacePoint entry = place_at(sphere, ray.entry), exit = place_at(sphere, ray.exit);
    const Vec3f origin = s.medium ? Vec3f(from) : ray_origin(v.point.surface, direction);
    const Vec3d chord = ray.exit - ray.entry;
    if (world_.plain && !flights_.open(origin, ray_origin(entry, -direction))) continue;
    if (ray.course == Course::Through &&
        !flights_.open(ray_origin(entry, chord), ray_origin(exit, -chord)))
      continue;
    Flight f = *v.from;
    f.carried.pdf *= share.possible;
    const std::size_t sent = shadows_.size();
    send_to_light(f, v, towards, beyond, ray_origin(exit, beyond.direction));
    if (!world_.plain && shadows_.size() > sent)
      leave_first(shadows_.back(), ball.object, origin, ray_origin(exit, -direction));
  }
}

/// Lets a shadow ray come from `origin` inside a ball to `exit` first, before it goes its way.
void Integrator::leave_first(Flight& f, int ball, Vec3f origin, Vec3f exit) {
  if (free_beyond_.empty()) {
    free_beyond_.push_back(int(beyond_.size()));
    beyond_.emplace_back();
  }
  f.beyond = free_beyond_.back();
  free_beyond_.pop_back();
  beyond_[std::size_t(f.beyond)] = {ball, f.origin, f.direction, f.t_max};
  const Vec3f way = exit - origin;
  f.origin = origin;
  f.t_max = length(way);
  f.direction = f.t_max > 0 ? way / f.t_max : f.direction;
}

/// Sends a shadow ray on that has come to where it leaves a ball; false if there is none.
bool Integrator::go_beyond(const Flight& arrived) {
  if (arrived.beyond < 0) return false;
  free_beyond_.push_back(arrived.beyond);
  if (arrived.end != End::Free) return false;
  const Beyond& b = beyond_[std::size_t(arrived.beyond)];
  Flight f = arrived;
  f.beyond = -1;
  world_.cross(f.media, b.object, false);
  f.forget_media();
  f.origin = b.origin;
  f.direction = b.direction;
  f.t_max = b.distance;
  f.t = 0;
  f.end = End::Flying;
  next_.push_back(f);
  return true;
}

}  // namespace mms::renderer
