// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Passes over the linker's graph: each takes a function and returns a better one of the same
/// value, bit for bit. What runs at which level is one table.

#include "lang/ir.h"
#include "lang/link.h"

namespace mms::lang {

/// Memory of a list of nodes, handed from pass to pass: a result takes it, an argument leaves its
/// own.
using Room = std::vector<Node>;

struct Pass {
  PassInfo info;
  /// Null: done before, while the graph was made.
  IrFunction (*run)(const Module&, IrFunction, Room&);
};

/// The pipeline, in order.
std::span<const Pass> pipeline();

/// Runs the passes of the level over every function; the text of all of them after the pass that
/// is to be dumped. Builds with assertions or sanitizers check every function after every pass.
std::string optimise(Module& module, const LinkOptions& options);

}  // namespace mms::lang
