// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Reflection by microfacets. What facets send on to other facets is given back by a second, broad
/// lobe (materials/energy.h): a white surface has albedo 1 at every roughness.

#include "materials/coated.h"
#include "materials/facets.h"
#include "materials/specular.h"

namespace mms::materials {

/// Half vector of two directions of one side; zero where they cancel (grazing, wi = -wo).
template <class R>
struct HalfVector {
  Vec3<R> h;
  R cosine = 0;  ///< between it and either direction

  /// Directions have length 1, so their sum is perpendicular to their difference: near the surface
  /// that tells the tangential part of the sum, which is what rounding has left of both, by the
  /// cosines, which are exact. The cosine is half the length of the sum: where directions nearly
  /// cancel, the product of either with `h` would be rounding alone.
  [[gnu::always_inline]] HalfVector(Vec3<R> a, Vec3<R> b) : h(a + b) {
    const Vec3<R> across = a - b;
    const R square = dot(across, across);
    if (square > 0) h = h - across * (dot(h, across) / square);
    const R l2 = dot(h, h);
    const R cut = 16 * std::numeric_limits<R>::epsilon();
    const R length = l2 > cut * cut ? std::sqrt(l2) : R(0);
    h = length > 0 ? h / length : Vec3<R>{0, 0, 0};
    cosine = std::min(length / 2, R(1));
  }
};

/// What of facets that are mirrors is alike along all directions.
template <class R>
struct FacetsSolved {
  R mean = 0;                      ///< over the hemisphere, what is lost to further bounces
  BounceSampling<R> bounces = {};  ///< how directions of these are drawn
  Spectrum<R> further = {};        ///< F of these bounces together
};

/// Facets along one direction: what is found once for all that it meets.
template <class R>
struct FacetsSeen {
  R shadow = 0;           ///< |w.z| Lambda(w)
  Spectrum<R> lost = {};  ///< by the first bounce, to further ones; of mirrors alike
};

/// Reflection by facets, alike for every wavelength but for Fresnel's factor.
template <class R, template <class> class Distribution>
struct RoughReflection {
  Distribution<R> facets;

  /// Roughness and anisotropy are the numbers at `p`.
  explicit RoughReflection(const R* p) : facets{Alpha<R>::from(p[0], p[1])} {}

  bool specular() const { return facets.specular(); }
  FacetLoss<R> loss() const { return {&facets.tables(), facets.ax, facets.ay}; }
  CoatedLobe<R> coated(Vec3<R> w) const {
    return CoatedLobe<R>::facets(facets.coated(), facets.ax, facets.ay, w);
  }

  /// What happens between two directions of one side.
  struct Value {
    R single = 0;    ///< f / F of one bounce
    R multiple = 0;  ///< f / F_multiple of all further ones
    R pdf = 0;
    R cos_h = 0;  ///< at the facet of the single bounce
  };

  /// `further(mean)` is F of further bounces, `mean` being that of the loss.
  template <class Further>
  FacetsSolved<R> solved(const Further& further) const {
    // No distribution loses less: where facets are all but flat, the spline may swing below it.
    const R area = facets.ax * facets.ay, mean = std::max(loss().mean(), R(0.02) * mean_unit(area));
    return {mean, BounceSampling<R>(area), further(mean)};
  }
  FacetsSeen<R> seen(Vec3<R> wo) const {
    const Vec3<R> up = to_upper(wo, wo);
    return {facets.shadow(up), Spectrum<R>(loss().at(up))};
  }

  Value evaluate(Vec3<R> wo, Vec3<R> wi, const FacetsSolved<R>& solved,
                 const FacetsSeen<R>& seen) const {
    Value v;
    if (!same_side(wo, wi)) return v;
    wi = to_upper(wi, wo);
    wo = to_upper(wo, wo);
    const R lost = seen.lost[0];
    v.multiple = lost * loss().at(wi) / (kPi<R> * solved.mean);
    v.pdf = lost * solved.bounces.pdf(wi.z);
    const HalfVector<R> half(wo, wi);
    const Vec3<R> h = half.h;
    if (!(h.z > 0)) return v;
    v.single = facets.density(h) * masking(facets, wo, seen.shadow, wi);
    v.pdf += (1 - lost) * visible(facets, wo, seen.shadow, h) / 4;
    v.cos_h = half.cosine;
    return v;
  }

  /// Draws wi; false where a single bounce leaves the side of wo.
  bool sample(Vec3<R> wo, R u_lobe, R u1, R u2, const FacetsSolved<R>& solved,
              const FacetsSeen<R>& seen, Vec3<R>& wi) const {
    const Vec3<R> up = to_upper(wo, wo);
    if (u_lobe < seen.lost[0]) {
      wi = solved.bounces.sample(u1, u2);
    } else {
      const Vec3<R> h = facets.sample_visible(up, u1, u2);
      wi = normalize(h * (2 * dot(up, h)) - up);
    }
    if (!(wi.z > 0)) return false;
    wi = to_upper(wi, wo);
    return true;
  }
};

/// F of all bounces but the first together, where `mean` is the hemispherical mean of F and `loss`
/// that of the loss: sum over n > 0 of mean^(n + 1) loss^(n - 1) (1 - loss) (Hill 2018, after Kulla
/// and Conty 2017).
template <class R>
inline R multiple_fresnel(R mean, R loss) {
  return mean * mean * (1 - loss) / (1 - mean * loss);
}

/// `microfacet` and `beckmann`: facets that are mirrors of one colour.
template <class R, template <class> class Distribution>
struct FacetMirror {
  Spectrum<R> colour;
  RoughReflection<R, Distribution> rough;

  explicit FacetMirror(const R* p) : colour(weight_at(p)), rough(p + kWavelengths) {}

  bool specular() const { return rough.specular(); }
  CoatedLobe<R> coated(Vec3<R> w) const { return rough.coated(w); }
  Spectrum<R> estimate(Vec3<R>) const { return colour; }
  SpecularTerms<R> terms(Vec3<R>) const { return mirror_terms(colour); }

  FacetsSolved<R> solved() const {
    return rough.solved([this](R loss) {
      // A colour above 1 is not physical: no series for it.
      return Spectrum<R>::map([loss](R c) { return c <= 1 ? multiple_fresnel(c, loss) : c; },
                              colour);
    });
  }
  FacetsSeen<R> seen(Vec3<R> wo, const FacetsSolved<R>&) const { return rough.seen(wo); }

  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode, const FacetsSolved<R>& solved,
                    const FacetsSeen<R>& seen) const {
    const auto v = rough.evaluate(wo, wi, solved, seen);
    return {colour * v.single + solved.further * v.multiple, Spectrum<R>(v.pdf)};
  }

  bool sample(Vec3<R> wo, R u_lobe, R u1, R u2, const FacetsSolved<R>& solved,
              const FacetsSeen<R>& seen, Vec3<R>& wi) const {
    return rough.sample(wo, u_lobe, u1, u2, solved, seen, wi);
  }
};

template <class R>
using Microfacet = FacetMirror<R, Ggx>;
template <class R>
using BeckmannMirror = FacetMirror<R, Beckmann>;

}  // namespace mms::materials
