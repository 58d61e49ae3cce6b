// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Everything about a path that depends on its wavelengths alone, looked up once.

#include <array>
#include <cstdint>

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

/// What is in a scene besides its lamps. Where all of it is grey, what a path carries is a sum of
/// lamps' spectra.
enum class Matter : std::uint8_t { Coloured, Grey };

/// The cluster drawn by `u` in [0, 1), of so many wavelengths that differ: a power of two. Where
/// they are fewer than lanes the lanes repeat them. Of grey matter `x`, `y` and `z` of all eight
/// are moved, as little as that takes, to where every `light` has its exact colour: no wavelength
/// that is drawn is seen.
Cluster sample_cluster(double u, int wavelengths = kWavelengths, Matter matter = Matter::Coloured);

/// Puts the digits of a number in [0, 1) into another order: the number that draws a cluster says
/// with its first binary digits which wavelength is the hero (three for eight of them), and with
/// the others where all lie. A stratified number has its strata in its first digits, and where
/// hardly anything depends on wavelength only the latter matter; so the two take turns, the latter
/// first.
double cluster_number(float u, int wavelengths = kWavelengths);

}  // namespace mms::renderer
