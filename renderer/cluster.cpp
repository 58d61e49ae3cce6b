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
  const int hero_bits = std::countr_zero(unsigned(wavelengths)), rest = kBits - 2 * hero_bits;
  std::uint32_t hero = 0, place = 0;
  for (int i = hero_bits; i-- > 0;) {
    place = place << 1 | (x >> (rest + 2 * i + 1) & 1);
    hero = hero << 1 | (x >> (rest + 2 * i) & 1);
  }
  place = place << rest | (x & ((1u << rest) - 1));
  return double(hero << (kBits - hero_bits) | place) / (1 << kBits);
}

namespace {

/// Of one wavelength: itself in nm, its density, the basis of `rgb`, daylight, and XYZ.
using Row = std::array<float, 8>;

/// Rows at evenly spaced numbers of [0, 1]. Between them wavelengths are off by less than 3e-3 nm
/// at the ends of the spectrum, where they lie farthest apart, and by 1e-5 nm in its middle;
/// estimates, which are sums over all, by the square of the distance of rows.
constexpr int kRows = 4096;

/// Wavelengths of one cluster are so many rows apart.
constexpr int kStep = kRows / kWavelengths;
static_assert(kStep * kWavelengths == kRows);

/// For each number below kStep that many rows on, around the end: what each row has, for all the
/// wavelengths of a cluster. Twice, so that those from any hero on lie in one piece.
using Rows = std::array<std::array<float, 2 * kWavelengths>, 8>;

Row row(int i) {
  static const double norm =
      1 / (materials::cie1931_integral().y * materials::illuminant_d65_luminance());
  const Wavelengths hero = sample_wavelengths(std::min(double(i) / kRows, 1 - 0x1p-53));
  const double nm = hero.nm[0];
  const Vec3d weights = materials::cie1931(nm) * (norm / hero.pdf[0]);
  return {hero.nm[0],
          hero.pdf[0],
          float(materials::rgb_red(float(nm))),
          float(materials::rgb_green(float(nm))),
          float(materials::illuminant_d65(nm)),
          float(weights.x),
          float(weights.y),
          float(weights.z)};
}

std::vector<Rows> make_rows() {
  std::vector<Rows> rows(kStep + 1);
  for (int i = 0; i <= kStep; ++i)
    for (int w = 0; w < kWavelengths; ++w) {
      const Row r = row(i + kStep * w);
      for (std::size_t k = 0; k < r.size(); ++k)
        rows[i][k][w] = rows[i][k][w + kWavelengths] = r[k];
    }
  return rows;
}

}  // namespace

Cluster sample_cluster(double u, int wavelengths) {
  static const std::vector<Rows> rows = make_rows();
  const double place = (u - std::floor(u)) * kRows;
  const int first = std::min(int(place), kRows - 1);
  const auto beyond = float(place - first);
  const int hero = first / kStep;
  const Rows &low = rows[first % kStep], &high = rows[first % kStep + 1];
  Cluster c;
  Spectrumf* const all[] = {&c.lambda.nm, &c.lambda.pdf, &c.red, &c.green,
                            &c.daylight,  &c.x,          &c.y,   &c.z};
  for (std::size_t k = 0; k < low.size(); ++k)
    for (int i = 0; i < kWavelengths; ++i)
      all[k]->v[i] = low[k][hero + i] + (high[k][hero + i] - low[k][hero + i]) * beyond;
  if (wavelengths == kWavelengths) return c;
  const Cluster every = c;  // fewer lie as far apart, and come again
  const Spectrumf* const from[] = {&every.lambda.nm, &every.lambda.pdf, &every.red, &every.green,
                                   &every.daylight,  &every.x,          &every.y,   &every.z};
  for (std::size_t k = 0; k < low.size(); ++k)
    for (int i = 0; i < kWavelengths; ++i)
      all[k]->v[i] = from[k]->v[i % wavelengths * (kWavelengths / wavelengths)];
  return c;
}

}  // namespace mms::renderer
