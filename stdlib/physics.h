// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// Spectra and Fresnel's equations for scripts: functions of reals, which the machine applies at
/// each wavelength of a spectrum. Formulas and tables are those of materials/{fresnel,spectra}.h;
/// they are written again here because those call libm and branch (tests compare the two). Both
/// bodies compute in double. Wavelengths in metres.

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
    const double e = (eta - 1) * (eta + 1), eta2 = eta * eta;
    const double g2 = fused(c, c, e), g = root(g2 > 0 ? g2 : 0.0);
    const double s = c + g, p = fused(eta2, c, g);
    const double rs = e / (s * s), rp = e * fused(eta2 + 1, c * c, -1.0) / (p * p);
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

inline constexpr double kD65[] = {
#include "materials/illuminant_d65.inc"
};
inline constexpr double kIlluminantA[] = {
#include "materials/illuminant_a.inc"
};
static_assert(sizeof kD65 == 107 * sizeof(double) && sizeof kIlluminantA == sizeof kD65);

/// A table over 300-830 nm, 5 nm apart, 100 at 560 nm, as 1 at 560 nm; its ends are held.
MMS_INLINE double relative_power(const double* table, double wavelength) {
  const double t0 = (wavelength * 1e9 - 300) * 0.2;
  const double t = t0 > 0 ? (t0 < 106 ? t0 : 106.0) : 0.0;
  const auto i0 = std::int32_t(t);
  const std::int32_t i = i0 < 105 ? i0 : 105;
  const double u = t - i;
  return (table[i] * (1 - u) + table[i + 1] * u) * 0.01;
}
/// Its slope, per metre; 0 where the ends are held.
MMS_INLINE double relative_power_slope(const double* table, double wavelength) {
  const double t = (wavelength * 1e9 - 300) * 0.2;
  const bool inside = (t >= 0) & (t < 106);
  const auto i = std::int32_t(inside ? t : 0.0);
  return inside ? (table[i + 1] - table[i]) * 0.01 * 0.2e9 : t != t ? t : 0.0;
}
template <class R>
struct IlluminantD65Slope {
  [[gnu::always_inline]] static R eval(R wavelength) {
    return R(relative_power_slope(kD65, wavelength));
  }
};
template <class R>
struct IlluminantASlope {
  [[gnu::always_inline]] static R eval(R wavelength) {
    return R(relative_power_slope(kIlluminantA, wavelength));
  }
};
template <class R>
struct IlluminantD65 {
  [[gnu::always_inline]] static R eval(R wavelength) { return R(relative_power(kD65, wavelength)); }
};
template <class R>
struct IlluminantA {
  [[gnu::always_inline]] static R eval(R wavelength) {
    return R(relative_power(kIlluminantA, wavelength));
  }
};

struct MetalRow {
  double lambda_nm, n, k;
};
#define MATERIAL(name, ...) inline constexpr MetalRow k_##name[] = {__VA_ARGS__};
#include "materials/conductors.inc"
#undef MATERIAL

/// The metals' tables are evenly spaced in photon energy (4.15 eV downwards, 0.05 eV apart), so
/// the row is found without a search; between rows they are linear in wavelength.
template <std::size_t N>
MMS_INLINE double metal_index(const MetalRow (&table)[N], double wavelength, bool imaginary) {
  constexpr std::int32_t last = std::int32_t(N) - 2;
  const double nm = wavelength * 1e9;
  const double t = (4.15 - 1239.8417 / nm) * 20;
  const auto i0 = std::int32_t(t > 0 ? (t < last ? t : double(last)) : 0.0);
  const MetalRow &a = table[i0], &b = table[i0 + 1];
  const double u0 = (nm - a.lambda_nm) / (b.lambda_nm - a.lambda_nm);
  const double u = u0 > 0 ? (u0 < 1 ? u0 : 1.0) : 0.0;
  return imaginary ? a.k + u * (b.k - a.k) : a.n + u * (b.n - a.n);
}
/// Its slope, per metre; 0 where the ends are held.
template <std::size_t N>
MMS_INLINE double metal_slope(const MetalRow (&table)[N], double wavelength, bool imaginary) {
  constexpr std::int32_t last = std::int32_t(N) - 2;
  const double nm = wavelength * 1e9;
  const double t = (4.15 - 1239.8417 / nm) * 20;
  const auto i = std::int32_t(t > 0 ? (t < last ? t : double(last)) : 0.0);
  const MetalRow &a = table[i], &b = table[i + 1];
  const double rise = imaginary ? b.k - a.k : b.n - a.n;
  const bool inside = (nm >= a.lambda_nm) & (nm < b.lambda_nm);
  return inside ? rise / (b.lambda_nm - a.lambda_nm) * 1e9 : nm != nm ? nm : 0.0;
}
#define MMS_METAL_PART(Name, function, table, imaginary) \
  template <class R>                                     \
  struct Name {                                          \
    [[gnu::always_inline]] static R eval(R wavelength) { \
      return R(function(table, wavelength, imaginary));  \
    }                                                    \
  };
#define MMS_METAL(Name, table)                            \
  MMS_METAL_PART(Name##N, metal_index, table, false)      \
  MMS_METAL_PART(Name##K, metal_index, table, true)       \
  MMS_METAL_PART(Name##NSlope, metal_slope, table, false) \
  MMS_METAL_PART(Name##KSlope, metal_slope, table, true)
MMS_METAL(Silver, k_silver)
MMS_METAL(Gold, k_gold)
MMS_METAL(Copper, k_copper)
MMS_METAL(Aluminium, k_aluminium)
#undef MMS_METAL
#undef MMS_METAL_PART

}  // namespace mms::stdlib::MMS_ISA
