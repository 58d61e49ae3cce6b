// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Rays that a polished ball mirrors, or a clear one lets through, from one point to another. A
/// light drawn for a vertex is reached by way of the ball as well as straight: else only scattering
/// finds it there, by chance, and what the ball gathers is most of the noise of the picture.
///
/// It is next event estimation past specular vertices (Hanika, Droske and Fascione 2015), with all
/// of the way in closed form but one angle. A ray keeps to a plane with the centre. With theta its
/// angle to the normal where it comes to a ball of radius r and index n and where it leaves, and
/// c = 1 for a ray that goes through or 0 for one that is mirrored, it turns about the centre,
/// between two points at distances a and b from there, by
///
///   2 theta - asin(r sin(theta) / a) - asin(r sin(theta) / b) + c (pi - 2 asin(sin(theta) / n)),
///
/// which is convex over theta in [0, pi / 2] for n > 1, so that every ray is found. From a point
/// inside, at a from the centre, a ray turns by
///
///   theta - asin(r sin(theta) / b) - asin(sin(theta) / n) +- asin(r sin(theta) / (n a))
///
/// and, for the lower sign, pi more: it comes past its point nearest to the centre first. The upper
/// sign makes it grow with theta; the lower one makes it convex where r < n a, and fall elsewhere.

#include <span>
#include <vector>

#include "renderer/scripts.h"

namespace mms::renderer {

/// A sphere of one lobe, the same all over, that only mirrors and bends.
struct PolishedBall {
  int object = -1;  ///< index into SceneData::objects
  Vec3d centre;
  double radius = 1;
  const materials::Layout* layout = nullptr;
  bool from_outside = true;  ///< else only light for points inside is looked for
};

/// How a ray goes by a ball.
enum class Course : std::uint8_t {
  Mirrored,
  Through,
  Out,      ///< from inside, away from the centre all along
  OutPast,  ///< from inside, past its point nearest to the centre
};

/// What rays are looked for at a ball, for the wavelengths of one path.
struct BallOptics {
  bool mirrors = false;
  float index = 0;  ///< of rays through: the hero's, inside over outside; 0: there are none

  BallOptics() = default;
  /// From the numbers of the layout.
  BallOptics(const materials::Layout& layout, const float* params);

  bool any() const { return mirrors || index > 0; }
};

/// A ray by way of a ball.
struct BallRay {
  Course course = Course::Mirrored;
  double cosine = 0;  ///< to the normal, outside, where it comes and where it leaves
  Vec3d entry, exit;  ///< the same but of one that goes through
};
inline constexpr int kMostBallRays = 4;

/// What becomes of light along such a ray.
struct BallShare {
  Spectrumf f;         ///< what is left of radiance
  Spectrumf possible;  ///< 1 for a wavelength that may go the hero's way, else 0
};
BallShare share_of(const PolishedBall& ball, const float* params, const BallOptics& optics,
                   const BallRay& ray);

/// All rays from `from` to `to`, which is outside, by way of `ball`; their number.
int rays_by(const PolishedBall& ball, const BallOptics& optics, Vec3d from, Vec3d to,
            std::span<BallRay, kMostBallRays> rays);

/// What a ray spreads by: how it went, and between what points.
struct BallWay {
  Course course = Course::Mirrored;
  double index = 1, cosine = 0;
};

/// The share of mirrored rays that are worth looking for from a point: a ball far off sends little.
double mirror_share(const PolishedBall& ball, Vec3d from);

/// Steradians at `from` for each m^2 across the ray at `to`. 0 where it is not known, the points
/// and the centre on a line.
double spread_by(const PolishedBall& ball, const BallWay& way, Vec3d from, Vec3d to);

/// Density, per steradian at `from`, of drawing a light's point `to` and going there by way of the
/// ball; `straight` is the density of the direction in which the point lies. `back`: unit, from
/// there to the ball.
double density_by(const PolishedBall& ball, const BallWay& way, Vec3d from, const SurfacePoint& to,
                  double straight, Vec3d back);

/// A point that stands for what lies endlessly far along a unit `direction`.
Vec3d far_point(const PolishedBall& ball, Vec3d direction);
/// The density likewise of light from endlessly far along `direction`.
double far_density_by(const PolishedBall& ball, const BallWay& way, Vec3d from, Vec3d direction,
                      double straight);

/// The numbers of the material of object `i`, if it is a sphere of a script and they are the same
/// all over; else none. Runs the script.
std::vector<float> ball_params(const SceneData& scene, const Compiled& compiled, int i);

/// Such balls of a scene, or the first few. `plain` as of World; where it is not, only those that
/// hold a volume alone. Runs scripts.
std::vector<PolishedBall> polished_balls(const SceneData& scene, const Compiled& compiled,
                                         bool plain);

}  // namespace mms::renderer
