// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What scripts may call, as the linker takes it.

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>

#include "vm/builtin.h"

namespace mms::vm {

/// Rows written in C++, and modules written in the language itself. All texts outlive what is
/// linked with them, messages included.
struct Library {
  std::span<const Builtin> builtins;
  /// A definition at the top level of a module: `name`, at [begin, end) of its text.
  struct Item {
    std::string_view name;
    std::uint32_t begin, end;
  };
  struct Module {
    std::string_view name;  ///< `noise`
    std::string_view text;
    std::span<const Item> items = {};  ///< all of them; none: they are looked for at every link
  };
  std::span<const Module> modules;
  /// A whole script with surfaces, volumes and params, which an import finds by its name, with or
  /// without `.mms`, where no file has it.
  struct Script {
    std::string_view name;  ///< `openpbr`
    std::string_view text;
  };
  std::span<const Script> scripts = {};

  /// The script that `written` names, or null.
  const Script* script(std::string_view written) const {
    if (written.ends_with(".mms")) written.remove_suffix(4);
    const auto found = std::ranges::find(scripts, written, &Script::name);
    return found == scripts.end() ? nullptr : &*found;
  }
};

}  // namespace mms::vm
