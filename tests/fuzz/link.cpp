// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "api/library.h"
#include "lang/link.h"
#include "lang/parser.h"
#include "tests/fuzz/targets.h"
#include "vm/verify.h"

namespace mms::fuzz {

void link(Bytes input) {
  if (input.empty()) return;
  lang::Diagnostics diagnostics;
  const lang::Graph graphs[] = {lang::parse(
      lang::make_source("fuzz.mms", std::string(input.begin(), input.end())), diagnostics)};
  if (diagnostics.has_errors()) return;
  lang::LinkOptions options;
  options.level = static_cast<lang::Level>(input.back() % 3);
  const auto linked = lang::link(graphs, api::standard_library(), options, diagnostics);
  lang::render(diagnostics);
  if (!linked) {
    if (!diagnostics.has_errors()) __builtin_trap();  // refused, and no word why
    return;
  }
  if (vm::verify(linked->program)) __builtin_trap();
  vm::disassemble(linked->program);
}

}  // namespace mms::fuzz
