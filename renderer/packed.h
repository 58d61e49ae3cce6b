// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A picture in a quarter of the memory or less: blocks of 4 x 4 texels, each a line between two
/// values and for every texel one of sixteen places on it (after Beers, Agrawala and Chaddha 1996,
/// and the block formats of graphics hardware; ends are halves, so that bright pictures keep).
/// The first three channels of a colour share a line, other channels have their own.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mms::renderer {

class Packed {
 public:
  /// `pixels`: width * height * channels numbers, row by row.
  Packed(int width, int height, int channels, const float* pixels);

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }
  std::size_t bytes() const { return blocks_.size() * sizeof(blocks_[0]); }

  /// Unpacks `columns` x `rows` texels from (x, y) on; what lies outside the picture is 0.
  /// \pre x and y are multiples of 4.
  void unpack(int x, int y, int columns, int rows, float* to) const;

  /// No texel comes out further from what it was packed within than by this part of the largest
  /// magnitude: an end of a line is rounded to a half.
  static constexpr double kRounding = 0x1p-11;

 private:
  static constexpr int kSide = 4, kTexels = kSide * kSide, kSteps = 16;
  int groups() const { return channels_ >= 3 ? channels_ - 2 : channels_; }
  int first_of(int group) const { return channels_ >= 3 && group > 0 ? group + 2 : group; }
  int count_of(int group) const { return channels_ >= 3 && group == 0 ? 3 : 1; }
  std::size_t words_of_block() const;

  void pack_group(const float* texels, int group);
  const std::uint16_t* unpack_group(const std::uint16_t* from, int group, float* texels) const;

  int width_, height_, channels_;
  std::vector<std::uint16_t> blocks_;  ///< of each group: ends, then places, four to a word
};

}  // namespace mms::renderer
