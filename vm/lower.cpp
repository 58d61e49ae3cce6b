// SPDX-License-Identifier: Apache-2.0
#include "vm/lower.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "vm/call_graph.h"
#include "vm/fuse.h"
#include "vm/input_use.h"
#include "vm/slots.h"
#include "vm/uniform.h"

namespace mms::vm {
namespace {

constexpr LoweredOp lowered(Op op) { return static_cast<LoweredOp>(op); }

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

/// One function. Names: a value is what the stack machine would have on its stack; here it is only
/// where its lanes are.
class FunctionLowering {
 public:
  FunctionLowering(const Program& program, std::uint32_t function, LoweredCode& code)
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

  LoweredFunction lower(const PairOf& pair_of) {
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

  std::vector<LoweredResult> results() const {
    std::vector<LoweredResult> results;
    for (std::size_t k = 0; k < results_.size(); ++k)
      results.push_back({f_.results[k], results_[k].index()});
    return results;
  }

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

  void count_locals() {
    locals_.resize(f_.locals.size());
    for (const Instruction& i : f_.code) {
      if (i.op == Op::LoadLocal) ++locals_[i.a].loads;
      if (i.op == Op::StoreLocal) ++locals_[i.a].stores;
    }
  }

  void place_results_and_params() {
    for (const SlotType t : f_.results) results_.push_back(slots_.allocate(t, Slots::kPinned));
    row_.result_blocks = slots_.blocks();
    for (std::size_t p = 0; p < f_.params.size(); ++p) {
      const SlotType t = f_.params[p];
      locals_[p].value = {slots_.allocate(t, Slots::kPinned), t};
      locals_[p].placed = true;
    }
    row_.param_blocks = slots_.blocks() - row_.result_blocks;
  }

  // Masks

  Operand new_mask() {
    if (free_masks_.empty()) return Operand::make(Operand::Mask, masks_++);
    const Operand m = free_masks_.back();
    free_masks_.pop_back();
    return m;
  }
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
  void blend(Operand dst, Operand mask, Value value) {
    if (value.at != dst) emit(select_op(value.type), dst, mask, value.at, dst);
  }

  void step(const Instruction& i) {
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

  void arithmetic(Op op) {
    const OpInfo& row = info(op);
    kernel(lowered(op), row.pops.size(), type_of(row.pushes[0]), in_place(row));
  }

  /// `over`: the result may stand where an operand stood.
  void kernel(LoweredOp op, std::size_t arity, SlotType type, bool over) {
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

  /// A component of what is no slot, and of a real that stands for a spectrum, is there already.
  void component(int k) {
    const Value s = pop();
    if (s.at.splat()) return push(s.at.unsplatted(), SlotType::Real);
    if (s.at.base() != Operand::Slot) return push(s.at.component(k), SlotType::Real);
    slots_.read(s.at);
    const Operand dst = slots_.allocate(SlotType::Real);
    emit(LoweredOp::Copy, dst, s.at.component(k));
    release({s});
    push(dst, SlotType::Real);
  }

  void pack() {
    const std::vector<Value> in = pop(kWavelengths);
    const Operand dst = slots_.allocate(SlotType::Spectrum);
    for (int k = 0; k < kWavelengths; ++k)
      emit(LoweredOp::Copy, dst.component(k), in[std::size_t(k)].at);
    slots_.define(dst, std::nullopt);
    release(in);
    push(dst, SlotType::Spectrum);
  }

  /// Takes the instruction before into this one where the pair has an instruction of its own.
  void absorb(LoweredInstruction& i) {
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

  /// Dividing by a constant whose reciprocal is exact is multiplying.
  void divide_exactly(LoweredInstruction& i) {
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

  /// The last instruction, taken back, if it is an `op` that made `o` for nobody else. The slot
  /// `o` stays allocated; what the instruction read still stands where it was.
  std::optional<LoweredInstruction> take_last(LoweredOp op, Operand o) {
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

  // Locals

  void load(Local& local) {
    // The references of a local that only names a value were counted when it was stored.
    if (local.stores != 1) slots_.refer(local.value.at, 1);
    push(local.value.at, local.value.type);
  }

  void store(Local& local) {
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

  // Arms

  void begin_if(std::size_t results) {
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

  void begin_else() {
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

  void end_if() {
    if (!arms_.back().in_else) begin_else();
    Arms arms = std::move(arms_.back());
    arms_.pop_back();
    land(arms.skip_pc);
    if (!arms.then_dead && !dead_)
      join(arms);
    else
      survive(arms);
  }

  /// Both arms arrive: choose each value by the mask of the first arm.
  void join(const Arms& arms) {
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

  void choose(const Arms& arms, Value then_value, Value else_value) {
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

  /// One arm arrives or none: its values and its mask are what is left.
  void survive(const Arms& arms) {
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

  /// Goes on behind the arms with the lanes of one.
  void resume(const Arms& arms, Current left) {
    within(left, arms.then_dead ? arms.else_mask : arms.then_mask);
    release(arms.outer);
    cur_ = {left.at, true};
    skip_if_none();
  }

  /// The mask that an arm ends with, if it is not the arm's own, was not made in a run that skipped
  /// the arm. There the arm's own is empty.
  void within(Current end, Operand arm) {
    if (end.at != arm) emit(LoweredOp::And, end.at, end.at, arm);
  }

  /// The lanes that left may have been all of them. Only outside of arms: a join reads the masks
  /// that its arms made.
  void skip_if_none() {
    if (arms_.empty()) skips_.push_back(emit(LoweredOp::SkipIfNone, {}, cur_.at));
  }

  // Calls

  std::uint32_t pool(const std::vector<Value>& values) {
    const std::uint32_t first = std::uint32_t(code_.operands.size());
    for (const Value& v : values)
      for (int k = 0; k < block_count(v.type); ++k) pool(v.at.component(k));
    return first;
  }
  void pool(Operand o) {
    slots_.read(o);
    code_.operands.push_back(o);
  }
  std::uint32_t pooled_since(std::uint32_t first) const {
    return std::uint32_t(code_.operands.size()) - first;
  }

  /// Fresh slots for results, pushed, and where they start in the pool. A spectrum's slot has no
  /// single definition (it is eight operands), so nothing may redirect it.
  std::uint32_t push_results(const std::vector<SlotType>& types) {
    const std::uint32_t first = std::uint32_t(code_.operands.size());
    for (const SlotType t : types) {
      const Operand o = slots_.allocate(t);
      if (t != SlotType::Spectrum) slots_.define(o, Definition{true, code_.operands.size()});
      for (int k = 0; k < block_count(t); ++k) code_.operands.push_back(o.component(k));
      push(o, t);
    }
    return first;
  }

  void emit_site(LoweredOp op, const CallSite& site) {
    const std::size_t pc = emit(op, {}, cur_.at);
    code_.instructions[pc].target = std::uint32_t(code_.sites.size());
    code_.sites.push_back(site);
  }

  void call(std::uint32_t function) {
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

  CallSite builtin_site(std::uint32_t builtin) const {
    CallSite site;
    site.f32 = program_.builtins[builtin]->f32;
    site.f64 = program_.builtins[builtin]->f64;
    site.image32 = program_.builtins[builtin]->image32;
    site.image64 = program_.builtins[builtin]->image64;
    return site;
  }

  void call_builtin(std::uint32_t builtin) {
    if (const LoweredOp op = program_.builtins[builtin]->instruction; op != LoweredOp::CallBuiltin)
      return kernel(op, program_.builtin_params[builtin].size(),
                    program_.builtin_results[builtin][0], true);
    CallSite site = builtin_site(builtin);
    const std::vector<Value> args = pop(program_.builtin_params[builtin].size());
    site.first_arg = pool(args);
    site.args = pooled_since(site.first_arg);
    site.first_result = push_results(program_.builtin_results[builtin]);
    site.results = pooled_since(site.first_result);
    release(args);
    finish_builtin(site);
  }

  void call_spectral(std::uint32_t builtin, std::uint32_t spectra) {
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

  void finish_builtin(const CallSite& site) {
    code_.builtin_blocks = std::max({code_.builtin_blocks, site.args, site.results});
    emit_site(LoweredOp::CallBuiltin, site);
  }

  // Leaving

  void tail_call() {
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

  /// Assigns a parameter. Where nothing is left to do but to start again, the lanes that do not
  /// never look at it.
  void pass(Operand param, Value value) {
    if (tail_calls_ > 1 || pc_ + 1 != end_of_work_) return blend(param, cur_.at, value);
    if (param != value.at) emit(copy_op(value.type), param, value.at);
  }

  bool reads_param_before(Operand o, std::size_t end) const {
    if (o.base() != Operand::Slot) return false;
    for (std::size_t p = 0; p < end; ++p)
      if (locals_[p].value.at.index() == o.index()) return true;
    return false;
  }

  void leave() {
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

}  // namespace

std::string_view name(LoweredOp op) {
  static constexpr std::string_view kNames[] = {
#define OP(name, ...) #name,
#include "vm/opcodes.def"
#undef OP
      "Copy", "SkipIfNone", "FmsR", "FnmaR", "MadI", "ModByR", "FloorR", "AbsR", "SqrtR",
#define PAIR(first, second, position, constants) #first "_" #second "_" #position "_" #constants,
#include "vm/pairs.def"
#undef PAIR
  };
  return kNames[static_cast<std::size_t>(op)];
}

LoweredCode lower(const Program& program) { return lower(program, tabled_pair); }

LoweredCode lower(const Program& program, const PairOf& pair_of) {
  LoweredCode code;
  code.constants = program.constants;
  code.identity = std::make_shared<const char>();
  for (const ProgramImage& i : program.images) {
    code.images.push_back(i.image ? i.image : magenta());
    code.image_table.push_back(code.images.back().get());
  }
  const CallGraph graph = call_graph(program);
  for (std::uint32_t f = 0; f < program.functions.size(); ++f) {
    FunctionLowering lowering(program, f, code);
    LoweredFunction row = lowering.lower(pair_of);
    row.recursive = graph.recursive[f];
    code.frame_blocks = std::max(code.frame_blocks, row.masks + row.blocks);
    code.functions.push_back(row);
    code.results.push_back(lowering.results());
  }
  find_input_use(code, graph);
  find_uniform_sites(code);
  return code;
}

}  // namespace mms::vm
