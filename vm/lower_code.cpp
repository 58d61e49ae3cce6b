// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "vm/lower_function.h"

namespace mms::vm {
namespace {

constexpr LoweredOp lowered(Op op) { return static_cast<LoweredOp>(op); }

constexpr SlotType type_of(char letter) {
  return letter == 'r'   ? SlotType::Real
         : letter == 'i' ? SlotType::Integer
         : letter == 'l' ? SlotType::Logic
                         : SlotType::Spectrum;
}

/// Whether results may be written over operands: not where lanes have different sizes in the
/// double machine.
bool in_place(const OpInfo& row) {
  const auto wide = [](char c) { return c == 'r' || c == 's'; };
  const bool first = wide(row.pushes[0]);
  return std::all_of(row.pops.begin(), row.pops.end(), [&](char c) { return wide(c) == first; });
}

/// 1 / c, where it is exact in float and in double: c is a power of two, and both are normal.
std::optional<Constant> exact_reciprocal(const Constant& c) {
  int exponent;
  if (double(c.f32) != c.f64 || std::fabs(std::frexp(c.f64, &exponent)) != 0.5) return std::nullopt;
  if (exponent < -124 || exponent > 126) return std::nullopt;
  Constant r = c;
  r.f32 = 1 / c.f32;
  r.f64 = 1 / c.f64;
  return r;
}

}  // namespace

FunctionLowering::FunctionLowering(const Program& program, std::uint32_t function,
                                   LoweredCode& code)
    : program_(program), f_(program.functions[function]), code_(code) {
  row_.begin = std::uint32_t(code.instructions.size());
  for (const Instruction& i : f_.code) {
    returns_ += i.op == Op::Return;
    row_.loops |= i.op == Op::TailCall;
    tail_calls_ += i.op == Op::TailCall;
  }
  for (end_of_work_ = f_.code.size(); f_.code[end_of_work_ - 1].op == Op::End; --end_of_work_) {
  }
  count_locals();
  place_results_and_params();
  cur_ = {new_mask(), false};
  if (row_.loops) next_ = new_mask();
}

LoweredFunction FunctionLowering::lower(const PairOf& pair_of) {
  for (std::size_t pc = 0; pc < f_.code.size(); ++pc) {
    pc_ = pc;
    line_ = f_.lines[pc];
    step(f_.code[pc]);
  }
  for (const std::size_t pc : skips_) land(pc);
  emit(LoweredOp::Return);
  for (std::size_t pc = row_.begin; pc < code_.instructions.size(); ++pc) {
    const LoweredInstruction& i = code_.instructions[pc];
    row_.calls |= i.op == LoweredOp::TailCall || i.op == LoweredOp::Call;
    for (const Operand o : {i.a, i.b, i.c}) row_.masked |= o.base() == Operand::Mask;
  }
  for (const std::size_t pc : slots_.read_once()) code_.instructions[pc].read_once = true;
  fuse(code_, row_.begin, pair_of);
  row_.end = std::uint32_t(code_.instructions.size());
  row_.masks = masks_;
  row_.blocks = slots_.blocks();
  return row_;
}

std::vector<LoweredResult> FunctionLowering::results() const {
  std::vector<LoweredResult> results;
  for (std::size_t k = 0; k < results_.size(); ++k)
    results.push_back({f_.results[k], results_[k].index()});
  return results;
}

void FunctionLowering::count_locals() {
  locals_.resize(f_.locals.size());
  for (const Instruction& i : f_.code) {
    if (i.op == Op::LoadLocal) ++locals_[i.a].loads;
    if (i.op == Op::StoreLocal) ++locals_[i.a].stores;
  }
}

void FunctionLowering::place_results_and_params() {
  for (const SlotType t : f_.results) results_.push_back(slots_.allocate(t, Slots::kPinned));
  row_.result_blocks = slots_.blocks();
  for (std::size_t p = 0; p < f_.params.size(); ++p) {
    const SlotType t = f_.params[p];
    locals_[p].value = {slots_.allocate(t, Slots::kPinned), t};
    locals_[p].placed = true;
  }
  row_.param_blocks = slots_.blocks() - row_.result_blocks;
}

void FunctionLowering::blend(Operand dst, Operand mask, Value value) {
  if (value.at != dst) emit(select_op(value.type), dst, mask, value.at, dst);
}

void FunctionLowering::step(const Instruction& i) {
  switch (i.op) {
    case Op::PushConst:
      return push(Operand::make(Operand::Constant, i.a), program_.constants[i.a].type);
    case Op::PushInput:
      return push(Operand::make(Operand::Input, std::uint32_t(input_block(int(i.a)))),
                  input_type(int(i.a)));
    case Op::LoadLocal:
      return load(locals_[i.a]);
    case Op::StoreLocal:
      return store(locals_[i.a]);
    case Op::Splat: {
      stack_.back() = {stack_.back().at.splatted(), SlotType::Spectrum};
      return;
    }
    case Op::Component:
      return component(int(i.a));
    case Op::Pack:
      return pack();
    case Op::If:
      return begin_if(program_.block_types[i.a].size());
    case Op::Else:
      return begin_else();
    case Op::End:
      return end_if();
    case Op::Call:
      return call(i.a);
    case Op::CallBuiltin:
      return call_builtin(i.a);
    case Op::CallSpectral:
      return call_spectral(i.a, i.b);
    case Op::TailCall:
      return tail_call();
    case Op::Return:
      return leave();
    default:
      return arithmetic(i.op);
  }
}

void FunctionLowering::arithmetic(Op op) {
  const OpInfo& row = info(op);
  kernel(lowered(op), row.pops.size(), type_of(row.pushes[0]), in_place(row));
}

void FunctionLowering::kernel(LoweredOp op, std::size_t arity, SlotType type, bool over) {
  const std::vector<Value> in = pop(arity);
  LoweredInstruction i{.op = op};
  Operand* const operands[] = {&i.a, &i.b, &i.c};
  for (std::size_t k = 0; k < in.size(); ++k) *operands[k] = in[k].at;
  absorb(i);
  divide_exactly(i);
  if (commutes(i.op) && i.a.base() == Operand::Constant) std::swap(i.a, i.b);
  for (const Operand o : {i.a, i.b, i.c}) slots_.read(o);
  if (over) release(in);
  i.dst = slots_.allocate(type);
  append(i);
  if (!over) release(in);
  push(i.dst, type);
}

void FunctionLowering::component(int k) {
  const Value s = pop();
  if (s.at.splat()) return push(s.at.unsplatted(), SlotType::Real);
  if (s.at.base() != Operand::Slot) return push(s.at.component(k), SlotType::Real);
  slots_.read(s.at);
  const Operand dst = slots_.allocate(SlotType::Real);
  emit(LoweredOp::Copy, dst, s.at.component(k));
  release({s});
  push(dst, SlotType::Real);
}

void FunctionLowering::pack() {
  const std::vector<Value> in = pop(kWavelengths);
  const Operand dst = slots_.allocate(SlotType::Spectrum);
  for (int k = 0; k < kWavelengths; ++k)
    emit(LoweredOp::Copy, dst.component(k), in[std::size_t(k)].at);
  slots_.define(dst, std::nullopt);
  release(in);
  push(dst, SlotType::Spectrum);
}

void FunctionLowering::absorb(LoweredInstruction& i) {
  if (i.op == LoweredOp::AddI) {
    for (const bool second : {false, true})
      if (const auto product = take_last(LoweredOp::MulI, second ? i.b : i.a)) {
        i = {.op = LoweredOp::MadI, .a = product->a, .b = product->b, .c = second ? i.a : i.b};
        return;
      }
  }
  if (i.op != LoweredOp::FmaR) return;
  if (const auto negated = take_last(LoweredOp::NegR, i.c))
    i.op = LoweredOp::FmsR, i.c = negated->a;
  else if (const auto left = take_last(LoweredOp::NegR, i.a))
    i.op = LoweredOp::FnmaR, i.a = left->a;
  else if (const auto right = take_last(LoweredOp::NegR, i.b))
    i.op = LoweredOp::FnmaR, i.b = right->a;
}

void FunctionLowering::divide_exactly(LoweredInstruction& i) {
  if (i.op != LoweredOp::DivR && i.op != LoweredOp::ModR) return;
  if (i.b.base() != Operand::Constant) return;
  const auto r = exact_reciprocal(code_.constants[i.b.index()]);
  if (!r) return;
  const Operand inverse = Operand::make(Operand::Constant, std::uint32_t(code_.constants.size()));
  code_.constants.push_back(*r);
  if (i.op == LoweredOp::DivR)
    i.op = LoweredOp::MulR, i.b = inverse;
  else
    i.op = LoweredOp::ModByR, i.c = inverse;
}

std::optional<LoweredInstruction> FunctionLowering::take_last(LoweredOp op, Operand o) {
  const std::size_t last = code_.instructions.size() - 1;
  const auto d = slots_.sole_definition(o);
  if (!d || d->pooled || d->index != last || last < landed_) return std::nullopt;
  const LoweredInstruction i = code_.instructions[last];
  if (i.op != op) return std::nullopt;
  slots_.define(o, std::nullopt);
  code_.instructions.pop_back();
  code_.lines.pop_back();
  return i;
}

void FunctionLowering::load(Local& local) {
  // The references of a local that only names a value were counted when it was stored.
  if (local.stores != 1) slots_.refer(local.value.at, 1);
  push(local.value.at, local.value.type);
}

void FunctionLowering::store(Local& local) {
  const Value v = pop();
  if (local.stores == 1) {  // a name for the value, no more
    local.value = v;
    slots_.refer(v.at, local.loads);
    slots_.refer(v.at, -1);
    return;
  }
  if (!local.placed) local.value = {slots_.allocate(v.type, Slots::kPinned), v.type};
  local.placed = true;
  blend(local.value.at, cur_.at, v);
  slots_.refer(v.at, -1);
}

}  // namespace mms::vm
