// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the camera sees first, pixel by pixel: the layers of a picture that tell of the scene and
/// not of its light. They are means over the first samples of each pixel, with the very camera rays
/// of the picture, so edges are smooth; a box filter of one pixel, whatever the filter of the film.
/// Semi-transparent surfaces are seen through, as the path tracer does (thesis 6.1.2).

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace mms::renderer {

struct World;

/// Each value row by row, top first.
struct Layers {
  int samples = 0;  ///< of each pixel that were looked at
  using Triple = std::array<float, 3>;
  /// Share of light in the colour of D65 that the first vertex scatters; linear sRGB. 0 where there
  /// is none.
  std::vector<Triple> albedo;
  /// Shading normal in world space, bumps included; shorter than 1 where a pixel holds several; 0
  /// in volumes and where there is nothing.
  std::vector<Triple> normal;
  std::vector<Triple> position;  ///< world, m; mean of what is there; 0 where there is nothing
  std::vector<float> depth;      ///< distance to the camera, m; infinite where there is nothing
  /// Light that comes to the camera without being scattered, of the environment too; linear sRGB.
  std::vector<Triple> emission;
  /// What most samples met: 1 + an index into `names`; 0 is nothing.
  std::vector<std::uint32_t> descriptor;
  /// Surfaces of the scene, then its volumes.
  std::vector<std::string> names;
};

/// At most so many samples of a pixel are looked at.
inline constexpr int kLayerSamples = 16;

/// \pre sizes are positive. `threads` 0: all of the machine. The same on any number of threads.
Layers trace_layers(const World& world, int width, int height, int samples, int threads);

}  // namespace mms::renderer
