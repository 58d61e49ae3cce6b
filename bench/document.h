// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// docs/performance.md is made of parts, each written by one benchmark between two marks; the
/// order of the parts in the file stays.

#include <string>
#include <string_view>

namespace mms::bench {

/// Puts `text` in place of the part `name` of docs/performance.md, or at its end if there is none.
/// False, with a message on standard error, where the file cannot be written.
bool write_part(std::string_view name, std::string_view text);

}  // namespace mms::bench
