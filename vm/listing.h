// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Lowered code as text, beside the source it came from.

#include <functional>
#include <string>

#include "vm/lower.h"

namespace mms::vm {

/// What one lowered instruction costs over a batch, in units of one real addition: that of its
/// opcode; of a builtin, the row's.
int cost_of(const Program& program, const LoweredCode& code, std::uint32_t instruction);

/// Each function's instructions with their cost; before those of another source line, the line's
/// place and what `text_of` says of it.
/// \pre `code` is `lower(program)`.
std::string disassemble(const Program& program, const LoweredCode& code,
                        const std::function<std::string(SourceLine)>& text_of);

}  // namespace mms::vm
