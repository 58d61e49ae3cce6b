// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Graph to stack bytecode: decides where each value is computed, and in which order.

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lang/ir.h"

namespace mms::lang {

/// Emits functions of a module into a Program, each once, with whatever they call.
class Emitter {
 public:
  Emitter(const Module& module, vm::Program& program);

  /// The program's function that returns `results` of `f`; they are values of `f`, in any order.
  std::uint32_t emit(FunctionId f, std::span<const Ref> results, std::string name);
  /// The program's number of constant `k` of the module.
  std::uint32_t constant(std::uint32_t k);

 private:
  std::uint32_t callee(FunctionId f);

  const Module& module_;
  vm::Program& program_;
  std::map<FunctionId, std::uint32_t> emitted_;
  std::vector<std::optional<std::uint32_t>> constants_;  ///< by their number in the module
  friend class FunctionEmitter;
};

}  // namespace mms::lang
