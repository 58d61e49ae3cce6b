// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The standard library as the linker takes it: every builtin row (functions of this folder and
/// the materials of materials/table.h), and the modules written in the language itself.

#include <span>
#include <string_view>

#include "vm/builtin.h"

namespace mms::stdlib {

/// All rows, with the kernels that suit this processor.
std::span<const vm::Builtin> builtins();

struct Module {
  std::string_view name;  ///< `noise`: file name without `.mms`
  std::string_view text;
};
/// The `.mms` files of this folder, compiled in; `prelude` first.
std::span<const Module> modules();

}  // namespace mms::stdlib
