// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Distributions of microfacet normals: GGX (Walter et al. 2007), and Beckmann. Both are
/// anisotropic, are masked after Smith with correlated heights (Heitz 2014), and are sampled by
/// visible normals: GGX through spherical caps (Dupuy and Benyoub 2023), Beckmann by inverting the
/// distribution of visible slopes (Heitz and d'Eon 2014). A distribution offers
///
///   density(h)            facets of unit normal `h` per steradian and unit area of surface
///   shadow(w)             |w.z| Lambda(w): finite at grazing angles
///   sample_visible(wo, u1, u2)  a normal that `wo` (z > 0) sees
///   tables(), interface() what multiple scattering needs (materials/energy.h)
///   coated()              the same of coats and of what lies below one (materials/coated.h)

#include "materials/energy.h"
#include "materials/lobe.h"

namespace mms::materials {

struct CoatedTables;
extern const CoatedTables kGgxCoated, kBeckmannCoated;

/// Below this alpha the lobe is a mirror. Rounding a direction in float moves it by about 1e-7
/// rad, so that at alpha = 1e-4 f already carries a relative error near 2e-3 where it is steepest.
inline constexpr double kMinAlpha = 1e-4;

/// Width of the distribution along the local axes.
template <class R>
struct Alpha {
  R ax, ay;

  /// alpha = roughness^2, stretched by `anisotropy` in [-1, 1]: positive elongates highlights along
  /// the local x axis; 0.9 of it removes, at most, 90% of the aspect's square (as Burley 2012).
  static Alpha from(R roughness, R anisotropy) {
    const R r = limited(roughness, R(0), R(1));
    const R a = limited(anisotropy, R(-1), R(1));
    const R aspect = std::sqrt(1 - R(0.9) * std::abs(a));
    const R wide = r * r / aspect, narrow = r * r * aspect;
    return a >= 0 ? Alpha{wide, narrow} : Alpha{narrow, wide};
  }

  bool specular() const { return !(std::min(ax, ay) >= R(kMinAlpha)); }

  /// Length of the tangential part of `w`, stretched.
  R tangent(Vec3<R> w) const {
    const R x = ax * w.x, y = ay * w.y;
    return std::sqrt(x * x + y * y);
  }
};

template <class R>
struct Ggx : Alpha<R> {
  using Alpha<R>::ax, Alpha<R>::ay;

  R density(Vec3<R> h) const {
    const R x = h.x / ax, y = h.y / ay;
    const R t = x * x + y * y + h.z * h.z;
    return 1 / (kPi<R> * ax * ay * t * t);
  }

  R shadow(Vec3<R> w) const {
    const R x = ax * w.x, y = ay * w.y, t2 = x * x + y * y, z = std::abs(w.z);
    const R sum = std::sqrt(t2 + z * z) + z;
    return sum > 0 ? t2 / sum / 2 : R(0);
  }

  Vec3<R> sample_visible(Vec3<R> wo, R u1, R u2) const {
    const Vec3<R> w = normalize(Vec3<R>{ax * wo.x, ay * wo.y, wo.z});
    // A point of the cap around `w`; 1 - z and 1 + z are formed without subtraction.
    const R low = u2 * (1 + w.z);
    const R r = std::sqrt(std::max(R(0), low * (2 - low)));
    const R phi = 2 * kPi<R> * u1;
    const Vec3<R> c{r * std::cos(phi), r * std::sin(phi), 1 - low};
    const Vec3<R> h = c + w;
    return normalize(Vec3<R>{ax * h.x, ay * h.y, std::max(R(0), h.z)});
  }

  static const FacetTables& tables() { return kGgxTables; }
  static const InterfaceTables& interface() { return kGgxInterface; }
  static const CoatedTables& coated() { return kGgxCoated; }
};

/// The value at `x` of the polynomial of these coefficients, of the highest power first. Not fused
/// as that of base/exponential.h is: a call for each term, where not every processor has it.
template <class R, int N>
inline R polynomial(R x, const double (&coefficients)[N]) {
  R sum = 0;
  for (const double c : coefficients) sum = sum * x + R(c);
  return sum;
}

/// x with erf(x) = `y` in (-1, 1), within 3e-7 of x (Giles 2012); nearer to 1 than floats are,
/// within 3e-3.
template <class R>
inline R near_erf_inverse(R y) {
  static constexpr double kMiddle[] = {2.81022636e-08,  3.43273939e-07, -3.5233877e-06,
                                       -4.39150654e-06, 0.00021858087,  -0.00125372503,
                                       -0.00417768164,  0.246640727,    1.50140941};
  static constexpr double kTail[] = {-0.000200214257, 0.000100950558, 0.00134934322,
                                     -0.00367342844,  0.00573950773,  -0.0076224613,
                                     0.00943887047,   1.00167406,     2.83297682};
  const R limit = 1 - std::numeric_limits<R>::epsilon() / 2;
  y = std::clamp(y, -limit, limit);
  const R w = -std::log((1 - y) * (1 + y));
  if (w < 5) return y * polynomial(w - R(2.5), kMiddle);
  const R known = std::min(w, R(16)), x = y * polynomial(std::sqrt(known) - 3, kTail);
  return w > known ? std::copysign(std::sqrt(x * x + R(0.97) * (w - known)), y) : x;
}

/// The same as exactly as R has it: where that is more than float, by Halley's method.
template <class R>
inline R erf_inverse(R y) {
  R x = near_erf_inverse(y);
  constexpr int kSteps = std::numeric_limits<R>::digits > 24 ? 3 : 0;
  for (int i = 0; i < kSteps; ++i) {
    const R error = std::abs(y) < R(0.5) ? std::erf(x) - y
                    : y > 0              ? (1 - y) - std::erfc(x)
                                         : std::erfc(-x) - (1 + y);
    const R newton = error * std::sqrt(kPi<R>) / 2 * std::exp(x * x);
    x -= newton / (1 + newton * x);
  }
  return x;
}

template <class R>
struct Beckmann : Alpha<R> {
  using Alpha<R>::ax, Alpha<R>::ay;

  R density(Vec3<R> h) const {
    const R x = h.x / ax, y = h.y / ay, z2 = h.z * h.z;
    const R area = kPi<R> * ax * ay * (z2 * z2);
    if (!(area > 0)) return 0;  // the exponential has fallen far below
    return std::exp(-(x * x + y * y) / z2) / area;
  }

  R shadow(Vec3<R> w) const {
    const R t = this->tangent(w), z = std::abs(w.z);
    if (!(t > 0) || z > 6 * t) return 0;  // below 1e-17 of z
    const R a = z / t;
    const R s = std::exp(-a * a) / std::sqrt(kPi<R>) - a * std::erfc(a);
    return std::max(R(0), t * s / 2);
  }

  Vec3<R> sample_visible(Vec3<R> wo, R u1, R u2) const {
    const R t = this->tangent(wo), length = std::sqrt(t * t + wo.z * wo.z);
    const R slope = visible_slope(wo.z / length, t / length, u1), across = erf_inverse(2 * u2 - 1);
    const R cx = t > 0 ? ax * wo.x / t : R(1), cy = t > 0 ? ay * wo.y / t : R(0);
    const R x = slope * cx - across * cy, y = slope * cy + across * cx;
    return normalize(Vec3<R>{-ax * x, -ay * y, R(1)});
  }

  static const FacetTables& tables() { return kBeckmannTables; }
  static const InterfaceTables& interface() { return kBeckmannInterface; }
  static const CoatedTables& coated() { return kBeckmannCoated; }

 private:
  /// The slope along a direction of cosine c and sine s: the density over x < c / s is proportional
  /// to (c - s x) e^(-x^2), and its integral to
  ///   I(x) = c (1 + erf x) / 2 + s e^(-x^2) / (2 sqrt pi)
  /// By Halley's method in a bracket, from the fit to erf x of Jakob (2014).
  static R visible_slope(R c, R s, R u) {
    const R root = std::sqrt(kPi<R>);
    R lo = -R(6), hi = c < 6 * s ? c / s : R(6);
    const R most = std::erf(hi), target = u * (c * (1 + most) + s * std::exp(-hi * hi) / root) / 2;
    const R angle = axes::angle(s, c) * (kPi<R> / 2),
            power = 1 + angle * (R(-0.876) + angle * (R(0.4265) - R(0.0594) * angle));
    const R start = near_erf_inverse(most - (1 + most) * std::pow(1 - u, power));
    R x = std::clamp(start, lo, hi);
    for (int i = 0; i < 40; ++i) {
      const R bell = std::exp(-x * x) / root, rest = c - s * x;
      const R error = (c * std::erfc(-x) + s * bell) / 2 - target;
      (error < 0 ? lo : hi) = x;
      // I'' / I' = -2 (x + s / (2 (c - s x)))
      const R newton = error / (rest * bell),
              step = newton / std::max(1 + newton * (x + s / (2 * rest)), R(0.5));
      const R before = x, next = x - step;
      x = next >= lo && next <= hi ? next : (lo + hi) / 2;
      const R noise = 16 * std::numeric_limits<R>::epsilon() * std::max(std::abs(x), R(1));
      if (std::abs(x - before) <= noise) break;
    }
    return x;
  }
};

/// G2 / (4 |wo.z| |wi.z|); `shadow` is that of `wo`.
template <class R, template <class> class Facets>
inline R masking(const Facets<R>& facets, Vec3<R> wo, R shadow, Vec3<R> wi) {
  const R o = std::abs(wo.z), i = std::abs(wi.z);
  const R s = o * i + i * shadow + o * facets.shadow(wi);
  return s > 0 ? R(0.25) / s : R(0);
}

/// Density of the visible normal `h` seen from `wo`, divided by |wo.h|; `shadow` is that of `wo`.
template <class R, template <class> class Facets>
inline R visible(const Facets<R>& facets, Vec3<R> wo, R shadow, Vec3<R> h) {
  return facets.density(h) / (std::abs(wo.z) + shadow);
}

}  // namespace mms::materials
