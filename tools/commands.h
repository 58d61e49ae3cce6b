// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The verbs of the command: one file each.

#include <CLI/CLI.hpp>

#include "tools/exit.h"

namespace mms::tools {

/// Adds a verb to the command; when it has been run, `exit` says how it went.
using AddVerb = void (*)(CLI::App& command, Exit& exit);

void add_check(CLI::App& command, Exit& exit);
void add_render(CLI::App& command, Exit& exit);
void add_info(CLI::App& command, Exit& exit);
void add_eval(CLI::App& command, Exit& exit);
void add_disasm(CLI::App& command, Exit& exit);
void add_explain(CLI::App& command, Exit& exit);
void add_doc(CLI::App& command, Exit& exit);

inline constexpr AddVerb kVerbs[] = {add_check,  add_render,  add_info, add_eval,
                                     add_disasm, add_explain, add_doc};

/// The name, the version, the exit codes and all verbs.
void build_command(CLI::App& command, Exit& exit);

}  // namespace mms::tools
