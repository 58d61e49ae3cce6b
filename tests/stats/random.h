// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Numbers in [0, 1) for statistical tests: a fixed seed and a counter, so that a failure repeats.

#include <cstdint>

#include "base/hash.h"

namespace mms::stats {

class Random {
 public:
  explicit Random(std::uint64_t seed) : seed_(mix64(seed)) {}

  double next() { return to_unit(hash_combine(seed_, ++count_)); }
  /// Rounded down, so that it stays below 1 in float too.
  float next_float() { return float(hash_combine(seed_, ++count_) >> 40) * 0x1p-24f; }
  double between(double lo, double hi) { return lo + (hi - lo) * next(); }

 private:
  std::uint64_t seed_, count_ = 0;
};

}  // namespace mms::stats
