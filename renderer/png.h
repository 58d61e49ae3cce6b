// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Pictures as .png, in memory.

#include <span>
#include <string>

#include "renderer/picture.h"

namespace mms::renderer {

/// The bytes of a file of 8-bit sRGB pixels, three bytes each, row by row.
Result<std::string> png(int width, int height, std::span<const unsigned char> pixels,
                        const Metadata& metadata);

}  // namespace mms::renderer
