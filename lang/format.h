// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Lays a script out: indentation by 4, one space where one belongs, `=` in line within a body,
/// lines of at most kFormatWidth columns, at most one blank line. Where an author broke a line
/// it stays broken, and a block that has a line break gets a line for each of its statements.
/// Tokens and comments stay what they are, in their order.

#include <optional>
#include <string>

#include "lang/diagnostics.h"
#include "lang/source.h"

namespace mms::lang {

/// Columns of a line, where its code can be broken; comments are never.
inline constexpr int kFormatWidth = 100;

/// The text of `source`, laid out. Formatting it again changes nothing. Empty where the source has
/// syntax errors, which `diagnostics` then holds.
std::optional<std::string> format(const SourcePtr& source, Diagnostics& diagnostics);

}  // namespace mms::lang
