// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Random programs that the verifier must accept: every instruction, arms that end or arrive,
/// locals stored in either or both, calls, recursion and loops that end.

#include <algorithm>
#include <random>

#include "assembler.h"

namespace mms::vm::test {

class Generator {
 public:
  explicit Generator(std::uint32_t seed) : random_(seed) {}

  /// Function 0 has no parameters. `loops`: functions may loop or recurse, a few times.
  Program program(bool loops) {
    a_ = Assembler();
    const int functions = 1 + pick(4);
    for (int k = 0; k < functions; ++k) signatures_.push_back(signature(k, loops));
    for (int k = 0; k < functions; ++k) body(k);
    return std::exchange(a_.program, {});
  }

 private:
  struct Signature {
    std::vector<SlotType> params, results;
    bool loops;  ///< parameter 0 is an integer that counts down
  };
  using Scope = std::vector<std::uint32_t>;  // locals that hold a value

  int pick(int n) { return int(random_() % unsigned(n)); }
  bool chance(int percent) { return pick(100) < percent; }
  SlotType any_type() { return static_cast<SlotType>(pick(4)); }
  std::vector<SlotType> types(int most) {
    std::vector<SlotType> list;
    for (int n = pick(most + 1); n > 0; --n) list.push_back(any_type());
    return list;
  }

  Signature signature(int k, bool loops) {
    Signature s{{}, types(3), k > 0 && loops && chance(60)};
    if (s.loops) s.params.push_back(I);
    if (k > 0)
      for (const SlotType t : types(3)) s.params.push_back(t);
    return s;
  }

  Function& f() { return a_.program.functions.back(); }

  void body(int k) {
    self_ = k;
    size_ = 0;
    a_.function("f" + std::to_string(k), signatures_[k].params, signatures_[k].results);
    scope_.clear();
    for (std::uint32_t p = 0; p < signatures_[k].params.size(); ++p) scope_.push_back(p);
    if (signatures_[k].loops) {
      a_.load(0).integer(0).op(Op::LeI).begin();
      const Scope before = scope_;
      leave(false);
      scope_ = before;
      a_.end();
    }
    if (!statements(3)) leave(signatures_[k].loops && chance(50));
  }

  /// Return or, where `again`, TailCall with the count one less.
  void leave(bool again) {
    const Signature& s = signatures_[self_];
    if (again) {
      a_.load(0).integer(1).op(Op::SubI);
      for (std::size_t p = 1; p < s.params.size(); ++p) expression(s.params[p], 2);
      a_.again();
    } else {
      for (const SlotType t : s.results) expression(t, 3);
      a_.ret();
    }
  }

  /// Some statements, with an empty stack; whether the last one left the function.
  bool statements(int depth) {
    for (int n = pick(4); n > 0; --n) {
      if (depth > 0 && chance(40)) {
        if (if_statement(depth - 1)) return true;
      } else {
        store(any_type());
      }
    }
    return false;
  }

  void store(SlotType type) {
    expression(type, 3);
    store_top(type);
  }
  void store_top(SlotType type) {
    f().locals.push_back(type);
    a_.store(std::uint32_t(f().locals.size() - 1));
    scope_.push_back(std::uint32_t(f().locals.size() - 1));
  }

  /// One arm of a statement; whether it left the function.
  bool arm(int depth) {
    if (statements(depth)) return true;
    if (!chance(25)) return false;
    leave(signatures_[self_].loops && chance(50));
    return true;
  }

  bool if_statement(int depth) {
    expression(L, 2);
    a_.begin();
    const Scope before = scope_;
    const bool both = chance(50);  // a local that either arm stores
    const SlotType type = any_type();
    std::uint32_t shared = 0;
    if (both) {
      f().locals.push_back(type);
      shared = std::uint32_t(f().locals.size() - 1);
      expression(type, 2);
      a_.store(shared);
    }
    const bool first = arm(depth);
    const Scope then = std::exchange(scope_, before);
    bool second = false;
    if (both || chance(70)) {
      a_.other();
      if (both) {
        expression(type, 2);
        a_.store(shared);
      }
      second = arm(depth);
    }
    a_.end();
    if (!first && !second) scope_ = before;
    if (second) scope_ = then;
    if (both) scope_.push_back(shared);
    return first && second;
  }

  /// Pushes one value.
  void expression(SlotType type, int depth) {
    ++size_;
    if (depth == 0 || size_ > 150 || chance(25)) return leaf(type);
    switch (pick(8)) {
      case 0:
        return choice(type, depth - 1);
      case 1:
        if (call(type, depth - 1)) return;
        break;
      case 2:
        if (builtin(type, depth - 1)) return;
        break;
      default:
        break;
    }
    instruction(type, depth - 1);
  }

  void leaf(SlotType type) {
    Scope fitting;
    for (const std::uint32_t l : scope_)
      if (f().locals[l] == type) fitting.push_back(l);
    if (!fitting.empty() && chance(60)) {
      a_.load(fitting[pick(int(fitting.size()))]);
      return;
    }
    if (type == I) return void(a_.integer(pick(9) - 4));
    if (type == L) return void(a_.logic(pick(2)));
    if (chance(40)) {
      a_.real((pick(41) - 20) * 0.25);
      if (type == S) a_.op(Op::Splat);
      return;
    }
    Scope inputs;
    for (int k = 0; k < input_count(); ++k)
      if (input_type(k) == type) inputs.push_back(std::uint32_t(k));
    a_.op(Op::PushInput, inputs[pick(int(inputs.size()))]);
  }

  void instruction(SlotType type, int depth) {
    std::vector<Op> fitting;
    for (int k = 0; k < kOpCount; ++k)
      if ((kOps[k].operand == OperandForm::None || kOps[k].operand == OperandForm::Wavelength) &&
          kOps[k].pushes == std::string(1, letter(type)))
        fitting.push_back(static_cast<Op>(k));
    const Op op = fitting[pick(int(fitting.size()))];
    for (const char c : info(op).pops)
      expression(c == 'r' ? R : c == 'i' ? I : c == 'l' ? L : S, depth);
    a_.op(op, info(op).operand == OperandForm::Wavelength ? std::uint32_t(pick(kWavelengths)) : 0);
  }

  /// An If that leaves a value, or three of which one is chosen.
  void choice(SlotType type, int depth) {
    constexpr Op selects[] = {Op::SelectR, Op::SelectI, Op::SelectL, Op::SelectS};
    expression(L, depth);
    const bool three = chance(30);
    const std::vector<SlotType> results =
        three ? std::vector<SlotType>{L, type, type} : std::vector<SlotType>{type};
    a_.begin(results);
    for (int k = 0; k < 2; ++k) {
      if (k == 1) a_.other();
      const Scope before = scope_;
      if (chance(30)) store(any_type());
      for (const SlotType t : results) expression(t, depth);
      scope_ = before;
    }
    a_.end();
    if (three) a_.op(selects[static_cast<int>(type)]);
  }

  bool call(SlotType type, int depth) {
    const int callee = self_ + pick(int(signatures_.size()) - self_);
    const Signature& s = signatures_[callee];
    if (callee == self_ && !(s.loops && chance(30))) return false;
    const auto wanted = std::find(s.results.begin(), s.results.end(), type);
    if (wanted == s.results.end()) return false;
    for (std::size_t p = 0; p < s.params.size(); ++p) {
      if (p == 0 && callee == self_)
        a_.load(0).integer(1).op(Op::SubI);
      else
        expression(s.params[p], depth);
      if (p == 0 && s.loops && callee != self_) a_.integer(4).op(Op::ModI);
    }
    a_.call(std::uint32_t(callee));
    store_results(s.results);
    a_.load(scope_[scope_.size() - 1 - std::size_t(wanted - s.results.begin())]);
    return true;
  }
  /// From the top of the stack down: so the last in scope is the first result.
  void store_results(const std::vector<SlotType>& results) {
    for (std::size_t k = results.size(); k-- > 0;) store_top(results[k]);
  }

  bool builtin(SlotType type, int depth) {
    if (type == R && chance(50)) {
      expression(R, depth);
      expression(R, depth);
      a_.op(Op::CallBuiltin, kSumAndDifference).op(Op::MulR);
    } else if (type == R) {
      for (int k = 0; k < 3; ++k) expression(R, depth);
      a_.op(Op::CallBuiltin, kScaleAndShift);
    } else if (type == S) {
      const std::uint32_t spectra = std::uint32_t(pick(8));
      for (int k = 0; k < 3; ++k) expression(spectra >> k & 1 ? S : R, depth);
      a_.op(Op::CallSpectral, kScaleAndShift, spectra);
    } else if (type == L) {
      expression(R, depth);
      a_.op(Op::CallBuiltin, kIsNonzero);
    } else {
      return false;
    }
    return true;
  }

  std::mt19937 random_;
  Assembler a_;
  std::vector<Signature> signatures_;
  int self_ = 0, size_ = 0;
  Scope scope_;
};

}  // namespace mms::vm::test
