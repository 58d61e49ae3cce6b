// SPDX-License-Identifier: Apache-2.0
#include "lang/ir.h"

#include <bit>

#include <fmt/format.h>

#include "base/hash.h"

namespace mms::lang {
namespace {

vm::SlotType type_of(char letter) {
  switch (letter) {
    case 'i':
      return vm::SlotType::Integer;
    case 'l':
      return vm::SlotType::Logic;
    case 's':
      return vm::SlotType::Spectrum;
    default:
      return vm::SlotType::Real;
  }
}

}  // namespace

std::size_t Module::HashOfBits::operator()(const Bits& b) const {
  const auto& [type, f32, f64, integer] = b;
  return hash_combine(f64, f32 ^ std::uint64_t{std::uint32_t(integer)} << 32 ^ std::uint64_t(type));
}

std::uint32_t Module::constant(const vm::Constant& c) {
  const Bits bits = {c.type, std::bit_cast<std::uint32_t>(c.f32),
                     std::bit_cast<std::uint64_t>(c.f64), c.integer};
  const auto [it, is_new] =
      constant_numbers_.try_emplace(bits, static_cast<std::uint32_t>(constants.size()));
  if (is_new) constants.push_back(c);
  return it->second;
}

std::uint32_t Module::builtin(const vm::Builtin* row, const std::vector<vm::SlotType>& params,
                              const std::vector<vm::SlotType>& results) {
  for (std::size_t i = 0; i < builtins.size(); ++i)
    if (builtins[i] == row) return static_cast<std::uint32_t>(i);
  builtins.push_back(row);
  builtin_params.push_back(params);
  builtin_results.push_back(results);
  return static_cast<std::uint32_t>(builtins.size() - 1);
}

SlotTypes pushed_types(vm::Op op) {
  SlotTypes types;
  for (char c : vm::info(op).pushes)
    if (c != '?') types.push_back(type_of(c));
  return types;
}

Ref add_node(IrFunction& f, FunctionId function, Node node) {
  if (node.results.empty()) node.results = pushed_types(node.op);
  f.nodes.push_back(std::move(node));
  return {static_cast<std::uint32_t>(f.nodes.size() - 1), 0, function};
}

std::string dump(const Module& module, const IrFunction& f) {
  std::string out = fmt::format("function {}\n", f.name);
  for (std::size_t i = 0; i < f.nodes.size(); ++i) {
    const Node& n = f.nodes[i];
    out += fmt::format("  %{} = {}", i, vm::info(n.op).name);
    if (n.op == vm::Op::PushConst) {
      const vm::Constant& c = module.constants[n.a];
      out +=
          c.type == vm::SlotType::Real ? fmt::format(" {}", c.f64) : fmt::format(" {}", c.integer);
    } else if (n.op == vm::Op::PushInput) {
      out += fmt::format(" ${}.{}", vm::info(vm::input_variable(n.a)).name, n.a);
    } else if (n.op == vm::Op::CallBuiltin || n.op == vm::Op::CallSpectral) {
      out += fmt::format(" {}", module.builtins[n.a]->signature);
    } else if (n.op == vm::Op::Call) {
      out += fmt::format(" {}", module.functions[n.a].name);
    } else if (n.op == vm::Op::LoadLocal) {
      out += fmt::format(" {}", n.a);
    }
    for (Ref r : n.args)
      out += fmt::format(" %{}{}", r.node, r.result ? fmt::format(".{}", r.result) : "");
    out += "\n";
  }
  out += "  return";
  for (Ref r : f.results)
    out += fmt::format(" %{}{}", r.node, r.result ? fmt::format(".{}", r.result) : "");
  return out + "\n";
}

}  // namespace mms::lang
