// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// GGX microfacets (Walter et al. 2007; anisotropic and height-correlated Smith masking after Heitz
/// 2014), sampled by visible normals through spherical caps (Dupuy and Benyoub 2023). Light that
/// would bounce more than once between facets is lost: the albedo falls below 1 as roughness grows.

#include "materials/specular.h"

namespace mms::materials {

/// Below this alpha the lobe is a mirror. Rounding a direction in float moves it by about 1e-7
/// rad, so that at alpha = 1e-4 f already carries a relative error near 2e-3 where it is steepest.
inline constexpr double kMinAlpha = 1e-4;

/// The distribution of normals over the upper hemisphere.
template <class R>
struct Ggx {
  R ax, ay;

  /// alpha = roughness^2, stretched by `anisotropy` in [-1, 1]: positive elongates highlights along
  /// the local x axis; 0.9 of it removes, at most, 90% of the aspect's square (as Burley 2012).
  static Ggx from(R roughness, R anisotropy) {
    const R r = limited(roughness, R(0), R(1));
    const R a = limited(anisotropy, R(-1), R(1));
    const R aspect = std::sqrt(1 - R(0.9) * std::abs(a));
    const R wide = r * r / aspect, narrow = r * r * aspect;
    return a >= 0 ? Ggx{wide, narrow} : Ggx{narrow, wide};
  }

  bool specular() const { return !(std::min(ax, ay) >= R(kMinAlpha)); }

  /// Density of facets with unit normal `h` per steradian and unit area of surface.
  R density(Vec3<R> h) const {
    const R x = h.x / ax, y = h.y / ay;
    const R t = x * x + y * y + h.z * h.z;
    return 1 / (kPi<R> * ax * ay * t * t);
  }

  /// |w.z| (1 + 2 Lambda(w)): what masking needs, finite at grazing angles.
  R stretch(Vec3<R> w) const {
    const R x = ax * w.x, y = ay * w.y;
    return std::sqrt(x * x + y * y + w.z * w.z);
  }

  /// G2 / (4 |wo.z| |wi.z|).
  R masking(Vec3<R> wo, Vec3<R> wi) const {
    const R o = std::abs(wo.z), i = std::abs(wi.z);
    const R s = i * stretch(wo) + o * stretch(wi);
    return s > 0 ? R(0.5) / s : R(0);
  }

  /// Density of the visible normal `h` seen from `wo`, divided by |wo.h|.
  R visible(Vec3<R> wo, Vec3<R> h) const { return density(h) * 2 / (std::abs(wo.z) + stretch(wo)); }

  /// A normal that `wo` (z > 0) sees.
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
};

/// Half vector of two directions of the same side; zero where they cancel (grazing, wi = -wo).
template <class R>
inline Vec3<R> half_vector(Vec3<R> a, Vec3<R> b) {
  const Vec3<R> h = a + b;
  const R l2 = dot(h, h);
  const R cut = 16 * std::numeric_limits<R>::epsilon();
  if (!(l2 > cut * cut)) return {0, 0, 0};
  return h / std::sqrt(l2);
}

/// f / F and pdf of reflection by facets; zero unless both directions are on the same side.
template <class R>
struct FacetReflection {
  R f = 0, pdf = 0, cos_h = 0;
};

template <class R>
inline FacetReflection<R> reflect_by_facets(const Ggx<R>& ggx, Vec3<R> wo, Vec3<R> wi) {
  if (!same_side(wo, wi)) return {};
  wi = to_upper(wi, wo);
  wo = to_upper(wo, wo);
  const Vec3<R> h = half_vector(wo, wi);
  if (!(h.z > 0)) return {};
  return {ggx.density(h) * ggx.masking(wo, wi), ggx.visible(wo, h) / 4,
          limited(dot(wo, h), R(0), R(1))};
}

/// Draws wi; false where it leaves the side of wo.
template <class R>
inline bool sample_facet_reflection(const Ggx<R>& ggx, Vec3<R> wo, R u1, R u2, Vec3<R>& wi) {
  const Vec3<R> up = to_upper(wo, wo);
  const Vec3<R> h = ggx.sample_visible(up, u1, u2);
  wi = normalize(h * (2 * dot(up, h)) - up);
  if (!(wi.z > 0)) return false;
  wi = to_upper(wi, wo);
  return true;
}

/// `microfacet`: facets that are mirrors of one colour.
template <class R>
struct Microfacet {
  Spectrum<R> colour;
  Ggx<R> ggx;

  explicit Microfacet(const R* p)
      : colour(weight_at(p)), ggx(Ggx<R>::from(p[kWavelengths], p[kWavelengths + 1])) {}

  bool specular() const { return ggx.specular(); }
  Spectrum<R> estimate(Vec3<R>) const { return colour; }
  SpecularTerms<R> terms(Vec3<R>) const { return mirror_terms(colour); }

  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode) const {
    const FacetReflection<R> r = reflect_by_facets(ggx, wo, wi);
    return {colour * r.f, Spectrum<R>(r.pdf)};
  }

  bool sample(Vec3<R> wo, R, R u1, R u2, Vec3<R>& wi) const {
    return sample_facet_reflection(ggx, wo, u1, u2, wi);
  }
};

}  // namespace mms::materials
