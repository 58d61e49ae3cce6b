// SPDX-License-Identifier: Apache-2.0
#include "vm/verify_code.h"

#include <algorithm>

#include "vm/limits.h"

namespace mms::vm {
namespace {

constexpr SlotType type_of(char letter) {
  return letter == 'r'   ? SlotType::Real
         : letter == 'i' ? SlotType::Integer
         : letter == 'l' ? SlotType::Logic
                         : SlotType::Spectrum;
}

/// Which locals hold a value. Each arm's stores are a segment of one log, so arms cost what they
/// store and no more.
class LocalStates {
 public:
  /// A value is there on no path, on some, or on all.
  enum State : std::uint8_t { None, Some, All, Pending };
  struct Store {
    std::uint32_t local;
    State state;
  };

  LocalStates(std::size_t locals, std::size_t params) : states_(locals, None) {
    std::fill_n(states_.begin(), params, All);
  }

  State operator[](std::uint32_t local) const { return states_[local]; }
  void store(std::uint32_t local) { add(local, All); }
  std::size_t mark() const { return log_.size(); }

  /// Forgets the stores since `mark` and returns them.
  std::vector<Store> take(std::size_t mark) {
    std::vector<Store> stores;
    for (std::size_t k = mark; k < log_.size(); ++k) {
      stores.push_back({log_[k], states_[log_[k]]});
      states_[log_[k]] = None;
    }
    log_.resize(mark);
    return stores;
  }
  void add(const std::vector<Store>& stores) {
    for (const Store& s : stores) add(s.local, s.state);
  }

  /// Joins the stores since `mark`, of one arm, with those of the other.
  void join(std::size_t mark, const std::vector<Store>& other) {
    const std::size_t end = log_.size();
    for (std::size_t k = mark; k < end; ++k)
      if (states_[log_[k]] == All) states_[log_[k]] = Pending;
    for (const Store& s : other) {
      if (states_[s.local] == None)
        add(s.local, Some);
      else
        states_[s.local] = states_[s.local] == Pending && s.state == All ? All : Some;
    }
    for (std::size_t k = mark; k < end; ++k)
      if (states_[log_[k]] == Pending) states_[log_[k]] = Some;
  }

 private:
  void add(std::uint32_t local, State state) {
    states_[local] = state;
    log_.push_back(local);
  }
  std::vector<State> states_;
  std::vector<std::uint32_t> log_;  // locals whose state is not None, parameters left out
};

class CodeVerifier {
 public:
  CodeVerifier(const Program& program, const Function& f)
      : program_(program), f_(f), locals_(f.locals.size(), f.params.size()) {}

  std::optional<VerifyFault> run() {
    frame_ = *blocks_of(f_.locals) + *blocks_of(f_.results);
    for (pc_ = 0; pc_ < f_.code.size() && ok(); ++pc_) step(f_.code[pc_]);
    if (ok()) {
      check(arms_.empty(), "If without End");
      check(dead_, "the end is reached without Return or TailCall");
    }
    if (ok()) return std::nullopt;
    return VerifyFault{f_.name, pc_ == 0 ? 0 : pc_ - 1, what_, limit_};
  }

 private:
  struct Arm {
    const std::vector<SlotType>* results;
    std::size_t height;  // of the stack when the If was entered
    std::size_t mark;    // of the locals
    bool in_else = false;
    bool then_dead = false;
    std::vector<LocalStates::Store> then_stores;
    std::size_t held = 0;  // blocks that the first arm left
  };

  bool ok() const { return what_.empty(); }
  /// Notes the first fault.
  bool check(bool condition, const char* what) {
    if (!condition && ok()) what_ = what;
    return condition;
  }
  void check_limit(bool condition, const char* what) {
    limit_ = limit_ || (ok() && !condition);
    check(condition, what);
  }

  void push(SlotType t) {
    stack_.push_back(t);
    frame_ += block_count(t);
    check_limit(frame_ <= std::size_t(limits::kSlots), "too many values and locals");
  }
  void push(const std::vector<SlotType>& types) {
    for (const SlotType t : types) push(t);
  }
  std::size_t floor() const { return arms_.empty() ? 0 : arms_.back().height; }

  void pop(SlotType t) {
    if (!check(stack_.size() > floor(), "an operand is missing")) return;
    check(stack_.back() == t, "an operand has the wrong type");
    frame_ -= block_count(stack_.back());
    stack_.pop_back();
  }
  /// Pops values of those types, the last on top.
  void pop(const std::vector<SlotType>& types) {
    for (std::size_t k = types.size(); k-- > 0 && ok();) pop(types[k]);
  }

  void step(const Instruction& i) {
    if (!check(static_cast<std::size_t>(i.op) < kOpCount, "no such instruction")) return;
    if (dead_ && i.op != Op::Else && i.op != Op::End) {
      check(false, "nothing reaches this instruction");
      return;
    }
    const OpInfo& row = info(i.op);
    if (!check(i.a < operand_limit(row.operand), "the operand is out of range")) return;
    for (std::size_t k = row.pops.size(); k-- > 0;)
      if (row.pops[k] != '?') pop(type_of(row.pops[k]));
    if (!ok()) return;
    special(i);
    if (!ok()) return;
    for (const char c : row.pushes)
      if (c != '?') push(type_of(c));
  }

  std::uint64_t operand_limit(OperandForm form) const {
    switch (form) {
      case OperandForm::None:
        return std::uint64_t(1) << 32;
      case OperandForm::Constant:
        return program_.constants.size();
      case OperandForm::Input:
        return input_count();
      case OperandForm::Local:
        return f_.locals.size();
      case OperandForm::BlockType:
        return program_.block_types.size();
      case OperandForm::Function:
        return program_.functions.size();
      case OperandForm::Builtin:
        return program_.builtins.size();
      case OperandForm::Wavelength:
        return kWavelengths;
    }
    return 0;
  }

  /// What the operand table leaves to the operand.
  void special(const Instruction& i) {
    switch (i.op) {
      case Op::PushConst:
        return push(program_.constants[i.a].type);
      case Op::PushInput:
        return push(input_type(int(i.a)));
      case Op::LoadLocal:
        check(locals_[i.a] == LocalStates::All, "a local is loaded before it is stored");
        return push(f_.locals[i.a]);
      case Op::StoreLocal:
        return store(i.a);
      case Op::If:
        return begin_if(program_.block_types[i.a]);
      case Op::Else:
        return begin_else();
      case Op::End:
        return end_if();
      case Op::Call:
        pop(program_.functions[i.a].params);
        return push(program_.functions[i.a].results);
      case Op::CallBuiltin:
        if (!has_kernels(i.a)) return;
        pop(program_.builtin_params[i.a]);
        return push(program_.builtin_results[i.a]);
      case Op::CallSpectral:
        return call_spectral(i.a, i.b);
      case Op::TailCall:
        return leave(f_.params);
      case Op::Return:
        return leave(f_.results);
      default:
        return;
    }
  }

  void store(std::uint32_t local) {
    check(locals_[local] == LocalStates::None, "a local is stored twice");
    pop(f_.locals[local]);
    if (ok()) locals_.store(local);
  }

  bool has_kernels(std::uint32_t builtin) {
    const Builtin& row = *program_.builtins[builtin];
    return check(row.f32 && row.f64, "the builtin has no kernel");
  }

  void call_spectral(std::uint32_t builtin, std::uint32_t spectra) {
    const std::vector<SlotType>& params = program_.builtin_params[builtin];
    const std::vector<SlotType>& results = program_.builtin_results[builtin];
    const auto real = [](SlotType t) { return t == SlotType::Real; };
    if (!has_kernels(builtin)) return;
    if (!check(std::all_of(params.begin(), params.end(), real) && results.size() == 1 &&
                   real(results[0]),
               "only a builtin from reals to one real works at each wavelength"))
      return;
    if (!check(params.size() >= 32 || spectra >> params.size() == 0,
               "a bit says that an argument which is not there is a spectrum"))
      return;
    for (std::size_t k = params.size(); k-- > 0 && ok();)
      pop(k < 32 && (spectra >> k & 1) ? SlotType::Spectrum : SlotType::Real);
  }

  void leave(const std::vector<SlotType>& types) {
    pop(types);
    check(stack_.empty(), "values are left under those of Return or TailCall");
    dead_ = true;
  }

  void begin_if(const std::vector<SlotType>& results) {
    check_limit(arms_.size() < std::size_t(limits::kIfDepth), "If is nested too deeply");
    arms_.push_back({&results, stack_.size(), locals_.mark(), false, false, {}, 0});
  }

  /// Ends an arm: takes its values off the stack.
  void end_arm(const Arm& arm) {
    if (dead_) return;
    pop(*arm.results);
    check(stack_.size() == arm.height, "an arm leaves more values than its block type");
  }

  void begin_else() {
    if (!check(!arms_.empty() && !arms_.back().in_else, "Else without If")) return;
    Arm& arm = arms_.back();
    end_arm(arm);
    if (!ok()) return;
    arm.in_else = true;
    arm.then_dead = dead_;
    arm.then_stores = locals_.take(arm.mark);
    arm.held = dead_ ? 0 : *blocks_of(*arm.results);
    frame_ += arm.held;
    dead_ = false;
  }

  void end_if() {
    if (!check(!arms_.empty(), "End without If")) return;
    if (!arms_.back().in_else) {
      check(arms_.back().results->empty(), "an If with results has no Else");
      begin_else();
      if (!ok()) return;
    }
    const Arm arm = std::move(arms_.back());
    end_arm(arm);
    arms_.pop_back();
    if (!ok()) return;
    frame_ -= arm.held;
    if (!dead_ && !arm.then_dead) {
      locals_.join(arm.mark, arm.then_stores);
    } else if (dead_) {
      locals_.take(arm.mark);
      if (!arm.then_dead) locals_.add(arm.then_stores);
    }
    dead_ = dead_ && arm.then_dead;
    if (!dead_) push(*arm.results);
  }

  const Program& program_;
  const Function& f_;
  std::vector<SlotType> stack_;
  std::vector<Arm> arms_;
  LocalStates locals_;
  std::size_t frame_ = 0;  // blocks of values, locals and results
  bool dead_ = false;      // nothing reaches this point
  std::size_t pc_ = 0;
  std::string what_;
  bool limit_ = false;
};

}  // namespace

std::optional<std::size_t> blocks_of(const std::vector<SlotType>& types) {
  std::size_t blocks = 0;
  for (const SlotType t : types) {
    if (!valid(t)) return std::nullopt;
    blocks += block_count(t);
  }
  if (blocks > std::size_t(limits::kSlots)) return std::nullopt;
  return blocks;
}

std::optional<VerifyFault> verify_code(const Program& program, const Function& f) {
  return CodeVerifier(program, f).run();
}

}  // namespace mms::vm
