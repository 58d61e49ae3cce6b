// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// How one function of bytecode becomes slot-addressed batch code, for lower.cpp alone. Its members
/// are defined in lower_code.cpp (straight code), lower_arms.cpp (choices and their masks) and
/// lower_calls.cpp.

#include <cstdint>
#include <optional>
#include <vector>

#include "vm/fuse.h"
#include "vm/lower.h"
#include "vm/slots.h"

namespace mms::vm {

constexpr LoweredOp copy_op(SlotType t) {
  return t == SlotType::Spectrum ? LoweredOp::Splat : LoweredOp::Copy;
}

constexpr LoweredOp select_op(SlotType t) {
  switch (t) {
    case SlotType::Real:
      return LoweredOp::SelectR;
    case SlotType::Spectrum:
      return LoweredOp::SelectS;
    case SlotType::Integer:
    case SlotType::Logic:
      break;
  }
  return LoweredOp::SelectI;
}

/// One function. Names: a value is what the stack machine would have on its stack; here it is only
/// where its lanes are.
class FunctionLowering {
 public:
  FunctionLowering(const Program& program, std::uint32_t function, LoweredCode& code);

  LoweredFunction lower(const PairOf& pair_of);

  std::vector<LoweredResult> results() const;

 private:
  struct Value {
    Operand at;
    SlotType type;
  };
  /// The mask of the lanes that run here. An owned one was made by joining two arms and belongs to
  /// the arm it is used in; the others are an If's or the function's own.
  struct Current {
    Operand at;
    bool owned = false;
  };
  struct Arms {
    Operand then_mask, else_mask;
    Current outer;
    std::size_t if_pc;
    bool in_else = false;
    // of the first arm, once it has ended:
    std::size_t skip_pc = 0;
    bool then_dead = false;
    Current then_cur;
    std::vector<Value> then_values;
    std::size_t results;
  };
  struct Local {
    Value value;
    int loads = 0, stores = 0;
    bool placed = false;
  };

  void count_locals();

  void place_results_and_params();

  // Masks

  Operand new_mask();
  void free_mask(Operand m) { free_masks_.push_back(m); }
  void release(Current c) {
    if (c.owned) free_mask(c.at);
  }

  // Code

  std::size_t emit(LoweredOp op, Operand dst = {}, Operand a = {}, Operand b = {}, Operand c = {}) {
    for (const Operand o : {a, b, c}) slots_.read(o);
    return append({.op = op, .dst = dst, .a = a, .b = b, .c = c});
  }
  /// An instruction whose operands have been read.
  std::size_t append(const LoweredInstruction& i) {
    code_.instructions.push_back(i);
    code_.lines.push_back(line_);
    slots_.define(i.dst, Definition{false, code_.instructions.size() - 1});
    return code_.instructions.size() - 1;
  }
  void land(std::size_t pc) {
    landed_ = code_.instructions.size();
    code_.instructions[pc].target = std::uint32_t(code_.instructions.size());
  }

  void push(Operand at, SlotType type) { stack_.push_back({at, type}); }
  Value pop() {
    const Value v = stack_.back();
    stack_.pop_back();
    return v;
  }
  /// The top `n` values, bottom first.
  std::vector<Value> pop(std::size_t n) {
    std::vector<Value> values(stack_.end() - std::ptrdiff_t(n), stack_.end());
    stack_.resize(stack_.size() - n);
    return values;
  }
  void release(const std::vector<Value>& values) {
    for (const Value& v : values) slots_.refer(v.at, -1);
  }

  /// `dst` = `mask` ? `value` : what it was.
  void blend(Operand dst, Operand mask, Value value);
  void step(const Instruction& i);
  void arithmetic(Op op);
  /// `over`: the result may stand where an operand stood.
  void kernel(LoweredOp op, std::size_t arity, SlotType type, bool over);
  /// A component of what is no slot, and of a real that stands for a spectrum, is there already.
  void component(int k);
  void pack();
  /// Takes the instruction before into this one where the pair has an instruction of its own.
  void absorb(LoweredInstruction& i);
  /// Dividing by a constant whose reciprocal is exact is multiplying.
  void divide_exactly(LoweredInstruction& i);
  /// The last instruction, taken back, if it is an `op` that made `o` for nobody else. The slot
  /// `o` stays allocated; what the instruction read still stands where it was.
  std::optional<LoweredInstruction> take_last(LoweredOp op, Operand o);

  // Locals

  void load(Local& local);
  void store(Local& local);

  // Arms

  void begin_if(std::size_t results);
  void begin_else();
  void end_if();
  /// Both arms arrive: choose each value by the mask of the first arm.
  void join(const Arms& arms);
  void choose(const Arms& arms, Value then_value, Value else_value);
  /// One arm arrives or none: its values and its mask are what is left.
  void survive(const Arms& arms);
  /// Goes on behind the arms with the lanes of one.
  void resume(const Arms& arms, Current left);
  /// The mask that an arm ends with, if it is not the arm's own, was not made in a run that skipped
  /// the arm. There the arm's own is empty.
  void within(Current end, Operand arm);
  /// The lanes that left may have been all of them. Only outside of arms: a join reads the masks
  /// that its arms made.
  void skip_if_none();

  // Calls

  std::uint32_t pool(const std::vector<Value>& values);
  void pool(Operand o);
  std::uint32_t pooled_since(std::uint32_t first) const {
    return std::uint32_t(code_.operands.size()) - first;
  }

  /// Fresh slots for results, pushed, and where they start in the pool. A spectrum's slot has no
  /// single definition (it is eight operands), so nothing may redirect it.
  std::uint32_t push_results(const std::vector<SlotType>& types);
  void emit_site(LoweredOp op, const CallSite& site);
  void call(std::uint32_t function);
  CallSite builtin_site(std::uint32_t builtin) const;
  void call_builtin(std::uint32_t builtin);
  void call_spectral(std::uint32_t builtin, std::uint32_t spectra);
  void finish_builtin(const CallSite& site);

  // Leaving

  void tail_call();
  /// Assigns a parameter. Where nothing is left to do but to start again, the lanes that do not
  /// never look at it.
  void pass(Operand param, Value value);
  bool reads_param_before(Operand o, std::size_t end) const;
  void leave();

  const Program& program_;
  const Function& f_;
  LoweredCode& code_;
  LoweredFunction row_;
  SourceLine line_;
  int returns_ = 0, tail_calls_ = 0;
  std::size_t landed_ = 0;  ///< no instruction from here on is jumped to, but the first
  std::size_t pc_ = 0, end_of_work_ = 0;  ///< behind it only Ends follow

  std::vector<Value> stack_;
  std::vector<Local> locals_;
  std::vector<Operand> results_;
  Slots slots_;

  std::vector<Arms> arms_;
  std::vector<std::size_t> skips_;  // instructions that go to the end of the code
  Current cur_;
  Operand next_;
  bool dead_ = false;
  std::uint32_t masks_ = 0;
  std::vector<Operand> free_masks_;
};

}  // namespace mms::vm
