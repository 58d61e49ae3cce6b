// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Compiled programs (`.mmsc`) where verbs take scripts.

#include <vector>

#include "base/result.h"
#include "lang/link.h"
#include "tools/script.h"

namespace mms::tools {

/// Whether one of the sources wants to be a compiled program, by its first bytes or its name.
bool any_stored(const std::vector<lang::SourcePtr>& sources);

/// The program in the only source, its images opened. Errors: there is another source too, it is
/// damaged, or does not fit this build; an image cannot be read, unless those are to be magenta,
/// which is then a warning in `diagnostics`. Of `options` whether they are, and who is told of
/// them. \pre `any_stored(sources)`
Result<lang::Linked> load_stored(const std::vector<lang::SourcePtr>& sources,
                                 const ScriptOptions& options, vm::ImageSource& images,
                                 lang::Diagnostics& diagnostics);

}  // namespace mms::tools
