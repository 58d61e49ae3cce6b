// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The part of the verifier that looks at code: one function at a time. Internal to vm.

#include <optional>

#include "vm/verify.h"

namespace mms::vm {

/// Whether a value read from a file is one of the four types.
constexpr bool valid(SlotType t) { return static_cast<unsigned>(t) <= 3; }

/// Blocks of values of those types, if each is a type and together they fit a frame.
std::optional<std::size_t> blocks_of(const std::vector<SlotType>& types);

/// The first fault in the code of function `f`.
/// \pre The tables of `program` (constants, block types, signatures of functions and builtins) are
///      sound, the locals of `f` start with its parameters, and it has a line for each instruction.
std::optional<VerifyFault> verify_code(const Program& program, const Function& f);

}  // namespace mms::vm
