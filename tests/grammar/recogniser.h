// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// docs/grammar.y at work: bison's parser, fed by the lexer.

#include <set>
#include <string>
#include <vector>

#include "lang/source.h"

namespace mms::grammar {

struct Recognition {
  bool accepted = false;
  std::set<int> rules;  ///< numbers of the rules that were reduced, if they were asked for
};

enum class Rules { Ignored, Noted };

/// Whether the published grammar derives the source. Not for several threads at once.
Recognition recognise(const lang::SourcePtr& source, Rules rules = Rules::Ignored);

/// The rules by number, as `left: right`; from the report that bison writes.
std::vector<std::string> all_rules();

}  // namespace mms::grammar
