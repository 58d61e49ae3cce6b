// SPDX-License-Identifier: Apache-2.0
#include "lang/ir.h"

#include <bit>

#include <fmt/format.h>

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

/// Equal as bits, so that 0 and -0 stay apart and a NaN is found again.
bool same(const vm::Constant& a, const vm::Constant& b) {
  return a.type == b.type &&
         std::bit_cast<std::uint32_t>(a.f32) == std::bit_cast<std::uint32_t>(b.f32) &&
         std::bit_cast<std::uint64_t>(a.f64) == std::bit_cast<std::uint64_t>(b.f64) &&
         a.integer == b.integer;
}

}  // namespace

std::uint32_t Module::constant(const vm::Constant& c) {
  // Recent constants repeat most; a full search would make linking quadratic.
  const std::size_t first = constants.size() > 64 ? constants.size() - 64 : 0;
  for (std::size_t i = constants.size(); i-- > first;)
    if (same(constants[i], c)) return static_cast<std::uint32_t>(i);
  constants.push_back(c);
  return static_cast<std::uint32_t>(constants.size() - 1);
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

std::vector<vm::SlotType> pushed_types(vm::Op op) {
  std::vector<vm::SlotType> types;
  for (char c : vm::info(op).pushes)
    if (c != '?') types.push_back(type_of(c));
  return types;
}

Ref add_node(IrFunction& f, std::uint16_t function, Node node) {
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
