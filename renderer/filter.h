// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// How far a sample of the film reaches: products of one curve along x and y, as whole numbers, so
/// that sums of weights have the same bits in any order.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace mms::renderer {

enum class FilterShape : std::uint8_t { Box, Gaussian, BlackmanHarris };

struct FilterInfo {
  FilterShape shape;
  std::string_view name;
  double radius;  ///< pixels
  std::string_view doc;
};

/// Every filter there is, in the order of FilterShape.
std::span<const FilterInfo> filters();
std::optional<FilterShape> filter_named(std::string_view name);

/// Never negative, 1 at most, and 0 beyond the radius.
class Filter {
 public:
  /// Weights are whole multiples of 2^-12 along one axis, so of 2^-24 in the plane.
  static constexpr int kBits = 12;

  explicit Filter(FilterShape shape);

  double radius() const { return radius_; }
  /// At `distance` pixels along one axis, in units of 2^-12; at least 1 within the radius.
  std::int32_t weight(double distance) const {
    const int i = int(distance * scale_);
    return table_[i < kEntries ? i : kEntries - 1];
  }
  /// Mean weight per sample of a pixel that is far from the edges: the integral over the plane.
  double integral() const { return integral_; }
  /// How many samples a pixel makes of each that falls into it: (integral of f)^2 over the
  /// integral of f^2. 1 for the box; more where neighbours share samples.
  double sharing() const { return sharing_; }

 private:
  static constexpr int kEntries = 512;  // steps of 0.003 pixels: below 1 % of a weight
  std::array<std::int32_t, kEntries> table_;
  double radius_, scale_, integral_, sharing_;
};

/// Made once.
const Filter& filter_of(FilterShape shape);

}  // namespace mms::renderer
