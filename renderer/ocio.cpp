// SPDX-License-Identifier: Apache-2.0
// From linear pictures to what a display shows, by OpenColorIO.
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
#include "renderer/openimageio.h"

namespace mms::renderer {
namespace {

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

}  // namespace

Result<std::vector<float>> in_module::display(const Film& film, const View& asked) {
  const char* variable = std::getenv("OCIO");
  const std::string file = asked.config.empty() && variable ? variable : asked.config;
  if (file.empty())
    return Error{"--view ocio", "no OpenColorIO configuration",
                 "name one: --ocio FILE, or set $OCIO"};
  OIIO::ColorConfig config(file);
  if (config.has_error())
    return Error{file, "cannot be read as an OpenColorIO configuration: " + config.geterror(),
                 "check the spelling of what --ocio or $OCIO names"};
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

}  // namespace mms::renderer
