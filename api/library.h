// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What every program that links scripts needs first: the standard library in the form that the
/// linker takes, and the text of a file.

#include <string>

#include "base/result.h"
#include "lang/link.h"

namespace mms::api {

/// The standard library. Immutable; shared by all threads.
const lang::Library& standard_library();

/// Reads the file at `path`, or standard input where `path` is `-` (named `<stdin>`); where there
/// is no such file, the library's script of that name (named `<openpbr>`). Errors: it cannot be
/// read, is a folder, is larger than limits::kSourceBytes, or holds nothing but white space.
Result<lang::SourcePtr> read_source(const std::string& path);

}  // namespace mms::api
