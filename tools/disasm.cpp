// SPDX-License-Identifier: Apache-2.0
// mms disasm: the bytecode of a script, and the code that runs, as text.
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "api/excerpts.h"
#include "tools/commands.h"
#include "tools/script.h"
#include "vm/listing.h"
#include "vm/verify.h"

namespace mms::tools {

namespace {

Exit disasm(const ScriptOptions& options) {
  Exit exit = Exit::Ok;
  const auto linked = compile_files(options.files, options, exit);
  if (!linked) return exit;
  const vm::Program& program = linked->program;
  api::Excerpts excerpts(program);
  const auto text_of = [&](vm::SourceLine line) { return excerpts.line(line); };
  fmt::print("{}{}", vm::disassemble(program),
             vm::disassemble(program, vm::lower(program), text_of));
  return exit;
}

}  // namespace

Verb disasm_verb() {
  auto options = std::make_shared<ScriptOptions>();
  Verb verb{"disasm",
            "Print a script's bytecode, and the code it is lowered to beside its source",
            "Examples:\n  mms disasm marble.mms\n  mms disasm -O0 marble.mms",
            {},
            [options] { return disasm(*options); }};
  add_files(verb, *options, "Scripts, linked together");
  add_script_options(verb, *options);
  return verb;
}

}  // namespace mms::tools
