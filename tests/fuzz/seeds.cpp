// SPDX-License-Identifier: Apache-2.0
// fuzz_seeds FOLDER SCRIPT...: what the scripts that link are stored as, for the target `load` to
// start from.
#include <filesystem>
#include <fstream>
#include <string>

#include "api/library.h"
#include "lang/parser.h"
#include "vm/serialise.h"

namespace mms::fuzz {
namespace {

void store(const std::filesystem::path& folder, const std::string& script, lang::Level level) {
  const auto source = api::read_source(script);
  if (!source) return;
  lang::Diagnostics diagnostics;
  const lang::Graph graphs[] = {lang::parse(*source, diagnostics)};
  if (diagnostics.has_errors()) return;
  lang::LinkOptions options;
  options.level = level;
  const auto linked = lang::link(graphs, api::standard_library(), options, diagnostics);
  if (!linked) return;
  const auto bytes = vm::save({linked->program, linked->params, linked->dependencies},
                              api::standard_library().builtins);
  const std::string name = std::to_string(static_cast<int>(level)) +
                           std::filesystem::path(script).filename().string() + 'c';
  std::ofstream out(folder / name, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
}

}  // namespace
}  // namespace mms::fuzz

int main(int argc, char** argv) {
  for (int i = 2; i < argc; ++i)
    for (const auto level : {mms::lang::Level::O0, mms::lang::Level::O2})
      mms::fuzz::store(argv[1], argv[i], level);
}
