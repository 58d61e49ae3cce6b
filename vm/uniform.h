// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Which builtin calls give the same in all lanes of a batch. Internal to vm.

#include "vm/lower.h"
#include "vm/variables.h"

namespace mms::vm {

/// The same for a whole frame, so for a batch wherever the caller keeps to that.
constexpr Variable kUniformVariable = Variable::Time;

/// Marks every CallSite of a builtin whose operands depend on nothing but constants and
/// `kUniformVariable`: the machine runs it for a few lanes and hands the result to all.
void find_uniform_sites(LoweredCode& code);

}  // namespace mms::vm
