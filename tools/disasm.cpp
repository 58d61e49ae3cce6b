// SPDX-License-Identifier: Apache-2.0
// mms disasm: the bytecode of a script, as text.
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "tools/commands.h"
#include "tools/script.h"
#include "vm/verify.h"

namespace mms::tools {

namespace {

Exit disasm(const ScriptOptions& options) {
  Exit exit = Exit::Ok;
  if (const auto linked = compile_files(options.files, options, exit))
    fmt::print("{}", vm::disassemble(linked->program));
  return exit;
}

}  // namespace

void add_disasm(CLI::App& command, Exit& exit) {
  CLI::App* verb =
      command.add_subcommand("disasm", "Print the bytecode that a script is linked to");
  auto options = std::make_shared<ScriptOptions>();
  verb->add_option("FILE", options->files, "Scripts, linked together; - is standard input")
      ->required()
      ->type_name("");
  add_script_options(*verb, *options);
  verb->footer("Examples:\n  mms disasm marble.mms\n  mms disasm -O0 marble.mms");
  verb->callback([options, &exit] { exit = disasm(*options); });
}

}  // namespace mms::tools
