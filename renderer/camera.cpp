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

CameraRay CameraRays::at(double x, double y, double u, double v) const {
  // On the plane in focus, which is parallel to the film.
  const Vec3d local{(x - width_ / 2) * pixel_, (height_ / 2 - y) * pixel_, -1};
  const Vec3d lens = square_to_disc(u, v) * camera_.aperture;
  const Vec3d direction = normalize(local * camera_.focus - lens);
  return {Vec3f(camera_.position + axes_.to_world(lens)), Vec3f(axes_.to_world(direction))};
}

}  // namespace mms::renderer
