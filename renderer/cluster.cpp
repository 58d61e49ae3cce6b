// SPDX-License-Identifier: Apache-2.0
#include "renderer/cluster.h"

#include <cstdint>

#include "materials/colour.h"
#include "materials/spectra.h"

namespace mms::renderer {

Spectrumf Cluster::reflectance(const std::array<double, 3>& rgb) const {
  const float r = float(rgb[0] - rgb[2]), g = float(rgb[1] - rgb[2]), b = float(rgb[2]);
  return red * r + green * g + Spectrumf(b);
}

std::array<double, 3> Cluster::xyz(const Spectrumf& radiance) const {
  std::array<double, 3> sum{0, 0, 0};
  for (int i = 0; i < kWavelengths; ++i) {
    sum[0] += double(radiance[i]) * x[i];
    sum[1] += double(radiance[i]) * y[i];
    sum[2] += double(radiance[i]) * z[i];
  }
  return sum;
}

double cluster_number(float u) {
  constexpr int kBits = 24;
  const auto x = std::uint32_t(u * float(1 << kBits));
  std::uint32_t hero = 0, place = 0;
  for (int i = 0; i < kBits; ++i) {
    const std::uint32_t digit = x >> (kBits - 1 - i) & 1;
    const bool of_hero = i == 1 || i == 3 || i == 5;
    std::uint32_t& to = of_hero ? hero : place;
    to = to << 1 | digit;
  }
  return double(hero << (kBits - 3) | place) / (1 << kBits);
}

Cluster sample_cluster(double u) {
  static const double norm =
      1 / (materials::cie1931_integral().y * materials::illuminant_d65_luminance());
  Cluster c;
  c.lambda = sample_wavelengths(u);
  for (int i = 0; i < kWavelengths; ++i) {
    const double nm = c.lambda.nm[i];
    c.red[i] = materials::rgb_red(float(nm));
    c.green[i] = materials::rgb_green(float(nm));
    c.daylight[i] = float(materials::illuminant_d65(nm));
    const Vec3d weights = materials::cie1931(nm) * (norm / c.lambda.pdf[i]);
    c.x[i] = float(weights.x), c.y[i] = float(weights.y), c.z[i] = float(weights.z);
  }
  return c;
}

}  // namespace mms::renderer
