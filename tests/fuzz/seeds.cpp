// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/seeds.h"

#include "api/library.h"
#include "lang/parser.h"
#include "vm/serialise.h"

namespace mms::fuzz {

std::vector<std::byte> store(const std::string& script, lang::Level level) {
  const auto source = api::read_source(script);
  if (!source) return {};
  lang::Diagnostics diagnostics;
  const lang::Graph graphs[] = {lang::parse(*source, diagnostics)};
  if (diagnostics.has_errors()) return {};
  lang::LinkOptions options;
  options.level = level;
  const auto linked = lang::link(graphs, api::standard_library(), options, diagnostics);
  if (!linked) return {};
  return vm::save({linked->program, linked->params, linked->dependencies},
                  api::standard_library().builtins);
}

}  // namespace mms::fuzz
