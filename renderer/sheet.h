// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Contact sheets: pictures of one size beside and below each other, with captions.

#include <string>
#include <vector>

namespace mms::renderer {

struct SheetTile {
  std::vector<unsigned char> pixels;  ///< 8-bit sRGB, three a pixel, row by row; empty is grey
  std::vector<std::string> caption;   ///< lines
};

struct Sheet {
  int width = 0, height = 0;
  std::vector<unsigned char> pixels;
  bool captions = true;  ///< false where no font was found: then the strips are empty
};

}  // namespace mms::renderer
