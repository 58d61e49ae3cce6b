// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the scattering models share: reading their numbers, the local frame, specular terms.
/// A model is a struct over R that is made from its numbers in the flat array and offers
///
///   Spectrum<R> estimate(wo)            its albedo, roughly: for the choice of a lobe; 0 only
///                                       where the model is black
///   bool specular()                     a delta with these numbers
/// and, when it is not a delta (contract of materials/bsdf.h, the model alone),
///   Lobes<R> evaluate(wo, wi, mode)     f and pdf
///   bool sample(wo, u_lobe, u1, u2, wi) draws for the hero
/// or, where a part of that depends on wo alone and takes long,
///   seen(wo)                            that part, a struct
///   Lobes<R> evaluate(wo, wi, mode, seen), bool sample(wo, u_lobe, u1, u2, seen, wi)
/// or, when it is a delta,
///   SpecularTerms<R> terms(wo)

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/spectrum.h"
#include "base/vec.h"
#include "base/warp.h"
#include "materials/fresnel.h"

namespace mms::materials {

/// What is transported along the sampled path, see materials/bsdf.h.
enum class Mode { Radiance, Importance };

/// `x`, or 0 where it is negative or not a number.
template <class R>
inline R non_negative(R x) {
  return x > 0 ? std::min(x, std::numeric_limits<R>::max()) : R(0);
}

/// `x` limited to [lo, hi]; `lo` where it is not a number.
template <class R>
inline R limited(R x, R lo, R hi) {
  return x > lo ? std::min(x, hi) : lo;
}

/// The kWavelengths numbers at `p`, each made non-negative.
template <class R>
inline Spectrum<R> weight_at(const R* p) {
  Spectrum<R> s;
  for (int j = 0; j < kWavelengths; ++j) s[j] = non_negative(p[j]);
  return s;
}

/// Both what a model returns and what it would have been sampled with.
template <class R>
struct Lobes {
  Spectrum<R> f, pdf;
};

template <class R>
inline bool same_side(Vec3<R> a, Vec3<R> b) {
  return a.z * b.z > 0 || (a.z > 0 && b.z > 0) || (a.z < 0 && b.z < 0);
}

/// `v` mirrored at the surface when `wo` is inside, so that models that reflect see z > 0.
template <class R>
inline Vec3<R> to_upper(Vec3<R> v, Vec3<R> wo) {
  return wo.z < 0 ? Vec3<R>{v.x, v.y, -v.z} : v;
}

/// The two directions a delta may lead to. Weights are f |wi.z|, probabilities are the model's own
/// choice between the two, for each wavelength as the hero.
template <class R>
struct SpecularTerms {
  Spectrum<R> reflect_weight, reflect_probability;
  Spectrum<R> transmit_weight, transmit_probability;  ///< weight in Importance mode
  Spectrum<R> eta{R(1)};  ///< index on the side of a transmitted wi over that of wo
};

/// Mirror image of `wo` at the normal.
template <class R>
inline Vec3<R> mirrored(Vec3<R> wo) {
  return {-wo.x, -wo.y, wo.z};
}

/// Refraction of `wo` through the surface, `eta` as in SpecularTerms. \pre not total reflection.
template <class R>
inline Vec3<R> refracted(Vec3<R> wo, R eta) {
  // Away from grazing the sine is read off the tangential length, which is finer than the cosine.
  const R g2 = std::abs(wo.z) > R(0.7) ? fused(eta, eta, -(wo.x * wo.x + wo.y * wo.y))
                                       : refraction_g2(std::abs(wo.z), eta);
  const R g = std::sqrt(std::max(R(0), g2));
  return normalize(Vec3<R>{-wo.x, -wo.y, wo.z > 0 ? -g : g});
}

/// Directions this close to the surface count as in it: nothing is scattered. Quotients by the
/// product of two cosines stay finite above it (1e-19 in float).
template <class R>
inline constexpr R kGrazing = R(sizeof(R) == sizeof(float) ? 0x1p-63 : 0x1p-511);

template <class R>
inline bool in_surface(Vec3<R> w) {
  return !(std::abs(w.z) > kGrazing<R>);
}

/// Indices are limited to this and its inverse.
template <class R>
inline constexpr R kMaxIor = R(1e3);

/// Index on the far side over that on the side of `wo`, from inside over outside.
template <class R>
inline R relative_eta(R ior, Vec3<R> wo) {
  // A number that is no index at all is an interface that is not there.
  const R n = ior > 0 ? limited(ior, 1 / kMaxIor<R>, kMaxIor<R>) : R(1);
  return wo.z > 0 ? n : 1 / n;
}

/// Calls `body(j, repeated)` for each wavelength, `repeated` where its number is the one before.
template <class R, class Body>
inline void for_each_index(const R* p, Body body) {
  for (int j = 0; j < kWavelengths; ++j) body(j, j > 0 && p[j] == p[j - 1]);
}

/// Fresnel's split of what comes along a direction of cosine `c` on the side of `wo`, for each
/// wavelength; `ior` is inside over outside.
template <class R>
struct InterfaceSplits {
  Spectrum<R> eta, reflected, transmitted;

  InterfaceSplits(const R* ior, Vec3<R> wo, R c) {
    c = limited(c, R(0), R(1));
    for_each_index(ior, [&](int j, bool repeated) {
      eta[j] = repeated ? eta[j - 1] : relative_eta(ior[j], wo);
      const FresnelSplit<R> s = repeated ? FresnelSplit<R>{reflected[j - 1], transmitted[j - 1]}
                                         : fresnel_split(c, eta[j]);
      reflected[j] = s.reflected;
      transmitted[j] = s.transmitted;
    });
  }
};

/// The deltas of a smooth interface, tinted: `split(j, eta)` is what it reflects and lets through
/// of light along `wo` at wavelength j.
template <class R, class Split>
inline SpecularTerms<R> interface_terms(const R* ior, Vec3<R> wo, const Spectrum<R>& reflected,
                                        const Spectrum<R>& transmitted, const Split& split) {
  SpecularTerms<R> t;
  for (int j = 0; j < kWavelengths; ++j) {
    t.eta[j] = relative_eta(ior[j], wo);
    const FresnelSplit<R> s = split(j, t.eta[j]);
    t.reflect_weight[j] = s.reflected * reflected[j];
    t.transmit_weight[j] = s.transmitted * transmitted[j];
    const R sum = t.reflect_weight[j] + t.transmit_weight[j];
    if (!(sum > 0)) continue;
    t.reflect_probability[j] = t.reflect_weight[j] / sum;
    t.transmit_probability[j] = t.transmit_weight[j] / sum;
  }
  return t;
}

/// What a model around such an interface scatters, roughly: both deltas where it is smooth, and
/// where it is rough, as its parts meet the light at other angles, a little of either side always.
template <class R>
inline Spectrum<R> interface_estimate(const R* ior, Vec3<R> wo, const Spectrum<R>& reflected,
                                      const Spectrum<R>& transmitted, bool rough) {
  const InterfaceSplits<R> s(ior, wo, std::abs(wo.z));
  const Spectrum<R> e = s.reflected * reflected + s.transmitted * transmitted;
  return rough ? e * R(0.9) + (reflected + transmitted) * R(0.05) : e;
}

}  // namespace mms::materials
