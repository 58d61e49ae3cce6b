// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Source text to a Graph. Reports syntax errors only; any number of sources may be parsed at the
/// same time.

#include "lang/ast.h"
#include "lang/diagnostics.h"

namespace mms::lang {

/// Parses a whole source. After a syntax error parsing goes on at the next item, so the Graph
/// holds whatever was understood; it must not be linked if `diagnostics` has errors.
Graph parse(SourcePtr source, Diagnostics& diagnostics);
/// The same for [begin, end) of the source, which holds whole items.
Graph parse(SourcePtr source, Diagnostics& diagnostics, std::uint32_t begin, std::uint32_t end);

/// Parses one function header without a body, as a builtin row states it: `real sq(real x)`.
/// The function is the Graph's only one.
Graph parse_signature(SourcePtr source, Diagnostics& diagnostics);

/// Parses a single expression (a derivative rule, a command-line value). It is the last
/// expression of the Graph.
Graph parse_expression(SourcePtr source, Diagnostics& diagnostics);

}  // namespace mms::lang
