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
  bool lossless = false;  ///< its albedo is 1 from everywhere by theory

  /// All but fits to walks through fibres, and what has a normal of its own.
  bool reciprocal() const {
    return !name.starts_with("sheen") && !name.starts_with("layer") && !tilted();
  }
  bool tilted() const { return name.starts_with("tilt"); }
};

/// A different value at each wavelength, from `first` to `last`.
Spectrum<double> ramp(double first, double last);

std::vector<Case> smooth_cases();

/// The lossless ones of these, and those that need no statistical test of their own: what is swept
/// in colour there in white, and deltas. Not lossless by theory, in white either:
/// phong, max_phong, spot    what falls below the surface is lost
/// ward, ashikhmin_shirley   so is it, and the cosines do not cancel
/// oren_nayar                grooves keep some
/// phong_glass               what neither side has a direction for is lost
/// sheen                     what passes the fibres is for `layer`, which keeps all of radiance but
///                           not of importance, as the fit is not reciprocal (sheen_test.cpp)
std::vector<Case> lossless_cases();

/// Degrees from the normal, both sides; under sanitizers every other one.
inline constexpr auto kDegrees = [] {
  constexpr std::array all{0.0, 30.0, 60.0, 85.0, 89.99, 180.0, 140.0, 105.0, 93.0, 90.01};
  constexpr int step = kSanitized ? 2 : 1;
  std::array<double, all.size() / step> taken{};
  for (std::size_t i = 0; i < taken.size(); ++i) taken[i] = all[i * step];
  return taken;
}();

}  // namespace mms::test
