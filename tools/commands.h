// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The verbs of the command: one file and one row each.

#include "tools/verb.h"

namespace mms::tools {

Verb check_verb();
Verb render_verb();
Verb merge_verb();
Verb compare_verb();
Verb converge_verb();
Verb info_verb();
Verb eval_verb();
Verb bounds_verb();
Verb disasm_verb();
Verb compile_verb();
Verb accuracy_verb();
Verb profile_verb();
Verb furnace_verb();
Verb explain_verb();
Verb doc_verb();
Verb completion_verb();
Verb fmt_verb();
Verb test_verb();

/// In the order of `mms --help`.
inline constexpr Verb (*kVerbs[])() = {
    check_verb,   render_verb, merge_verb,  compare_verb, converge_verb, furnace_verb,
    info_verb,    eval_verb,   bounds_verb, disasm_verb,  compile_verb,  accuracy_verb,
    profile_verb, fmt_verb,    test_verb,   explain_verb, doc_verb,      completion_verb};

}  // namespace mms::tools
