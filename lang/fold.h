// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Evaluates operations on constants with the machine's own kernels, in float and in double.

#include <optional>
#include <span>

#include "vm/program.h"

namespace mms::lang {

/// The constant that an arithmetic operation of the opcode table gives, or nothing where it is not
/// arithmetic on real, integer or logic values.
std::optional<vm::Constant> fold(vm::Op op, std::span<const vm::Constant> args);

/// The constant that a builtin with one result of type `result` gives.
vm::Constant fold_builtin(const vm::Builtin& row, vm::SlotType result,
                          std::span<const vm::Constant> args);

}  // namespace mms::lang
