// SPDX-License-Identifier: Apache-2.0
// What scripts are asked for besides the vertices of paths, in batches: what a surface lies in, and
// what lights radiate.
#include <algorithm>

#include "renderer/integrator.h"
#include "renderer/vertex.h"

namespace mms::renderer {

/// Nested dielectrics: a surface that lies in another object has its index over that object's,
/// which is asked for at the very point.
void Integrator::ask_surroundings() {
  nested_.clear();
  for (Vertex& v : vertices_) {
    if (v.from->end != End::Surface) continue;
    const int object = v.from->hit.object;
    if (world_.scene.objects[object].priority == 0) continue;
    const int around = surrounding(world_.scene, v.from->media, object);
    if (around < 0) continue;
    const Surface& s = world_.surface_of_object(around);
    if (s.script && world_.compiled.of(s.script).index) nested_.push_back({&v, around});
  }
  const auto surface = [&](const Nested& n) { return world_.scene.objects[n.around].surface; };
  std::stable_sort(nested_.begin(), nested_.end(),
                   [&](const Nested& a, const Nested& b) { return surface(a) < surface(b); });
  for (std::size_t first = 0, last = 0; first < nested_.size(); first = last) {
    outside_points_.clear();
    while (last < nested_.size() && last - first < std::size_t(scripts_.width()) &&
           surface(nested_[last]) == surface(nested_[first])) {
      const Nested& n = nested_[last++];
      outside_points_.push_back(n.vertex->point);
      outside_points_.back().object = &world_.scene.objects[n.around];
    }
    lanes_.clear();
    for (const ScriptPoint& p : outside_points_) lanes_.push_back(&p);
    const vm::Descriptor& d = *world_.scene.surfaces[surface(nested_[first])].script;
    scripts_.run(d, EntryKind::Shade, lanes_);
    for (std::size_t i = first; i < last; ++i)
      if (!scripts_.given_up(int(i - first)))
        nested_[i].vertex->outside =
            scripts_.spectrum(*world_.compiled.of(&d).index, int(i - first));
  }
}

/// Asks scripted emitters what they radiate towards the vertices that drew them.
void Integrator::ask_emitters() {
  std::vector<Connection> asked;
  for (const Connection& c : connections_)
    if (c.light.object != kEnvironment && world_.surface_of_object(c.light.object).script)
      asked.push_back(c);
  const auto surface_index = [&](const Connection& c) {
    return world_.scene.objects[c.light.object].surface;
  };
  std::stable_sort(asked.begin(), asked.end(), [&](const Connection& a, const Connection& b) {
    return surface_index(a) < surface_index(b);
  });
  for (std::size_t first = 0, last = 0; first < asked.size(); first = last) {
    light_points_.clear();
    while (last < asked.size() && last - first < std::size_t(scripts_.width()) &&
           surface_index(asked[last]) == surface_index(asked[first])) {
      const Connection& c = asked[last++];
      ScriptPoint q;
      q.object = &world_.scene.objects[c.light.object];
      q.cluster = &paths_[shadows_[c.flight].path].cluster;
      q.surface = c.light.surface;
      q.view = -c.light.direction;
      q.distance = shadows_[c.flight].t_max;
      light_points_.push_back(q);
    }
    lanes_.clear();
    for (const ScriptPoint& q : light_points_) lanes_.push_back(&q);
    const vm::Descriptor& d = *world_.scene.surfaces[surface_index(asked[first])].script;
    scripts_.run(d, EntryKind::Emit, lanes_);
    for (std::size_t i = first; i < last; ++i) {
      const int lane = int(i - first);
      const Spectrumf emitted =
          scripts_.given_up(lane)
              ? Spectrumf(0.0f)
              : scripted_emission(world_.compiled, scripts_, d, EntryKind::Emit, lane,
                                  light_points_[lane].surface, light_points_[lane].view, scratch_);
      shadows_[asked[i].flight].carried.beta *= emitted;
    }
  }
}

}  // namespace mms::renderer
