// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Pinhole and thin-lens cameras: the queries of docs/renderer.md.

#include <array>
#include <optional>

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

  /// A point of the lens, and its density per m^2; for a pinhole 1, in place of a delta.
  struct LensPoint {
    Vec3d position;
    double pdf;
  };
  LensPoint sample_lens(double u, double v) const;
  double pdf_lens() const;
  /// The lens is one point, whatever chooses it.
  bool pinhole() const { return !(camera_.aperture > 0); }

  /// What is sensed from a point of the lens along a direction.
  struct Sensed {
    double x, y;  ///< where on the film, in pixels; inside of it
    double
        pdf;  ///< of that direction when all of the film is drawn evenly; per projected steradian
    /// Sensitivity: integrated over the projected solid angle of a pixel and over the lens (times
    /// pdf_lens) it is 1, so that a pixel's value is a radiance.
    double importance;
  };
  /// Nothing where `direction` (unit, from the lens outwards) does not meet the film.
  std::optional<Sensed> sense(Vec3d lens_point, Vec3d direction) const;

  /// Looks out, along the middle of the film: the lens' normal.
  Vec3d forward() const { return axes_.n * -1.0; }
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
