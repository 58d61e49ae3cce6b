// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Measured curves over the wavelength that scripts read from text files.
///
/// A file has one row a line: the wavelength, then one value or several, separated by blanks,
/// commas, semicolons or tabs. Empty lines and what follows `#` or `//` count for nothing. A line
/// of words names the columns of the rows that follow it, up to the next such line: a file may
/// hold several tables one after another.

#include <memory>
#include <string>
#include <string_view>

#include "vm/images.h"

namespace mms::materials {

/// A curve from a text: linear between rows, ends held. `use` names the unit of its wavelengths
/// (vm::kCurveUnits), and the column: a name or a place, that of the wavelengths being 0; empty:
/// the second one. Errors say the line.
Result<std::shared_ptr<const vm::Image>> read_curve(std::string_view text, const vm::ImageUse& use);

/// The same of the file that `use` names.
Result<std::shared_ptr<const vm::Image>> open_curve(const vm::ImageUse& use);

}  // namespace mms::materials
