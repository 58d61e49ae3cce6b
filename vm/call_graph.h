// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the calls between functions of a program say: which functions are recursive, and how many
/// calls one run of a function can make where nothing counts them at run time.

#include <cstdint>
#include <vector>

#include "vm/program.h"

namespace mms::vm {

struct CallGraph {
  /// Whether a function can reach itself through calls. Tail calls are loops, not recursion.
  std::vector<bool> recursive;
  /// For each function, calls of one run of its body with everything below it, calls inside a
  /// cycle left out (the machine counts those); saturates at the largest value.
  std::vector<std::uint64_t> expansion;
  /// All functions, what a function calls before it; those that reach one another side by side.
  std::vector<std::uint32_t> order;
  /// For each function, the one that stands for all that reach it and are reached by it.
  std::vector<std::uint32_t> cycle;
};

/// \pre Every Call of `program` names a function of it.
CallGraph call_graph(const Program& program);

}  // namespace mms::vm
