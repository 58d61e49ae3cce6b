// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The texels of pictures through OpenImageIO's image cache: levels of half the size each, made
/// where the file has none, read tile by tile and kept as they are stored, within a budget.
/// Internal to the textures.

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"

namespace mms::renderer {

/// The cache itself: pictures share it and keep it alive.
class TexelCache {
 public:
  explicit TexelCache(double megabytes);
  ~TexelCache();
  TexelCache(const TexelCache&) = delete;
  TexelCache& operator=(const TexelCache&) = delete;

  void* handle() const { return cache_; }  ///< an OIIO::ImageCache*

 private:
  void* cache_;
};

/// Of one picture: columns and rows of all it shows, of which the file may have a part.
struct TexelLevelSize {
  int columns, rows;
  int left, top;  ///< of the first column and row, as the file counts
  int data_left, data_top, data_right, data_bottom;  ///< what the file has; the last two are behind
  int tile_columns, tile_rows;
};

/// The levels of a picture in the cache, the first being the largest. Immutable.
class TexelPyramid {
 public:
  /// `name`: what the cache knows it by. The error's `what` goes on after the file's name.
  static Result<TexelPyramid> open(const TexelCache& cache, const std::string& name);

  int levels() const { return int(levels_.size()); }
  const TexelLevelSize& level(int k) const { return levels_[std::size_t(k)]; }
  /// How many columns or rows of the first level are one of level k, along the axis with more.
  double scale(int k) const { return scales_[std::size_t(k)]; }
  /// Whether the file lacks a part of what the picture shows; it is black.
  bool cropped() const { return cropped_; }

 private:
  friend class TexelReader;
  void* handle_ = nullptr;  ///< an OIIO::ImageCache::ImageHandle*
  std::vector<TexelLevelSize> levels_;
  std::vector<double> scales_;
  bool cropped_ = false;
};

/// Reads texels for one thread, and holds on to the tiles that it read last.
class TexelReader {
 public:
  explicit TexelReader(const TexelCache& cache);
  ~TexelReader();
  TexelReader(const TexelReader&) = delete;
  TexelReader& operator=(const TexelReader&) = delete;

  /// Which texels: some columns and rows of a level, rows from the top; -1: black.
  struct Block {
    const int *columns, *rows;
    int across, down;
  };
  /// Those texels row by row: `channels` numbers of each from the `first` one on. False where the
  /// file turns out to be broken.
  bool read(const TexelPyramid& pyramid, int level, const Block& block, int first, int channels,
            float* to);

 private:
  struct Slot {
    void* tile = nullptr;
    const TexelPyramid* pyramid = nullptr;
    int level = 0, column = 0, row = 0;
    const unsigned char* texels = nullptr;
    int number = 0, number_bytes = 0, pixel_bytes = 0, row_bytes = 0;
  };
  const Slot* tile_of(const TexelPyramid& pyramid, int level, int column, int row);
  static void take_texels(const Slot& s, int x, int y, int count, int first, int channels,
                          float* to);

  void* cache_;
  void* thread_;
  std::array<Slot, 8> slots_;  ///< of two levels, two by two tiles
};

}  // namespace mms::renderer
