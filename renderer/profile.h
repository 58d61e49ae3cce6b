// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A lamp's photometric file (.ies) as scripts see it: a picture whose u is the horizontal angle in
/// turns and whose v is the vertical angle in half turns, of luminous intensity in candela. Its
/// angles are its own, so it is never filtered; blur and wrap mode mean nothing.

#include <memory>

#include "base/result.h"
#include "vm/images.h"

namespace mms::renderer {

/// By its name.
bool is_profile(const std::string& file);

/// The error's `what` goes on after the file's name.
Result<std::shared_ptr<const vm::Image>> open_profile(const std::string& file);

}  // namespace mms::renderer
