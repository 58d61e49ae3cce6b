// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The standard library as the linker takes it: every builtin row (functions of this folder and
/// the materials of materials/table.h), and the modules written in the language itself.

#include <cstdint>
#include <span>
#include <string_view>

#include "vm/builtin.h"

namespace mms::stdlib {

/// All rows, with the kernels that suit this processor.
std::span<const vm::Builtin> builtins();

struct Module {
  /// A definition at the top level: `name`, at [begin, end) of the text.
  struct Item {
    std::string_view name;
    std::uint32_t begin, end;
  };
  std::string_view name;  ///< `noise`: file name without `.mms`
  std::string_view text;
  std::span<const Item> items;  ///< every definition, in order
};
/// The `.mms` files of this folder that hold no surface, compiled in; `prelude` first.
std::span<const Module> modules();

/// A whole script with surfaces, volumes and params: `openpbr`.
struct Script {
  std::string_view name;  ///< file name without `.mms`
  std::string_view text;
};
/// The other `.mms` files of this folder, compiled in.
std::span<const Script> scripts();

}  // namespace mms::stdlib
