// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "vm/lower_function.h"

namespace mms::vm {

Operand FunctionLowering::new_mask() {
  if (free_masks_.empty()) return Operand::make(Operand::Mask, masks_++);
  const Operand m = free_masks_.back();
  free_masks_.pop_back();
  return m;
}

void FunctionLowering::begin_if(std::size_t results) {
  const Value cond = pop();
  Arms arms{};
  arms.then_mask = new_mask();
  arms.else_mask = new_mask();
  arms.outer = cur_;
  arms.results = results;
  arms.if_pc = emit(LoweredOp::If, arms.then_mask, cond.at, cur_.at, arms.else_mask);
  slots_.refer(cond.at, -1);
  cur_ = {arms.then_mask, false};
  arms_.push_back(std::move(arms));
}

void FunctionLowering::begin_else() {
  Arms& arms = arms_.back();
  arms.in_else = true;
  arms.then_dead = dead_;
  arms.then_cur = cur_;
  if (!dead_) arms.then_values = pop(arms.results);
  arms.skip_pc = emit(LoweredOp::SkipIfNone, {}, arms.else_mask);
  land(arms.if_pc);
  cur_ = {arms.else_mask, false};
  dead_ = false;
}

void FunctionLowering::end_if() {
  if (!arms_.back().in_else) begin_else();
  Arms arms = std::move(arms_.back());
  arms_.pop_back();
  land(arms.skip_pc);
  if (!arms.then_dead && !dead_)
    join(arms);
  else
    survive(arms);
}

void FunctionLowering::join(const Arms& arms) {
  const std::vector<Value> other = pop(arms.results);
  for (std::size_t k = 0; k < other.size(); ++k) choose(arms, arms.then_values[k], other[k]);
  const bool whole = arms.then_cur.at == arms.then_mask && cur_.at == arms.else_mask;
  if (whole) {
    cur_ = arms.outer;
  } else {
    within(arms.then_cur, arms.then_mask);
    within(cur_, arms.else_mask);
    const Operand m = new_mask();
    emit(LoweredOp::Or, m, arms.then_cur.at, cur_.at);
    release(arms.then_cur);
    release(cur_);
    release(arms.outer);
    cur_ = {m, true};
  }
  free_mask(arms.then_mask);
  free_mask(arms.else_mask);
  if (!whole) skip_if_none();
}

void FunctionLowering::choose(const Arms& arms, Value then_value, Value else_value) {
  if (then_value.at == else_value.at) {
    slots_.refer(else_value.at, -1);
    return push(then_value.at, then_value.type);
  }
  const LoweredOp op = select_op(then_value.type);
  LoweredInstruction i{.op = op, .a = arms.then_mask, .b = then_value.at, .c = else_value.at};
  for (const Operand o : {i.a, i.b, i.c}) slots_.read(o);
  slots_.refer(then_value.at, -1);
  slots_.refer(else_value.at, -1);
  i.dst = slots_.allocate(then_value.type);
  append(i);
  push(i.dst, then_value.type);
}

void FunctionLowering::survive(const Arms& arms) {
  const bool both_dead = arms.then_dead && dead_;
  const Current lost = arms.then_dead ? arms.then_cur : cur_;
  const Current left = arms.then_dead ? cur_ : arms.then_cur;
  stack_.insert(stack_.end(), arms.then_values.begin(), arms.then_values.end());
  release(lost);
  if (both_dead) release(left);
  dead_ = both_dead;
  if (both_dead)
    cur_ = arms.outer;
  else
    resume(arms, left);
  for (const Operand m : {arms.then_mask, arms.else_mask})
    if (both_dead || m != left.at) free_mask(m);
}

void FunctionLowering::resume(const Arms& arms, Current left) {
  within(left, arms.then_dead ? arms.else_mask : arms.then_mask);
  release(arms.outer);
  cur_ = {left.at, true};
  skip_if_none();
}

void FunctionLowering::within(Current end, Operand arm) {
  if (end.at != arm) emit(LoweredOp::And, end.at, end.at, arm);
}

void FunctionLowering::skip_if_none() {
  if (arms_.empty()) skips_.push_back(emit(LoweredOp::SkipIfNone, {}, cur_.at));
}

}  // namespace mms::vm
