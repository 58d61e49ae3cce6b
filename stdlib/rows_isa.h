// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Every row of the library, those of this folder for the instruction set that the including source
/// is compiled for and named MMS_ISA after. Joined while compiling: a vector would bring weak
/// functions into a source compiled for AVX2.

#include <array>
#include <cstddef>

#include "materials/rows.h"
#include "stdlib/cells_rows.h"
#include "stdlib/complex_rows.h"
#include "stdlib/elementary_rows.h"
#include "stdlib/images_rows.h"
#include "stdlib/noise_rows.h"
#include "stdlib/physics_rows.h"
#include "stdlib/seeded_rows.h"
#include "stdlib/worley_rows.h"

namespace mms::stdlib::MMS_ISA {

template <std::size_t... N>
constexpr auto joined(const vm::Builtin (&... parts)[N]) {
  std::array<vm::Builtin, (N + ...)> all{};
  std::size_t n = 0;
  const auto append = [&](const vm::Builtin* part, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) all[n++] = part[i];
  };
  (append(parts, N), ...);
  return all;
}

inline constexpr auto kRows =
    joined(kElementaryRows, kComplexRows, kNoiseRows, kSeededRows, kCellsRows, kWorleyRows,
           kPhysicsRows, kImageRows, materials::kRows);

}  // namespace mms::stdlib::MMS_ISA
