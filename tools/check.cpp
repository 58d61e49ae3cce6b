// SPDX-License-Identifier: Apache-2.0
// mms check: are these scripts right?
#include <algorithm>
#include <memory>

#include "tools/commands.h"
#include "tools/dependencies.h"
#include "tools/script.h"

namespace mms::tools {

namespace {

struct CheckOptions : ScriptOptions {
  DepsOption deps;
};

/// Each file is a program of its own; the worst result counts.
Exit check(const CheckOptions& options) {
  Exit worst = Exit::Ok;
  for (const std::string& file : options.files) {
    Exit exit = Exit::Ok;
    const auto compiled = compile_files({file}, options, exit);
    if (compiled && !options.deps.form.empty()) print_deps(file, *compiled, options.deps, options);
    worst = std::max(worst, exit);
  }
  return worst;
}

}  // namespace

Verb check_verb() {
  auto options = std::make_shared<CheckOptions>();
  Verb verb{"check",
            "Check scripts; says nothing if all is well",
            "Examples:\n  mms check marble.mms\n  mms check -Werror --format=json *.mms\n"
            "  mms check --deps=make marble.mms",
            {},
            [options] { return check(*options); }};
  add_files(verb, *options, "Scripts, each a program of its own");
  add_deps_option(verb, options->deps);
  add_script_options(verb, *options);
  add_format_option(verb, *options);
  return verb;
}

}  // namespace mms::tools
