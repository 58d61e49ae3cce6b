// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What can be said of a Graph from its names alone.

#include "lang/ast.h"
#include "lang/diagnostics.h"

namespace mms::lang {

/// Warns of locals nobody reads; one whose name is close to an output's is an error.
void lint(const Graph& graph, Diagnostics& diagnostics);

}  // namespace mms::lang
