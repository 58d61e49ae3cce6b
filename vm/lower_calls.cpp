// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "vm/lower_function.h"

namespace mms::vm {

std::uint32_t FunctionLowering::pool(const std::vector<Value>& values) {
  const std::uint32_t first = std::uint32_t(code_.operands.size());
  for (const Value& v : values)
    for (int k = 0; k < block_count(v.type); ++k) pool(v.at.component(k));
  return first;
}

void FunctionLowering::pool(Operand o) {
  slots_.read(o);
  code_.operands.push_back(o);
}

std::uint32_t FunctionLowering::push_results(const std::vector<SlotType>& types) {
  const std::uint32_t first = std::uint32_t(code_.operands.size());
  for (const SlotType t : types) {
    const Operand o = slots_.allocate(t);
    if (t != SlotType::Spectrum) slots_.define(o, Definition{true, code_.operands.size()});
    for (int k = 0; k < block_count(t); ++k) code_.operands.push_back(o.component(k));
    push(o, t);
  }
  return first;
}

void FunctionLowering::emit_site(LoweredOp op, const CallSite& site) {
  const std::size_t pc = emit(op, {}, cur_.at);
  code_.instructions[pc].target = std::uint32_t(code_.sites.size());
  code_.sites.push_back(site);
}

void FunctionLowering::call(std::uint32_t function) {
  const Function& callee = program_.functions[function];
  CallSite site;
  site.function = function;
  const std::vector<Value> args = pop(callee.params.size());
  site.first_arg = pool(args);
  site.args = pooled_since(site.first_arg);
  site.first_result = push_results(callee.results);
  site.results = pooled_since(site.first_result);
  release(args);
  emit_site(LoweredOp::Call, site);
}

CallSite FunctionLowering::builtin_site(std::uint32_t builtin) const {
  CallSite site;
  site.f32 = program_.builtins[builtin]->f32;
  site.f64 = program_.builtins[builtin]->f64;
  site.image32 = program_.builtins[builtin]->image32;
  site.image64 = program_.builtins[builtin]->image64;
  return site;
}

void FunctionLowering::call_builtin(std::uint32_t builtin) {
  if (const LoweredOp op = program_.builtins[builtin]->instruction; op != LoweredOp::CallBuiltin)
    return kernel(op, program_.builtin_params[builtin].size(), program_.builtin_results[builtin][0],
                  true);
  CallSite site = builtin_site(builtin);
  const std::vector<Value> args = pop(program_.builtin_params[builtin].size());
  site.first_arg = pool(args);
  site.args = pooled_since(site.first_arg);
  site.first_result = push_results(program_.builtin_results[builtin]);
  site.results = pooled_since(site.first_result);
  release(args);
  finish_builtin(site);
}

void FunctionLowering::call_spectral(std::uint32_t builtin, std::uint32_t spectra) {
  CallSite site = builtin_site(builtin);
  const std::vector<Value> args = pop(program_.builtin_params[builtin].size());
  site.first_arg = std::uint32_t(code_.operands.size());
  site.args = std::uint32_t(args.size());
  site.repeats = kWavelengths;
  for (int k = 0; k < kWavelengths; ++k)
    for (std::size_t j = 0; j < args.size(); ++j) {
      const bool spectrum = j < 32 && (spectra >> j & 1);
      pool(spectrum ? args[j].at.component(k) : args[j].at);
    }
  site.first_result = push_results({SlotType::Spectrum});
  site.results = 1;
  release(args);
  finish_builtin(site);
}

void FunctionLowering::finish_builtin(const CallSite& site) {
  code_.builtin_blocks = std::max({code_.builtin_blocks, site.args, site.results});
  emit_site(LoweredOp::CallBuiltin, site);
}

void FunctionLowering::tail_call() {
  std::vector<Value> args = pop(f_.params.size());
  // Parameters are assigned in order, so an argument that reads an earlier one is copied first.
  for (std::size_t j = 0; j < args.size(); ++j) {
    if (!reads_param_before(args[j].at, j)) continue;
    const Operand copy = slots_.allocate(args[j].type);
    emit(copy_op(args[j].type), copy, args[j].at);
    slots_.refer(args[j].at, -1);
    args[j].at = copy;
  }
  for (std::size_t j = 0; j < args.size(); ++j) pass(locals_[j].value.at, args[j]);
  release(args);
  const std::size_t pc = emit(LoweredOp::TailCall, {}, cur_.at);
  code_.instructions[pc].dst = next_;
  dead_ = true;
}

void FunctionLowering::pass(Operand param, Value value) {
  if (tail_calls_ > 1 || pc_ + 1 != end_of_work_) return blend(param, cur_.at, value);
  if (param != value.at) emit(copy_op(value.type), param, value.at);
}

bool FunctionLowering::reads_param_before(Operand o, std::size_t end) const {
  if (o.base() != Operand::Slot) return false;
  for (std::size_t p = 0; p < end; ++p)
    if (locals_[p].value.at.index() == o.index()) return true;
  return false;
}

void FunctionLowering::leave() {
  const std::vector<Value> values = pop(f_.results.size());
  const bool only = returns_ == 1 && !row_.loops;  // then every lane leaves here, at once
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Value& v = values[k];
    if (!only)
      blend(results_[k], cur_.at, v);
    else if (const auto d = slots_.sole_definition(v.at))
      (d->pooled ? code_.operands[d->index] : code_.instructions[d->index].dst) = results_[k];
    else
      emit(copy_op(v.type), results_[k], v.at);
    slots_.refer(v.at, -1);
  }
  dead_ = true;
}

}  // namespace mms::vm
