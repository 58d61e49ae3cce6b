// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Lambert's models: `matte` reflects, `translucent` transmits, both evenly over projected solid
/// angle. f = colour / pi; lossless for colour 1; samples are cosine-distributed.

#include "materials/lobe.h"

namespace mms::materials {

/// `kTransmits`: to the other side.
template <class R, bool kTransmits>
struct Lambert {
  Spectrum<R> colour;

  explicit Lambert(const R* p) : colour(weight_at(p)) {}

  static constexpr bool specular() { return false; }
  Spectrum<R> estimate(Vec3<R>) const { return colour; }

  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode) const {
    if (same_side(wo, wi) == kTransmits) return {};
    return {colour * (1 / kPi<R>), Spectrum<R>(std::abs(wi.z) / kPi<R>)};
  }

  bool sample(Vec3<R> wo, R, R u1, R u2, Vec3<R>& wi) const {
    wi = square_to_cosine_hemisphere(u1, u2);
    if ((wo.z < 0) != kTransmits) wi.z = -wi.z;
    return wi.z != 0;
  }
};

template <class R>
using Matte = Lambert<R, false>;
template <class R>
using Translucent = Lambert<R, true>;

}  // namespace mms::materials
