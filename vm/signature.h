// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What a builtin row's signature says to the machine: which slots go in and come out. The
/// language's own parser reads signatures too, for their meaning; this is the machine's word
/// against the linker's, and what files call a row by.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vm/types.h"

namespace mms::vm {

struct Signature {
  /// Result, name and types of the formals: `real[2] worley_pair(real[3])`. Names of formals and
  /// defaults are left out: they may change and the row is still the same.
  std::string key;
  std::vector<SlotType> params;   ///< flattened, materials left out
  std::vector<SlotType> results;  ///< flattened; none for a material
  int materials = 0;              ///< formals that are materials
};

/// Reads `real[3] f(real a, b, spectrum c = 1)`: a type holds for the names after it up to the
/// next type. Nothing if that is not its form, or a type has no slots (a string, a function).
std::optional<Signature> read_signature(std::string_view text);

}  // namespace mms::vm
