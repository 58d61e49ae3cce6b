// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// `slab`: a plane-parallel plate, such as a window pane, seen as one surface. Light that its two
/// faces throw to and fro is summed in closed form, for each polarisation by itself, as it keeps
/// its polarisation inside. With r, t = 1 - r of one face and a what is left after one passage:
///
///   reflected    r + r t^2 a^2 / (1 - r^2 a^2)
///   transmitted  t^2 a / (1 - r^2 a^2)          straight on: the second face undoes the refraction
///
/// (Born and Wolf 7.6, without interference: plates are thicker than light is coherent.) Lossless
/// without absorption, and alike from both sides.

#include "materials/lobe.h"

namespace mms::materials {

template <class R>
struct Slab {
  const R *ior, *absorption;
  R thickness;

  explicit Slab(const R* p)
      : ior(p), absorption(p + kWavelengths + 1), thickness(non_negative(p[kWavelengths])) {}

  Spectrum<R> estimate(Vec3<R> wo) const {
    const SpecularTerms<R> t = terms(wo);
    return t.reflect_weight + t.transmit_weight;
  }

  SpecularTerms<R> terms(Vec3<R> wo) const {
    const R c = limited(std::abs(wo.z), R(0), R(1));
    SpecularTerms<R> t;
    for (int j = 0; j < kWavelengths; ++j) {
      const FresnelSplit<R> s = plate(c, j);
      t.reflect_weight[j] = s.reflected;
      t.transmit_weight[j] = s.transmitted;
      const R sum = s.reflected + s.transmitted;
      t.reflect_probability[j] = sum > 0 ? s.reflected / sum : R(0);
      t.transmit_probability[j] = sum > 0 ? s.transmitted / sum : R(0);
    }
    return t;
  }

 private:
  /// Of both faces together, unpolarised.
  FresnelSplit<R> plate(R c, int j) const {
    const R eta = relative_eta(ior[j], Vec3<R>{0, 0, 1}), e = (eta - 1) * (eta + 1);
    const R g2 = refraction_g2(c, eta);
    if (!(g2 > 0)) return {R(1), R(0)};  // total reflection at the first face
    const R g = std::sqrt(g2), eta2 = eta * eta;
    // Absorbed in one passage, along a cosine of g / eta.
    const R depth = std::min(thickness * non_negative(absorption[j]), R(1e6)) * eta / g;
    const R kept = std::exp(-depth), lost = -std::expm1(-depth);
    FresnelSplit<R> sum{R(0), R(0)};
    const auto add = [&](R amplitude, R t) {
      const R r = amplitude * amplitude;
      const R room = t + r * lost;  // 1 - r a, without subtraction
      if (!(room > 0)) {            // all is reflected at the first face
        sum.reflected += r / 2;
        return;
      }
      const R through = t * kept / (room * (1 + r * kept));  // t a / (1 - r^2 a^2)
      sum.reflected += r * (1 + t * kept * through) / 2;
      sum.transmitted += t * through / 2;
    };
    const R ds = c + g, dp = fused(eta2, c, g);
    add(e / (ds * ds), 4 * c * g / (ds * ds));
    add(e * (fused(eta2 + 1, c * c, R(-1))) / (dp * dp), 4 * eta2 * c * g / (dp * dp));
    return {std::min(sum.reflected, R(1)), std::min(sum.transmitted, R(1))};
  }
};

}  // namespace mms::materials
