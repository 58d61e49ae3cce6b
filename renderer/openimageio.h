// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What is done to pictures through OpenImageIO. It lies in the module `mms_images` with what reads
/// images for scripts, and is loaded when it is first asked for: the hundreds of libraries behind
/// OpenImageIO take longer to load than a first picture takes to render. A .png that is written
/// does without (renderer/png.h).

#include <string>
#include <vector>

#include "renderer/picture.h"
#include "renderer/sheet.h"

namespace mms::renderer {

struct OpenImageIo {
  /// The bytes of an .exr with all layers.
  Result<std::string> (*exr)(const Picture& picture);
  /// `read_picture`.
  Result<ReadPicture> (*read)(const std::string& path, const std::string& layer);
  /// `tiles` of width x height pixels in rows of `columns`; each caption stands below its tile, all
  /// of one size that fits.
  Sheet (*sheet)(const std::vector<SheetTile>& tiles, int width, int height, int columns);
  /// `display_values` of Curve::OpenColorIO.
  Result<std::vector<float>> (*display)(const Film& film, const View& view);
};

/// For what is to be done with `file`. Error: the module is not there.
Result<const OpenImageIo*> open_image_io(const std::string& file);

/// Where the module has them.
namespace in_module {
Result<std::string> exr(const Picture& picture);
Result<ReadPicture> read(const std::string& path, const std::string& layer);
Sheet sheet(const std::vector<SheetTile>& tiles, int width, int height, int columns);
Result<std::vector<float>> display(const Film& film, const View& view);
}  // namespace in_module

}  // namespace mms::renderer
