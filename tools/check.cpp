// SPDX-License-Identifier: Apache-2.0
// mms check: are these scripts right?
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "tools/commands.h"
#include "tools/script.h"

namespace mms::tools {

namespace {

/// Each file is a program of its own; the worst result counts.
Exit check(const ScriptOptions& options) {
  Exit worst = Exit::Ok;
  for (const std::string& file : options.files) {
    Exit exit = Exit::Ok;
    compile_files({file}, options, exit);
    if (exit > worst) worst = exit;
  }
  return worst;
}

}  // namespace

Verb check_verb() {
  auto options = std::make_shared<ScriptOptions>();
  Verb verb{"check",
            "Check scripts; says nothing if all is well",
            "Examples:\n  mms check marble.mms\n  mms check -Werror --format=json *.mms",
            {},
            [options] { return check(*options); }};
  add_files(verb, *options, "Scripts, each a program of its own");
  add_script_options(verb, *options);
  add_format_option(verb, *options);
  return verb;
}

}  // namespace mms::tools
