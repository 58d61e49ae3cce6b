// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Every random number of a render: one explicit function of (seed, pixel, sample, coordinate),
/// thesis 6.1.1. Nothing owns a random state, so any sample of any pixel replays alone, on any
/// thread and in any order.
///
/// Coordinates 0 to 3 are point `sample` of a (1, 4)-sequence, Owen-scrambled for each pixel, or
/// what `Generator` puts in its place. All further ones come in pairs, each of a (0, 2)-sequence
/// that is scrambled likewise. Each pair takes the points in an order of its own, shuffled such
/// that each 2^k points in a row stay together (Burley 2020, "Practical Hash-based Owen
/// Scrambling"): samples are stratified within a pair, and pairs are independent of each other.
/// `random` and `unscrambled` hash them instead. Who uses which: 0, 1 film; 2 wavelengths; 3 the
/// part of a material that the first vertex scatters by; 4, 5 lens; from `pair_of_bounce` on those
/// of the scattering events.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

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

  /// Coordinates 0 to 3. All numbers are in [0, 1): never 1, also after rounding to float.
  std::array<float, 4> first() const;
  /// Coordinates 2 `number` and the next. \pre number >= 2, a `pair_of_light` or a `pair_of_glow`
  std::array<float, 2> pair(int number) const { return pair(number, 0, 1); }
  /// The same, of draw `draw` of `draws` that each sample has of it.
  std::array<float, 2> pair(int number, int draw, int draws) const;
  float operator()(int coordinate) const;

  /// Numbers of the same sample that are others, for what goes another way at event `event`.
  Sampler branch(int event) const;

  /// A hashed number for events that a path has any number of (steps through media): `stream`
  /// tells users apart, `n` counts.
  float hashed(std::uint32_t stream, std::uint32_t n) const;

 private:
  std::uint64_t key_ = 0, sample_ = 0;
  Generator generator_ = Generator::Niederreiter;
};

/// What the first four are for, and which pairs.
enum : int { kFilmX, kFilmY, kWavelength, kFirstPart };
enum : int { kLensPair = 2, kFirstBounce };

/// Pairs of a scattering event: places on a light, directions, and choices, which are of a part of
/// a material and of Russian roulette. The first event takes its part from `kFirstPart`: whether a
/// lamp's reflection is met depends on it and on the place on the film together.
enum BouncePair : int { kLight, kDirection, kChoices, kPairsOfBounce };

/// `bounce` counts from 0.
constexpr int pair_of_bounce(int bounce, BouncePair p) {
  return kFirstBounce + bounce * kPairsOfBounce + p;
}

/// Places on light `i` (from 1 to 3) where a vertex is lit by each; `kLight` has those on light 0.
/// The first event has one more, of directions to where lamps are mirrored.
inline constexpr int kLampImage = 4;
constexpr int pair_of_light(int bounce, int i) { return -4 * bounce - i; }
/// Directions to volumes that emit.
constexpr int pair_of_glow(int bounce) { return std::numeric_limits<int>::min() + bounce; }

}  // namespace mms::renderer
