// SPDX-License-Identifier: Apache-2.0
#include "renderer/filter.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace mms::renderer {
namespace {

constexpr FilterInfo kFilters[] = {
    {FilterShape::Box, "box", 0.5, "the mean over the pixel; neighbours share no samples"},
    {FilterShape::Gaussian, "gaussian", 1.5, "standard deviation 0.5 pixels, cut off at 1.5"},
    {FilterShape::BlackmanHarris, "blackman-harris", 1.5, "4 terms, 3 pixels wide"},
};

/// The curve at t = distance / radius in [0, 1].
double curve(FilterShape shape, double t, double radius) {
  switch (shape) {
    case FilterShape::Gaussian: {
      // Less its value at the end, so that there is no step.
      constexpr double kDeviation = 0.5;
      const auto bell = [](double x) { return std::exp(-x * x / (2 * kDeviation * kDeviation)); };
      const double end = bell(radius);
      return (bell(t * radius) - end) / (1 - end);
    }
    case FilterShape::BlackmanHarris: {
      // Harris 1978, "On the use of windows for harmonic analysis", minimum 4-term window.
      const double a = std::numbers::pi * t;
      return 0.35875 + 0.48829 * std::cos(a) + 0.14128 * std::cos(2 * a) +
             0.01168 * std::cos(3 * a);
    }
    case FilterShape::Box:
      break;
  }
  return 1;
}

}  // namespace

std::span<const FilterInfo> filters() { return kFilters; }

std::optional<FilterShape> filter_named(std::string_view name) {
  for (const FilterInfo& f : kFilters)
    if (f.name == name) return f.shape;
  return {};
}

Filter::Filter(FilterShape shape) : radius_(kFilters[int(shape)].radius) {
  scale_ = kEntries / radius_;
  double sum = 0, squares = 0;
  for (int i = 0; i < kEntries; ++i) {
    const double f = curve(shape, (i + 0.5) / kEntries, radius_);
    table_[i] = std::int32_t(std::max(1L, std::lround(f * (1 << kBits))));
    const double kept = double(table_[i]) / (1 << kBits);
    sum += kept;
    squares += kept * kept;
  }
  const double along = 2 * radius_ * sum / kEntries, along2 = 2 * radius_ * squares / kEntries;
  integral_ = along * along;
  sharing_ = integral_ * integral_ / (along2 * along2);
}

const Filter& filter_of(FilterShape shape) {
  static const Filter all[] = {Filter(FilterShape::Box), Filter(FilterShape::Gaussian),
                               Filter(FilterShape::BlackmanHarris)};
  return all[std::size_t(shape)];
}

}  // namespace mms::renderer
