// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Fresnel's equations for unpolarised light, in forms without cancellation, over any real type.
/// The scattering models and the script library use these same functions. Every function is pure.

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace mms::materials {

/// Reflected and transmitted fractions of the incident power; each is computed directly.
template <class R>
struct FresnelSplit {
  R reflected, transmitted;
};

/// g^2 = eta^2 - sin^2 at the cosine of incidence `c`: negative or 0 in total reflection. Of its
/// two forms, c^2 + (eta^2 - 1) and eta^2 - (1 - c)(1 + c), the one that subtracts less. `e` is
/// eta^2 - 1, of which a rounded eta next to 1 says little.
///
/// This and what is always inlined below only select: loops over it are computed side by side.
template <class R>
[[gnu::always_inline]] inline R refraction_g2(R c, R eta, R e) {
  const bool steep = c > R(0.7);
  const R root = steep ? eta : c;
  return fused(root, root, steep ? -(1 - c) * (1 + c) : e);
}
template <class R>
[[gnu::always_inline]] inline R refraction_g2(R c, R eta) {
  return refraction_g2(c, eta, (eta - 1) * (eta + 1));
}

/// Dielectric of relative index `eta` (far side over near side, > 0) at the cosine of incidence
/// `c` in [0, 1]. With e = eta^2 - 1, g^2 = c^2 + e: r_s = -e / (c + g)^2,
/// r_p = e ((eta^2 + 1) c^2 - 1) / (eta^2 c + g)^2; total reflection where g^2 <= 0. At eta = 1
/// nothing is reflected, not even at c = 0.
template <class R>
[[gnu::always_inline]] inline FresnelSplit<R> fresnel_split(R c, R eta, R e) {
  const R eta2 = eta * eta;
  const R g2 = refraction_g2(c, eta, e), g = std::sqrt(g2 > 0 ? g2 : R(0));
  const R ds = c + g, dp = fused(eta2, c, g);
  const R is = 1 / (ds * ds), ip = 1 / (dp * dp);
  const bool steep = c > R(0.7);
  const R tilt = fused(steep ? eta2 : eta2 + 1, c * c, steep ? -(1 - c) * (1 + c) : R(-1));
  const R rs = e * is, rp = e * tilt * ip;
  const R up = (rs * rs + rp * rp) / 2, down = 2 * c * g * (is + eta2 * ip);
  const R reflected = g2 > 0 ? up < 1 ? up : R(1) : R(1);
  const R transmitted = g2 > 0 ? down < 1 ? down : R(1) : R(0);
  return {e == 0 ? R(0) : reflected, e == 0 ? R(1) : transmitted};
}
template <class R>
[[gnu::always_inline]] inline FresnelSplit<R> fresnel_split(R c, R eta) {
  return fresnel_split(c, eta, (eta - 1) * (eta + 1));
}

/// Reflectance of a dielectric, as above.
template <class R>
[[gnu::always_inline]] inline R fresnel_dielectric(R c, R eta) {
  return fresnel_split(c, eta).reflected;
}

/// sqrt(x^2 + y^2) where squares may overflow or vanish; unlike std::hypot no call.
template <class R>
inline R hypotenuse(R x, R y) {
  const R a = std::abs(x), b = std::abs(y), large = a > b ? a : b, small = a > b ? b : a;
  const R quotient = large > 0 ? small / large : R(0);
  return large * std::sqrt(1 + quotient * quotient);
}

/// 1 - reflectance of a conductor of index n + i k (relative to the near side; n, k >= 0) at the
/// cosine of incidence `c` in [0, 1]. Lengths are scaled by max(n, k, 1), so k may be 1e25 in
/// float. With s^2 = 1 - c^2, a + i b = sqrt((n + i k)^2 - s^2), q = a^2 + b^2:
/// A_s = 4 a c / (q + c^2 + 2 a c),
/// A_p = 4 a c (q + s^2) / (c^2 (n^2 + k^2)^2 + 2 a c (q + s^2) + q).
template <class R>
[[gnu::always_inline]] inline R fresnel_conductor_absorptance(R c, R n, R k) {
  const R large = n > k ? n : k, scale = 1 / (large > 1 ? large : R(1));
  const R nn = n * scale, kk = k * scale, cs = c * scale;
  const R s2 = (1 - c) * (1 + c) * scale * scale;
  const R t = ((n - 1) * scale) * ((n + 1) * scale) - kk * kk + cs * cs;  // Re(eps) - s^2
  const R q = hypotenuse(t, 2 * nn * kk);
  const R big = std::sqrt((q + std::abs(t)) / 2);
  const R other = big > 0 ? nn * kk / big : R(0);
  const R ac = (t >= 0 ? big : other) * cs;
  const R ds = q + cs * cs + 2 * ac;
  const R as = ds > 0 ? 4 * ac / ds : R(0);
  const R modulus = nn * nn + kk * kk, p = ac * (q + s2);
  const R dp = c * c * modulus * modulus + 2 * p + scale * scale * q;
  const R ap = dp > 0 ? 4 * p / dp : R(0);
  const R both = (as + ap) / 2;
  return both < 1 ? both : R(1);
}

/// Small reflectances of a conductor (index near 1; n and k at most 100), as above, directly:
/// R_s = |eps - 1|^2 / D_s^2, R_p = |eps - 1|^2 |(eps + 1) c^2 - 1|^2 / D_p^2, eps = (n + i k)^2,
/// with the denominators of A_s and A_p.
template <class R>
[[gnu::always_inline]] inline R fresnel_conductor_direct(R c, R n, R k) {
  const R s2 = (1 - c) * (1 + c), t = (n - 1) * (n + 1) - k * k + c * c;
  const R q = hypotenuse(t, 2 * n * k);
  const R big = std::sqrt((q + std::abs(t)) / 2);
  const R other = big > 0 ? n * k / big : R(0), a = t >= 0 ? big : other;
  const R ac = a * c, modulus = n * n + k * k;
  const R ds = q + c * c + 2 * ac;
  const R dp = c * c * modulus * modulus + 2 * ac * (q + s2) + q;
  const R re = (n - 1) * (n + 1) - k * k, im = 2 * n * k;
  const R step = hypotenuse(re, im);  // |eps - 1|
  const R tilt = hypotenuse((re + 2) * c * c - 1, im * c * c);
  const R rs = ds > 0 ? step / ds : R(1), rp = dp > 0 ? step * tilt / dp : R(1);
  const R both = (rs * rs + rp * rp) / 2;
  return both < 1 ? both : R(1);
}

/// Whether that is better than 1 - absorptance.
template <class R>
inline bool reflects_little(R absorptance, R n, R k) {
  return absorptance >= R(0.5) && std::max(n, k) <= R(100);
}

/// Reflectance of a conductor, as above.
template <class R>
inline R fresnel_conductor(R c, R n, R k) {
  const R absorptance = fresnel_conductor_absorptance(c, n, k);
  return reflects_little(absorptance, n, k) ? fresnel_conductor_direct(c, n, k) : 1 - absorptance;
}

/// Reflectance of a dielectric of relative index `eta` for diffuse (Lambertian) light,
/// 2 int_0^1 F(c) c dc, in closed form (Duntley 1942; Egan and Hilgeman 1973); `eta` > 0.
/// Computed in double whatever R is: the terms cancel as 1/(eta-1)^2 near 1.
template <class R>
inline R fresnel_dielectric_diffuse(R eta) {
  const double x = double(eta);
  const double n = x < 1 ? 1 / x : x;
  if (n < 1 + 1e-5) return R(x < 1 ? 1 - 1 / (n * n) : 0);
  const double n2 = n * n, n4 = n2 * n2, p = n2 + 1, d = n4 - 1;
  const double outer = 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
                       n2 * (n2 - 1) * (n2 - 1) / (p * p * p) * std::log((n - 1) / (n + 1)) -
                       2 * n2 * n * (n2 + 2 * n - 1) / (p * d) +
                       8 * n4 * (n4 + 1) / (p * d * d) * std::log(n);
  // From the dense side: what enters leaves by the same angles, spread over n^2 less solid angle.
  return R(x < 1 ? 1 - (1 - outer) / n2 : outer);
}

}  // namespace mms::materials
