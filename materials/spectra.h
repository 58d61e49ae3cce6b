// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Spectra by formula: black bodies, the thesis' RGB basis, refractive indices; and the illuminants
/// that the renderer itself needs, of optical_tables.h.
/// Every function is pure. The templates are shared with the script library.

#include <cmath>

namespace mms::materials {

/// Planck's spectral radiance at `lambda_nm` (> 0) and `kelvin`, in W m^-2 sr^-1 nm^-1, with the
/// exact SI constants: 2 h c^2 = 1.19104297239719e-16 W m^2, h c / k = 1.43877687750393e-2 m K.
/// 0 at and below 0 K. Where exp(x) would overflow float, it is taken in the log domain.
template <class R>
inline R planck(R lambda_nm, R kelvin) {
  if (!(kelvin > 0) || !(lambda_nm > 0)) return 0;
  const R x = R(1.438776877503934e7) / lambda_nm / kelvin;
  const R log_front = R(46.2265312305412) - 5 * std::log(lambda_nm);  // ln(1.19104297239719e20)
  if (x > 40) return std::exp(log_front - x);  // exp(-40) is below the last digit of 1 in double
  const R l2 = lambda_nm * lambda_nm;
  return R(1.19104297239719e20) / (l2 * l2 * lambda_nm) / std::expm1(x);
}

/// Thesis Table 6.1: the share of R and of G in the spectrum of a reflectance (R, G, B); that of B
/// is 1 - (r + g), so (c, c, c) is exactly c.
template <class R>
inline R smooth_step(R a, R b, R x) {
  const R t = (x - a) / (b - a);
  const R u = t < 0 ? R(0) : t > 1 ? R(1) : t;
  return u * u * (3 - 2 * u);
}
template <class R>
inline R rgb_red(R lambda_nm) {
  if (lambda_nm < R(447.29)) return R(0.165) * (1 - smooth_step(R(404.50), R(447.29), lambda_nm));
  return smooth_step(R(574.34), R(603.73), lambda_nm);
}
template <class R>
inline R rgb_green(R lambda_nm) {
  if (lambda_nm < R(494.75)) return smooth_step(R(468.22), R(494.75), lambda_nm);
  return 1 - smooth_step(R(573.99), R(601.77), lambda_nm);
}

/// Sellmeier's index: n^2 = 1 + sum b_i l^2 / (l^2 - c_i), l in micrometres, c in um^2. 1 where
/// that is not above 0.
template <class R>
inline R sellmeier(R lambda_nm, const R (&b)[3], const R (&c)[3]) {
  const R um = lambda_nm / 1000, l2 = um * um;
  const R n2 = 1 + b[0] * l2 / (l2 - c[0]) + b[1] * l2 / (l2 - c[1]) + b[2] * l2 / (l2 - c[2]);
  return n2 > 0 ? std::sqrt(n2) : R(1);
}

/// Cauchy's index: a + b / l^2 + c / l^4, l in micrometres.
template <class R>
inline R cauchy(R lambda_nm, R a, R b, R c = R(0)) {
  const R um = lambda_nm / 1000, i = 1 / (um * um);
  return a + i * (b + i * c);
}

/// CIE standard illuminants, relative power: 1 at 560 nm. Table over 300-830 nm, 5 nm steps.
double illuminant_d65(double lambda_nm);
double illuminant_a(double lambda_nm);

/// Luminance (Y of xyz_of_spectrum) of illuminant_d65: divide by it for a light of luminance 1.
double illuminant_d65_luminance();

}  // namespace mms::materials
