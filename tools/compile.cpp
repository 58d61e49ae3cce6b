// SPDX-License-Identifier: Apache-2.0
// mms compile: a linked program to a file, which every verb takes in place of the scripts.
#include <filesystem>
#include <fstream>
#include <memory>

#include "api/library.h"
#include "base/file.h"
#include "tools/commands.h"
#include "tools/overwrite.h"
#include "tools/script.h"
#include "vm/serialise.h"

namespace mms::tools {

namespace {

struct CompileOptions : ScriptOptions {
  std::string output;
};

/// Whether a file is there that holds something, and no compiled program: a picture, a script.
bool is_foreign(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::string start(vm::kMagic.size(), '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(start.data(), std::streamsize(start.size()));
  start.resize(std::size_t(in.gcount()));
  return !start.empty() && !vm::is_stored(start);
}

Exit compile_to_file(const CompileOptions& options) {
  Exit exit = Exit::Ok;
  const auto linked = compile_files(options.files, options, exit);
  if (!linked) return exit;
  std::vector<std::string> inputs = options.files;
  inputs.insert(inputs.end(), linked->dependencies.begin(), linked->dependencies.end());
  if (const auto error = overwrites(options.output, inputs))
    return fail(Exit::Usage, *error, options);
  if (is_foreign(options.output))
    return fail(Exit::Usage,
                {options.output, "is there, and no compiled program",
                 "name another file, or remove it first"},
                options);
  const std::vector<std::byte> bytes = vm::save(
      {linked->program, linked->params, linked->dependencies}, api::standard_library().builtins);
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (const auto error = replace_file(options.output, text))
    return fail(Exit::File, *error, options);
  return Exit::Ok;
}

}  // namespace

Verb compile_verb() {
  auto options = std::make_shared<CompileOptions>();
  Verb verb{"compile",
            "Store a linked program in a file, which every verb takes in place of the scripts",
            "Examples:\n  mms compile marble.mms -o marble.mmsc\n"
            "  mms compile --set scale=2 wood.mms -o wood.mmsc && mms info wood.mmsc",
            {},
            [options] { return compile_to_file(*options); }};
  add_files(verb, *options, "Scripts, linked together");
  verb.add({"-o,--output",
            &options->output,
            "PATH",
            "The file; it is replaced whole or not at all",
            {},
            true});
  add_script_options(verb, *options);
  add_format_option(verb, *options);
  return verb;
}

}  // namespace mms::tools
