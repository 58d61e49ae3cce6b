// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The materials and directions that the statistical tests sweep.

#include <array>
#include <string>
#include <vector>

#include "tests/sanitized.h"
#include "tests/unit/materials/make.h"

namespace mms::test {

struct Case {
  std::string name;
  Material material;
  double lossless = 0;  ///< 1 for models whose albedo is exactly 1 by theory

  /// All but fits to walks through fibres.
  bool reciprocal() const { return !name.starts_with("sheen") && !name.starts_with("layer"); }
};

/// A different value at each wavelength, from `first` to `last`.
Spectrum<double> ramp(double first, double last);

std::vector<Case> smooth_cases();

/// Degrees from the normal, both sides; under sanitizers every other one.
inline constexpr auto kDegrees = [] {
  constexpr std::array all{0.0, 30.0, 60.0, 85.0, 89.99, 180.0, 140.0, 105.0, 93.0, 90.01};
  constexpr int step = kSanitized ? 2 : 1;
  std::array<double, all.size() / step> taken{};
  for (std::size_t i = 0; i < taken.size(); ++i) taken[i] = all[i * step];
  return taken;
}();

}  // namespace mms::test
