// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Proves that a program can run safely: stack depth and types, operand ranges, nesting of If /
/// Else / End, locals stored before they are loaded, that every path ends in Return or TailCall,
/// signatures of entries and layouts. Trusts nothing of the emitter.

#include <optional>
#include <string>

#include "vm/program.h"

namespace mms::vm {

struct VerifyFault {
  std::string function;  ///< empty for faults outside code
  std::size_t instruction = 0;
  std::string what;
  bool limit = false;  ///< it is too large, which may be its script's fault
};

/// The first fault found, or nothing.
std::optional<VerifyFault> verify(const Program& program);

/// Bytecode as text, one instruction a line with its source line.
std::string disassemble(const Program& program);

}  // namespace mms::vm
