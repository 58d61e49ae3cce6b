// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// Spectra and Fresnel's equations for scripts: functions of reals, which the machine applies at
/// each wavelength of a spectrum. Formulas are those of materials/{fresnel,spectra}.h;
/// they are written again here because those call libm and branch (tests compare the two). Both
/// bodies compute in double. Wavelengths in metres.

#include "materials/optical_tables.h"
#include "stdlib/core.h"

namespace mms::stdlib::MMS_ISA {

/// Planck's law per nanometre, constants of the SI (2019): c1 = 2 h c^2 1e-9, c2 = h c / k.
template <class R>
struct Planck {
  [[gnu::always_inline]] static R eval(R wavelength, R temperature) {
    const double l = wavelength, t = temperature;
    const double x = 0.014387768775039338 / (l * t);
    const double front = 1.19104297239718841e-25 / (l * l * l * l * l);
    double r;
    if constexpr (kDouble<R>)
      r = front / __builtin_expm1(x);
    else
      r = x > 200 ? 0.0 : front / expm1_core(x);  // e^-200: below the least float
    return R((t <= 0) | (l <= 0) ? 0.0 : r);
  }
};

/// Reflectance of a dielectric for unpolarised light. With e = ior^2 - 1, g^2 = c^2 + e:
/// r_s = e / (c + g)^2, r_p = e ((ior^2 + 1) c^2 - 1) / (ior^2 c + g)^2, free of cancellation.
template <class R>
struct Fresnel {
  [[gnu::always_inline]] static R eval(R cos_theta, R ior) {
    const double a = magnitude(cos_theta), c = a > 1 ? 1.0 : a, eta = ior;
    const double e = (eta - 1) * (eta + 1), eta2 = eta * eta, s2 = (1 - c) * (1 + c);
    // Of three terms around 1 those that cancel come first.
    const double g2 = eta2 < 0.5 ? fused(eta, eta, -s2) : fused(c, c, e);
    const double g = root(g2 > 0 ? g2 : 0.0), s = c + g, p = fused(eta2, c, g);
    const double rs = e / (s * s), rp = e * fused(eta2 * c, c, -s2) / (p * p);
    const double r = 0.5 * (rs * rs + rp * rp);
    return R(e == 0 ? 0.0 : g2 <= 0 ? 1.0 : r > 1 ? 1.0 : r + (g2 - g2));
  }
};

/// Reflectance of a conductor of index n + i k as 1 - absorptance, the absorptance without
/// cancellation and with lengths scaled by the larger of n, k, 1 (materials/fresnel.h).
template <class R>
struct FresnelConductor {
  [[gnu::always_inline]] static R eval(R cos_theta, R n, R k) {
    const double a0 = magnitude(cos_theta), c = a0 > 1 ? 1.0 : a0;
    const double largest0 = n > k ? double(n) : double(k);
    const double scale = 1 / (largest0 > 1 ? largest0 : 1.0);
    const double nn = n * scale, kk = k * scale, cs = c * scale;
    const double s2 = (1 - c) * (1 + c) * scale * scale;
    const double t = (nn - kk) * (nn + kk) - s2, nk = nn * kk;
    const double q = root(t * t + 4 * nk * nk);
    const double big = root(0.5 * (q + magnitude(t)));
    const double a = t >= 0 ? big : big > 0 ? nk / big : 0.0;
    const double ac = a * cs;
    const double ds = q + cs * cs + 2 * ac, as = ds > 0 ? 4 * ac / ds : 0.0;
    const double modulus = nn * nn + kk * kk, p = ac * (q + s2);
    const double dp = c * c * modulus * modulus + 2 * p + scale * scale * q;
    const double ap = dp > 0 ? 4 * p / dp : 0.0;
    const double r = 1 - 0.5 * (as + ap);
    return R(r < 0 ? 0.0 : r);
  }
};

/// n^2 = 1 + sum b l^2 / (l^2 - c); 1 where that is not above 0.
template <class R>
struct Sellmeier {
  [[gnu::always_inline]] static R eval(R wavelength, R b1, R c1, R b2, R c2, R b3, R c3) {
    const double um = wavelength * 1e6, l2 = um * um;
    const double n2 = 1 + b1 * l2 / (l2 - c1) + b2 * l2 / (l2 - c2) + b3 * l2 / (l2 - c3);
    return R(n2 > 0 ? root(n2) : 1.0);
  }
};

template <class R>
struct Cauchy {
  [[gnu::always_inline]] static R eval(R wavelength, R a, R b) {
    const double um = wavelength * 1e6;
    return R(a + b / (um * um));
  }
};

/// The number of a table: a whole one, held at the ends.
MMS_INLINE std::int32_t table_number(double x) {
  constexpr double last = materials::kOpticalTables - 1;
  return std::int32_t(x > 0 ? (x < last ? x : last) : 0.0);
}
template <class R>
struct OpticalTable {
  [[gnu::always_inline]] static R eval(R wavelength, R table) {
    return R(materials::optical_tables[table_number(table)].at(double(wavelength) * 1e9));
  }
};
template <class R>
struct OpticalTableSlope {
  [[gnu::always_inline]] static R eval(R wavelength, R table) {
    const double nm = double(wavelength) * 1e9;
    const double slope = materials::optical_tables[table_number(table)].slope(nm);
    return R(nm != nm ? nm : slope * 1e9);
  }
};

}  // namespace mms::stdlib::MMS_ISA
