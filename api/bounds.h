// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Enclosures of a descriptor's outputs over a box, and what follows from them.

#include <span>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "vm/bounds.h"

namespace mms::api {

/// Sets the variable `name` of a box to [lo, hi], one pair for each component; one pair alone is
/// for all of them, and for all wavelengths. Errors: no such variable, another number of pairs,
/// ends in the wrong order or NaN.
Result<vm::Variable> set_box(vm::Box& box, std::string_view name, std::span<const double> lo,
                             std::span<const double> hi);

/// The enclosure of an output that is made of numbers: one interval for `height` and `bound`, two
/// for `gradient`, one for all wavelengths of a spectrum. Empty for materials.
struct OutputBounds {
  std::vector<vm::Interval> values;
  bool widened = false;  ///< a loop was cut short somewhere: wider than need be
};

/// `grid`: parts that the box is cut into along each component of `$position`,
/// `$object_position` and `$uv` that the output reads and the box leaves open, as long as there are
/// at most kMostParts of them in all; then fewer. The more, the tighter.
OutputBounds output_bounds(const vm::Program& program, const vm::Descriptor& d, vm::Output output,
                           const vm::Box& box, int grid = 1);
inline constexpr int kMostParts = 1 << 20;

/// No lobe or combiner of the descriptor's material weighs light by more than this, whatever the
/// direction: at most 1 proves that it creates no energy. Infinite where nothing is known. Over the
/// unit sphere's box.
double largest_weight(const vm::Program& program, const vm::Descriptor& d);

}  // namespace mms::api
