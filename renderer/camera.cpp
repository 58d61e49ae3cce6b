// SPDX-License-Identifier: Apache-2.0
#include "renderer/camera.h"

#include "base/warp.h"

namespace mms::renderer {

CameraRays::CameraRays(const Camera& camera, int width, int height)
    : camera_(camera), width_(width), height_(height) {
  const Vec3d back = normalize(camera.position - camera.target);
  const Vec3d right = normalize(cross(camera.up, back));
  axes_ = {right, cross(back, right), back};
  pixel_ = 2 * std::tan(camera.fov / 2) / height_;
}

CameraRays::LensPoint CameraRays::sample_lens(double u, double v) const {
  return {camera_.position + axes_.to_world(square_to_disc(u, v) * camera_.aperture), pdf_lens()};
}

double CameraRays::pdf_lens() const {
  return camera_.aperture > 0 ? 1 / (kPi<double> * camera_.aperture * camera_.aperture) : 1;
}

/// The film is even on the plane in focus, at distance h: a pixel covers (p h)^2 there, which is
/// seen under cos^3 (p h)^2 / h^2 steradians, and projected under cos^4 p^2.
std::optional<CameraRays::Sensed> CameraRays::sense(Vec3d lens_point, Vec3d direction) const {
  const Vec3d lens = axes_.to_local(lens_point - camera_.position);
  const Vec3d d = axes_.to_local(direction);
  const double cosine = -d.z;
  if (!(cosine > 0)) return {};
  const Vec3d in_focus = (lens + d * (camera_.focus / cosine)) / camera_.focus;
  const double x = in_focus.x / pixel_ + width_ / 2, y = height_ / 2 - in_focus.y / pixel_;
  if (!(x >= 0 && x < width_ && y >= 0 && y < height_)) return {};
  const double square = cosine * cosine * pixel_;
  const double importance = 1 / (square * square);
  return Sensed{x, y, importance / (width_ * height_), importance};
}

CameraRay CameraRays::at(double x, double y, double u, double v) const {
  // On the plane in focus, which is parallel to the film.
  const Vec3d local{(x - width_ / 2) * pixel_, (height_ / 2 - y) * pixel_, -1};
  const Vec3d lens = square_to_disc(u, v) * camera_.aperture;
  const Vec3d direction = normalize(local * camera_.focus - lens);
  return {Vec3f(camera_.position + axes_.to_world(lens)), Vec3f(axes_.to_world(direction))};
}

}  // namespace mms::renderer
