// SPDX-License-Identifier: Apache-2.0
#include "renderer/texel_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mms::renderer {

TexelBounds::TexelBounds(const TexelFile& file) {
  low_ = std::numeric_limits<double>::infinity();
  high_ = -low_;
  known_ = true;
  TexelLevel level;
  for (int k = 0; read_texels(file, k, level); ++k) {
    if (k == 0) take_blocks(file, level);
    take_level(file, level);
  }
  known_ = known_ && low_ <= high_;
}

void TexelBounds::take_level(const TexelFile& file, const TexelLevel& level) {
  const int w = level.width, h = level.height, n = file.channels;
  const auto at = [&](int x, int y, int c) {
    return double(level.pixels[(std::size_t(y) * std::size_t(w) + std::size_t(x)) * std::size_t(n) +
                               std::size_t(c)]);
  };
  double across = 0, down = 0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      for (int c = 0; c < n; ++c) {
        const double v = at(x, y, c);
        known_ = known_ && std::isfinite(v);
        low_ = std::min(low_, v);
        high_ = std::max(high_, v);
        across = std::max(across, std::fabs(v - at((x + 1) % w, y, c)));
        down = std::max(down, std::fabs(v - at(x, (y + 1) % h, c)));
      }
  slope_u_ = std::max(slope_u_, across * w);
  slope_v_ = std::max(slope_v_, down * h);
}

void TexelBounds::take_blocks(const TexelFile& file, const TexelLevel& level) {
  columns_ = (level.width + kBlock - 1) / kBlock;
  const int rows = (level.height + kBlock - 1) / kBlock;
  constexpr double kInf = std::numeric_limits<double>::infinity();
  blocks_.assign(std::size_t(columns_) * std::size_t(rows), {kInf, -kInf});
  const float* p = level.pixels.data();
  for (int y = 0; y < level.height; ++y)
    for (int x = 0; x < level.width; ++x) {
      Span& block = blocks_[std::size_t(y / kBlock * columns_ + x / kBlock)];
      for (int c = 0; c < file.channels; ++c, ++p) {
        block.low = std::min(block.low, double(*p));
        block.high = std::max(block.high, double(*p));
      }
    }
}

void TexelBounds::within(int first_column, int last_column, int first_row, int last_row,
                         double& low, double& high) const {
  low = std::numeric_limits<double>::infinity();
  high = -low;
  for (int y = first_row / kBlock; y <= last_row / kBlock; ++y)
    for (int x = first_column / kBlock; x <= last_column / kBlock; ++x) {
      const Span& block = blocks_[std::size_t(y * columns_ + x)];
      low = std::min(low, block.low);
      high = std::max(high, block.high);
    }
}

}  // namespace mms::renderer
