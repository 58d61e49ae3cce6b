// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What rounding does to a script: every output in float against the same in double, over sample
/// points, and what either costs.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "api/samples.h"
#include "vm/program.h"

namespace mms::api {

/// The error of one output: of all its numbers, a material's parameters among them.
struct OutputAccuracy {
  std::string descriptor;  ///< `surface marble`
  std::string output;      ///< `bsdf`
  std::uint64_t compared = 0;
  /// Units in the last place of a float at the double's value, and as they are.
  double worst_ulp = 0, median_ulp = 0, worst_absolute = 0, median_absolute = 0;
  /// Of the worst in ulp: `$object_position` there, and both values.
  std::array<double, 3> point{};
  double float_value = 0, double_value = 0;
  /// Numbers that are NaN or infinite in float alone, and in either; and where the first of them
  /// was made (`file:line:column`).
  std::uint64_t lost = 0, not_finite = 0;
  std::string made_at;
};

/// Points per second of one thread.
struct EntrySpeed {
  std::string descriptor, entry;
  double float_points = 0, double_points = 0;
};

struct Accuracy {
  std::vector<OutputAccuracy> outputs;  ///< those that are not constant
  std::vector<EntrySpeed> speeds;
  std::uint64_t given_up = 0;  ///< points that ran out of their budget in either machine
};

/// \pre `verify(program)` found no fault.
Accuracy accuracy(const vm::Program& program, const Samples& samples);

/// `file:line:column` as messages write it; without the column where it is 0.
std::string place(const vm::Program& program, vm::SourceLine line);

}  // namespace mms::api
