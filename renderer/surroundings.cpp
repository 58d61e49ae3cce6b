// SPDX-License-Identifier: Apache-2.0
#include "renderer/surroundings.h"

#include <algorithm>

#include "renderer/batches.h"

namespace mms::renderer {

void Surroundings::ask(std::span<const Place> places) {
  nested_.clear();
  for (const Place& p : places) {
    if (p.flight->end != End::Surface) continue;
    const int object = p.flight->hit.object;
    if (world_.scene.objects[object].priority == 0) continue;
    const int around = surrounding(world_.scene, p.flight->media, object);
    if (around < 0) continue;
    const Surface& s = world_.surface_of_object(around);
    if (s.script && world_.compiled.of(s.script).index) nested_.push_back({p, around});
  }
  const auto surface = [&](const Nested& n) { return world_.scene.objects[n.around].surface; };
  std::ranges::stable_sort(nested_, {}, surface);
  for_each_batch(std::span(nested_), scripts_.width(), surface, [&](std::span<const Nested> batch) {
    points_.clear();
    for (const Nested& n : batch) {
      points_.push_back(*n.place.point);
      points_.back().object = &world_.scene.objects[n.around];
    }
    lanes_.clear();
    for (const ScriptPoint& p : points_) lanes_.push_back(&p);
    const vm::Descriptor& d = *world_.scene.surfaces[surface(batch[0])].script;
    scripts_.run(d, EntryKind::Shade, lanes_);
    for (int i = 0; i < int(batch.size()); ++i)
      if (!scripts_.given_up(i))
        *batch[i].place.outside = scripts_.spectrum(*world_.compiled.of(&d).index, i);
  });
}

}  // namespace mms::renderer
