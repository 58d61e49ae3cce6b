// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// How much two pictures differ, by several measures. None is a substitute for looking.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "renderer/film.h"
#include "renderer/picture.h"

namespace mms::renderer {

/// 0 for equal pictures, and more the more they differ.
enum class Measure : std::uint8_t { Rmse, RmseShown, RelativeMse, Dssim };

struct MeasureInfo {
  Measure measure;
  std::string_view name;
  std::string_view doc;
};

/// Every measure, in the order of Measure.
std::span<const MeasureInfo> measures();

struct Comparison {
  std::array<double, 4> value{};    ///< by Measure
  std::array<double, 3> channel{};  ///< root mean square of each linear channel
  double largest = 0;               ///< of one linear channel of one pixel
  /// Where both pictures know their variance: root mean square of the difference of luminance over
  /// its standard error. 1 is what chance makes of two renders of one scene.
  std::optional<double> z;
  /// Pixels that are not finite in just one of the pictures, or differ so; left out of all else.
  std::uint64_t not_finite = 0;
  /// Difference of the shown pictures by luminance, for each pixel of the part compared.
  std::vector<float> map;

  double operator[](Measure m) const { return value[std::size_t(m)]; }
};

/// Compares pixels of `part` of `a` with those of `b`, the reference; pictures that are not
/// display values are shown by `view` first where a measure is of what is seen. Errors: other
/// sizes, a part that is outside, no such view.
Result<Comparison> compare(const ReadPicture& a, const ReadPicture& b, const View& view,
                           std::optional<Rect> part = {});

}  // namespace mms::renderer
