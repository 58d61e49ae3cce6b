// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Sums of samples in 128-bit fixed point: the same bits whatever the order of threads.

#include <array>
#include <cstdint>
#include <mutex>
#include <vector>

#include "renderer/render.h"

namespace mms::renderer {

__extension__ using Int128 = __int128;

/// A sum of values in units of 2^-64 and of squares in units of 2^-48. Values must be below 2^32
/// in magnitude, so 2^15 of the largest squares, or any real picture, fit.
struct PixelSums {
  Int128 xyz[3] = {0, 0, 0};
  Int128 luminance_square = 0;
  std::uint32_t samples = 0;
};

/// Adds one sample; what was wrong with it, if it could not be added.
enum class SampleFate : std::uint8_t { Added, NotANumber, Infinite, Overflow };
SampleFate add_sample(PixelSums& sums, const std::array<double, 3>& xyz);

/// The picture under way. A dropped sample still counts as one (of radiance zero).
class FilmSums {
 public:
  FilmSums(int width, int height)
      : width_(width), height_(height), pixels_(std::size_t(width) * height) {}
  int width() const { return width_; }
  int height() const { return height_; }
  /// Not locked: a caller adds to pixels that no other thread adds to at the same time.
  PixelSums& pixel(int x, int y) { return pixels_[std::size_t(y) * width_ + x]; }
  const PixelSums& pixel(int x, int y) const { return pixels_[std::size_t(y) * width_ + x]; }

  Film develop() const;

 private:
  int width_, height_;
  std::vector<PixelSums> pixels_;
};

}  // namespace mms::renderer
