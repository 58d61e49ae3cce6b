// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The manual of a script, from its `///` comments.

#include <string>

#include "lang/ast.h"

namespace mms::tools {

/// Surfaces, volumes, params, functions, constants and types of the script, as Markdown; what has
/// no comment is listed by its header. \pre `graph` was parsed without errors.
std::string script_document(const lang::Graph& graph);

}  // namespace mms::tools
