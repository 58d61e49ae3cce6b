// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What can be said of a Graph from its names alone.

#include "lang/ast.h"
#include "lang/diagnostics.h"

namespace mms::lang {

/// Warns of locals, params and named imports that nobody reads; a local whose name is close to an
/// output's is an error. Top-level functions and constants are what a script offers: they may go
/// unread, and where there is no descriptor so may the rest.
void lint(const Graph& graph, Diagnostics& diagnostics);

/// Whether `graph` may read a name that `part`, which it imports, defines.
bool uses(const Graph& graph, const Graph& part);

}  // namespace mms::lang
