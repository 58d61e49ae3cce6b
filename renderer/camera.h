// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Pinhole and thin-lens camera rays.

#include "renderer/scene.h"

namespace mms::renderer {

struct CameraRay {
  Vec3f origin, direction;
};

class CameraRays {
 public:
  CameraRays(const Camera& camera, int width, int height);

  /// The ray through (x, y), in pixels from the top left corner; (u, v) choose the lens point.
  CameraRay at(double x, double y, double u, double v) const;

  /// Angle between neighbouring pixels at the middle of the picture, radians.
  double pixel_angle() const { return pixel_; }
  /// World directions of growing x and y in the picture; unit.
  Vec3d right() const { return axes_.s; }
  Vec3d down() const { return axes_.t * -1.0; }

 private:
  Camera camera_;
  Frame<double> axes_;  ///< right, up, backwards
  double width_, height_, pixel_;
};

}  // namespace mms::renderer
