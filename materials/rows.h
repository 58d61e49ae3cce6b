// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The rows of lobes.def as data, for tables that are joined while compiling.

#include "materials/table.h"

namespace mms::materials {

inline constexpr vm::Builtin kRows[] = {
#define LOBE(name, prototype, traits, documentation, expression) \
  {.signature = prototype,                                       \
   .module = "materials",                                        \
   .doc = documentation,                                         \
   .example = expression,                                        \
   .derivative = {},                                             \
   .cost = 0,                                                    \
   .lobe = static_cast<int>(Lobe::name)},
#include "materials/lobes.def"
#undef LOBE
};
static_assert(std::size(kRows) == kLobeCount);

}  // namespace mms::materials
