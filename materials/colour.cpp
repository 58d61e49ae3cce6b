// SPDX-License-Identifier: Apache-2.0
#include "materials/colour.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace mms::materials {
namespace {

constexpr Vec3d kCie1931[] = {
#include "materials/cie1931.inc"
};
static_assert(std::size(kCie1931) == 471);

constexpr Vec3d cie1931_sum() {
  Vec3d sum;
  for (const Vec3d& row : kCie1931) sum += row;
  return sum;
}
constexpr Vec3d kIntegral = cie1931_sum();

// sRGB primaries (0.64, 0.33), (0.30, 0.60), (0.15, 0.06) and white (0.3127, 0.3290), solved in
// double; the standard prints four digits of it.
constexpr Vec3d kToXyz[] = {{0.4123907992659595, 0.357584339383878, 0.1804807884018343},
                            {0.2126390058715104, 0.715168678767756, 0.0721923153607337},
                            {0.0193308187155918, 0.119194779794626, 0.9505321522496607}};
constexpr Vec3d kToRgb[] = {{3.2409699419045213, -1.5373831775700935, -0.4986107602930033},
                            {-0.9692436362808798, 1.8759675015077206, 0.0415550574071756},
                            {0.0556300796969936, -0.2039769588889765, 1.0569715142428786}};

Vec3d times(const Vec3d (&m)[3], Vec3d v) { return {dot(m[0], v), dot(m[1], v), dot(m[2], v)}; }

double luminance(Vec3d rgb) { return dot(kToXyz[1], rgb); }

Vec3d clamp01(Vec3d v) {
  return {std::clamp(v.x, 0.0, 1.0), std::clamp(v.y, 0.0, 1.0), std::clamp(v.z, 0.0, 1.0)};
}

}  // namespace

Vec3d cie1931(double lambda_nm) {
  const double t = lambda_nm - kLambdaMin;
  if (!(t >= 0 && t <= kLambdaMax - kLambdaMin)) return {};
  const int i = std::min(int(t), int(std::size(kCie1931)) - 2);
  const double u = t - i;
  return kCie1931[i] * (1 - u) + kCie1931[i + 1] * u;
}

Vec3d cie1931_integral() { return kIntegral; }

Vec3d xyz_of_sample(double lambda_nm, double value, double pdf) {
  if (!(pdf > 0)) return {};
  return cie1931(lambda_nm) * (value / (pdf * kIntegral.y));
}

Vec3d xyz_of_cluster(const Wavelengths& w, const Spectrumf& value) {
  Vec3d sum;
  for (int j = 0; j < kWavelengths; ++j) sum += xyz_of_sample(w.nm[j], value[j], w.pdf[j]);
  return sum / double(kWavelengths);
}

Vec3d linear_srgb_of_xyz(Vec3d xyz) { return times(kToRgb, xyz); }
Vec3d xyz_of_linear_srgb(Vec3d rgb) { return times(kToXyz, rgb); }

double map_luminance(double y, double sensitivity, double contrast) {
  const double t = sensitivity * y;
  if (!(t > 0)) return 0;
  return -std::expm1(-std::numbers::ln2 * std::pow(t, contrast));
}

Vec3d desaturate_to_srgb(Vec3d xyz) {
  const double y = std::clamp(xyz.y, 0.0, 1.0);
  const Vec3d clamped = clamp01(linear_srgb_of_xyz(xyz));
  const double missing = y - luminance(clamped);
  const Vec3d towards = missing <= 0 ? clamped : Vec3d{1, 1, 1} - clamped;
  const double step = luminance(towards);
  // A step of 0 means that the colour is black or white already and nothing is missing.
  return step > 0 ? clamp01(clamped + towards * (missing / step)) : clamped;
}

Vec3d tone_map(Vec3d xyz, double sensitivity, double contrast) {
  if (!(xyz.y > 0)) return {};
  const double y = map_luminance(xyz.y, sensitivity, contrast);
  if (std::isinf(xyz.y)) return {1, 1, 1};
  const double x_ratio = xyz.x / xyz.y, z_ratio = xyz.z / xyz.y;
  if (!std::isfinite(x_ratio) || !std::isfinite(z_ratio)) return {};
  return desaturate_to_srgb({x_ratio * y, y, z_ratio * y});
}

double srgb_encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace mms::materials
