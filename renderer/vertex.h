// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What happens at one point of a path: the shading frame, and light that leaves the point.

#include "base/vec.h"
#include "renderer/scripts.h"

namespace mms::renderer {

/// The number that draws the last way in which a lobe may send light on: to let it through.
inline constexpr float kLastWay = 1 - 0x1p-24f;

/// 1 where there is a chance at all, else 0.
inline Spectrumf possible(const Spectrumf& chances) {
  return Spectrumf::map([](float chance) { return chance > 0 ? 1.0f : 0.0f; }, chances);
}

/// The frame that scattering is evaluated in. The normal of `s` is tilted by the gradient of the
/// height field, n - g_u tangent - g_v bitangent, then held back where it would turn away from
/// `view` or mirror it into the surface: a bump can not show its own back.
Frame<double> shading_frame(const SurfacePoint& s, const std::array<double, 2>& gradient,
                            Vec3d view);

/// Whether `direction` is on the same side of the geometry as of the shading normal. Light on
/// different sides would leak through the surface.
inline bool consistent(const SurfacePoint& s, const Frame<double>& frame, Vec3d direction) {
  return dot(direction, s.geometric_normal) * dot(direction, frame.n) > 0;
}

/// Turns the indices of what bends light from over vacuum to over `outside`, for a surface that
/// lies in something else. `params`: the numbers of `layout`.
void immerse(const materials::Layout& layout, const Spectrumf& outside, float* params);

/// Radiance that a scripted surface sends from lane `lane` of the last run towards `to`: what is
/// negative counts as 0.
Spectrumf scripted_emission(const Compiled& compiled, const Scripts& scripts,
                            const vm::Descriptor& d, EntryKind entry, int lane,
                            const SurfacePoint& s, Vec3d to, std::vector<float>& scratch);

/// Radiance of a surface that the scene describes; to the side of its normal only.
Spectrumf fixed_emission(const FixedSurface& surface, const SurfacePoint& s, Vec3d to,
                         const Cluster& cluster);

/// Albedo of a surface that the scene describes.
Spectrumf fixed_albedo(const FixedSurface& surface, const Object& object, Vec3d position,
                       const Cluster& cluster);

}  // namespace mms::renderer
