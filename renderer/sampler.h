// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Every random number of a render: one explicit function of (seed, pixel, sample, coordinate),
/// thesis 6.1.1. Nothing owns a random state, so any sample of any pixel replays alone, on any
/// thread and in any order.
///
/// Coordinates 0 to 3 are a point of a (1, 4)-sequence, Owen-scrambled for each pixel, or what
/// `Generator` puts in its place; further ones are hashed. Who uses which: 0, 1 film; 2
/// wavelengths; 3 the light that the first vertex is lit by; 4, 5 lens; from `first_of_bounce(b)`
/// on those of the b-th scattering event.

#include <cstdint>

#include "base/hash.h"
#include "renderer/switches.h"

namespace mms::renderer {

/// Coordinate `coordinate` (0 to 3) of point `number` of the (1, 4)-sequence: 32 binary digits.
std::uint32_t nx4(std::uint64_t number, int coordinate);

/// The same of Sobol's sequence, a (3, 4)-sequence; its first two coordinates are a (0,
/// 2)-sequence.
std::uint32_t sobol(std::uint64_t number, int coordinate);

/// Owen's nested uniform scrambling of 32 binary digits: each digit is flipped by a hash of the
/// digits above it (Laine and Karras 2011: multiplications on the reversed word).
std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed);

/// The numbers of one sample of one pixel.
class Sampler {
 public:
  Sampler() = default;
  Sampler(std::uint64_t seed, int x, int y, std::uint64_t sample,
          Generator generator = Generator::Niederreiter)
      : key_(hash_combine(mix64(seed), (std::uint64_t(std::uint32_t(y)) << 32) | std::uint32_t(x))),
        sample_(sample),
        generator_(generator) {}

  /// In [0, 1): never 1, also after rounding to float.
  float operator()(int coordinate) const;

  /// A hashed number for events that a path has any number of (steps through media): `stream`
  /// tells users apart, `n` counts.
  float hashed(std::uint32_t stream, std::uint32_t n) const;

 private:
  std::uint64_t key_ = 0, sample_ = 0;
  Generator generator_ = Generator::Niederreiter;
};

/// What the coordinates of a scattering event are for.
enum BounceCoordinate : int {
  kLightU,
  kLightV,
  kLobe,
  kDirectionU,
  kDirectionV,
  kRoulette,
  kCoordinatesOfBounce
};

inline constexpr int kFilmX = 0, kFilmY = 1, kWavelength = 2, kFirstLight = 3, kLensU = 4,
                     kLensV = 5, kFirstBounce = 6;

/// `bounce` counts from 0. The first choice of a light gets the last coordinate of the sequence.
constexpr int coordinate_of(int bounce, BounceCoordinate c) {
  if (bounce == 0 && c == kLightU) return kFirstLight;
  return kFirstBounce + bounce * kCoordinatesOfBounce + c;
}

}  // namespace mms::renderer
