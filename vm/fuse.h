// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Pairs of lowered instructions as one: what the first makes never goes through memory, and one
/// dispatch does for two. Only pairs of the table vm/pairs.def, which bench/mine_pairs.cpp makes.

#include <cstdint>
#include <functional>
#include <optional>

#include "vm/lower.h"

namespace mms::vm {

/// An operation whose result is operand `position` of another, and of nothing else. Their other
/// operands, the first's first, are blocks of lanes, or constants where bit k is set.
struct Pair {
  LoweredOp first, second;
  int position;
  unsigned constants;
  friend bool operator==(const Pair&, const Pair&) = default;
};

/// The instruction that is the pair, or nothing if it stays two.
using PairOf = std::function<std::optional<LoweredOp>(const Pair&)>;

/// Blocks that the instruction reads: operands of kernels and of their pairs; 1 for what is none.
int operand_count(LoweredOp op);

/// In units of one real addition, calls apart.
int cost_of(LoweredOp op);

/// Fuses the instructions from `begin` to the end of the code, which are one function's.
void fuse(LoweredCode& code, std::uint32_t begin, const PairOf& pair_of);

/// `lower` with other pairs than the table's.
LoweredCode lower(const Program& program, const PairOf& pair_of);

/// Whether the first two operands may change places: no bit of the result depends on it.
bool commutes(LoweredOp op);

/// What vm/pairs.def has.
std::optional<LoweredOp> tabled_pair(const Pair& pair);

}  // namespace mms::vm
