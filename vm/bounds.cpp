// SPDX-License-Identifier: Apache-2.0
#include "vm/bounds.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <utility>

#include "vm/call_graph.h"
#include "vm/limits.h"
#include "vm/polynomial.h"

namespace mms::vm {
namespace {

using Index = std::uint32_t;
constexpr Index kNone = ~Index(0);
constexpr std::uint64_t kMost = 10 * std::uint64_t(limits::kBoundsInstructions);

/// A value that the program computed: single assignment, so that a value has one index for as long
/// as its function runs, and equal indices are equal values.
struct Node {
  Interval value;
  Op op = Op::PushConst;  ///< what made it: an input, constant, parameter or join says PushConst
  Index a = kNone, b = kNone;
  Index cubic = kNone;  ///< where it is a polynomial of an earlier value
};

/// A value as a polynomial of one earlier value.
struct Cubic {
  Index of;
  Polynomial polynomial;
};

using Values = std::vector<Interval>;

/// Where the arms of an If end.
struct Jump {
  Index else_pc = kNone, end_pc = kNone;
};

std::vector<Jump> jumps_of(const Function& f) {
  std::vector<Jump> jumps(f.code.size());
  std::vector<Index> open;
  for (Index pc = 0; pc < f.code.size(); ++pc) {
    if (f.code[pc].op == Op::If) open.push_back(pc);
    if (f.code[pc].op == Op::Else) jumps[open.back()].else_pc = pc;
    if (f.code[pc].op == Op::End) {
      jumps[open.back()].end_pc = pc;
      open.pop_back();
    }
  }
  return jumps;
}

/// Blocks that a frame of `f` has at most once it is lowered: what an instruction leaves, and
/// masks.
std::size_t most_blocks(const Function& f) {
  std::size_t blocks = (f.code.size() + 2) * (kWavelengths + 3);
  for (const auto* types : {&f.locals, &f.results})
    for (const SlotType t : *types) blocks += static_cast<std::size_t>(block_count(t));
  return blocks;
}

}  // namespace

Interval& Box::at(Variable v, int component) {
  return inputs[static_cast<std::size_t>(input_index(v, component))];
}

Box Box::unit_sphere() {
  constexpr double kInf = Interval::kInf;
  Box box;
  for (int k = 0; k < input_count(); ++k) {
    Interval& i = box.inputs[static_cast<std::size_t>(k)];
    switch (input_variable(k)) {
      case Variable::Uv:
      case Variable::RgbRed:
      case Variable::RgbGreen:
        i = {0, 1, false};
        break;
      case Variable::Distance:
        i = {0, kInf, false};
        break;
      case Variable::Footprint:
      case Variable::UvTangent:
      case Variable::UvBitangent:
        i = {-kInf, kInf, false};
        break;
      case Variable::Time:
        i = {0, 0, false};
        break;
      case Variable::Wavelength:
        // A little more, for nanometres become metres in float.
        i = reals(kLambdaMin * 1e-9 * (1 - 0x1p-22), kLambdaMax * 1e-9 * (1 + 0x1p-22));
        break;
      default:
        i = {-1, 1, false};
    }
  }
  return box;
}

struct BoundsMachine::State {
  struct Store {
    Index local, node;
    Interval value;
  };
  /// An If whose arms are being run.
  struct Arm {
    Jump jump;
    Index condition;
    const std::vector<SlotType>* types;
    std::size_t height, undo_mark, store_mark;
    bool in_else = false, then_dead = false, else_dead = false;
    std::vector<Index> then_results;
    Values then_values;  // as narrow as they were in that arm
    std::vector<Store> then_stores;
  };
  /// One run of a function's code from its start.
  struct Pass {
    const Function& f;
    const std::vector<Jump>& jumps;
    int depth;
    std::vector<Index> locals;
    std::vector<Index> stack;
    std::vector<Arm> arms;
    std::vector<Store> stores;
    std::optional<Values> returned;
    std::optional<Values> tail;
    std::vector<Index> tail_nodes;  // kNone where several tail calls differ
    std::size_t pc = 0;
  };

  explicit State(const Program& p) : program(p), recursive(call_graph(p).recursive) {
    for (const Function& f : p.functions) {
      jumps.push_back(jumps_of(f));
      blocks.push_back(most_blocks(f));
    }
    open_calls.assign(p.functions.size(), 0);
  }

  const Program& program;
  std::vector<bool> recursive;
  std::vector<std::vector<Jump>> jumps;
  std::vector<std::size_t> blocks;
  std::vector<Node> nodes;
  std::vector<Cubic> cubics;
  std::vector<std::pair<Index, Interval>> undo;
  std::vector<int> open_calls;
  std::vector<Interval> in, out;  // of a builtin
  std::size_t open_blocks = 0;
  std::uint64_t instructions = 0, back_edges = 0;
  bool widened = false, may_give_up = false;

  // Values

  const Interval& value(Index n) const { return nodes[n].value; }
  Index make(const Interval& v, Op op = Op::PushConst, Index a = kNone, Index b = kNone) {
    nodes.push_back({v, op, a, b, kNone});
    return static_cast<Index>(nodes.size() - 1);
  }
  void forget(std::size_t mark) {
    while (nodes.size() > mark) {
      if (nodes.back().cubic != kNone) cubics.pop_back();
      nodes.pop_back();
    }
  }
  void narrow_to(Index n, const Interval& v) {
    if (nodes[n].value == v) return;
    undo.emplace_back(n, nodes[n].value);
    nodes[n].value = v;
  }
  void undo_to(std::size_t mark) {
    for (; undo.size() > mark; undo.pop_back()) nodes[undo.back().first].value = undo.back().second;
  }

  /// Takes for granted that a logic value is `outcome`; whether that can be.
  bool assume(Index n, bool outcome) {
    const Node node = nodes[n];
    if (!(outcome ? can_be_true(node.value) : can_be_false(node.value))) return false;
    narrow_to(n, Interval::point(outcome));
    switch (node.op) {
      case Op::Not:
        return assume(node.a, !outcome);
      case Op::And:
        return !outcome || (assume(node.a, true) && assume(node.b, true));
      case Op::Or:
        return outcome || (assume(node.a, false) && assume(node.b, false));
      case Op::LtR:
      case Op::LtI:
        return assume_order(Comparison::Less, outcome, node);
      case Op::LeR:
      case Op::LeI:
        return assume_order(Comparison::LessEqual, outcome, node);
      case Op::EqR:
      case Op::EqI:
        return assume_order(Comparison::Equal, outcome, node);
      case Op::NeR:
      case Op::NeI:
        return assume_order(Comparison::NotEqual, outcome, node);
      default:
        return true;
    }
  }
  bool assume_order(Comparison c, bool outcome, const Node& node) {
    if (node.a == node.b) return true;
    Interval a = value(node.a), b = value(node.b);
    const bool integers = node.op == Op::LtI || node.op == Op::LeI;
    narrow(c, outcome, integers, a, b);
    if (a.is_empty() || b.is_empty()) return false;
    narrow_to(node.a, a);
    narrow_to(node.b, b);
    return true;
  }

  // Instructions

  Interval unary(Op op, const Interval& a) const {
    switch (op) {
      case Op::NegI:
        return neg_integer(a);
      case Op::RealOfInt:
        return real_of_integer(a);
      case Op::IntOfReal:
        return integer_of_real(a);
      case Op::Not:
        return {1 - a.hi, 1 - a.lo, false};
      case Op::NegR:
      case Op::NegS:
        return neg(a);
      default:
        return Interval::whole();
    }
  }

  Interval binary(Op op, Index m, Index n) const {
    const Interval &a = value(m), &b = value(n);
    const bool same = m == n;
    switch (op) {
      case Op::AddR:
      case Op::AddS:
        return add(a, b);
      case Op::SubR:
      case Op::SubS:
        return same && a.has_number() ? Interval{0, 0, a.nan || a.contains_infinity()} : sub(a, b);
      case Op::MulR:
      case Op::MulS:
        return same ? square(a) : mul(a, b);
      case Op::DivR:
      case Op::DivS:
        return same && a.has_number()
                   ? Interval{1, 1, a.nan || a.contains(0) || a.contains_infinity()}
                   : div(a, b);
      case Op::ModR:
        return mod(a, b);
      case Op::AddI:
        return add_integers(a, b);
      case Op::SubI:
        return same ? Interval::point(0) : sub_integers(a, b);
      case Op::MulI:
        return mul_integers(a, b);
      case Op::ModI:
        return mod_integers(a, b);
      case Op::LtR:
      case Op::LtI:
        return same ? logic(true, false) : compare(Comparison::Less, a, b);
      case Op::LeR:
      case Op::LeI:
        return same ? logic(a.nan, a.has_number()) : compare(Comparison::LessEqual, a, b);
      case Op::EqR:
      case Op::EqI:
        return same ? logic(a.nan, a.has_number()) : compare(Comparison::Equal, a, b);
      case Op::NeR:
      case Op::NeI:
        return same ? logic(a.has_number(), a.nan) : compare(Comparison::NotEqual, a, b);
      case Op::And:
        return {std::min(a.lo, b.lo), std::min(a.hi, b.hi), false};
      default:  // Or
        return {std::max(a.lo, b.lo), std::max(a.hi, b.hi), false};
    }
  }

  Interval fused(Index a, Index b, Index c) const {
    if (a == b) return square_fma(value(a), value(c));
    const auto is_difference = [&](Index d) {
      return (nodes[d].op == Op::SubR || nodes[d].op == Op::SubS) && nodes[d].b == c;
    };
    if (is_difference(a)) return blend(value(c), value(nodes[a].a), value(a), value(b));
    if (is_difference(b)) return blend(value(c), value(nodes[b].a), value(b), value(a));
    return fma(value(a), value(b), value(c));
  }

  Index select(Index condition, Index yes, Index no) {
    const std::size_t mark = undo.size();
    std::optional<Interval> a, b;
    if (assume(condition, true)) a = value(yes);
    undo_to(mark);
    if (assume(condition, false)) b = value(no);
    undo_to(mark);
    if (a && b) return yes == no ? yes : make(join(*a, *b));
    return a ? yes : no;
  }

  // Polynomials

  bool is_constant(Index n) const { return n >= first_constant() && n < first_value(); }
  static Index first_constant() { return static_cast<Index>(input_count()); }
  Index first_value() const {
    return first_constant() + static_cast<Index>(program.constants.size());
  }
  /// The value that `n` is a polynomial of; itself if of no other.
  Index root(Index n) const { return nodes[n].cubic == kNone ? n : cubics[nodes[n].cubic].of; }

  /// `n` as a polynomial of `of`, if it is one.
  std::optional<Polynomial> polynomial(Index n, Index of) const {
    if (is_constant(n) && !value(n).contains_infinity() && !value(n).nan)
      return Polynomial::constant(value(n));
    if (n == of) return Polynomial::identity();
    if (nodes[n].cubic == kNone || cubics[nodes[n].cubic].of != of) return std::nullopt;
    return cubics[nodes[n].cubic].polynomial;
  }

  std::optional<Polynomial> polynomial(Op op, std::span<const Index> operands, Index of) const {
    const double size = value(of).magnitude();
    std::optional<Polynomial> p[3];
    for (std::size_t k = 0; k < operands.size(); ++k)
      if (!(p[k] = polynomial(operands[k], of))) return std::nullopt;
    const auto fits = [&] { return p[0]->degree() + p[1]->degree() < Polynomial::kTerms; };
    switch (op) {
      case Op::NegR:
      case Op::NegS:
        return negative(*p[0]);
      case Op::AddR:
      case Op::AddS:
        return vm::sum(*p[0], *p[1], size);
      case Op::SubR:
      case Op::SubS:
        return vm::sum(*p[0], negative(*p[1]), size);
      case Op::MulR:
      case Op::MulS:
        return fits() ? std::optional(vm::product(*p[0], *p[1], size)) : std::nullopt;
      case Op::FmaR:
      case Op::FmaS:
        return fits() ? std::optional(vm::sum(vm::product(*p[0], *p[1], size), *p[2], size))
                      : std::nullopt;
      default:
        return std::nullopt;
    }
  }

  /// Where result `n` is a polynomial of a value that occurs in it more than once, what that says.
  Index tightened(Index n, std::initializer_list<Index> operands) {
    const std::span<const Index> all(operands.begin(), operands.size());
    for (const Index operand : all) {
      if (is_constant(operand)) continue;
      for (const Index of : {root(operand), operand}) {
        const Interval& x = value(of);
        if (!x.has_number() || !(x.magnitude() < 1e9)) continue;
        const std::optional<Polynomial> p = polynomial(nodes[n].op, all, of);
        if (!p) continue;
        nodes[n].cubic = static_cast<Index>(cubics.size());
        cubics.push_back({of, *p});
        if (p->degree() > 1) {
          const bool nan = nodes[n].value.nan;
          nodes[n].value = meet(nodes[n].value, p->range(x));
          nodes[n].value.nan = nan;
        }
        return n;
      }
    }
    return n;
  }

  static Index pop(Pass& p) {
    const Index n = p.stack.back();
    p.stack.pop_back();
    return n;
  }
  static std::vector<Index> pop(Pass& p, std::size_t count) {
    std::vector<Index> taken(p.stack.end() - static_cast<std::ptrdiff_t>(count), p.stack.end());
    p.stack.resize(p.stack.size() - count);
    return taken;
  }

  void simple(Pass& p, const Instruction& i) {
    const std::size_t operands = info(i.op).pops.size();
    if (operands == 3) {
      const Index c = pop(p), b = pop(p), a = pop(p);
      if (i.op == Op::FmaR || i.op == Op::FmaS)
        p.stack.push_back(tightened(make(fused(a, b, c), i.op, a, b), {a, b, c}));
      else
        p.stack.push_back(select(a, b, c));
    } else if (operands == 2) {
      const Index b = pop(p), a = pop(p);
      p.stack.push_back(tightened(make(binary(i.op, a, b), i.op, a, b), {a, b}));
    } else {
      const Index a = pop(p);
      p.stack.push_back(tightened(make(unary(i.op, value(a)), i.op, a), {a}));
    }
  }

  void builtin(Pass& p, const Instruction& i) {
    const Builtin& row = *program.builtins[i.a];
    const std::vector<SlotType>& results = program.builtin_results[i.a];
    const std::vector<Index> args = pop(p, program.builtin_params[i.a].size());
    instructions += static_cast<std::uint64_t>(row.cost);
    in.clear();
    for (const Index n : args) in.push_back(value(n));
    out.resize(results.size());
    enclose_row(row, results, in, out);
    for (const Interval& r : out) p.stack.push_back(make(r, i.op));
  }

  // Calls

  /// Every value of the results of a function.
  static Values anything(const Function& f) {
    Values r;
    for (const SlotType t : f.results) r.push_back(Interval::all(t));
    return r;
  }

  /// What function `f` returns; nothing if it never does.
  std::optional<Values> call(Index f, std::vector<Index> args, int depth) {
    const Function& function = program.functions[f];
    if (recursive[f]) ++back_edges;
    if (depth > limits::kCallDepth) {
      may_give_up = true;
      return std::nullopt;
    }
    if (open_calls[f] >= limits::kBoundsDepth || instructions > kMost) {
      widened = may_give_up = true;
      return anything(function);
    }
    ++open_calls[f];
    open_blocks += blocks[f];
    if (open_blocks > limits::kStackBlocks) may_give_up = true;
    std::optional<Values> r = loop(f, std::move(args), depth);
    open_blocks -= blocks[f];
    --open_calls[f];
    return r;
  }

  std::optional<Values> loop(Index f, std::vector<Index> args, int depth) {
    const std::size_t mark = nodes.size();
    std::optional<Values> returned;
    const auto pass = [&] {
      Pass p{program.functions[f], jumps[f], depth, {}, {}, {}, {}, {}, {}, {}, 0};
      p.locals = args;
      p.locals.resize(p.f.locals.size(), kNone);
      const std::size_t undo_mark = undo.size();
      run(p);
      undo_to(undo_mark);
      if (p.returned) join_into(returned, *p.returned);
      return p;
    };
    for (int step = 0;; ++step) {
      const Pass p = pass();
      if (p.tail) {
        ++back_edges;
        if (step < limits::kBoundsSteps && instructions < limits::kBoundsInstructions) {
          forget(mark);
          for (std::size_t k = 0; k < args.size(); ++k)
            args[k] = p.tail_nodes[k] < mark ? p.tail_nodes[k] : make((*p.tail)[k]);
          continue;
        }
        widen(f, *p.tail, args, mark, pass);
      }
      break;
    }
    forget(mark);
    return returned;
  }

  /// Goes round until every later step of the loop is covered.
  template <class PassOnce>
  void widen(Index f, Values covered, std::vector<Index>& args, std::size_t mark, PassOnce pass) {
    widened = may_give_up = true;
    const std::vector<SlotType>& types = program.functions[f].params;
    if (instructions > kMost)
      for (std::size_t k = 0; k < covered.size(); ++k) covered[k] = Interval::all(types[k]);
    for (int round = 0;; ++round) {
      forget(mark);
      for (std::size_t k = 0; k < args.size(); ++k) args[k] = make(covered[k]);
      const Pass p = pass();
      if (!p.tail) return;
      bool grew = false;
      for (std::size_t k = 0; k < args.size(); ++k) {
        const Interval next = join(covered[k], (*p.tail)[k]);
        if (next == covered[k]) continue;
        grew = true;
        covered[k] = round < 2                       ? next
                     : round < limits::kBoundsRounds ? vm::widened(covered[k], next, types[k])
                                                     : Interval::all(types[k]);
      }
      if (!grew) return;
    }
  }

  static void join_into(std::optional<Values>& all, const Values& more) {
    if (!all) {
      all = more;
      return;
    }
    for (std::size_t k = 0; k < more.size(); ++k) (*all)[k] = join((*all)[k], more[k]);
  }

  Values values_of(const std::vector<Index>& of) const {
    Values r;
    for (const Index n : of) r.push_back(value(n));
    return r;
  }

  // Control

  /// Nothing goes on from here: to where the other arm or the code after the If is.
  static void die(Pass& p) {
    if (p.arms.empty()) {
      p.pc = p.f.code.size();
      return;
    }
    Arm& arm = p.arms.back();
    if (!arm.in_else && arm.jump.else_pc != kNone) {
      arm.then_dead = true;
      p.pc = arm.jump.else_pc;
    } else {
      (arm.in_else ? arm.else_dead : arm.then_dead) = true;
      p.pc = arm.jump.end_pc;
    }
  }

  std::vector<Store> take_stores(Pass& p, std::size_t mark) const {
    std::vector<Store> taken(p.stores.begin() + static_cast<std::ptrdiff_t>(mark), p.stores.end());
    p.stores.resize(mark);
    for (Store& s : taken) {
      s.value = value(s.node);
      p.locals[s.local] = kNone;
    }
    return taken;
  }
  static void store(Pass& p, Index local, Index node) {
    p.locals[local] = node;
    p.stores.push_back({local, node, {}});
  }

  void begin_if(Pass& p, const Instruction& i) {
    Arm arm;
    arm.jump = p.jumps[p.pc];
    arm.condition = pop(p);
    arm.types = &program.block_types[i.a];
    arm.height = p.stack.size();
    arm.undo_mark = undo.size();
    arm.store_mark = p.stores.size();
    p.arms.push_back(std::move(arm));
    ++p.pc;
    if (!assume(p.arms.back().condition, true)) die(p);
  }

  /// Puts the first arm's results and stores aside and begins the second.
  void begin_else(Pass& p) {
    Arm& arm = p.arms.back();
    if (!arm.then_dead) arm.then_results = pop(p, arm.types->size());
    arm.then_values = values_of(arm.then_results);
    arm.then_stores = take_stores(p, arm.store_mark);
    p.stack.resize(arm.height);
    undo_to(arm.undo_mark);
    arm.in_else = true;
    ++p.pc;
    if (!assume(arm.condition, false)) die(p);
  }

  void end_if(Pass& p) {
    if (!p.arms.back().in_else) {
      // There is no Else: the second arm does nothing.
      begin_else(p);
      p.pc = p.arms.back().jump.end_pc;
    }
    Arm arm = std::move(p.arms.back());
    p.arms.pop_back();
    ++p.pc;
    if (arm.then_dead && arm.else_dead) {
      undo_to(arm.undo_mark);
      take_stores(p, arm.store_mark);
      p.stack.resize(arm.height);
      return die(p);
    }
    if (arm.then_dead) return;  // what the second arm assumes goes on to hold
    if (arm.else_dead) {
      take_stores(p, arm.store_mark);
      p.stack.resize(arm.height);
      p.stack.insert(p.stack.end(), arm.then_results.begin(), arm.then_results.end());
      undo_to(arm.undo_mark);
      for (const Store& s : arm.then_stores) store(p, s.local, s.node);
      if (!assume(arm.condition, true)) die(p);
      return;
    }
    join_arms(p, arm);
  }

  void join_arms(Pass& p, const Arm& arm) {
    const std::vector<Index> other = pop(p, arm.types->size());
    const Values other_values = values_of(other);
    const std::vector<Store> stores = take_stores(p, arm.store_mark);
    undo_to(arm.undo_mark);
    for (std::size_t k = 0; k < other.size(); ++k)
      p.stack.push_back(other[k] == arm.then_results[k]
                            ? other[k]
                            : make(join(arm.then_values[k], other_values[k])));
    for (const Store& first : arm.then_stores)
      for (const Store& second : stores)
        if (first.local == second.local)
          store(p, first.local,
                first.node == second.node ? first.node : make(join(first.value, second.value)));
  }

  void tail_call(Pass& p) {
    const std::vector<Index> args = pop(p, p.f.params.size());
    if (!p.tail) {
      p.tail = values_of(args);
      p.tail_nodes = args;
    } else {
      join_into(p.tail, values_of(args));
      for (std::size_t k = 0; k < args.size(); ++k)
        if (p.tail_nodes[k] != args[k]) p.tail_nodes[k] = kNone;
    }
    die(p);
  }

  void run(Pass& p) {
    while (p.pc < p.f.code.size()) {
      const Instruction& i = p.f.code[p.pc];
      ++instructions;
      switch (i.op) {
        case Op::PushConst:
          p.stack.push_back(first_constant() + i.a);
          break;
        case Op::PushInput:
          p.stack.push_back(i.a);
          break;
        case Op::LoadLocal:
          p.stack.push_back(p.locals[i.a]);
          break;
        case Op::StoreLocal:
          store(p, i.a, pop(p));
          break;
        case Op::Splat:  // a number is its own spectrum
          break;
        case Op::Component:  // not the same value as another component
          p.stack.push_back(make(value(pop(p))));
          break;
        case Op::Pack: {
          Interval all = Interval::empty();
          for (const Interval& v : values_of(pop(p, kWavelengths))) all = join(all, v);
          p.stack.push_back(make(all));
          break;
        }
        case Op::If:
          begin_if(p, i);
          continue;
        case Op::Else:
          begin_else(p);
          continue;
        case Op::End:
          end_if(p);
          continue;
        case Op::Call: {
          const auto r = call(i.a, pop(p, program.functions[i.a].params.size()), p.depth + 1);
          if (!r) {
            die(p);
            continue;
          }
          for (const Interval& v : *r) p.stack.push_back(make(v));
          break;
        }
        case Op::CallBuiltin:
        case Op::CallSpectral:
          builtin(p, i);
          break;
        case Op::TailCall:
          tail_call(p);
          continue;
        case Op::Return:
          join_into(p.returned, values_of(pop(p, p.f.results.size())));
          die(p);
          continue;
        default:
          simple(p, i);
      }
      ++p.pc;
    }
  }
};

void enclose_row(const Builtin& row, std::span<const SlotType> results,
                 std::span<const Interval> in, std::span<Interval> out) {
  const auto real = [&](std::size_t k) {
    return results[k] == SlotType::Real || results[k] == SlotType::Spectrum;
  };
  bool numbers = true, nan = false;
  for (const Interval& i : in) {
    numbers &= i.has_number();
    nan |= i.nan;
  }
  const Interval range{row.bounds.low, row.bounds.high, true};
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = real(k) ? range : Interval::all(results[k]);
  const bool enclosed = row.bounds.run && numbers;
  if (enclosed) row.bounds.run(in.data(), out.data());
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (!real(k)) continue;
    // Ends that are one number but for rounding may come in the wrong order.
    if (out[k].lo > out[k].hi && std::isfinite(out[k].lo) && std::isfinite(out[k].hi))
      std::swap(out[k].lo, out[k].hi);
    if (enclosed) out[k] = reals_within(out[k].lo, out[k].hi, row.max_ulp, out[k].nan);
    out[k] = meet(out[k], range);
    out[k].nan |= nan;
  }
}

BoundsMachine::BoundsMachine(const Program& program) : state_(std::make_unique<State>(program)) {}
BoundsMachine::~BoundsMachine() = default;
BoundsMachine::BoundsMachine(BoundsMachine&&) noexcept = default;

Enclosure BoundsMachine::run(std::uint32_t function, const Box& box) {
  State& s = *state_;
  s.nodes.clear();
  s.cubics.clear();
  for (const Interval& i : box.inputs) s.make(i);
  for (const Constant& c : s.program.constants) s.make(interval_of(c));
  s.undo.clear();
  s.instructions = s.back_edges = 0;
  s.open_blocks = 0;
  s.widened = s.may_give_up = false;
  const std::optional<Values> r = s.call(function, {}, 0);
  const Function& f = s.program.functions[function];
  if (s.back_edges > std::uint64_t(limits::kBackEdges)) s.may_give_up = true;
  Enclosure e;
  e.widened = s.widened;
  e.results = r ? *r : Values(f.results.size(), Interval::point(0));
  if (s.may_give_up)
    for (Interval& i : e.results) i = join(i, Interval::point(0));
  return e;
}

Interval enclose(BoundsMachine& machine, const Program& program, const Entry& entry,
                 const ValueSource& value, const Box& box) {
  if (value.constant) return interval_of(program.constants[value.index]);
  return machine.run(*entry.function, box).results[value.index];
}

}  // namespace mms::vm
