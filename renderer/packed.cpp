// SPDX-License-Identifier: Apache-2.0
#include "renderer/packed.h"

#define IMATH_HALF_NO_LOOKUP_TABLE  // its table would be one more library to link
#include <OpenImageIO/half.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mms::renderer {
namespace {

std::uint16_t half_bits(float v) { return half(std::clamp(v, -65504.0f, 65504.0f)).bits(); }

float half_value(std::uint16_t bits) {
  half h;
  h.setBits(bits);
  return h;
}

}  // namespace

std::size_t Packed::words_of_block() const {
  std::size_t words = 0;
  for (int g = 0; g < groups(); ++g) words += std::size_t(2 * count_of(g) + kTexels / 4);
  return words;
}

Packed::Packed(int width, int height, int channels, const float* pixels)
    : width_(width), height_(height), channels_(channels) {
  const int across = (width + kSide - 1) / kSide, down = (height + kSide - 1) / kSide;
  blocks_.reserve(std::size_t(across) * std::size_t(down) * words_of_block());
  std::vector<float> texels(std::size_t(kTexels * channels));
  for (int by = 0; by < down; ++by)
    for (int bx = 0; bx < across; ++bx) {
      for (int k = 0; k < kTexels; ++k) {  // texels beyond the border repeat it
        const int x = std::min(bx * kSide + k % kSide, width - 1);
        const int y = std::min(by * kSide + k / kSide, height - 1);
        std::copy_n(
            pixels + (std::size_t(y) * std::size_t(width) + std::size_t(x)) * std::size_t(channels),
            channels, &texels[std::size_t(k * channels)]);
      }
      for (int g = 0; g < groups(); ++g) pack_group(texels.data(), g);
    }
}

/// The line runs along a diagonal of the box around the texels: each channel rises or falls as it
/// does with the one that varies most.
void Packed::pack_group(const float* texels, int group) {
  const int first = first_of(group), count = count_of(group);
  const auto at = [&](int k, int c) {
    const float v = texels[k * channels_ + first + c];
    return std::isfinite(v) ? v : 0.0f;
  };
  std::array<float, 3> low{}, high{};
  std::array<double, 3> mean{};
  int widest = 0;
  for (int c = 0; c < count; ++c) {
    low[c] = high[c] = at(0, c);
    for (int k = 0; k < kTexels; ++k) {
      low[c] = std::min(low[c], at(k, c));
      high[c] = std::max(high[c], at(k, c));
      mean[c] += at(k, c) / double(kTexels);
    }
    if (high[c] - low[c] > high[widest] - low[widest]) widest = c;
  }
  std::array<float, 3> begin = low, end = high;
  for (int c = 0; c < count; ++c) {
    double covariance = 0;
    for (int k = 0; k < kTexels; ++k)
      covariance += (at(k, c) - mean[c]) * (at(k, widest) - mean[widest]);
    if (covariance < 0) std::swap(begin[c], end[c]);
  }
  double length = 0;
  std::array<double, 3> along{};
  for (int c = 0; c < count; ++c) {
    blocks_.push_back(half_bits(begin[c]));
    blocks_.push_back(half_bits(end[c]));
    begin[c] = half_value(blocks_[blocks_.size() - 2]);
    along[c] = double(half_value(blocks_.back())) - begin[c];
    length += along[c] * along[c];
  }
  for (int word = 0; word < kTexels / 4; ++word) {
    unsigned places = 0;
    for (int k = 0; k < 4; ++k) {
      double t = 0;
      for (int c = 0; c < count; ++c) t += (at(4 * word + k, c) - double(begin[c])) * along[c];
      t = length > 0 ? std::clamp(t / length, 0.0, 1.0) : 0;
      places |= unsigned(std::lround(t * (kSteps - 1))) << (4 * k);
    }
    blocks_.push_back(std::uint16_t(places));
  }
}

const std::uint16_t* Packed::unpack_group(const std::uint16_t* from, int group,
                                          float* texels) const {
  const int first = first_of(group), count = count_of(group);
  const std::uint16_t* const places = from + 2 * count;
  for (int c = 0; c < count; ++c) {
    const float begin = half_value(from[2 * c]), end = half_value(from[2 * c + 1]);
    std::array<float, kSteps> steps;
    for (int s = 0; s < kSteps; ++s)
      steps[s] = s == kSteps - 1 ? end : begin + (end - begin) * (float(s) / (kSteps - 1));
    for (int k = 0; k < kTexels; ++k)
      texels[k * channels_ + first + c] = steps[places[k / 4] >> (4 * (k % 4)) & 15];
  }
  return places + kTexels / 4;
}

void Packed::unpack(int x, int y, int columns, int rows, float* to) const {
  const int across = (width_ + kSide - 1) / kSide;
  const std::size_t words = words_of_block();
  std::vector<float> texels(std::size_t(kTexels * channels_));
  std::fill_n(to, std::size_t(columns) * std::size_t(rows) * std::size_t(channels_), 0.0f);
  for (int by = y; by < std::min(y + rows, height_); by += kSide)
    for (int bx = x; bx < std::min(x + columns, width_); bx += kSide) {
      const std::uint16_t* from =
          blocks_.data() +
          (std::size_t(by / kSide) * std::size_t(across) + std::size_t(bx / kSide)) * words;
      for (int g = 0; g < groups(); ++g) from = unpack_group(from, g, texels.data());
      for (int row = by; row < std::min({by + kSide, y + rows, height_}); ++row) {
        const int n = std::min({kSide, x + columns - bx, width_ - bx});
        std::copy_n(&texels[std::size_t((row - by) * kSide * channels_)], n * channels_,
                    to + (std::size_t(row - y) * std::size_t(columns) + std::size_t(bx - x)) *
                             std::size_t(channels_));
      }
    }
}

}  // namespace mms::renderer
