// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Everything that a render reads and nothing writes, shared by all threads.

#include "renderer/accel.h"
#include "renderer/camera.h"
#include "renderer/lights.h"
#include "renderer/majorants.h"
#include "renderer/scripts.h"
#include "renderer/switches.h"

namespace mms::renderer {

/// Objects that a ray is inside of and that hold a volume, outermost first. The innermost rules.
struct Media {
  static constexpr int kDeepest = 6;
  int objects[kDeepest] = {};
  int count = 0;

  int current() const { return count > 0 ? objects[count - 1] : -1; }
  void enter(int object) {
    if (count < kDeepest) objects[count++] = object;
  }
  /// Leaving what was never entered (an open mesh) changes nothing.
  void leave(int object) {
    int kept = 0;
    bool left = false;  // the innermost entry only: from the back
    for (int i = count; i-- > 0 && !left;)
      if (objects[i] == object) left = true, objects[i] = kNone;
    for (int i = 0; i < count; ++i)
      if (objects[i] != kNone) objects[kept++] = objects[i];
    count = kept;
  }

 private:
  static constexpr int kNone = -1;
};

struct World {
  const SceneData& scene;
  const Compiled& compiled;
  const Accel& accel;
  const Lights& lights;
  CameraRays camera;
  Media camera_media;        ///< what the camera stands in
  std::vector<bool> sealed;  ///< objects whose inside no light reaches unscattered
  bool plain = true;         ///< no volume and nothing semi-transparent: rays end where they hit
  std::uint64_t seed = 0;
  int max_depth = 0;
  std::vector<MajorantGrid> majorants;  ///< of each object's volume, if it varies: Findings
  Estimator estimator = Estimator::Clustered;
  Generator generator = Generator::Niederreiter;

  const Surface& surface_of_object(int object) const {
    return scene.surfaces[scene.objects[object].surface];
  }
  const CompiledDescriptor& volume_of_object(int object) const {
    return compiled.of(scene.volumes[scene.objects[object].volume].script);
  }
  /// Follows a ray through a surface.
  void cross(Media& media, int object, bool inwards) const {
    if (scene.objects[object].volume < 0) return;
    if (inwards)
      media.enter(object);
    else
      media.leave(object);
  }
};

/// Whether object `o` sends out light of its own.
bool emits(const SceneData& scene, const Compiled& compiled, const Object& o);

/// Whether everything between the inside of object `i` and any light is the object's own opaque
/// surface: then shadow rays from inside are vain.
bool sealed(const SceneData& scene, const Compiled& compiled, int i);

/// Whether rays may pass object `o` without being scattered.
bool semi_transparent(const SceneData& scene, const Compiled& compiled, const Object& o);

}  // namespace mms::renderer
