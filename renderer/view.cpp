// SPDX-License-Identifier: Apache-2.0
// From linear pictures to what a display shows.
#include <algorithm>
#include <cmath>

#include "materials/colour.h"
#include "renderer/openimageio.h"

namespace mms::renderer {
namespace {

constexpr CurveInfo kCurves[] = {
    {Curve::Thesis, "thesis", "luminance rolls off, colours that do not fit fade to white"},
    {Curve::Srgb, "srgb", "as it is; what does not fit is cut off"},
    {Curve::OpenColorIO, "ocio", "a view of an OpenColorIO configuration"},
};

/// One colour, by the curves that need nothing but themselves.
Vec3d displayed(const View& view, Vec3d xyz, double scale) {
  if (view.curve == Curve::Thesis)
    return materials::tone_map(xyz, view.sensitivity * scale, view.contrast);
  const Vec3d rgb = materials::linear_srgb_of_xyz(xyz * scale);
  const auto cut = [](double v) { return v > 0 ? std::min(v, 1.0) : 0.0; };  // NaN is black
  return {cut(rgb.x), cut(rgb.y), cut(rgb.z)};
}

}  // namespace

std::span<const CurveInfo> curves() { return kCurves; }

Result<std::vector<float>> display_values(const Film& film, const View& view) {
  if (view.curve == Curve::OpenColorIO) {
    const auto io = open_image_io("--view ocio");
    if (!io) return io.error();
    return (*io)->display(film, view);
  }
  const double scale = std::exp2(view.exposure);
  std::vector<float> values;
  values.reserve(film.xyz.size() * 3);
  for (const auto& p : film.xyz) {
    const Vec3d rgb = displayed(view, {p[0], p[1], p[2]}, scale);
    for (int k = 0; k < 3; ++k) values.push_back(float(materials::srgb_encode(rgb[k])));
  }
  return values;
}

Result<std::vector<unsigned char>> display_pixels(const Film& film, const View& view) {
  const auto values = display_values(film, view);
  if (!values) return values.error();
  std::vector<unsigned char> bytes(values->size());
  std::transform(values->begin(), values->end(), bytes.begin(),
                 [](float v) { return static_cast<unsigned char>(std::lround(255 * v)); });
  return bytes;
}

}  // namespace mms::renderer
