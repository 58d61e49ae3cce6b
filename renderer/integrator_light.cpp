// SPDX-License-Identifier: Apache-2.0
// Light that is drawn for a vertex: rays to lamps, the environment and volumes that emit.
#include <algorithm>
#include <limits>

#include "renderer/integrator.h"
#include "renderer/scatterer.h"

namespace mms::renderer {

/// Draws light for a vertex.
void Integrator::connect(const Vertex& v, const Scatterer& s, int draws) {
  const Path& p = paths_[v.from->path];
  const Vec3d from = v.point.surface.position;
  const int bounce = p.depth - 1, pair = pair_of_bounce(bounce, kLight);
  const Receiver receiver(from, s.receives(v.point));
  if (draws == 0) {
    const auto [light_u, light_v] = p.sampler.pair(pair);
    connect(v, s, world_.lights.sample(receiver, light_u, light_v));
    return;
  }
  for (int i = 0; i < world_.lights.count(); ++i) {
    if (world_.lights.below_horizon(i, receiver)) continue;
    for (int draw = 0; draw < draws; ++draw) {
      const auto [light_u, light_v] =
          p.sampler.pair(i == 0 ? pair : pair_of_light(bounce, i), draw, draws);
      LightSample light = world_.lights.sample_one(i, receiver, light_u, light_v);
      light.pdf *= draws;
      connect(v, s, light);
    }
  }
}

/// Makes the shadow rays to a point of a light: straight, and by way of balls.
void Integrator::connect(const Vertex& v, const Scatterer& s, const LightSample& light) {
  if (!(light.pdf > 0)) return;
  for (int ball = 0; ball < int(world_.balls.size()); ++ball) connect_by(ball, v, s, light);
  Flight f = *v.from;
  if (!s.medium) follow(f, v, light.direction);
  if (world_.sealed_in(f.media)) return;
  const Sampled towards = s.evaluate(v.point, light.direction);
  if (towards.f.is_black()) return;
  const Vec3f origin =
      s.medium ? Vec3f(v.point.surface.position) : ray_origin(v.point.surface, light.direction);
  send_to_light(f, v, towards, light, origin);
}

/// Makes the shadow ray of a vertex to a point of a light; thesis (4.15). `f`: the flight that came
/// there. It leaves `origin`, which is elsewhere where light goes by way of something.
void Integrator::send_to_light(Flight& f, const Vertex& v, const Sampled& towards,
                               const LightSample& light, Vec3f origin) {
  const Path& p = paths_[v.from->path];
  f.carried.beta *= towards.f;
  f.carried.light_pdf = f.carried.pdf;
  f.carried.pdf *= towards.pdf;
  bool scripted = false;
  if (light.object == kEnvironment) {
    f.carried.beta *= world_.lights.environment(light.direction, p.cluster);
  } else {
    const Surface& surface = world_.surface_of_object(light.object);
    scripted = surface.script;
    if (!scripted)
      f.carried.beta *= fixed_emission(surface.fixed, light.surface, -light.direction, p.cluster);
  }
  if (f.carried.beta.is_black()) return;
  f.origin = origin;
  f.t_max = std::numeric_limits<float>::infinity();
  Vec3d direction = light.direction;
  if (light.object != kEnvironment) {
    // Both ends are moved off their surfaces, so the ray ends before it meets the light.
    const Vec3d to = Vec3d(ray_origin(light.surface, -light.direction)) - Vec3d(f.origin);
    const double distance = length(to);
    if (!(distance > 0)) return;
    direction = to / distance;
    f.t_max = float(distance);
  }
  f.direction = Vec3f(direction);
  f.light_density = light.pdf;
  start_for_light(f, Errand::Shadow);
  if (scripted) connections_.push_back({int(shadows_.size()), light});
  shadows_.push_back(f);
}

/// Sends a ray from a vertex that gathers what volumes emit.
void Integrator::connect_to_glows(const Vertex& v, const Scatterer& s) {
  const Path& p = paths_[v.from->path];
  const float chance = glow_chance(p.depth);
  const auto [u, w] = p.sampler.pair(pair_of_glow(p.depth - 1));
  if (u >= chance) return;
  Glows::Sample light = world_.glows.sample(v.point.surface.position, u / chance, w);
  light.pdf *= chance;
  if (!(light.pdf > 0)) return;
  const Sampled towards = s.evaluate(v.point, light.direction);
  if (towards.f.is_black()) return;
  Flight f = *v.from;
  if (s.medium) {
    f.origin = Vec3f(v.point.surface.position);
  } else {
    f.origin = ray_origin(v.point.surface, light.direction);
    follow(f, v, light.direction);
  }
  f.carried.beta *= towards.f;
  f.carried.light_pdf = f.carried.pdf;
  f.carried.pdf *= towards.pdf;
  f.direction = Vec3f(light.direction);
  f.t_max = std::numeric_limits<float>::infinity();
  f.light_density = light.pdf;
  start_for_light(f, Errand::Gather);
  shadows_.push_back(f);
}

/// Lets a ray for light begin at a vertex.
void Integrator::start_for_light(Flight& f, Errand errand) const {
  f.errand = errand;
  f.look_step = 1;
  f.end = End::Flying;
  f.t = 0;
  f.step = 0;
  f.stream = 2 * std::uint32_t(paths_[f.path].depth) + 1;
}

void Integrator::send_shadow_rays() {
  if (world_.plain) {
    for (Flight& f : shadows_)
      if (f.carried.beta.is_black()) f.end = End::Lost;
    flights_.fly(shadows_, views_);
    for (const Flight& f : shadows_) receive(f);
    return;
  }
  for (const Flight& f : shadows_) {
    if (f.carried.beta.is_black()) {
      if (f.beyond >= 0) free_beyond_.push_back(f.beyond);
      continue;
    }
    ++paths_[f.path].asks;
    next_.push_back(f);
  }
}

/// Adds what a shadow ray found.
void Integrator::receive(const Flight& f) {
  if (f.end != End::Free || f.errand != Errand::Shadow) return;
  paths_[f.path].lit += f.carried.weighted(Technique::Light, f.light_density, world_.estimator);
}

}  // namespace mms::renderer
