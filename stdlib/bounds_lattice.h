// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Boxes over the cells of a lattice, for the enclosures of noise.

#include <algorithm>
#include <cmath>

#include "stdlib/bounds_math.h"
#include "vm/interval.h"

namespace mms::stdlib::bounds {

using vm::Interval;

/// Cells that are looked at one by one; a box over more of them gets the range.
inline constexpr double kMostCells = 64;

struct Range {
  double lo, hi;
};

inline bool finite(const Interval* in, int n) {
  for (int k = 0; k < n; ++k)
    if (in[k].contains_infinity()) return false;
  return true;
}

/// Calls `f(floors, offset ranges)` for each cell of the box; false where there are too many, or
/// beyond the lattice.
template <int N, class F>
bool each_cell(const Interval* in, F f) {
  double first[N], last[N], at[N];
  double cells = 1;
  for (int k = 0; k < N; ++k) {
    if (!(in[k].magnitude() < 0x1p30)) return false;
    at[k] = first[k] = std::floor(in[k].lo);
    last[k] = std::floor(in[k].hi);
    cells *= last[k] - first[k] + 1;
  }
  if (cells > kMostCells) return false;
  for (;;) {
    Range offset[N];
    for (int k = 0; k < N; ++k)
      offset[k] = {std::max(in[k].lo - at[k], 0.0), std::min(in[k].hi - at[k], 1.0)};
    f(at, offset);
    int k = 0;
    while (k < N && ++at[k] > last[k]) {
      at[k] = first[k];
      ++k;
    }
    if (k == N) return true;
  }
}

}  // namespace mms::stdlib::bounds
