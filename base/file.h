// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Writing files so that nobody ever finds half of one.

#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"

namespace mms {

/// What would keep `replace_file` from writing to `path`, as far as that can be told before there
/// is anything to write: it is a folder, lies in none, or may not be written.
std::optional<Error> check_replaceable(const std::string& path);

/// Puts `text`, which may be any bytes, in the place of the file at `path`, which keeps its
/// permissions: the old file or the new one is there at every moment. Follows symbolic links. The
/// error says what failed.
std::optional<Error> replace_file(const std::string& path, std::string_view text);

}  // namespace mms
