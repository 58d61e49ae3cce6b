// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Runs the bytecode of one point and keeps every value: for looking into a program, not for
/// speed. It computes with the kernels of the batch machine, so the bits are the same.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "vm/interpreter.h"
#include "vm/program.h"

namespace mms::vm {

/// Real and spectrum values as doubles (a float is one exactly), others as integers.
struct TracedValue {
  SlotType type = SlotType::Real;
  double real[kWavelengths] = {};
  std::int32_t integer = 0;
  /// Where a value that is infinite or NaN comes from: the step of `Trace::origins` that made one
  /// of finite ones. -1: it is finite, or an input or a constant that is not.
  int origin = -1;
};

/// A value, and the instruction that made it.
struct TraceStep {
  std::uint32_t function = 0, instruction = 0;
  SourceLine line;
  int depth = 0;  ///< open calls
  TracedValue value;
};

struct Trace {
  std::vector<TraceStep> steps;  ///< in the order of their making; the first `most` of them
  std::size_t step_count = 0;    ///< all of them
  std::vector<TraceStep> origins;
  std::vector<TracedValue> results;
  std::optional<Fault> fault;  ///< then there are no results
};

/// Runs function `function`, which has no parameters, at lane `lane` of `in`.
/// \pre `verify(program)` found no fault.
template <class R>
Trace trace(const Program& program, std::uint32_t function, InputBatch<R>& in, int lane,
            std::size_t most = 10000);

extern template Trace trace(const Program&, std::uint32_t, InputBatch<float>&, int, std::size_t);
extern template Trace trace(const Program&, std::uint32_t, InputBatch<double>&, int, std::size_t);

}  // namespace mms::vm
