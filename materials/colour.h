// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// From spectra to displayed colour: the CIE 1931 observer, XYZ, linear sRGB, the thesis' luminance
/// and gamut mapping (section 6.1.3), and the sRGB transfer. Double throughout: it runs once a
/// pixel. Every function is pure.

#include "base/spectrum.h"
#include "base/vec.h"

namespace mms::materials {

/// CIE 1931 2-degree colour matching functions at `lambda_nm`, linear between the 1 nm rows of
/// CIE 15; 0 outside 360-830 nm.
Vec3d cie1931(double lambda_nm);

/// Integral of each matching function over 360-830 nm, in nm (about 106.9 each).
Vec3d cie1931_integral();

/// The share of one sample in XYZ: `value` at `lambda_nm`, drawn with density `pdf` per nm. The
/// mean over samples of a spectrum that is 1 everywhere has Y = 1. Black where pdf is 0.
Vec3d xyz_of_sample(double lambda_nm, double value, double pdf);

/// Mean of the shares of a cluster.
Vec3d xyz_of_cluster(const Wavelengths& w, const Spectrumf& value);

/// XYZ of the whole spectrum `f(lambda_nm)`, summed over the 1 nm rows; Y of the unit spectrum
/// is 1.
template <class F>
Vec3d xyz_of_spectrum(F f) {
  Vec3d sum;
  for (int nm = int(kLambdaMin); nm <= int(kLambdaMax); ++nm) sum += cie1931(nm) * f(double(nm));
  return sum / cie1931_integral().y;
}

/// Linear sRGB (IEC 61966-2-1; D65 white) of XYZ with white at Y = 1; may leave [0, 1].
Vec3d linear_srgb_of_xyz(Vec3d xyz);
Vec3d xyz_of_linear_srgb(Vec3d rgb);

/// Mapped luminance 1 - 2^(-(sensitivity y)^contrast): [0, inf] to [0, 1], increasing. Both
/// parameters are positive. 0 for negative luminance and for what is not a number.
double map_luminance(double y, double sensitivity, double contrast);

/// Thesis Algorithm 6.1: the colour in [0, 1]^3 whose luminance is exactly `xyz.y`, in [0, 1], and
/// whose order of channels is that of `xyz`: what does not fit fades to white.
Vec3d desaturate_to_srgb(Vec3d xyz);

/// Both: finite, in [0, 1]^3, luminance increasing with that of `xyz`; black for what is not finite
/// in chromaticity, white for infinite luminance.
Vec3d tone_map(Vec3d xyz, double sensitivity, double contrast);

/// The sRGB transfer function of one channel and its inverse, on [0, 1].
double srgb_encode(double linear);
double srgb_decode(double encoded);

}  // namespace mms::materials
