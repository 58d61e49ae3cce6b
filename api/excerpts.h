// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The text that instructions came from.

#include <map>
#include <string>
#include <vector>

#include "lang/source.h"
#include "vm/program.h"

namespace mms::api {

/// Finds source lines by the names that programs have for sources: files that are still there,
/// modules of the library, and what was handed over.
class Excerpts {
 public:
  explicit Excerpts(const vm::Program& program, std::vector<lang::SourcePtr> sources = {});

  /// The line without the space around it; empty if the source is not there.
  std::string line(vm::SourceLine at);
  /// The same from its column on, cut after `length` characters.
  std::string from_column(vm::SourceLine at, std::size_t length = 40);

 private:
  const lang::Source* source(std::uint32_t index);

  const vm::Program& program_;
  std::map<std::string, lang::SourcePtr> sources_;
};

}  // namespace mms::api
