// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The two models that are always a delta: `mirror`, and `refraction` without Fresnel loss, which
/// reflects where refraction is impossible. Lossless for colour 1.

#include "materials/lobe.h"

namespace mms::materials {

/// The delta of a mirror with reflectance `colour`.
template <class R>
inline SpecularTerms<R> mirror_terms(const Spectrum<R>& colour) {
  SpecularTerms<R> t;
  t.reflect_weight = colour;
  t.reflect_probability = Spectrum<R>(R(1));
  return t;
}

template <class R>
struct Mirror {
  Spectrum<R> colour;

  explicit Mirror(const R* p) : colour(weight_at(p)) {}

  Spectrum<R> estimate(Vec3<R>) const { return colour; }
  SpecularTerms<R> terms(Vec3<R>) const { return mirror_terms(colour); }
};

template <class R>
struct Refraction {
  const R* ior;
  Spectrum<R> colour;

  explicit Refraction(const R* p) : ior(p), colour(weight_at(p + kWavelengths)) {}

  /// Whether it is known what coats send back.
  bool knows_coats() const { return true; }

  Spectrum<R> estimate(Vec3<R>) const { return colour; }

  SpecularTerms<R> terms(Vec3<R> wo) const {
    SpecularTerms<R> t;
    for (int j = 0; j < kWavelengths; ++j) {
      const R eta = t.eta[j] = relative_eta(ior[j], wo);
      const bool total = !(refraction_g2(std::abs(wo.z), eta) > 0);
      (total ? t.reflect_weight : t.transmit_weight)[j] = colour[j];
      (total ? t.reflect_probability : t.transmit_probability)[j] = 1;
    }
    return t;
  }
};

}  // namespace mms::materials
