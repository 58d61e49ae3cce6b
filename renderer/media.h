// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What a ray is inside of. Closed objects may overlap. Their volumes add: coefficients of all that
/// a ray is in are summed along it. An object that states a `priority` (nested dielectrics, Schmidt
/// and Budge 2002) takes the place of everything of a lower one: there the lower one's volume is
/// not, nor is its surface.

#include <algorithm>
#include <array>

#include "renderer/scene.h"

namespace mms::renderer {

/// Objects that a ray is inside of and that count there: those with a volume or a priority.
struct Media {
  static constexpr int kDeepest = 8;  ///< more are left out
  std::array<int, kDeepest> objects{};
  int count = 0;

  bool empty() const { return count == 0; }
  void clear() { count = 0; }
  void enter(int object) {
    if (count < kDeepest) objects[count++] = object;
  }
  /// Leaving what was never entered (an open mesh) changes nothing.
  void leave(int object) {
    int* const end = objects.data() + count;
    int* const at = std::find(objects.data(), end, object);
    if (at == end) return;
    std::copy(at + 1, end, at);
    --count;
  }
};

/// The volumes that are where a ray is.
struct Filling {
  std::array<int, Media::kDeepest> even{}, varied{};  ///< objects, by whether place matters
  int even_count = 0, varied_count = 0;
};

inline bool tracked(const Object& o) { return o.volume >= 0 || o.priority > 0; }

/// Whether the surface of `object` is not there for a ray in `media`: it is inside what has
/// priority. What has no inside of its own, such as a fly in amber, stays.
inline bool hidden(const SceneData& scene, const Media& media, int object) {
  if (!tracked(scene.objects[object])) return false;
  for (int i = 0; i < media.count; ++i)
    if (scene.objects[media.objects[i]].priority > scene.objects[object].priority) return true;
  return false;
}

/// What lies on the other side of the surface of `object`: of the objects around it the one of the
/// highest priority, the last that was entered among equals; -1 where none has one.
inline int surrounding(const SceneData& scene, const Media& media, int object) {
  int found = -1, highest = 1;
  for (int i = 0; i < media.count; ++i) {
    const int other = media.objects[i], priority = scene.objects[other].priority;
    if (other == object || priority < highest) continue;
    found = other;
    highest = priority;
  }
  return found;
}

}  // namespace mms::renderer
