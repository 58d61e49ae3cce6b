// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A picture at a point: its texels, each weighed by every probe of what the pixel covers. Written
/// once over R, float or double; texels are the same floats for both. Internal to the textures.

#include "renderer/texel_cache.h"
#include "renderer/texel_filter.h"

namespace mms::renderer {

/// Of three channels or fewer: the values, and their slopes by u and by v.
template <class R>
struct TexelSums {
  static constexpr int kChannels = 3;
  R value[kChannels] = {}, u[kChannels] = {}, v[kChannels] = {};
};

template <class R>
class TexelLookup {
 public:
  /// `first` of `channels` numbers of each texel. Slopes are left at 0 where they are not asked
  /// for.
  TexelLookup(TexelReader& reader, const TexelPyramid& pyramid, TexelFilter filter, TexelWrap wrap,
              int first, int channels, bool slopes)
      : reader_(reader),
        pyramid_(pyramid),
        filter_(filter),
        wrap_(wrap),
        first_(first),
        channels_(channels),
        slopes_(slopes && filter != TexelFilter::Nearest) {}

  /// At [u, v] with the pixel and the blurs that follow (vm::kImageArguments), all of them finite.
  /// False where the file turns out to be broken.
  bool run(const R* at, TexelSums<R>& sums) {
    const TexelLevelSize& full = pyramid_.level(0);
    const auto pixel = texel_footprint<R>(at + 2, at[6], at[7], full.columns, full.rows);
    smooth_ = filter_ == TexelFilter::Bicubic ? R(1) : pixel.smooth;
    int level = 0;
    while (level + 1 < pyramid_.levels() && R(pyramid_.scale(level + 1)) <= pixel.width) ++level;
    R coarser = 0;
    if (level + 1 < pyramid_.levels()) {
      const R here = R(pyramid_.scale(level)), next = R(pyramid_.scale(level + 1));
      coarser = (pixel.width - here) / (next - here);
    }
    return probe(at, pixel, level, 1 - coarser, sums) &&
           (coarser == 0 || probe(at, pixel, level + 1, coarser, sums));
  }

 private:
  /// Adds all probes into a level.
  bool probe(const R* at, const TexelFootprint<R>& pixel, int level, R weight, TexelSums<R>& sums) {
    const TexelLevelSize &full = pyramid_.level(0), &size = pyramid_.level(level);
    const R middle = filter_ == TexelFilter::Nearest ? R(0) : R(0.5);
    const auto x = texel_place(at[0], size.columns, middle, wrap_);
    const auto y = texel_place(at[1], size.rows, middle, wrap_);
    if (pixel.beside == 0) return add(level, x, y, weight, sums);
    const R dx = pixel.u * R(size.columns) / R(full.columns);
    const R dy = pixel.v * R(size.rows) / R(full.rows);
    R sum = 1;
    for (int k = 1; k <= pixel.beside; ++k) sum += 2 * pixel.weight(k);
    for (int k = -pixel.beside; k <= pixel.beside; ++k)
      if (!add(level, texel_place(x.whole, x.part + R(k) * dx),
               texel_place(y.whole, y.part + R(k) * dy), weight * pixel.weight(k) / sum, sums))
        return false;
    return true;
  }

  /// Adds what is seen at one place of a level.
  bool add(int level, TexelPlace<R> px, TexelPlace<R> py, R weight, TexelSums<R>& sums) {
    constexpr int kMost = TexelWeights<R>::kMost;
    const TexelLevelSize& size = pyramid_.level(level);
    const TexelWeights<R> x = texel_weights(filter_, smooth_, px);
    const TexelWeights<R> y = texel_weights(filter_, smooth_, py);
    int columns[kMost], rows[kMost];
    for (int i = 0; i < x.count; ++i) columns[i] = wrapped_texel(x.first + i, size.columns, wrap_);
    for (int j = 0; j < y.count; ++j) {  // v grows upwards, rows go down
      rows[j] = wrapped_texel(y.first + j, size.rows, wrap_);
      if (rows[j] >= 0) rows[j] = size.rows - 1 - rows[j];
    }
    float texels[kMost * kMost * TexelSums<R>::kChannels];
    if (!reader_.read(pyramid_, level, {columns, rows, x.count, y.count}, first_, channels_,
                      texels))
      return false;
    const int along = channels_, down = channels_ * x.count;
    for (int c = 0; c < channels_; ++c) {
      sums.value[c] += weight * values(texels + c, x, along, y, down);
      if (!slopes_) continue;
      sums.u[c] += weight * R(size.columns) * steps(texels + c, x, along, y, down);
      sums.v[c] += weight * R(size.rows) * steps(texels + c, y, down, x, along);
    }
    return true;
  }

  static R values(const float* t, const TexelWeights<R>& x, int along, const TexelWeights<R>& y,
                  int down) {
    R sum = 0;
    for (int j = 0; j < y.count; ++j) {
      R row = 0;
      for (int i = 0; i < x.count; ++i) row += x.value[std::size_t(i)] * R(t[j * down + i * along]);
      sum += y.value[std::size_t(j)] * row;
    }
    return sum;
  }

  /// The same of the differences along the first axis: what they sum to is never larger than they.
  static R steps(const float* t, const TexelWeights<R>& x, int along, const TexelWeights<R>& y,
                 int down) {
    R sum = 0;
    for (int j = 0; j < y.count; ++j) {
      R row = 0;
      for (int i = 0; i + 1 < x.count; ++i) {
        const float* const here = t + j * down + i * along;
        row += x.step[std::size_t(i)] * (R(here[along]) - R(*here));
      }
      sum += y.value[std::size_t(j)] * row;
    }
    return sum;
  }

  TexelReader& reader_;
  const TexelPyramid& pyramid_;
  TexelFilter filter_;
  TexelWrap wrap_;
  int first_, channels_;
  bool slopes_;
  R smooth_ = 1;
};

}  // namespace mms::renderer
