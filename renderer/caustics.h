// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Rays that go through a clear ball from one point to another. A light drawn for a vertex is
/// reached through the ball as well as straight: else only scattering finds it there, by chance,
/// and what the ball focuses is most of the noise of the picture.
///
/// It is next event estimation past specular vertices (Hanika, Droske and Fascione 2015), with all
/// of the way in closed form but one angle. A ray keeps to a plane with the centre. With theta its
/// angle to the normal where it enters and leaves a ball of radius r and index n, it turns about
/// the centre, between two points at distances a and b from there, by
///
///   pi + 2 theta - 2 asin(sin(theta) / n) - asin(r sin(theta) / a) - asin(r sin(theta) / b),
///
/// which is convex over theta in [0, pi / 2] for n > 1, so that every ray is found.

#include <span>
#include <vector>

#include "renderer/scripts.h"

namespace mms::renderer {

/// A sphere of one `dielectric` that is the same all over.
struct ClearBall {
  int object = -1;  ///< index into SceneData::objects
  Vec3d centre;
  double radius = 1;
};

/// What it is made of, for the wavelengths of one path.
struct BallGlass {
  float index = 0;        ///< the hero's, inside over outside; 0: no ray is looked for
  Spectrumf transmitted;  ///< tint; 0 for a wavelength that is not bent as the hero is

  BallGlass() = default;
  /// From the numbers of the `dielectric`.
  explicit BallGlass(const float* params);
  /// The share of light that Fresnel's factor and the tint leave to a ray.
  Spectrumf carried(double cosine) const;
};

/// A ray through a ball.
struct BallRay {
  double cosine = 0;  ///< to the normal, where it enters and where it leaves
  Vec3d entry, exit;
};
inline constexpr int kMostBallRays = 3;

/// All rays from `from` to `to`, two points outside, through `ball`; their number.
int rays_through(const ClearBall& ball, double index, Vec3d from, Vec3d to,
                 std::span<BallRay, kMostBallRays> rays);

/// How such a ray spreads: steradians at one end for each m^2 across it at the other, the same both
/// ways. 0 where it is not known, the points and the centre on a line.
double spread_through(const ClearBall& ball, double index, Vec3d from, Vec3d to, double cosine);

/// Density, per steradian at `from`, of drawing a light's point `to` and going there through the
/// ball; `straight` is the density of the direction in which the point lies. `back`: unit, from
/// there to the ball.
double density_through(const ClearBall& ball, double index, Vec3d from, const SurfacePoint& to,
                       double straight, Vec3d back, double cosine);

/// The clear balls of a scene, or the first few.
std::vector<ClearBall> clear_balls(const SceneData& scene, const Compiled& compiled);

}  // namespace mms::renderer
