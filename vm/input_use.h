// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Which inputs the functions of lowered code read. Internal to vm.

#include "vm/call_graph.h"
#include "vm/lower.h"

namespace mms::vm {

/// Fills in `first_input`, `inputs` and `input_end` of every function.
void find_input_use(LoweredCode& code, const CallGraph& graph);

}  // namespace mms::vm
