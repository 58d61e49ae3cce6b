// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Everything that a render reads and nothing writes, shared by all threads.

#include "renderer/accel.h"
#include "renderer/camera.h"
#include "renderer/glows.h"
#include "renderer/lamp_images.h"
#include "renderer/lights.h"
#include "renderer/media.h"
#include "renderer/rate_grid.h"
#include "renderer/scripts.h"
#include "renderer/switches.h"

namespace mms::renderer {

struct World {
  const SceneData& scene;
  const Compiled& compiled;
  const Accel& accel;
  const Lights& lights;
  CameraRays camera;
  Media camera_media;                  ///< what the camera stands in
  std::vector<bool> sealed;            ///< objects whose inside no light reaches unscattered
  std::vector<bool> semi_transparent;  ///< objects that rays may pass unscattered
  bool plain = true;  ///< no volume, no priority, nothing semi-transparent: rays end where they hit
  bool nested = false;  ///< some object has a priority
  /// The first vertices of a path are lit by each of the lights rather than by one of them: most of
  /// what a pixel's samples differ by happens there, and the choice between lights is most of that.
  bool each_light = false;
  Matter matter = Matter::Coloured;
  std::uint64_t seed = 0;
  int max_depth = 0;
  /// Of each object's volume, if it varies: Findings.
  std::vector<RateGrid> majorants, emission_rates;
  Glows glows;
  Estimator estimator = Estimator::Clustered;
  Generator generator = Generator::Niederreiter;
  std::vector<PolishedBall> balls;       ///< by way of which lights are reached
  std::vector<GlossyBall> glossy_balls;  ///< that show lamps to what is matte; where `each_light`

  /// The one of `balls` that an object is, or -1.
  int ball_of(int object) const {
    const auto at = std::ranges::find(balls, object, &PolishedBall::object);
    return at == balls.end() ? -1 : int(at - balls.begin());
  }
  const Surface& surface_of_object(int object) const {
    return scene.surfaces[scene.objects[object].surface];
  }
  const CompiledDescriptor& volume_of_object(int object) const {
    return compiled.of(scene.volumes[scene.objects[object].volume].script);
  }
  /// Follows a ray through a surface.
  void cross(Media& media, int object, bool inwards) const {
    if (!tracked(scene.objects[object])) return;
    if (inwards)
      media.enter(object);
    else
      media.leave(object);
  }
  /// The volumes around a ray: of the highest priority there.
  Filling filling(const Media& media) const;
  /// Whether no light comes unscattered to where a ray is.
  bool sealed_in(const Media& media) const {
    for (int i = 0; i < media.count; ++i)
      if (sealed[media.objects[i]]) return true;
    return false;
  }
};

/// Grey where no wavelength can be told from another but by what lamps of the scene radiate. What
/// a script radiates need not be of their colours.
Matter matter_of(const SceneData& scene, const Compiled& compiled);

/// Whether object `o` sends out light of its own.
bool emits(const SceneData& scene, const Compiled& compiled, const Object& o);

/// Whether everything between the inside of object `i` and any light is the object's own opaque
/// surface: then shadow rays from inside are vain.
bool sealed(const SceneData& scene, const Compiled& compiled, int i);

/// Whether rays may pass object `o` without being scattered.
bool semi_transparent(const SceneData& scene, const Compiled& compiled, const Object& o);

/// Whether a ray may find itself where the surface of `o` is not there: something has priority.
bool may_be_hidden(const SceneData& scene, const Object& o);

}  // namespace mms::renderer
