// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Directions in which rough balls show lamps. What a glossy ball sends on to matte things comes
/// from about where it mirrors a lamp, and directions drawn by the cosine seldom lead there.
///
/// A ball of radius r mirrors the middle of a lamp at one point (renderer/caustics.h). Let theta be
/// the angle to the normal there, a and b the distances to the receiver and to the lamp. A step of
/// length s away from that point turns the half vector against the normal by the slope
///
///   s (cos(theta) / 2 (1 / a + 1 / b) + 1 / r)    in the plane of the ray,
///   s ((1 / a + 1 / b) / (2 cos(theta)) + 1 / r)  across,
///
/// to first order, and facets of GGX scatter by 1 / (1 + slope^2 / alpha^2)^2: such a lobe, wider
/// by the size of the lamp, is drawn around the direction to that point.

#include <array>
#include <vector>

#include "renderer/caustics.h"
#include "renderer/lights.h"

namespace mms::renderer {

/// A sphere that scatters about where a polished one would mirror, the same all over.
struct GlossyBall {
  PolishedBall polished;
  double alpha = 0;  ///< width of slopes between view and what is scattered, as of GGX
};

/// Such balls of a scene, or the first few. Runs scripts.
std::vector<GlossyBall> glossy_balls(const SceneData& scene, const Compiled& compiled);

/// The images of lamps that are seen from one matte point.
class LampImages {
 public:
  /// \pre `lights` are few (kLightsDrawnEach); `normal` is unit.
  LampImages(std::span<const GlossyBall> balls, const Lights& lights, Vec3d from, Vec3d normal);

  /// How likely a direction is worth to be drawn; 0 where there are no images.
  double chance() const { return chance_; }
  /// A unit vector. \pre chance() > 0
  Vec3d sample(double u, double v) const;
  /// Per steradian, a direction being drawn.
  double pdf(Vec3d direction) const;

  static constexpr int kMostBalls = 2;

 private:
  struct Image {
    Frame<double> axes;       ///< n towards it, s in the plane of the ray
    double width_s, width_t;  ///< of its tangents
    double power;
  };
  static bool image_of(const GlossyBall& ball, const Lights::Lamp& lamp, Vec3d from, Vec3d normal,
                       Image& image);

  std::array<Image, std::size_t(kMostBalls* kLightsDrawnEach)> images_;
  int count_ = 0;
  double power_ = 0;  ///< of all images
  double chance_ = 0;
};

}  // namespace mms::renderer
