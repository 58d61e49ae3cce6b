// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Rough diffuse reflection: `oren_nayar` (Oren and Nayar 1994, the qualitative form), which loses
/// what grooves keep, and `rough_matte`, the energy-preserving form (Portsmouth, Kutz and Hill
/// 2024), whose further bounces make white lossless. With s = wi.wo - |wi.z| |wo.z|:
///
///   oren_nayar   f = colour / pi (A + B max(0, s) / max(|wi.z|, |wo.z|))
///   rough_matte  f = colour / pi a (1 + r s / (max(|wi.z|, |wo.z|) where s > 0, else 1)) + further
///
/// f grows as 1 / |z| where both directions are the same and near grazing. Samples are therefore
/// drawn evenly over the hemisphere as often as by the cosine: weights stay below 4.

#include "materials/coated.h"
#include "materials/lobe.h"

namespace mms::materials {

/// Half by the cosine, half evenly over solid angle, on the side of `wo`.
template <class R>
struct BroadSampling {
  static R pdf(Vec3<R> wi) { return std::abs(wi.z) / (2 * kPi<R>)+1 / (4 * kPi<R>); }

  static bool sample(Vec3<R> wo, R u_lobe, R u1, R u2, Vec3<R>& wi) {
    wi = u_lobe < R(0.5) ? square_to_cosine_hemisphere(u1, u2) : square_to_sphere(u1 / 2, u2);
    if (!(wi.z > 0)) return false;
    wi = to_upper(wi, wo);
    return true;
  }
};

/// wi.wo - |wi.z| |wo.z| for directions of one side.
template <class R>
inline R tangent_cosine(Vec3<R> wo, Vec3<R> wi) {
  return wo.x * wi.x + wo.y * wi.y;
}

template <class R>
struct OrenNayar {
  Spectrum<R> colour;
  R a, b;

  explicit OrenNayar(const R* p) : colour(weight_at(p)) {
    const R sigma = limited(p[kWavelengths], R(0), kPi<R> / 2), s2 = sigma * sigma;
    a = 1 - R(0.5) * s2 / (s2 + R(0.33));
    b = R(0.45) * s2 / (s2 + R(0.09));
  }

  static constexpr bool specular() { return false; }
  Spectrum<R> estimate(Vec3<R>) const { return colour * a; }

  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode) const {
    if (!same_side(wo, wi)) return {};
    const R s = std::max(R(0), tangent_cosine(wo, wi));
    const R f = (a + b * s / std::max(std::abs(wo.z), std::abs(wi.z))) / kPi<R>;
    return {colour * f, Spectrum<R>(BroadSampling<R>::pdf(wi))};
  }

  bool sample(Vec3<R> wo, R u_lobe, R u1, R u2, Vec3<R>& wi) const {
    return BroadSampling<R>::sample(wo, u_lobe, u1, u2, wi);
  }
};

template <class R>
struct RoughMatte {
  Spectrum<R> colour;
  R r, a;

  /// Mean losses: c1 of a grazing direction (1/2 - 2 / (3 pi)), c1 - c2 of the hemisphere, where c2
  /// = 2/3 - 28 / (15 pi); times r a.
  static constexpr R c1 = R(0.5) - 2 / (3 * kPi<R>), c2 = R(2) / 3 - 28 / (15 * kPi<R>);

  explicit RoughMatte(const R* p) : colour(weight_at(p)) {
    r = limited(p[kWavelengths], R(0), R(1));
    a = 1 / (1 + c1 * r);
  }

  static constexpr bool specular() { return false; }
  Spectrum<R> estimate(Vec3<R>) const { return colour; }
  CoatedLobe<R> coated(Vec3<R> w) const { return CoatedLobe<R>::matte(r, w); }

  /// 1 - albedo of one bounce on white, over r a: c1 - G / pi, G = s (theta - s c + 2/3 (c (1 + s +
  /// s^2) / (1 + s) - 1)), which is free of divisions by the cosine.
  static R loss(R c) {
    const R s = std::sqrt(std::max(R(0), (1 - c) * (1 + c))), theta = std::atan2(s, c);
    const R g = s * (theta - s * c + R(2) / 3 * (c * (1 + s + s * s) / (1 + s) - 1));
    return std::max(R(0), c1 - g / kPi<R>);
  }

  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode) const {
    if (!same_side(wo, wi)) return {};
    const R o = std::min(std::abs(wo.z), R(1)), i = std::min(std::abs(wi.z), R(1));
    const R s = tangent_cosine(wo, wi);
    const R single = a * std::max(R(0), 1 + r * (s > 0 ? s / std::max(o, i) : s));
    const R further = r * a * loss(o) * loss(i) / (c1 - c2);
    const R kept = 1 - r * a * (c1 - c2);  // of white, by one bounce
    Lobes<R> out{Spectrum<R>(), Spectrum<R>(BroadSampling<R>::pdf(wi))};
    for (int j = 0; j < kWavelengths; ++j) {
      const R rho = colour[j];
      const R again = rho <= 1 ? rho * rho * kept / (1 - rho * (1 - kept)) : rho;
      out.f[j] = (rho * single + again * further) / kPi<R>;
    }
    return out;
  }

  bool sample(Vec3<R> wo, R u_lobe, R u1, R u2, Vec3<R>& wi) const {
    return BroadSampling<R>::sample(wo, u_lobe, u1, u2, wi);
  }
};

}  // namespace mms::materials
