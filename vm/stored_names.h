// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// From this build's numbers to names, and back. Internal to vm.

#include <optional>
#include <span>
#include <string>

#include "vm/stored_form.h"

namespace mms::vm {

/// \pre `package.program` is verified, with rows and lobes of `library`.
StoredForm name_all(Package package, std::span<const Builtin> library);

/// Replaces names by this build's numbers; why not, if one is missing or out of place. The
/// package's program is then as it was linked, but not verified.
std::optional<Error> number_all(StoredForm& form, std::span<const Builtin> library);

}  // namespace mms::vm
