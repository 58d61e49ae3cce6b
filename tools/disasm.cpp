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

Verb disasm_verb() {
  auto options = std::make_shared<ScriptOptions>();
  Verb verb{"disasm",
            "Print the bytecode that a script is linked to",
            "Examples:\n  mms disasm marble.mms\n  mms disasm -O0 marble.mms",
            {},
            [options] { return disasm(*options); }};
  add_files(verb, *options, "Scripts, linked together");
  add_script_options(verb, *options);
  return verb;
}

}  // namespace mms::tools
