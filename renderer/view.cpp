// SPDX-License-Identifier: Apache-2.0
// From linear pictures to what a display shows.
#include <OpenImageIO/color.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "materials/colour.h"
#include "renderer/picture.h"

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

/// The space of the configuration that holds CIE XYZ with a white of D65, or linear sRGB. The first
/// is a role that OpenColorIO 2 defines for it; the others are names in common use.
struct Space {
  std::string name;
  bool xyz = false;
};
std::optional<Space> interchange(const OIIO::ColorConfig& config) {
  if (const char* xyz = config.getColorSpaceNameByRole("cie_xyz_d65_interchange"))
    return Space{xyz, true};
  const std::vector<std::string> known = config.getColorSpaceNames();
  for (const char* name :
       {"lin_rec709", "lin_srgb", "Linear Rec.709 (sRGB)", "lin_rec709_srgb",
        "Utility - Linear - sRGB", "Utility - Linear - Rec.709", "Linear", "linear"})
    if (std::find(known.begin(), known.end(), name) != known.end()) return Space{name, false};
  return {};
}

Error unknown(const std::string& what, const std::string& name,
              const std::vector<std::string>& known) {
  return {"--view", fmt::format("the OpenColorIO configuration has no {} `{}`", what, name),
          fmt::format("it has: {}", fmt::join(known, ", "))};
}

/// Fills in what `view` leaves open.
Result<View> chosen(const OIIO::ColorConfig& config, View view) {
  const std::vector<std::string> displays = config.getDisplayNames();
  if (view.display.empty() && config.getDefaultDisplayName())
    view.display = config.getDefaultDisplayName();
  if (std::find(displays.begin(), displays.end(), view.display) == displays.end())
    return unknown("display", view.display, displays);
  const std::vector<std::string> views = config.getViewNames(view.display);
  if (view.view.empty() && config.getDefaultViewName(view.display))
    view.view = config.getDefaultViewName(view.display);
  if (std::find(views.begin(), views.end(), view.view) == views.end())
    return unknown("view", view.view, views);
  return view;
}

Result<std::vector<float>> by_open_color_io(const Film& film, const View& asked) {
  const char* variable = std::getenv("OCIO");
  const std::string file = asked.config.empty() && variable ? variable : asked.config;
  if (file.empty())
    return Error{"--view ocio", "no OpenColorIO configuration",
                 "name one: --ocio FILE, or set $OCIO"};
  OIIO::ColorConfig config(file);
  if (config.has_error())
    return Error{file, "cannot be read as an OpenColorIO configuration: " + config.geterror(), ""};
  const Result<View> view = chosen(config, asked);
  if (!view) return view.error();
  const auto space = interchange(config);
  if (!space)
    return Error{file, "does not say which of its colour spaces is linear sRGB or CIE XYZ",
                 "give it the role cie_xyz_d65_interchange"};
  OIIO::ImageBuf image(OIIO::ImageSpec(film.width, film.height, 3, OIIO::TypeDesc::FLOAT));
  const double scale = std::exp2(asked.exposure);
  for (std::size_t i = 0; i < film.xyz.size(); ++i) {
    const Vec3d xyz = Vec3d{film.xyz[i][0], film.xyz[i][1], film.xyz[i][2]} * scale;
    const Vec3d v = space->xyz ? xyz : materials::linear_srgb_of_xyz(xyz);
    const float pixel[3] = {float(v.x), float(v.y), float(v.z)};
    image.setpixel(int(i % std::size_t(film.width)), int(i / std::size_t(film.width)), pixel);
  }
  const OIIO::ImageBuf shown = OIIO::ImageBufAlgo::ociodisplay(
      image, view->display, view->view, space->name, "", true, "", "", &config);
  if (shown.has_error()) return Error{file, "OpenColorIO: " + shown.geterror(), ""};
  std::vector<float> values(film.xyz.size() * 3);
  shown.get_pixels(shown.roi(), OIIO::TypeDesc::FLOAT, values.data());
  for (float& v : values) v = v > 0 ? std::min(v, 1.0f) : 0;
  return values;
}

}  // namespace

std::span<const CurveInfo> curves() { return kCurves; }

Result<std::vector<float>> display_values(const Film& film, const View& view) {
  if (view.curve == Curve::OpenColorIO) return by_open_color_io(film, view);
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
