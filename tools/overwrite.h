// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Outputs that would take the place of what they are made from.

#include <optional>
#include <span>
#include <string>

#include "base/result.h"

namespace mms::tools {

/// An error where `output` is the same file as one of `inputs`, by whatever path. What is not there
/// is the same as nothing.
std::optional<Error> overwrites(const std::string& output, std::span<const std::string> inputs);

}  // namespace mms::tools
