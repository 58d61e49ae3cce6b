// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Skies that need no picture: types of the CIE standard general sky (ISO 15469:2004, CIE S 011).

#include <span>
#include <string_view>

#include "renderer/scene.h"

namespace mms::renderer {

/// One of the standard's fifteen types: coefficients of its luminance, relative to the zenith's,
/// f(chi) phi(Z) / (f(Zs) phi(0)), where Z is the angle from the zenith, chi that from the sun, and
/// Zs that between both; the gradation is phi(Z) = 1 + a exp(b / cos Z), the indicatrix
/// f(chi) = 1 + c (exp(d chi) - exp(d pi / 2)) + e cos^2 chi.
struct Sky {
  std::string_view name;
  double a, b, c, d, e;
  Rgb colour;  ///< everywhere above the horizon; its spectrum has luminance 1. The standard states
               ///< none

  bool has_sun() const { return c != 0 || e != 0; }  ///< whether it matters where the sun is
};

std::span<const Sky> skies();

/// Towards the sun of a scene that says nothing else: before and to the left of the camera of the
/// built-in scenes, 42 degrees high.
inline constexpr Vec3d kSun{-1, 2, 2};

/// Radiance of what lies below the horizon, all round, where a matte white surface that faces up
/// has 1: a grey of reflectance 0.2 (the usual one of open ground) in the light of the sky alone.
inline constexpr float kSkyGround = 0.2F;

/// The sky as a picture, without the sun itself: 512 by 256 texels, half of them below the horizon.
/// The first row there repeats the last of the sky, so that no blending with the ground darkens the
/// horizon. A matte white surface that faces up has radiance 1 in the light of the sky. \pre `sun`,
/// towards the sun and of any length, lies above the horizon.
EnvironmentImage make_sky(const Sky& sky, Vec3d sun);

}  // namespace mms::renderer
