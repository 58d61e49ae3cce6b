// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Pictures for scripts, through OpenImageIO's image cache: files of any kind it reads, tiled
/// and mip-mapped (.tx) or not, held in memory tile by tile within a budget.

#include <memory>

#include "vm/images.h"

namespace mms::renderer {

/// Opens pictures; `megabytes` is the budget of the decoded tiles of all of them together. The
/// pictures keep what they need: they may outlive the source.
std::unique_ptr<vm::ImageSource> open_textures(double megabytes);

}  // namespace mms::renderer
