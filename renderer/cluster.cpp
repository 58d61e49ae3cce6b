// SPDX-License-Identifier: Apache-2.0
#include "renderer/cluster.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

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

double cluster_number(float u, int wavelengths) {
  constexpr int kBits = 24;
  const auto x = std::uint32_t(u * float(1 << kBits));
  const int hero_bits = std::countr_zero(unsigned(wavelengths));
  std::uint32_t hero = 0, place = 0;
  for (int i = 0; i < kBits; ++i) {
    const std::uint32_t digit = x >> (kBits - 1 - i) & 1;
    const bool of_hero = i % 2 == 1 && i < 2 * hero_bits;
    std::uint32_t& to = of_hero ? hero : place;
    to = to << 1 | digit;
  }
  return double(hero << (kBits - hero_bits) | place) / (1 << kBits);
}

namespace {

/// Of one wavelength: itself in nm, its density, the basis of `rgb`, daylight, and XYZ.
using Row = std::array<float, 8>;

/// Rows at evenly spaced numbers of [0, 1]. Between them wavelengths are off by less than 3e-3 nm
/// at the ends of the spectrum, where they lie farthest apart, and by 1e-5 nm in its middle;
/// estimates, which are sums over all, by the square of the distance of rows.
constexpr int kRows = 4096;

std::vector<Row> make_rows() {
  const double norm = 1 / (materials::cie1931_integral().y * materials::illuminant_d65_luminance());
  std::vector<Row> rows;
  for (int i = 0; i <= kRows; ++i) {
    const double u = std::min(double(i) / kRows, 1 - 0x1p-53);
    const Wavelengths hero = sample_wavelengths(u);
    const double nm = hero.nm[0];
    const Vec3d weights = materials::cie1931(nm) * (norm / hero.pdf[0]);
    rows.push_back({hero.nm[0], hero.pdf[0], float(materials::rgb_red(float(nm))),
                    float(materials::rgb_green(float(nm))), float(materials::illuminant_d65(nm)),
                    float(weights.x), float(weights.y), float(weights.z)});
  }
  return rows;
}

}  // namespace

Cluster sample_cluster(double u, int wavelengths) {
  static const std::vector<Row> rows = make_rows();
  Cluster c;
  for (int i = 0; i < kWavelengths; ++i) {
    double place = u + double(i % wavelengths) / wavelengths;
    place = (place - std::floor(place)) * kRows;
    const auto row = std::size_t(place);
    const auto beyond = float(place - double(row));
    Row r;
    for (std::size_t k = 0; k < r.size(); ++k)
      r[k] = rows[row][k] + (rows[row + 1][k] - rows[row][k]) * beyond;
    c.lambda.nm[i] = r[0], c.lambda.pdf[i] = r[1];
    c.red[i] = r[2], c.green[i] = r[3], c.daylight[i] = r[4];
    c.x[i] = r[5], c.y[i] = r[6], c.z[i] = r[7];
  }
  return c;
}

}  // namespace mms::renderer
