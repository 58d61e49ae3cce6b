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

void add_check(CLI::App& command, Exit& exit) {
  CLI::App* verb = command.add_subcommand("check", "Check scripts; says nothing if all is well");
  auto options = std::make_shared<ScriptOptions>();
  verb->add_option("FILE", options->files,
                   "Scripts, each a program of its own; - is standard input")
      ->required()
      ->type_name("");
  add_script_options(*verb, *options);
  add_format_option(*verb, *options);
  verb->footer("Examples:\n  mms check marble.mms\n  mms check -Werror --format=json *.mms");
  verb->callback([options, &exit] { exit = check(*options); });
}

}  // namespace mms::tools
