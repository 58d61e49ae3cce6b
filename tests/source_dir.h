// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace mms {

/// The root of the project's sources. Only one object is told where they lie, so that a compiler's
/// cache serves every clone.
const std::filesystem::path& source_dir();

}  // namespace mms
