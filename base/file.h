// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Writing files so that nobody ever finds half of one.

#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"

namespace mms {

/// Puts `text`, which may be any bytes, in the place of the file at `path`, which keeps its
/// permissions: the old file or the new one is there at every moment. Follows symbolic links. The
/// error says what failed.
std::optional<Error> replace_file(const std::string& path, std::string_view text);

}  // namespace mms
