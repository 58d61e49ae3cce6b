// SPDX-License-Identifier: Apache-2.0
#include "renderer/sky.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/warp.h"
#include "renderer/latlong.h"

namespace mms::renderer {
namespace {

/// 0.7 degrees a texel: what changes fastest, the brightness around the sun, halves within 13.
constexpr int kWidth = 512, kHeight = 256;

// Types 1 and 12 of the standard's Table 1. The blue of the clear one is a choice of ours: the
// red, green and blue whose spectrum, as a light (thesis Table 6.1), has the chromaticity of CIE
// daylight of 15000 K.
constexpr Sky kSkies[] = {
    {"overcast", 4, -0.7, 0, -1, 0, {1, 1, 1}},
    {"clear", -1, -0.32, 10, -3, 0.45, {0.7202, 1.0438, 1.6956}},
};

/// In units of a constant that depends on the sky and the sun alone. `cos_z` is above 0.
double relative_luminance(const Sky& s, double cos_z, double cos_chi) {
  const double chi = std::acos(std::clamp(cos_chi, -1.0, 1.0));
  const double gradation = 1 + s.a * std::exp(s.b / cos_z);
  const double indicatrix =
      1 + s.c * (std::exp(s.d * chi) - std::exp(s.d * kPi<double> / 2)) + s.e * cos_chi * cos_chi;
  return gradation * indicatrix;
}

}  // namespace

std::span<const Sky> skies() { return kSkies; }

EnvironmentImage make_sky(const Sky& sky, Vec3d sun) {
  const Vec3d to_sun = normalize(sun);
  constexpr int kAbove = kWidth * kHeight / 2;
  std::vector<double> luminance;
  luminance.reserve(kAbove);
  double irradiance = 0;
  for (int y = 0; y < kHeight / 2; ++y) {
    // The solid angle of a texel, times the mean cosine over it.
    const double top = std::sin(kPi<double> * y / kHeight);
    const double bottom = std::sin(kPi<double> * (y + 1) / kHeight);
    const double projected = (bottom * bottom - top * top) * kPi<double> / kWidth;
    for (int x = 0; x < kWidth; ++x) {
      const Vec3d d = latlong_direction((x + 0.5) / kWidth, (y + 0.5) / kHeight, 0);
      luminance.push_back(relative_luminance(sky, d.y, dot(d, to_sun)));
      irradiance += luminance.back() * projected;
    }
  }
  EnvironmentImage image{"", kWidth, kHeight, {}};
  image.rgb.reserve(2 * kAbove);
  for (const double l : luminance) {
    const double radiance = l * kPi<double> / irradiance;
    image.rgb.push_back({float(radiance * sky.colour[0]), float(radiance * sky.colour[1]),
                         float(radiance * sky.colour[2])});
  }
  image.rgb.insert(image.rgb.end(), image.rgb.end() - kWidth, image.rgb.end());
  image.rgb.resize(2 * kAbove, {kSkyGround, kSkyGround, kSkyGround});
  return image;
}

}  // namespace mms::renderer
