// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "lang/ir.h"
#include "vm/variables.h"

namespace mms::lang {
namespace {

using vm::Op;
using vm::SlotType;

std::string letters(std::span<const SlotType> types) {
  std::string s;
  for (SlotType t : types) s += vm::letter(t);
  return s;
}

/// Whether the operand of `n` names something that is there.
bool operand_in_range(const Module& m, const IrFunction& f, const Node& n) {
  switch (vm::info(n.op).operand) {
    case vm::OperandForm::Constant:
      return n.a < m.constants.size();
    case vm::OperandForm::Input:
      return n.a < static_cast<std::uint32_t>(vm::input_count());
    case vm::OperandForm::Local:
      return n.a < f.params.size();
    case vm::OperandForm::Function:
      return n.a < m.functions.size();
    case vm::OperandForm::Builtin:
      return n.a < m.builtins.size();
    case vm::OperandForm::Wavelength:
      return n.a < static_cast<std::uint32_t>(kWavelengths);
    default:
      return true;
  }
}

std::string expected_args(const Module& m, const Node& n) {
  std::string spectral;
  switch (n.op) {
    case Op::Call:
      return letters(m.functions[n.a].params);
    case Op::CallBuiltin:
      return letters(m.builtin_params[n.a]);
    case Op::CallSpectral:
      for (std::size_t k = 0; k < m.builtin_params[n.a].size(); ++k)
        spectral += (n.b >> k & 1) ? 's' : 'r';
      return spectral;
    case Op::If:
      return 'l' + letters(n.results) + letters(n.results);
    default:
      return std::string(vm::info(n.op).pops);
  }
}

std::string expected_results(const Module& m, const IrFunction& f, const Node& n) {
  switch (n.op) {
    case Op::PushConst:
      return letters({&m.constants[n.a].type, 1});
    case Op::PushInput:
      return std::string(1, vm::letter(vm::input_type(static_cast<int>(n.a))));
    case Op::LoadLocal:
      return letters({&f.params[n.a], 1});
    case Op::Call:
      return letters(m.functions[n.a].result_types());
    case Op::CallBuiltin:
      return letters(m.builtin_results[n.a]);
    case Op::If:
      return letters(n.results);
    default:
      return std::string(vm::info(n.op).pushes);
  }
}

/// An operation that only the bytecode has.
bool is_code_only(Op op) {
  return op == Op::StoreLocal || op == Op::Else || op == Op::End || op == Op::TailCall ||
         op == Op::Return;
}

bool is_there(const IrFunction& f, Ref r) {
  return r.node < f.nodes.size() && r.result < f.nodes[r.node].results.size();
}

std::string check_node(const Module& m, const IrFunction& f, std::size_t i) {
  const Node& n = f.nodes[i];
  if (is_code_only(n.op)) return "is no operation of a graph";
  if (!operand_in_range(m, f, n)) return fmt::format("has operand {}, which is not there", n.a);
  std::string found;
  for (Ref r : n.args) {
    if (!is_there(f, r))
      return fmt::format("refers to %{}.{}, which is not there", r.node, r.result);
    if (r.node >= i && !f.nodes[r.node].args.empty())
      return fmt::format("refers to %{}, which comes later", r.node);
    found += vm::letter(f.type(r));
  }
  if (const std::string expected = expected_args(m, n); found != expected)
    return fmt::format("takes `{}`, found `{}`", expected, found);
  if (const std::string expected = expected_results(m, f, n); letters(n.results) != expected)
    return fmt::format("gives `{}`, marked `{}`", expected, letters(n.results));
  if (n.known < 0) return {};
  if (n.known >= static_cast<std::int64_t>(m.constants.size()) || n.results.size() != 1 ||
      m.constants[n.known].type != n.results[0])
    return fmt::format("is said to be constant {}, which is not of its type", n.known);
  return {};
}

}  // namespace

std::string check_ir(const Module& module, const IrFunction& f) {
  for (std::size_t i = 0; i < f.nodes.size(); ++i)
    if (const std::string fault = check_node(module, f, i); !fault.empty())
      return fmt::format("{}: node %{} ({}) {}", f.name, i, vm::info(f.nodes[i].op).name, fault);
  for (Ref r : f.results)
    if (!is_there(f, r)) return fmt::format("{}: result %{} is not there", f.name, r.node);
  return {};
}

}  // namespace mms::lang
