// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Everything about a path that depends on its wavelengths alone, looked up once.

#include <array>

#include "base/spectrum.h"

namespace mms::renderer {

struct Cluster {
  Wavelengths lambda;
  Spectrumf red, green;  ///< basis curves of `rgb` (thesis Table 6.1); blue is what is left to 1
  Spectrumf daylight;    ///< illuminant D65, 1 at 560 nm; W m^-2 sr^-1 nm^-1 of a light of 1
  Spectrumf x, y, z;     ///< colour matching over the density of the wavelength; D65 has sum(y) = 1

  /// A reflectance from linear sRGB.
  Spectrumf reflectance(const std::array<double, 3>& rgb) const;
  /// A light from linear sRGB: the reflectance times daylight, so (1, 1, 1) looks white.
  Spectrumf light(const std::array<double, 3>& rgb) const { return reflectance(rgb) * daylight; }
  /// CIE XYZ of what the path carries: one estimate, Y = 1 is display white.
  std::array<double, 3> xyz(const Spectrumf& radiance) const;
};

/// The cluster drawn by `u` in [0, 1).
Cluster sample_cluster(double u);

}  // namespace mms::renderer
