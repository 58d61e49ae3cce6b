// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// How many nodes a material has at most, and what is kept of each. Apart from materials/layout.h,
/// which names every row of the table, so that a new row leaves the tables of the build as they
/// are.

#include <array>

namespace mms::materials {

/// Trees are limited to this many nodes (ARCHITECTURE.md: at most 64 lobes).
inline constexpr int kMaxNodes = 64;

/// One entry for each node of a layout; entries beyond it are not initialised.
template <class T>
union PerNode {
  PerNode() {}
  std::array<T, kMaxNodes> of;
};

}  // namespace mms::materials
