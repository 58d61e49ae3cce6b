// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The instructions of the form that runs (vm/lower.h).

#include <cstdint>
#include <string_view>

namespace mms::vm {

/// The instructions of the stack machine, of which the stack's own never occur, and a few more.
///
///  op          | dst        | a        | b           | c         | target
///  ------------|------------|----------|-------------|-----------|---------------------------
///  arithmetic  | result     | operands, in the order of the table |
///  Splat       | result     | a spectrum, or a real splatted      |
///  If          | then mask  | logic    | mask        | else mask | if no lane: into the other arm
///  Call        |            | mask     |             |           | call site
///  CallBuiltin |            |          |             |           | call site
///  TailCall    |            | mask     |             |           |
///  Return      |            |          |             |           | end of the function's code
///  Copy        | result     | block    |             |           |
///  SkipIfNone  |            | mask     |             |           | if no lane: where to go
///  FmsR        | a b - c, rounded once: FmaR of a NegR
///  FnmaR       | c - a b, rounded once: FmaR of a NegR
///  MadI        | a b + c, wraps: AddI of a MulI
///  FloorR      | floor a; AbsR, SqrtR alike: builtins without a call
///  ModByR      | ModR by b, whose reciprocal c is exact
///  F_G_k_c     | G, whose operand k is what F makes of the first operands (vm/pairs.def)
enum class LoweredOp : std::uint8_t {
#define OP(name, ...) name,
#include "vm/opcodes.def"
#undef OP
  Copy,
  SkipIfNone,
  FmsR,
  FnmaR,
  MadI,
  ModByR,
  FloorR,
  AbsR,
  SqrtR,
#define PAIR(first, second, position, constants) first##_##second##_##position##_##constants,
#include "vm/pairs.def"
#undef PAIR
};

/// As in the enumeration: `FmaR`, `MulR_FmaR_2`.
std::string_view name(LoweredOp op);

}  // namespace mms::vm
