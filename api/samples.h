// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Shading points to look at a script with: those of the test sphere, or of a box.

#include <array>
#include <optional>
#include <string>

#include "base/result.h"
#include "vm/interpreter.h"

namespace mms::api {

struct Samples {
  int count = 4096;
  /// Lower and upper corner, metres: points are spread over the box, `$position` and
  /// `$object_position` alike, all else as in fill_defaults. Without it: over the unit sphere, with
  /// the tangents and parameters it has there.
  std::optional<std::array<double, 6>> box;
};

/// `x0,y0,z0,x1,y1,z1` with each upper corner above the lower.
Result<std::array<double, 6>> parse_box(const std::string& text);

/// Points first .. first + lanes - 1 of `samples` in the first lanes of `in`: the same floats for
/// either machine, and the same in every run. \pre fill_defaults(in)
template <class R>
void fill_samples(vm::InputBatch<R>& in, const Samples& samples, int first, int lanes);

extern template void fill_samples(vm::InputBatch<float>&, const Samples&, int, int);
extern template void fill_samples(vm::InputBatch<double>&, const Samples&, int, int);

}  // namespace mms::api
