// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Albedo by quadrature, which uses nothing of a model's own sampling.

#include <cmath>
#include <vector>

#include "base/quadrature.h"
#include "tests/sanitized.h"
#include "tests/unit/materials/make.h"

namespace mms::test {

/// What the hemisphere of z > 0 or z < 0 gets of `wo`, without deltas, at wavelength `j`: over
/// x = cos^2 and the azimuth from `wo`'s opposite, both from the direction (cos^2 = `peak`) where
/// the lobe may be narrow, as eighth powers near it: `panels` Gauss rules of 8 points along each.
inline double hemisphere(const materials::Bsdf<double>& bsdf, Vec3d wo, bool upper, double peak,
                         int panels) {
  const int n = 8 * panels;
  const auto choice = bsdf.choose(wo);
  const double start = std::atan2(-wo.y, -wo.x);
  std::vector<double> offset(n), weight(n);  // 1 - (1 - u^8)^2: smooth in z where z is 0
  for (int i = 0; i < n; ++i) {
    const double u = (i / 8 + gauss<8>().x[i % 8]) / panels;
    const double far = 1 - std::pow(u, 8);
    offset[i] = 1 - far * far;
    weight[i] = 16 * far * std::pow(u, 7) * gauss<8>().w[i % 8] / panels;
  }
  double sum = 0;
  for (const double reach : {1 - peak, -peak})
    for (int i = 0; i < n; ++i) {
      const double x = peak + reach * offset[i], z = std::sqrt(x), r = std::sqrt(1 - x);
      double ring = 0;
      for (int k = 0; k < n; ++k)
        for (const double a : {kPi<double> * offset[k], -kPi<double> * offset[k]}) {
          const Vec3d wi{r * std::cos(start + a), r * std::sin(start + a), upper ? z : -z};
          ring += weight[k] * bsdf.evaluate(wo, wi, materials::Mode::Importance, choice).f[0];
        }
      sum += std::abs(reach) * weight[i] * ring;
    }
  return sum * kPi<double> / 2;  // dx = 2 cos sin dtheta
}

/// Albedo towards the side of `wo` without deltas.
inline double albedo(const Material& m, double degrees, double azimuth = 0,
                     int panels = kSanitized ? 8 : 12) {
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  const Vec3d wo = direction(degrees, azimuth);
  return hemisphere(materials::Bsdf<double>(layout, p.data()), wo, wo.z > 0, wo.z * wo.z, panels);
}

}  // namespace mms::test
