// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Programs through a file and back, for tests.

#include <string>
#include <vector>

#include "api/library.h"
#include "lang/link.h"
#include "vm/serialise.h"

namespace mms::golden {

/// The program stored and loaded again. Says what is not as it was.
inline vm::Program reloaded(const lang::Linked& linked, std::vector<std::string>& failures) {
  const vm::Package package{linked.program, linked.params, linked.dependencies};
  const auto library = api::standard_library().builtins;
  const std::vector<std::byte> file = vm::save(package, library);
  auto loaded = vm::load(file, library);
  if (!loaded) {
    failures.push_back("it does not load again: " + loaded.error().what);
    return linked.program;
  }
  if (loaded->params != package.params || loaded->dependencies != package.dependencies)
    failures.push_back("its params or dependencies are lost when it is stored");
  if (vm::save(*loaded, library) != file) failures.push_back("stored again it is another file");
  if (vm::disassemble(loaded->program) != vm::disassemble(linked.program))
    failures.push_back("stored and loaded it is another program");
  return std::move(loaded->program);
}

}  // namespace mms::golden
