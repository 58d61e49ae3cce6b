// SPDX-License-Identifier: Apache-2.0
#include "renderer/cluster.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
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

/// Of one wavelength: itself in nm, its density, the basis of `rgb`, daylight, XYZ, and XYZ where
/// matter is grey.
enum : std::size_t { kNm, kPdf, kRed, kGreen, kDaylight, kXyz, kGreyXyz = kXyz + 3 };
using Row = std::array<float, kGreyXyz>;

/// Rows at evenly spaced numbers of [0, 1]. Between them wavelengths are off by less than 3e-3 nm
/// at the ends of the spectrum, where they lie farthest apart, and by 1e-5 nm in its middle;
/// estimates, which are sums over all, by the square of the distance of rows.
constexpr int kRows = 4096;

/// Wavelengths of one cluster are so many rows apart.
constexpr int kStep = kRows / kWavelengths;
static_assert(kStep * kWavelengths == kRows);

/// For each number below kStep that many rows on, around the end: what each row has, for all the
/// wavelengths of a cluster. Twice, so that those from any hero on lie in one piece.
using Rows = std::array<std::array<float, 2 * kWavelengths>, kGreyXyz + 3>;

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

using Values = std::array<double, kWavelengths>;

double dot(const Values& a, const Values& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}
void add(Values& to, const Values& v, double times) {
  for (int w = 0; w < kWavelengths; ++w) to[w] += v[w] * times;
}

Values column(const Rows& rows, std::size_t k) {
  Values v;
  std::copy_n(rows[k].begin(), kWavelengths, v.begin());
  return v;
}

/// Spectra whose sums are all that lamps of a scene radiate.
std::array<Values, 3> lamps(const Rows& rows) {
  std::array<Values, 3> all{column(rows, kDaylight), column(rows, kRed), column(rows, kGreen)};
  for (int w = 0; w < kWavelengths; ++w)
    for (int k : {1, 2}) all[k][w] *= all[0][w];
  return all;
}

/// Moves weights of one of X, Y and Z by a sum of `lamps`, so that they see each as `exact` says.
void move_to(const std::array<double, 3>& exact, std::array<Values, 3> lamps, Values& weights) {
  // Lamp after lamp, of each what is at right angles to those before it.
  std::array<double, 3> wanted = exact;
  for (int k = 0; k < 3; ++k) {
    const double scale = 1 / dot(lamps[k], lamps[k]);
    add(weights, lamps[k], (wanted[k] - dot(weights, lamps[k])) * scale);
    for (int later = k + 1; later < 3; ++later) {
      const double part = dot(lamps[later], lamps[k]) * scale;
      add(lamps[later], lamps[k], -part);
      wanted[later] -= wanted[k] * part;
    }
  }
}

std::vector<Rows> make_rows() {
  std::vector<Rows> rows(kStep + 1);
  const auto set = [&](int i, std::size_t k, int w, double v) {
    rows[i][k][w] = rows[i][k][w + kWavelengths] = float(v);
  };
  for (int i = 0; i <= kStep; ++i)
    for (int w = 0; w < kWavelengths; ++w) {
      const Row r = row(i + kStep * w);
      for (std::size_t k = 0; k < r.size(); ++k) set(i, k, w, r[k]);
    }
  // What a lamp is on average over all clusters; of daylight, exactly what it is by definition.
  std::array<std::array<double, 3>, 3> exact{};
  for (int i = 0; i < kStep; ++i) {
    const std::array<Values, 3> all = lamps(rows[i]);
    for (std::size_t c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) exact[c][k] += dot(column(rows[i], kXyz + c), all[k]);
  }
  const double norm = kWavelengths / exact[1][0];
  for (std::size_t c = 0; c < 3; ++c) {
    for (double& e : exact[c]) e *= norm;
    for (int i = 0; i <= kStep; ++i) {
      Values weights = column(rows[i], kXyz + c);
      move_to(exact[c], lamps(rows[i]), weights);
      for (int w = 0; w < kWavelengths; ++w) set(i, kGreyXyz + c, w, weights[w]);
    }
  }
  return rows;
}

}  // namespace

Cluster sample_cluster(double u, int wavelengths, Matter matter) {
  static const std::vector<Rows> rows = make_rows();
  const double place = (u - std::floor(u)) * kRows;
  const int first = std::min(int(place), kRows - 1);
  const auto beyond = float(place - first);
  const int hero = first / kStep;
  const Rows &low = rows[first % kStep], &high = rows[first % kStep + 1];
  Cluster c;
  Spectrumf* const all[] = {&c.lambda.nm, &c.lambda.pdf, &c.red, &c.green,
                            &c.daylight,  &c.x,          &c.y,   &c.z};
  for (std::size_t k = 0; k < std::size(all); ++k) {
    const std::size_t from = k + (k >= kXyz && matter == Matter::Grey ? kGreyXyz - kXyz : 0);
    for (int i = 0; i < kWavelengths; ++i)
      all[k]->v[i] = low[from][hero + i] + (high[from][hero + i] - low[from][hero + i]) * beyond;
  }
  if (wavelengths == kWavelengths) return c;
  const Cluster every = c;  // fewer lie as far apart, and come again
  const Spectrumf* const from[] = {&every.lambda.nm, &every.lambda.pdf, &every.red, &every.green,
                                   &every.daylight,  &every.x,          &every.y,   &every.z};
  for (std::size_t k = 0; k < std::size(all); ++k)
    for (int i = 0; i < kWavelengths; ++i)
      all[k]->v[i] = from[k]->v[i % wavelengths * (kWavelengths / wavelengths)];
  return c;
}

}  // namespace mms::renderer
