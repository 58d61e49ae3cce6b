// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What a surface or a volume does in a white furnace: how much of the light along each direction
/// it gives back, whether it is reciprocal, and how well it is sampled. Pure; uses nothing but Bsdf
/// and Phase.

#include <vector>

#include "base/spectrum.h"
#include "materials/layout.h"

namespace mms::materials {

struct FurnaceRow {
  double degrees = 0;            ///< from the normal; above 90 inside
  Spectrum<double> albedo;       ///< reflected and transmitted, deltas too
  double standard_error = 0;     ///< of the first wavelength's, were the samples independent
  double relative_variance = 0;  ///< of a sample's weight at the first wavelength; 0 is ideal

  /// 1 - albedo where that is furthest from 0: positive is lost, negative gained.
  double lost() const;
  /// How many ideal samples one is worth, in (0, 1]: 1 / (1 + relative_variance).
  double efficiency() const { return 1 / (1 + relative_variance); }
};

struct FurnaceReport {
  std::vector<FurnaceRow> rows;  ///< of a phase function, the same everywhere, one
  /// Largest |f(a, b) - f(b, a)| over their larger, of 2000 pairs of directions; of pairs on two
  /// sides f(b, a) is that of importance.
  double reciprocity = 0;
};

/// `numbers` as layout.h states. `samples` for each direction and wavelength, the same every time.
FurnaceReport furnace(const Layout& layout, const std::vector<double>& numbers, int samples);

}  // namespace mms::materials
