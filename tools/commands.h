// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The verbs of the command: one file and one row each.

#include "tools/verb.h"

namespace mms::tools {

Verb check_verb();
Verb render_verb();
Verb info_verb();
Verb eval_verb();
Verb bounds_verb();
Verb disasm_verb();
Verb explain_verb();
Verb doc_verb();

/// In the order of `mms --help`.
inline constexpr Verb (*kVerbs[])() = {check_verb,  render_verb, info_verb,    eval_verb,
                                       bounds_verb, disasm_verb, explain_verb, doc_verb};

}  // namespace mms::tools
