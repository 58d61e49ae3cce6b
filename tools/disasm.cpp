// SPDX-License-Identifier: Apache-2.0
// mms disasm: the bytecode of a script, and the code that runs, as text.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "api/excerpts.h"
#include "tools/commands.h"
#include "tools/script.h"
#include "tools/stored.h"
#include "vm/listing.h"
#include "vm/verify.h"

namespace mms::tools {

namespace {

std::vector<std::string> pass_names() {
  std::vector<std::string> names;
  for (const lang::PassInfo& pass : lang::passes()) names.emplace_back(pass.name);
  return names;
}

Exit disasm(const ScriptOptions& options) {
  Exit exit = Exit::Ok;
  const auto sources = read_sources(options.files, options, exit);
  if (!sources) return exit;
  if (!options.dump_after.empty() && any_stored(*sources))
    return fail(Exit::Usage,
                {"--dump-after", "a compiled program has its passes behind it",
                 "give the scripts that it is made from"},
                options);
  const auto linked = compile(*sources, options, exit);
  if (!linked) return exit;
  if (options.dump_after.empty()) {
    const vm::Program& program = linked->program;
    api::Excerpts excerpts(program);
    const auto text_of = [&](vm::SourceLine line) { return excerpts.line(line); };
    fmt::print("{}{}", vm::disassemble(program),
               vm::disassemble(program, vm::lower(program), text_of));
    return exit;
  }
  for (const lang::PassInfo& pass : lang::passes())
    if (pass.name == options.dump_after && options.level[0] - '0' < static_cast<int>(pass.from))
      return fail(
          Exit::Usage,
          {"--dump-after", fmt::format("`{}` does not run at -O{}", pass.name, options.level),
           fmt::format("it does from -O{} on; `mms doc passes` says which run when",
                       static_cast<int>(pass.from))},
          options);
  fmt::print("{}", linked->dump);
  return exit;
}

}  // namespace

Verb disasm_verb() {
  auto options = std::make_shared<ScriptOptions>();
  Verb verb{"disasm",
            "Print a script's bytecode, and the code it is lowered to beside its source",
            "Examples:\n  mms disasm marble.mms\n  mms disasm -O0 marble.mms\n  mms disasm "
            "--dump-after=fold marble.mms",
            {},
            [options] { return disasm(*options); }};
  add_files(verb, *options, "Scripts, linked together");
  verb.add({"--dump-after", &options->dump_after, "PASS",
            "Print the linker's graph after a pass instead; `mms doc passes` lists them",
            pass_names()});
  add_script_options(verb, *options);
  return verb;
}

}  // namespace mms::tools
