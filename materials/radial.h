// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Lobes that depend on nothing but the angle to the mirror direction: `phong` (reciprocal, Lewis
/// 1994), `max_phong` (Neumann et al. 1999) and `spot`. With c the cosine of that angle:
///
///   phong      f = colour (n + 2) / (2 pi) c^n
///   max_phong  f = colour (n + 1) / (2 pi) c^n / max(|wo.z|, |wi.z|)
///   spot       f = colour N s(c), s = 1 within the inner angle, 0 beyond the outer, smooth between
///
/// Each keeps all energy at normal incidence (`max_phong` all but what the cosine takes there) and
/// loses what falls below the surface towards grazing.

#include "materials/specular.h"

namespace mms::materials {

/// 1 - the cosine between `wi` and the mirror direction of `wo`, without subtraction.
template <class R>
inline R off_mirror(Vec3<R> wo, Vec3<R> wi) {
  const Vec3<R> d = wi - mirrored(wo);
  return std::min(R(2), dot(d, d) / 2);
}

/// `local` around the mirror direction of `wo`; false where it leaves the side of `wo`.
template <class R>
inline bool around_mirror(Vec3<R> wo, R one_minus_c, R u2, Vec3<R>& wi) {
  const R s = std::sqrt(std::max(R(0), one_minus_c * (2 - one_minus_c))), phi = 2 * kPi<R> * u2;
  const Frame<R> frame = Frame<R>::around(mirrored(wo));
  wi = normalize(frame.to_world({s * std::cos(phi), s * std::sin(phi), 1 - one_minus_c}));
  return same_side(wo, wi);
}

/// Above this exponent the lobe is a mirror: at 1e7 it is 3e-4 rad wide.
inline constexpr double kMaxExponent = 1e7;

/// `kMax`: the form that is divided by the larger cosine.
template <class R, bool kMax>
struct PhongLobe {
  Spectrum<R> colour;
  R n;

  explicit PhongLobe(const R* p) : colour(weight_at(p)), n(non_negative(p[kWavelengths])) {}

  bool specular() const { return n > R(kMaxExponent); }
  Spectrum<R> estimate(Vec3<R>) const { return colour; }
  /// What `phong` keeps of a narrow lobe is the cosine.
  SpecularTerms<R> terms(Vec3<R> wo) const {
    return mirror_terms(kMax ? colour : colour * std::min(std::abs(wo.z), R(1)));
  }

  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode) const {
    if (!same_side(wo, wi)) return {};
    const R off = off_mirror(wo, wi);
    if (!(off < 1)) return {};
    const R power = std::exp(n * std::log1p(-off)) / (2 * kPi<R>);
    const R pdf = (n + 1) * power;
    const R f = kMax ? pdf / std::max(std::abs(wo.z), std::abs(wi.z)) : (n + 2) * power;
    return {colour * f, Spectrum<R>(pdf)};
  }

  bool sample(Vec3<R> wo, R, R u1, R u2, Vec3<R>& wi) const {
    // c = (1 - u1)^(1 / (n + 1))
    return around_mirror(wo, -std::expm1(std::log1p(-u1) / (n + 1)), u2, wi);
  }
};

template <class R>
using Phong = PhongLobe<R, false>;
template <class R>
using MaxPhong = PhongLobe<R, true>;

template <class R>
struct Spot {
  Spectrum<R> colour;
  R inner, outer;  ///< 1 - cosine

  explicit Spot(const R* p) : colour(weight_at(p)) {
    const auto off = [](R angle) {
      const R s = std::sin(limited(angle, R(1e-3), kPi<R> / 2) / 2);
      return 2 * s * s;
    };
    outer = off(p[kWavelengths + 1]);
    inner = p[kWavelengths] > 0 ? std::min(off(p[kWavelengths]), outer) : R(0);
  }

  static constexpr bool specular() { return false; }
  Spectrum<R> estimate(Vec3<R>) const { return colour; }

  /// 1 to 0 as 1 - 3 t^2 + 2 t^3 in t = (off - inner) / (outer - inner).
  R profile(R off) const {
    if (off <= inner) return 1;
    if (!(off < outer)) return 0;
    const R t = (outer - off) / (outer - inner);
    return t * t * (3 - 2 * t);
  }

  /// int s do: even up to `inner`, half of the slope.
  R area() const { return (inner + outer) / 2; }

  /// 1 / int s c dw at normal incidence: with off = o the ring is 2 pi (1 - o) do; of the slope's
  /// width w, int s o counts w^2 / 2 - 3 w^2 / 4 + 2 w^2 / 5 from `inner` on.
  R scale() const {
    const R w = outer - inner;
    const R moment = inner * inner / 2 + inner * w / 2 + w * w * R(0.15);
    return 1 / (2 * kPi<R> * (area() - moment));
  }

  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode) const {
    if (!same_side(wo, wi)) return {};
    const R s = profile(off_mirror(wo, wi));
    return {colour * (scale() * s), Spectrum<R>(s / (2 * kPi<R> * area()))};
  }

  bool sample(Vec3<R> wo, R, R u1, R u2, Vec3<R>& wi) const {
    const R share = u1 * area();
    if (share <= inner) return around_mirror(wo, share, u2, wi);
    // t - t^3 + t^4 / 2 grows from 0 to 1/2 over the slope: Newton's method, kept in a bracket.
    const R w = outer - inner, target = (share - inner) / w;
    R lo = 0, hi = 1, t = target;
    for (int i = 0; i < 30; ++i) {
      const R error = t * (1 - t * t * (1 - t / 2)) - target;
      if (std::abs(error) <= std::numeric_limits<R>::epsilon()) break;
      (error < 0 ? lo : hi) = t;
      const R next = t - error / ((1 - t) * (1 - t) * (1 + 2 * t));
      t = next > lo && next < hi ? next : (lo + hi) / 2;
    }
    return around_mirror(wo, inner + w * t, u2, wi);
  }
};

}  // namespace mms::materials
