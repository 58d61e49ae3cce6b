// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Whether a PNG file is whole. libpng writes what it meets to standard error, whoever asked it to
/// read, so a file that is cut off or damaged is found out before it gets there.

#include <string>

namespace mms::renderer {

/// What is wrong with the chunks of a PNG file: one that is cut off, or a checksum. Empty where
/// nothing is, and of a file that is no PNG.
std::string png_fault(const std::string& path);

}  // namespace mms::renderer
