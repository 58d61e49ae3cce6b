// SPDX-License-Identifier: Apache-2.0
// What scripts are asked for besides the vertices of paths, in batches: what a surface lies in, and
// what lights radiate.
#include <algorithm>

#include "renderer/batches.h"
#include "renderer/integrator.h"
#include "renderer/vertex.h"

namespace mms::renderer {

/// Finds what the surfaces that were met lie in.
void Integrator::ask_surroundings() {
  places_.clear();
  for (Vertex& v : vertices_) places_.push_back({v.from, &v.point, &v.outside});
  surroundings_.ask(places_);
}

/// Asks what balls scatter by for the wavelengths of the paths from `first` on.
void Integrator::ask_balls(std::size_t first) {
  const std::size_t balls = world_.balls.size();
  const auto batch = [&](std::size_t ball, std::size_t from, std::size_t to) {
    const Object& object = world_.scene.objects[world_.balls[ball].object];
    const vm::Descriptor& d = *world_.scene.surfaces[object.surface].script;
    light_points_.assign(to - from, {});
    lanes_.clear();
    for (std::size_t i = from; i < to; ++i) {
      ScriptPoint& q = light_points_[i - from];
      q.object = &object;
      q.cluster = &paths_[i].cluster;
      lanes_.push_back(&q);
    }
    scripts_.run(d, EntryKind::Shade, lanes_);
    for (std::size_t i = from; i < to; ++i) {
      const std::size_t at = at_ball(int(i), int(ball)), stride = world_.compiled.max_params();
      optics_[at] = {};
      if (scripts_.given_up(int(i - from))) continue;
      scripts_.params(d.shade.material, int(i - from), &ball_params_[at * stride]);
      optics_[at] = {*world_.balls[ball].layout, &ball_params_[at * stride]};
    }
  };
  const std::size_t width = std::size_t(scripts_.width());
  for (std::size_t ball = 0; ball < balls; ++ball)
    for (std::size_t i = first; i < paths_.size(); i += width)
      batch(ball, i, std::min(i + width, paths_.size()));
}

/// Asks scripted emitters what they radiate towards the vertices that drew them.
void Integrator::ask_emitters() {
  const auto surface_index = [&](const Connection& c) {
    return world_.scene.objects[c.light.object].surface;
  };
  std::ranges::stable_sort(connections_, {}, surface_index);
  const auto ask = [&](std::span<const Connection> batch) {
    light_points_.clear();
    for (const Connection& c : batch) {
      ScriptPoint q;
      q.object = &world_.scene.objects[c.light.object];
      q.cluster = &paths_[shadows_[c.flight].path].cluster;
      q.surface = complete(q.object->shape, c.light.surface);
      q.view = -c.light.direction;
      const Flight& f = shadows_[c.flight];
      q.distance = f.beyond < 0 ? f.t_max : beyond_[std::size_t(f.beyond)].distance;
      light_points_.push_back(q);
    }
    lanes_.clear();
    for (const ScriptPoint& q : light_points_) lanes_.push_back(&q);
    const vm::Descriptor& d = *world_.scene.surfaces[surface_index(batch[0])].script;
    scripts_.run(d, EntryKind::Emit, lanes_);
    for (int lane = 0; lane < int(batch.size()); ++lane) {
      const Spectrumf emitted =
          scripts_.given_up(lane)
              ? Spectrumf(0.0f)
              : scripted_emission(world_.compiled, scripts_, d, EntryKind::Emit, lane,
                                  light_points_[lane].surface, light_points_[lane].view, scratch_);
      shadows_[batch[lane].flight].carried.beta *= emitted;
    }
  };
  for_each_batch(std::span(connections_), scripts_.width(), surface_index, ask);
}

}  // namespace mms::renderer
