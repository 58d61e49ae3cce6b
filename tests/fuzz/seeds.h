// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the target `load` starts from.

#include <cstddef>
#include <string>
#include <vector>

#include "lang/link.h"

namespace mms::fuzz {

/// The script in a file, linked and stored; empty if it does not link.
std::vector<std::byte> store(const std::string& script, lang::Level level);

}  // namespace mms::fuzz
