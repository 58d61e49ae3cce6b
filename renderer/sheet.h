// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Contact sheets: pictures of one size beside and below each other, with captions.

#include <string>
#include <vector>

#include "base/result.h"

namespace mms::renderer {

struct SheetTile {
  std::vector<unsigned char> pixels;  ///< 8-bit sRGB, three a pixel, row by row; empty is grey
  std::string caption;
};

struct Sheet {
  int width = 0, height = 0;
  std::vector<unsigned char> pixels;
  bool captions = true;  ///< false where no font was found: then the strips are empty
};

/// `tiles` of width x height pixels in rows of `columns`; each caption stands below its tile, all
/// of one size that fits. Error: OpenImageIO, which draws the captions, is not there.
Result<Sheet> make_sheet(const std::vector<SheetTile>& tiles, int width, int height, int columns);

}  // namespace mms::renderer
