// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Picture files: what a render leaves, and what is read again to be compared. Files are replaced
/// whole or not at all.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/layers.h"
#include "renderer/render.h"

namespace mms::renderer {

/// How a linear picture becomes a display picture.
enum class Curve : std::uint8_t { Thesis, Srgb, OpenColorIO };

struct CurveInfo {
  Curve curve;
  std::string_view name;
  std::string_view doc;
};

/// Every curve, in the order of Curve; the default first.
std::span<const CurveInfo> curves();

/// Ignored for linear formats.
struct View {
  Curve curve = Curve::Thesis;
  double exposure = 0;  ///< stops
  /// Of the thesis' curve y' = 1 - 2^(-(sensitivity y)^contrast), 6.1.3; both positive. At these,
  /// mid grey (0.18 of a white matte surface in light of 1) is shown at luminance 0.19 and white at
  /// 0.69; highlights roll off.
  double sensitivity = 1.7, contrast = 1;
  /// Of OpenColorIO: the file of a configuration, and the display and view in it. Empty:
  /// $OCIO, the default display, its default view.
  std::string config = {}, display = {}, view = {};
};

/// What a picture says of itself: names and values, in the order of the file.
using Metadata = std::vector<std::pair<std::string, std::string>>;

struct Picture {
  const Film& film;
  const Layers* layers = nullptr;  ///< written to .exr, where they are there
  Metadata metadata = {};
};

/// Whether `path` has a supported extension (pictures and films), its folder can be written to, and
/// what writes an .exr is there.
Result<Done> check_writable(const std::string& path);

/// Pixels as encoded sRGB in [0, 1] (or whatever the OpenColorIO view is for), row by row, three a
/// pixel. Errors: no such configuration, display or view.
Result<std::vector<float>> display_values(const Film& film, const View& view);

/// The same in 8 bits.
Result<std::vector<unsigned char>> display_pixels(const Film& film, const View& view);

/// Writes .png (8 bit, by `view`) or .exr (32-bit float: linear sRGB primaries as R, G, B, and
/// named layers).
Result<Done> write_picture(const std::string& path, const Picture& picture, const View& view = {});

/// Writes 8-bit sRGB pixels as .png. \pre three bytes for each pixel
Result<Done> write_png(const std::string& path, int width, int height,
                       std::span<const unsigned char> pixels, const Metadata& metadata = {});

/// A picture file of anyone's, or one layer of it.
struct ReadPicture {
  int width = 0, height = 0;
  std::vector<std::array<float, 3>> rgb;  ///< linear, row by row, top first; any float
  std::vector<float> variance;            ///< of our own layer of that name; else empty
  Metadata metadata;                      ///< what is text
  bool encoded = false;                   ///< held display values, as .png does
};

/// Everything that OpenImageIO reads; encoded pictures are linearised. `layer`: empty is the
/// picture, else as our .exr files name them; one channel is given three times. Errors: unreadable,
/// a film, no such layer.
Result<ReadPicture> read_picture(const std::string& path, const std::string& layer = "");

}  // namespace mms::renderer
