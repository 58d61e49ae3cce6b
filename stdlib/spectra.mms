// SPDX-License-Identifier: Apache-2.0
// Spectra: colours, black bodies, bands. Emission is in W m^-2 sr^-1 nm^-1.

/// The reflectance of linear red, green and blue in [0, 1] (thesis Table 6.1); equal parts give a grey exactly.
/// >>> rgb(0.5, 0.5, 0.5)
/// 0.5
spectrum rgb(real r, g, b) = b + (r - b) * $rgb_red + (g - b) * $rgb_green;

/// `rgb` of an array.
/// >>> rgb([0.2, 0.2, 0.2])
/// 0.2
spectrum rgb(real[3] c) = rgb(c[0], c[1], c[2]);

/// Radiance of a black body at a temperature in kelvin.
/// >>> blackbody(6000.0) / planck($wavelength, 6000.0)
/// 1
spectrum blackbody(real temperature) = planck($wavelength, temperature);

/// The colour of a black body: its radiance over that at its peak (Wien's law); 0 at and below 0 K.
/// >>> blackbody_normalised(0.0)
/// 0
spectrum blackbody_normalised(real temperature)
    peak = planck(2.897771955e-3 / max(temperature, 1.0), max(temperature, 1.0));
    return planck($wavelength, temperature) / peak;

/// A bell around `centre` of standard deviation `width`, 1 at the centre; both wavelengths in metres.
/// >>> gaussian_band(550nm, 1m)
/// 1
spectrum gaussian_band(real centre, width)
    d = ($wavelength - centre) / width;
    return exp(-0.5 * d * d);

/// f of each wavelength, in metres: any function of a real becomes a spectrum.
/// >>> spectral(function(l) -> 2 * l) / $wavelength
/// 2
spectrum spectral(function(real) -> real f) = intrinsic::spectral(f, $wavelength);

/// f of each value of a spectrum.
/// >>> spectral(#sqrt, rgb(0.25, 0.25, 0.25))
/// 0.5
spectrum spectral(function(real) -> real f, spectrum s) = intrinsic::spectral(f, s);

/// A triangle around `centre`, 1 at the centre and 0 from `width` away on; in metres.
/// >>> triangular_band(550nm, 1000m)
/// 1
spectrum triangular_band(real centre, width) = max(1.0 - abs($wavelength - centre) / width, 0.0);

/// A table of measured values: `values[k]` at the wavelength `wavelengths[k]`, in metres and growing;
/// straight between, level outside.
/// >>> tabulated([400nm, 700nm], [0.5, 0.5])
/// 0.5
spectrum tabulated(real[n] wavelengths, values) =
    spectral(function(l) -> ramp(l, wavelengths, values));
