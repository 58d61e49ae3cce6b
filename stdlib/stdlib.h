// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The standard library as the linker takes it: every builtin row (functions of this folder and
/// the materials of materials/table.h), and the modules written in the language itself.

#include <span>

#include "vm/library.h"

namespace mms::stdlib {

/// All rows, with the kernels that suit this processor.
std::span<const vm::Builtin> builtins();

/// The `.mms` files of this folder that hold no surface, compiled in; `prelude` first.
std::span<const vm::Library::Module> modules();

/// The other `.mms` files of this folder, compiled in: `openpbr`.
std::span<const vm::Library::Script> scripts();

}  // namespace mms::stdlib
