// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The linker's intermediate form: for each function a graph of pure operations on machine slots.
/// Aggregates, closures, materials and generics are gone; `If` is a lazy choice between two lists
/// of values, and where a value is computed is decided only by the emitter.

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "base/short_list.h"
#include "vm/program.h"

namespace mms::lang {

using FunctionId = std::uint32_t;  ///< index in Module::functions

/// One value: result `result` of node `node` of function `function`.
struct Ref {
  std::uint32_t node = 0;
  std::uint16_t result = 0;
  FunctionId function = 0;
  friend auto operator<=>(const Ref&, const Ref&) = default;
};

using Refs = ShortList<Ref, 3>;
using SlotTypes = ShortList<vm::SlotType, 8>;

/// One operation. Besides the arithmetic rows of the opcode table a node may be
///   PushConst a (constant), PushInput a, LoadLocal a (parameter `a`),
///   If: args[0] is the condition, then the values of the first arm, then those of the second,
///   Call a, CallBuiltin a, CallSpectral a b.
struct Node {
  vm::Op op = vm::Op::PushConst;
  std::uint32_t a = 0, b = 0;
  Refs args;
  SlotTypes results;
  vm::SourceLine line;
  std::int32_t known = -1;  ///< the constant it is certain to be, where it has one result
  bool steady = false;      ///< differentiation takes it for constant
};

struct IrFunction {
  std::string name;
  std::vector<vm::SlotType> params;
  std::vector<Ref> results;
  std::vector<Node> nodes;
  bool recursive = false;  ///< can reach itself: computing it where it is not needed may not end

  vm::SlotType type(Ref r) const { return nodes[r.node].results[r.result]; }
  std::vector<vm::SlotType> result_types() const {
    std::vector<vm::SlotType> t;
    for (Ref r : results) t.push_back(type(r));
    return t;
  }
};

/// Everything the passes work on.
struct Module {
  std::deque<IrFunction> functions;
  std::vector<vm::Constant> constants;
  std::vector<const vm::Builtin*> builtins;
  std::vector<std::vector<vm::SlotType>> builtin_params, builtin_results;
  std::vector<vm::ProgramImage> images;

  /// The number of `c`, equal as bits: 0 and -0 stay apart and a NaN is found again.
  std::uint32_t constant(const vm::Constant& c);
  std::uint32_t builtin(const vm::Builtin* row, const std::vector<vm::SlotType>& params,
                        const std::vector<vm::SlotType>& results);

 private:
  using Bits = std::tuple<vm::SlotType, std::uint32_t, std::uint64_t, std::int32_t>;
  struct HashOfBits {
    std::size_t operator()(const Bits& b) const;
  };
  std::unordered_map<Bits, std::uint32_t, HashOfBits> constant_numbers_;
};

/// The nodes that the values `roots` need, of those that are `wanted`: beyond others it does not
/// look.
template <class Wanted>
std::vector<bool> reached(const IrFunction& f, std::span<const Ref> roots, Wanted wanted) {
  std::vector<bool> seen(f.nodes.size(), false);
  std::vector<std::uint32_t> pending;
  const auto visit = [&](Ref r) {
    if (seen[r.node] || !wanted(r)) return;
    seen[r.node] = true;
    pending.push_back(r.node);
  };
  for (Ref r : roots) visit(r);
  while (!pending.empty()) {
    const std::uint32_t n = pending.back();
    pending.pop_back();
    for (Ref a : f.nodes[n].args) visit(a);
  }
  return seen;
}

/// Adds an operation whose result types the opcode table or `results` gives.
Ref add_node(IrFunction& f, FunctionId function, Node node);

/// Types an operation of the table pushes; empty where the operand decides.
SlotTypes pushed_types(vm::Op op);

/// Text of one function, for `--dump-after`.
std::string dump(const Module& module, const IrFunction& f);

/// What is wrong with the graph, or empty: operands in range, argument and result types as the
/// opcode table and the signatures say, arguments before what uses them (leaves may stand
/// anywhere), known values of the right type. That each value is defined once needs no check: a
/// value is a place in the list of nodes.
std::string check_ir(const Module& module, const IrFunction& f);

}  // namespace mms::lang
