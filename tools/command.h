// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The command line: from words to a verb that runs. The one place that knows CLI11.

#include <string>
#include <vector>

#include "tools/verb.h"

namespace mms::tools {

/// Reads the command line, runs its verb and flushes standard output.
Exit run_command(int argc, const char* const* argv);

/// Every verb, as `mms --help` lists them.
std::vector<Verb> verbs();

/// What `mms --help` prints, or `mms VERB --help` for each of `verbs()`, in order.
std::string command_help();
std::vector<std::string> verb_helps();

}  // namespace mms::tools
