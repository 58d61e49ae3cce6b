// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Values of a linked program at one point, as text and as numbers.

#include <optional>
#include <string>
#include <vector>

#include "tools/script.h"
#include "vm/interpreter.h"

namespace mms::tools {

/// A value of the language: what `mms eval` prints.
struct Evaluated {
  std::string type;  ///< in the language's syntax
  std::string text;
  std::vector<double> numbers;  ///< flattened; a spectrum is one for each wavelength
};

/// One point: the north pole of api::fill_defaults, and on it what `--set` says of variables.
/// Empty where a setting is wrong, which has then been said.
template <class R>
std::optional<vm::InputBatch<R>> point(const Compiled& compiled, const ScriptOptions& options,
                                       Exit& exit);

/// The value of `e` there. The error says on which line the script ran out of its budget.
template <class R>
Result<Evaluated> evaluate(const vm::Program& program, const vm::Export& e, vm::InputBatch<R>& in);

}  // namespace mms::tools
