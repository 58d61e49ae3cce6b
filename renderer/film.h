// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The picture under way. Samples are points of the image function (thesis 2.3): a place on the
/// film and CIE XYZ, bound to no pixel; a filter spreads each over the pixels around it. All sums
/// are whole numbers in 128 bits, so they have the same bits whatever the order of samples, the
/// number of threads and the parts that a picture was made in.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/filter.h"
#include "renderer/render.h"

namespace mms::renderer {

__extension__ using Int128 = __int128;

/// One point of the stream that an integrator makes.
struct FilmSample {
  double x = 0, y = 0;       ///< pixels from the top left corner
  std::uint32_t number = 0;  ///< of the sample in its pixel
  std::array<double, 3> xyz{};
};

/// What was wrong with a sample, if it could not be added; then it counts as black.
enum class SampleFate : std::uint8_t { Added, NotANumber, Infinite, Overflow };

/// Values of samples, from here on, are refused.
inline constexpr double kLargestSample = 0x1p32;

/// Luminance above it counts as it in variances: squares of what is brighter would not fit. 2^38 in
/// units of 2^-64 is 2^102 and leaves room for 2^25 samples.
inline constexpr double kLargestForVariance = 0x1p19;

/// Edge of the squares that a picture is worked on in, in pixels.
inline constexpr int kTile = 16;

/// Pixels [x0, x1) x [y0, y1).
struct Rect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  std::size_t area() const { return std::size_t(x1 - x0) * std::size_t(y1 - y0); }
  bool has(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  bool operator==(const Rect&) const = default;
};

/// Sums for one pixel. Values are multiples of 2^-40, weights of 2^-24, so products are of 2^-64:
/// below 2^32 each, 2^31 of the largest fit.
struct PixelSums {
  Int128 xyz[3] = {0, 0, 0};    ///< of weight times value, in 2^-64
  Int128 luminance_square = 0;  ///< of weight times Y^2, in 2^-64; |Y| is cut for it
  std::int64_t weight = 0;      ///< in 2^-24
  std::uint32_t samples = 0;    ///< that fell into the pixel
  std::uint32_t dropped = 0;    ///< of them, those that were not added
  PixelSums& operator+=(const PixelSums& other);
  bool operator==(const PixelSums&) const = default;
};

/// Luminance alone, of samples with numbers in one range.
struct BlockSums {
  Int128 y = 0;  ///< in 2^-64, cut like the squares
  std::int64_t weight = 0;
  BlockSums& operator+=(const BlockSums& other);
  bool operator==(const BlockSums&) const = default;
};

/// The block that sample `number` belongs to: [0, 2), [2, 4), [4, 8), [8, 16) ... The blocks before
/// one have together as many samples as it has, and like it are a net of the sequence.
constexpr int block_of(std::uint32_t number) { return number < 2 ? 0 : 31 - __builtin_clz(number); }
/// First number after block `block`.
constexpr std::uint32_t block_end(int block) { return 2u << block; }

/// Sums over a picture or over a part of it.
class FilmSums {
 public:
  FilmSums(int width, int height, FilterShape filter)
      : FilmSums(width, height, filter, {0, 0, width, height}) {}
  /// Pixels of `rect` of a picture of width x height.
  FilmSums(int width, int height, FilterShape filter, Rect rect);

  int width() const { return width_; }
  int height() const { return height_; }
  FilterShape filter() const { return shape_; }
  const Rect& rect() const { return rect_; }

  /// Makes all sums zero, over other pixels of the same picture.
  void restart(Rect rect);
  /// Spreads a sample over the pixels of the rect that it reaches. Not locked.
  SampleFate add(const FilmSample& sample);
  /// Adds what a part has gathered; `part` lies within this.
  void merge(const FilmSums& part);

  const PixelSums& pixel(int x, int y) const { return pixels_[index(x, y)]; }
  std::span<const PixelSums> pixels() const { return pixels_; }

  /// How many samples the filter lets the pixel see: about those that fell into it.
  double samples_seen(const PixelSums& p) const;
  /// As many independent samples would know its mean as well: it makes use of those that it shares
  /// with its neighbours, too.
  double samples_worth(const PixelSums& p) const;
  /// Of one value; \pre p.weight > 0
  static double mean(const PixelSums& p, int i);
  /// Variance of the mean luminance, were the samples independent; 0 below two samples.
  double variance(const PixelSums& p) const;

  /// Luminance is summed by blocks at pixels whose x and y are multiples of this: enough pixels to
  /// know the error of a large picture by.
  int probe_stride() const { return stride_; }
  /// Probes of the picture, row by row, or nothing where no sample of the block came.
  std::span<const BlockSums> block(int b) const {
    return b < int(blocks_.size()) ? std::span<const BlockSums>(blocks_[b])
                                   : std::span<const BlockSums>();
  }
  int blocks() const { return int(blocks_.size()); }
  /// The block at a probe of this rect, or zeros.
  BlockSums block(int b, int x, int y) const {
    return block(b).empty() ? BlockSums() : blocks_[std::size_t(b)][probe(x, y)];
  }
  std::size_t probes() const { return std::size_t(across_) * std::size_t(down_); }

  /// Takes sums that were kept. \pre as many as there are pixels, and probes or none in each block.
  void restore(std::vector<PixelSums> pixels, std::vector<std::vector<BlockSums>> blocks);

  /// Means, and the variance of each by the scatter of its samples as if they were independent.
  Film develop() const;
  /// One pixel more at the end of `film`.
  void develop(const PixelSums& p, Film& film) const;

 private:
  std::size_t index(int x, int y) const {
    return std::size_t(y - rect_.y0) * std::size_t(rect_.width()) + std::size_t(x - rect_.x0);
  }
  std::size_t probe(int x, int y) const {
    return std::size_t(y / stride_ - first_down_) * std::size_t(across_) +
           std::size_t(x / stride_ - first_across_);
  }
  void spread(Int128 y, Int128 square, const Int128 (&xyz)[3], const FilmSample& s);
  std::vector<BlockSums>& open_block(int b);

  int width_, height_, stride_;
  FilterShape shape_;
  const Filter* filter_;
  Rect rect_;
  int first_across_ = 0, first_down_ = 0, across_ = 0, down_ = 0;  ///< probes in the rect
  std::vector<PixelSums> pixels_;
  std::vector<std::vector<BlockSums>> blocks_;
};

}  // namespace mms::renderer
