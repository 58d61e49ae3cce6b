// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// `conductor`: GGX facets of metal with the exact Fresnel reflectance; polished at low roughness.

#include "materials/fresnel.h"
#include "materials/microfacet.h"

namespace mms::materials {

template <class R>
struct Conductor {
  const R* n;
  const R* k;
  Ggx<R> ggx;

  explicit Conductor(const R* p)
      : n(p),
        k(p + kWavelengths),
        ggx(Ggx<R>::from(p[2 * kWavelengths], p[2 * kWavelengths + 1])) {}

  bool specular() const { return ggx.specular(); }

  /// Reflectance of a facet at the cosine of incidence `c`.
  Spectrum<R> reflectance(R c) const {
    Spectrum<R> f;
    for (int j = 0; j < kWavelengths; ++j) {
      const bool repeated = j > 0 && n[j] == n[j - 1] && k[j] == k[j - 1];
      f[j] = repeated ? f[j - 1] : fresnel_conductor(c, non_negative(n[j]), non_negative(k[j]));
    }
    return f;
  }

  Spectrum<R> estimate(Vec3<R> wo) const {
    return reflectance(limited(std::abs(wo.z), R(0), R(1)));
  }
  SpecularTerms<R> terms(Vec3<R> wo) const { return mirror_terms(estimate(wo)); }

  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode) const {
    const FacetReflection<R> r = reflect_by_facets(ggx, wo, wi);
    if (!(r.pdf > 0)) return {};
    return {reflectance(r.cos_h) * r.f, Spectrum<R>(r.pdf)};
  }

  bool sample(Vec3<R> wo, R, R u1, R u2, Vec3<R>& wi) const {
    return sample_facet_reflection(ggx, wo, u1, u2, wi);
  }
};

}  // namespace mms::materials
