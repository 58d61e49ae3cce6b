// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// `--deps`: the files that a script is made of besides itself.

#include <string>

#include "tools/script.h"

namespace mms::tools {

/// How `--deps` was given: not at all, as a list, or as a rule for make.
struct DepsOption {
  std::string form;  ///< empty, `list` or `make`
};

/// Adds `--deps` and `--deps=make`.
void add_deps_option(Verb& verb, DepsOption& option);

/// Prints the files that `file` imports, directly or not: one a line; or a rule that its picture
/// (NAME.png) depends on it and them; or one JSON object.
void print_deps(const std::string& file, const lang::Linked& linked, const DepsOption& option,
                const ScriptOptions& options);

}  // namespace mms::tools
