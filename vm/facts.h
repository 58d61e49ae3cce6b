// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What a verified program says of itself before it runs: how often each output must be computed,
/// and bounds of what its code takes.

#include <cstdint>
#include <vector>

#include "vm/program.h"

namespace mms::vm {

/// How often a value changes. Params are folded at link, so they are constants.
enum class Rate : std::uint8_t {
  Constant,  ///< reads no variable: the same everywhere
  Uniform,   ///< reads only variables that are the same for a whole frame: `$time`
  Varying    ///< anything else; `$wavelength` belongs to the path, so what reads it varies
};
Rate rate(const OutputInfo& output);

/// Whether an output is the same for either direction of a path: it reads none of `$view`,
/// `$distance` and `$footprint`, which belong to the ray that came. The scattering models
/// themselves are reciprocal.
bool reciprocal(const OutputInfo& output);
/// Whether light is scattered alike in both directions: all of bsdf or phase, scattering,
/// absorption, height and gradient are reciprocal.
bool reciprocal(const Descriptor& descriptor);

/// Bounds for one run of a function, everything it calls included. Where the depth of a recursion
/// is decided at run time, the machine's own limit (vm/limits.h) is the bound, and `limited` says
/// that a lane may be given up there.
struct CodeFacts {
  std::uint64_t instructions = 0;  ///< of the function and of all that it reaches, each once
  /// Units of one real addition over a batch: both arms of each choice, each loop once and each
  /// recursion one level deep.
  std::uint64_t cost = 0;
  std::uint64_t calls = 0;         ///< most calls open at a time below its own; tail calls are none
  std::uint64_t back_edges = 0;    ///< most tail calls and recursive calls of a lane; 0: no loop
  std::uint64_t stack_blocks = 0;  ///< blocks of the frames of all open calls; a block is one
                                   ///< number for each lane
  bool loops = false;              ///< it, or what it reaches, has a tail call
  bool recursive = false;          ///< it, or what it reaches, calls itself otherwise
  bool limited() const { return loops || recursive; }
};

/// One for each function. \pre `verify(program)` found no fault.
std::vector<CodeFacts> code_facts(const Program& program);

}  // namespace mms::vm
