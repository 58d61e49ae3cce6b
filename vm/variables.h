// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The table of `$variables`, and how their components are numbered as machine inputs.

#include <array>
#include <cstdint>
#include <string_view>

#include "vm/types.h"

namespace mms::vm {

enum class Variable : std::uint8_t {
#define VAR(id, ...) id,
#include "vm/variables.def"
#undef VAR
  Count
};

enum class Visibility : std::uint8_t { Public, Hidden };

struct VariableInfo {
  Variable variable;
  std::string_view name;  ///< without the `$`
  std::string_view type;  ///< in the language's own syntax
  Visibility visibility;
  std::string_view along_tangent, along_bitangent;  ///< names of rows; empty: no change
  std::string_view space, unit, doc;

  /// Components that are machine inputs of their own: 3 for `real[3]`, 1 for `spectrum`.
  constexpr int components() const {
    if (type == "real[3]") return 3;
    if (type == "real[2]") return 2;
    if (type == "real[2,2]") return 4;
    return 1;
  }
  constexpr SlotType slot_type() const {
    return type == "spectrum" ? SlotType::Spectrum : SlotType::Real;
  }
};

inline constexpr std::array kVariables = {
#define VAR(id, name, type, visibility, along_tangent, along_bitangent, space, unit, doc)        \
  VariableInfo{Variable::id, name, type, Visibility::visibility, along_tangent, along_bitangent, \
               space,        unit, doc},
#include "vm/variables.def"
#undef VAR
};

constexpr const VariableInfo& info(Variable v) { return kVariables[static_cast<std::size_t>(v)]; }

/// Number of machine inputs (each a block, or kWavelengths blocks if it is a spectrum).
constexpr int input_count() {
  int n = 0;
  for (const VariableInfo& v : kVariables) n += v.components();
  return n;
}

/// The machine input that holds component `c` of `v`.
constexpr int input_index(Variable v, int c = 0) {
  int n = c;
  for (const VariableInfo& row : kVariables) {
    if (row.variable == v) break;
    n += row.components();
  }
  return n;
}

/// The variable that machine input `index` belongs to.
constexpr Variable input_variable(int index) {
  for (const VariableInfo& row : kVariables) {
    if (index < row.components()) return row.variable;
    index -= row.components();
  }
  return Variable::Count;
}

constexpr SlotType input_type(int index) { return info(input_variable(index)).slot_type(); }

/// First block of input `index` where all inputs stand one after another.
constexpr int input_block(int index) {
  int n = 0;
  for (int i = 0; i < index; ++i) n += block_count(input_type(i));
  return n;
}

}  // namespace mms::vm
