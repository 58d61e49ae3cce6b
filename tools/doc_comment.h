// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What stands in `///` comments: text, and examples that `mms test` runs.
///
///     /// Half of it.
///     /// >>> half(3)
///     /// 1.5

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lang/source.h"

namespace mms::tools {

struct Example {
  std::uint32_t line = 0;  ///< of the expression
  std::string expression;  ///< after `>>>`
  std::string expected;    ///< the lines below, to an empty one or the next `>>>`; may be empty
};

/// Every example of the source, in order.
std::vector<Example> examples_of(const lang::Source& source);

/// The text of a doc comment as Markdown: examples become code blocks.
std::string doc_markdown(std::string_view doc);

}  // namespace mms::tools
