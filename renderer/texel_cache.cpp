// SPDX-License-Identifier: Apache-2.0
#include "renderer/texel_cache.h"

#include <OpenImageIO/imagecache.h>

#define IMATH_HALF_NO_LOOKUP_TABLE  // its table would be one more library to link
#include <OpenImageIO/half.h>

#include <algorithm>
#include <cstring>

namespace mms::renderer {
namespace {

OIIO::ImageCache& cache_at(void* p) { return *static_cast<OIIO::ImageCache*>(p); }
OIIO::ImageCache::ImageHandle* file_at(void* p) {
  return static_cast<OIIO::ImageCache::ImageHandle*>(p);
}
OIIO::ImageCache::Tile* tile_at(void* p) { return static_cast<OIIO::ImageCache::Tile*>(p); }

/// Whole numbers stand for parts of the largest one.
constexpr std::array<float, 256> kBytes = [] {
  std::array<float, 256> all{};
  for (int k = 0; k < 256; ++k) all[std::size_t(k)] = float(k) / 255;
  return all;
}();

template <class N>
N stored(const unsigned char* from) {
  N n;
  std::memcpy(&n, from, sizeof(n));
  return n;
}

/// `count` numbers as they are stored, in float.
void take_numbers(int type, const unsigned char* from, int count, float* to) {
  if (type == OIIO::TypeDesc::UINT8) {
    for (int k = 0; k < count; ++k) to[k] = kBytes[from[k]];
  } else if (type == OIIO::TypeDesc::UINT16) {
    for (int k = 0; k < count; ++k) to[k] = float(stored<std::uint16_t>(from + 2 * k)) / 65535;
  } else if (type == OIIO::TypeDesc::HALF) {
    for (int k = 0; k < count; ++k) to[k] = float(stored<half>(from + 2 * k));
  } else {
    std::memcpy(to, from, std::size_t(count) * sizeof(float));
  }
}

TexelLevelSize size_of(const OIIO::ImageSpec& s) {
  return {s.full_width, s.full_height, s.full_x,       s.full_y,     s.x,
          s.y,          s.x + s.width, s.y + s.height, s.tile_width, s.tile_height};
}

}  // namespace

TexelCache::TexelCache(double megabytes) {
  OIIO::ImageCache* const cache = OIIO::ImageCache::create(false);
  cache->attribute("max_memory_MB", float(megabytes));
  cache->attribute("autotile", 64);
  cache->attribute("automip", 1);
  cache->attribute("unassociatedalpha", 1);
  cache_ = cache;
}

TexelCache::~TexelCache() { OIIO::ImageCache::destroy(&cache_at(cache_)); }

Result<TexelPyramid> TexelPyramid::open(const TexelCache& shared, const std::string& name) {
  OIIO::ImageCache& cache = cache_at(shared.handle());
  TexelPyramid p;
  auto* const file = cache.get_image_handle(OIIO::ustring(name));
  p.handle_ = file;
  int levels = 0;
  if (!file || !cache.good(file) ||
      !cache.get_image_info(file, nullptr, 0, 0, OIIO::ustring("miplevels"),
                            OIIO::TypeDesc::TypeInt, &levels))
    return Error{name, "cannot be read: " + cache.geterror(), ""};
  for (int k = 0; k < levels; ++k) {
    const OIIO::ImageSpec* const spec = cache.imagespec(file, nullptr, 0, k);
    if (!spec) return Error{name, "cannot be read: " + cache.geterror(), ""};
    p.levels_.push_back(size_of(*spec));
    const TexelLevelSize &first = p.levels_[0], &now = p.levels_.back();
    p.scales_.push_back(std::max(double(first.columns) / now.columns,  //
                                 double(first.rows) / now.rows));
    // A level that is no smaller than the one before would never be chosen.
    if (k > 0 && !(p.scales_[std::size_t(k)] > p.scales_[std::size_t(k - 1)])) {
      p.levels_.pop_back();
      p.scales_.pop_back();
      break;
    }
  }
  const TexelLevelSize& s = p.levels_[0];
  p.cropped_ = s.data_left > s.left || s.data_top > s.top || s.data_right < s.left + s.columns ||
               s.data_bottom < s.top + s.rows;
  return p;
}

TexelReader::TexelReader(const TexelCache& cache)
    : cache_(cache.handle()), thread_(cache_at(cache_).get_perthread_info()) {}

TexelReader::~TexelReader() {
  for (const Slot& s : slots_)
    if (s.tile) cache_at(cache_).release_tile(tile_at(s.tile));
}

/// The tile with that column and row of the file; null where it cannot be read.
const TexelReader::Slot* TexelReader::tile_of(const TexelPyramid& pyramid, int level, int column,
                                              int row) {
  const TexelLevelSize& size = pyramid.level(level);
  const int x = (column - size.data_left) / size.tile_columns;
  const int y = (row - size.data_top) / size.tile_rows;
  Slot& s = slots_[std::size_t((x & 1) | (y & 1) << 1 | (level & 1) << 2)];
  if (s.tile && s.pyramid == &pyramid && s.level == level && s.column == x && s.row == y)
    return s.texels ? &s : nullptr;
  OIIO::ImageCache& cache = cache_at(cache_);
  if (s.tile) cache.release_tile(tile_at(s.tile));
  auto* const tile =
      cache.get_tile(file_at(pyramid.handle_), static_cast<OIIO::ImageCache::Perthread*>(thread_),
                     0, level, column, row, 0);
  s = {tile, &pyramid, level, x, y};
  OIIO::TypeDesc type;
  const void* const texels = tile ? cache.tile_pixels(tile, type) : nullptr;
  if (!texels) return nullptr;
  s.texels = static_cast<const unsigned char*>(texels);
  s.number = type.basetype;
  s.number_bytes = int(type.basesize());
  s.pixel_bytes = s.number_bytes * cache.tile_roi(tile).nchannels();
  s.row_bytes = s.pixel_bytes * size.tile_columns;
  return &s;
}

bool TexelReader::read(const TexelPyramid& pyramid, int level, const Block& block, int first,
                       int channels, float* to) {
  const TexelLevelSize& size = pyramid.level(level);
  const int* const columns = block.columns;
  // No wrap goes up by one for each column but where it does nothing.
  const bool together =
      columns[0] >= 0 && columns[block.across - 1] - columns[0] == block.across - 1;
  for (int j = 0; j < block.down; ++j)
    for (int i = 0, run; i < block.across; i += run, to += run * channels) {
      run = 1;
      const int column = size.left + columns[i], row = size.top + block.rows[j];
      if (columns[i] < 0 || block.rows[j] < 0 || column < size.data_left ||
          column >= size.data_right || row < size.data_top || row >= size.data_bottom) {
        std::fill_n(to, channels, 0.0f);
        continue;
      }
      const Slot* const s = tile_of(pyramid, level, column, row);
      if (!s) return false;
      const int x = column - size.data_left - s->column * size.tile_columns;
      const int y = row - size.data_top - s->row * size.tile_rows;
      if (together)
        run = std::min({block.across - i, size.tile_columns - x, size.data_right - column});
      take_texels(*s, x, y, run, first, channels, to);
    }
  return true;
}

void TexelReader::take_texels(const Slot& s, int x, int y, int count, int first, int channels,
                              float* to) {
  const unsigned char* from =
      s.texels + y * s.row_bytes + x * s.pixel_bytes + first * s.number_bytes;
  if (channels * s.number_bytes == s.pixel_bytes)
    return take_numbers(s.number, from, count * channels, to);
  for (int k = 0; k < count; ++k, from += s.pixel_bytes, to += channels)
    take_numbers(s.number, from, channels, to);
}

}  // namespace mms::renderer
