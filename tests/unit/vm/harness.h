// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Runs a program on the machine and on the reference, and compares them lane by lane.

#include <doctest/doctest.h>

#include <optional>

#include "assembler.h"
#include "reference.h"

namespace mms::vm::test {

/// One value for each machine input of one point.
template <class T>
using Point = std::vector<Cell<T>>;

template <class T>
Point<T> zero_point() {
  return Point<T>(input_count());
}

/// Sets the inputs of one lane.
template <class T>
void put(InputBatch<T>& in, int lane, const Point<T>& point);

/// What one lane came to.
template <class T>
struct Outcome {
  std::vector<Cell<T>> results;
  std::optional<Fault> fault;  ///< its lane is not compared

  friend bool operator==(const Outcome& a, const Outcome& b) {
    if (a.results.size() != b.results.size() || a.fault.has_value() != b.fault.has_value())
      return false;
    if (a.fault && (a.fault->cause != b.fault->cause || a.fault->line != b.fault->line))
      return false;
    for (std::size_t k = 0; k < a.results.size(); ++k) {
      if (a.results[k].i != b.results[k].i) return false;
      for (int w = 0; w < kWavelengths; ++w)
        if (!same(a.results[k].r[w], b.results[k].r[w])) return false;
    }
    return true;
  }
};

/// Runs the points as one batch.
template <class T>
std::vector<Outcome<T>> run(Interpreter<T>& machine, const Executable& exe, const Program& p,
                            std::uint32_t function, const std::vector<Point<T>>& points);

template <class T>
Outcome<T> reference(const Program& p, std::uint32_t function, const Point<T>& point);

/// Checks a function against the reference at every point, for both builds of the machine.
template <class T>
void check_against_reference(const Program& p, std::uint32_t function,
                             const std::vector<Point<T>>& points);

}  // namespace mms::vm::test
