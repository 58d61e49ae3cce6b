// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The machine that carries bounds: bytecode as opcodes.def describes it, one lane, over the values
/// of bounded.h.

#include <optional>
#include <vector>

#include "tests/property/bounded.h"
#include "vm/limits.h"

namespace mms::property {

class BoundedMachine {
 public:
  using Values = std::vector<BoundedCell>;

  /// `inputs`: a cell for each machine input.
  BoundedMachine(const vm::Program& program, Values inputs)
      : p_(program), inputs_(std::move(inputs)) {}

  /// Empty where the float machine may have gone another way, or ran too long.
  std::optional<Values> run(std::uint32_t function) {
    spent_ = 0;
    return run(function, {}, 0);
  }

 private:
  static constexpr int kMostSteps = 1 << 14;

  static Values pop(Values& stack, std::size_t n) {
    Values top(stack.end() - std::ptrdiff_t(n), stack.end());
    stack.resize(stack.size() - n);
    return top;
  }

  /// From an If or Else to behind the Else or End of the same nesting.
  static std::size_t skip(const vm::Function& f, std::size_t pc) {
    for (int depth = 0;;) {
      const vm::Op op = f.code[++pc].op;
      if (depth == 0 && (op == vm::Op::Else || op == vm::Op::End)) return pc + 1;
      depth += (op == vm::Op::If) - (op == vm::Op::End);
    }
  }

  static BoundedCell select(const BoundedCell& condition, const BoundedCell& yes,
                            const BoundedCell& no) {
    const BoundedCell &chosen = condition.i ? yes : no, &other = condition.i ? no : yes;
    if (condition.sure) return chosen;
    BoundedCell d;
    for (std::size_t k = 0; k < d.r.size(); ++k) d.r[k] = either(chosen.r[k], other.r[k]);
    d.i = chosen.i;
    d.sure = chosen.sure && other.sure && chosen.i == other.i;
    return d;
  }

  /// An instruction whose operands are all on the stack.
  static BoundedCell apply(vm::Op op, const BoundedCell& a, const BoundedCell& b,
                           const BoundedCell& c) {
    using vm::Op;
    BoundedCell d;
    switch (op) {
      case Op::Splat:
        d.r.fill(a.r[0]);
        return d;
      case Op::RealOfInt:
        d.r[0] = {double(a.i), a.sure ? std::fabs(double(float(a.i)) - a.i) : kInfinity};
        return d;
      case Op::IntOfReal: {
        const Bounded x = a.r[0];
        d.i = vm::test::truncated(x.v);
        d.sure = x.e == 0 || (x.e < kInfinity && !std::isnan(x.v) &&
                              vm::test::truncated(x.v - x.e) == vm::test::truncated(x.v + x.e));
        return d;
      }
      case Op::LtR:
      case Op::LeR:
      case Op::EqR:
      case Op::NeR:
        d.sure = compare_surely(op, a.r[0], b.r[0], d.i);
        return d;
      case Op::SelectR:
      case Op::SelectI:
      case Op::SelectL:
      case Op::SelectS:
        return select(a, b, c);
      default:
        break;
    }
    const std::string_view pops = vm::info(op).pops;
    if (pops[0] == 'r' || pops[0] == 's') {
      const int n = pops[0] == 'r' ? 1 : kWavelengths;
      for (int k = 0; k < n; ++k) {
        const auto at = static_cast<std::size_t>(k);
        d.r[at] = arithmetic(op, a.r[at], b.r[at], c.r[at]);
      }
      return d;
    }
    vm::test::Cell<double> x, y;
    x.i = a.i;
    y.i = b.i;
    d.i = vm::test::apply<double>(op, x, y, {}).i;
    d.sure = a.sure && (pops.size() < 2 || b.sure);
    if (op == Op::And) d.sure |= (a.sure && !a.i) || (b.sure && !b.i);
    if (op == Op::Or) d.sure |= (a.sure && a.i) || (b.sure && b.i);
    return d;
  }

  Values call(std::uint32_t builtin, const Values& args) {
    return LibraryCall(*p_.builtins[builtin], p_.builtin_params[builtin],
                       p_.builtin_results[builtin])(args);
  }

  BoundedCell spectral(const vm::Instruction& i, const Values& args) {
    BoundedCell result;
    for (std::size_t k = 0; k < result.r.size(); ++k) {
      Values at = args;
      for (std::size_t j = 0; j < at.size(); ++j) at[j].r[0] = args[j].r[i.b >> j & 1 ? k : 0];
      result.r[k] = call(i.a, at)[0].r[0];
    }
    return result;
  }

  BoundedCell constant(const vm::Constant& c) const {
    BoundedCell cell;
    cell.r[0] = {c.f64, c.f64 == double(c.f32) || (std::isnan(c.f64) && std::isnan(c.f32))
                            ? 0.0
                            : std::fabs(c.f64 - double(c.f32))};
    if (std::isnan(cell.r[0].e)) cell.r[0].e = kInfinity;
    cell.i = c.integer;
    return cell;
  }

  std::optional<Values> run(std::uint32_t function, Values locals, int depth);

  const vm::Program& p_;
  Values inputs_;
  int spent_ = 0;
};

inline std::optional<BoundedMachine::Values> BoundedMachine::run(std::uint32_t function,
                                                                 Values locals, int depth) {
  using vm::Op;
  const vm::Function& f = p_.functions[function];
  Values stack;
  locals.resize(f.locals.size());
  for (std::size_t pc = 0;; ++pc) {
    const vm::Instruction i = f.code[pc];
    switch (i.op) {
      case Op::PushConst:
        stack.push_back(constant(p_.constants[i.a]));
        break;
      case Op::PushInput:
        stack.push_back(inputs_[i.a]);
        break;
      case Op::LoadLocal:
        stack.push_back(locals[i.a]);
        break;
      case Op::StoreLocal:
        locals[i.a] = pop(stack, 1)[0];
        break;
      case Op::If: {
        const BoundedCell condition = pop(stack, 1)[0];
        if (!condition.sure) return std::nullopt;
        if (!condition.i) pc = skip(f, pc) - 1;
        break;
      }
      case Op::Else:
        pc = skip(f, pc) - 1;
        break;
      case Op::End:
        break;
      case Op::Call: {
        Values args = pop(stack, p_.functions[i.a].params.size());
        if (++spent_ > kMostSteps || depth >= vm::limits::kCallDepth / 2) return std::nullopt;
        const auto results = run(i.a, std::move(args), depth + 1);
        if (!results) return std::nullopt;
        stack.insert(stack.end(), results->begin(), results->end());
        break;
      }
      case Op::CallBuiltin: {
        const Values results = call(i.a, pop(stack, p_.builtin_params[i.a].size()));
        stack.insert(stack.end(), results.begin(), results.end());
        break;
      }
      case Op::CallSpectral:
        stack.push_back(spectral(i, pop(stack, p_.builtin_params[i.a].size())));
        break;
      case Op::Component: {
        BoundedCell value;
        value.r[0] = pop(stack, 1)[0].r[i.a];
        stack.push_back(value);
        break;
      }
      case Op::Pack: {
        const Values in = pop(stack, kWavelengths);
        BoundedCell spectrum;
        for (std::size_t k = 0; k < in.size(); ++k) spectrum.r[k] = in[k].r[0];
        stack.push_back(spectrum);
        break;
      }
      case Op::TailCall:
        locals = pop(stack, f.params.size());
        locals.resize(f.locals.size());
        if (++spent_ > kMostSteps) return std::nullopt;
        pc = std::size_t(-1);
        break;
      case Op::Return:
        return pop(stack, f.results.size());
      default: {
        Values in = pop(stack, vm::info(i.op).pops.size());
        in.resize(3);
        stack.push_back(apply(i.op, in[0], in[1], in[2]));
      }
    }
  }
}

}  // namespace mms::property
