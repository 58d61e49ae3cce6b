// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What a ray meets. Embree behind a small face: one ray at a time, so that the company a ray
/// keeps cannot change its hit.
///
/// Semi-transparent objects never stop a ray here: the filter only collects where they were
/// crossed, nearest `kMaxCrossings` first (thesis 6.1.2); whether light passes is a script's
/// answer, and scripts run in batches later.

#include <memory>

#include "renderer/scene.h"

namespace mms::renderer {

inline constexpr int kMaxCrossings = 16;

struct Hit {
  int object = -1;  ///< index into SceneData::objects; -1 is a miss
  std::uint32_t primitive = 0;
  float t = 0, u = 0, v = 0;  ///< distance; barycentrics of a triangle
};

/// Crossings of semi-transparent surfaces, in order of distance.
struct Crossings {
  Hit hits[kMaxCrossings];
  int count = 0;
  bool overflow = false;  ///< there were more: trace again from the last one's distance

  /// Keeps the nearest; each (object, primitive, t) once.
  void add(const Hit& h);
};

class Accel {
 public:
  /// `semi_transparent[i]` says whether object i is collected rather than hit.
  Accel(const SceneData& scene, const std::vector<bool>& semi_transparent);
  ~Accel();

  bool any_semi_transparent() const;

  /// The nearest opaque hit in (t_min, t_max); fills `crossings` with what lies before it.
  Hit intersect(Vec3f origin, Vec3f direction, float t_min, float t_max,
                Crossings& crossings) const;

  /// Whether anything opaque lies in (0, t_max).
  bool occluded(Vec3f origin, Vec3f direction, float t_max) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The surface where a ray hit it.
SurfacePoint surface_of(const SceneData& scene, const Hit& hit, Vec3f origin, Vec3f direction);

}  // namespace mms::renderer
