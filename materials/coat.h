// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What a coat does to light along a direction of |cosine| z. With F Fresnel's reflectance there
/// and m its mean over the hemisphere, a coat whose lobe is broad by s in [0, 1] reflects
///
///   E = (1 - s) F + s m      and lets T = 1 - E through,
///
/// as rough interfaces do, whose facets meet light at many angles: s is 0 for a mirror, and for
/// facets 0.98 alpha^1.4, alpha the geometric mean of both, so that highlights near the normal are
/// as bright as F times the facets there (fitted for indices from 1.5; towards grazing such
/// interfaces reflect less than E). `glossy` counts as the facets that are as wide. Of several
/// lobes, s is the mean by their weights. The mean of E is m whatever s is.

#include <algorithm>
#include <cmath>

#include "base/spectrum.h"
#include "materials/fresnel.h"
#include "materials/lobe.h"

namespace mms::materials {

/// s of facets, from the geometric mean of both alphas; below 1, so that E is above 0.
template <class R>
inline R broadness(R alpha) {
  return R(0.98) * std::pow(alpha, R(1.4));
}
/// s of `glossy`.
template <class R>
inline R glossy_broadness(R gloss) {
  return broadness(1 / std::sqrt(1 + 2 * gloss));
}

/// E and T of a coat, from F's.
template <class R>
inline FresnelSplit<R> coat_split(const FresnelSplit<R>& f, R mean, R broad) {
  return {f.reflected + broad * (mean - f.reflected), f.transmitted + broad * (f.reflected - mean)};
}

/// The mean of T over the hemisphere.
template <class R>
inline R mean_through(R eta) {
  return 1 - fresnel_dielectric_diffuse(eta);
}

/// A coat at each wavelength. Where its index is not above 1 it counts as a mirror.
template <class R>
struct CoatNumbers {
  Spectrum<R> eta{R(1)};  ///< index below over index above
  Spectrum<R> broad{};    ///< s
  Spectrum<R> mean{};     ///< m

  CoatNumbers() = default;
  CoatNumbers(const R* ior, const Spectrum<R>& s) {
    for_each_index(ior, [&](int j, bool repeated) {
      eta[j] = repeated ? eta[j - 1] : relative_eta(ior[j], Vec3<R>{0, 0, 1});
      mean[j] = repeated ? mean[j - 1] : std::max(fresnel_dielectric_diffuse(eta[j]), R(0));
      broad[j] = eta[j] > 1 ? s[j] : R(0);
    });
  }

  bool operator==(const CoatNumbers& b) const {
    return eta.v == b.eta.v && broad.v == b.broad.v;  // from which the mean follows
  }
  /// Whether wavelength j is as the one before.
  bool repeated(int j) const { return j > 0 && eta[j] == eta[j - 1] && broad[j] == broad[j - 1]; }

  /// What a lobe of the coat that is broad by `s` reflects at wavelength j, and what it leaves.
  FresnelSplit<R> split(int j, R z, R s) const {
    return coat_split(fresnel_split(z, eta[j]), mean[j], s);
  }
};

/// E and T of a coat along one direction, at each wavelength.
template <class R>
struct CoatAlong {
  Spectrum<R> reflected{}, through{};

  CoatAlong() = default;
  CoatAlong(const CoatNumbers<R>& coat, R z) {
    z = limited(z, R(0), R(1));
    for (int j = 0; j < kWavelengths; ++j) {
      const FresnelSplit<R> e = coat.repeated(j) ? FresnelSplit<R>{reflected[j - 1], through[j - 1]}
                                                 : coat.split(j, z, coat.broad[j]);
      reflected[j] = e.reflected;
      through[j] = e.transmitted;
    }
  }
};

}  // namespace mms::materials
