// SPDX-License-Identifier: Apache-2.0
#include "vm/bounds.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "vm/bounds_values.h"
#include "vm/call_graph.h"
#include "vm/limits.h"

namespace mms::vm {
namespace {

using Index = ValueIndex;
constexpr Index kNone = ValueTable::kNone;
constexpr std::uint64_t kMost = 10 * std::uint64_t(kBoundsInstructions);

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

struct BoundsMachine::State : ValueTable {
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

  explicit State(const Program& p) : ValueTable(p), recursive(call_graph(p).recursive) {
    for (const Function& f : p.functions) {
      jumps.push_back(jumps_of(f));
      blocks.push_back(most_blocks(f));
    }
    open_calls.assign(p.functions.size(), 0);
  }

  std::vector<bool> recursive;
  std::vector<std::vector<Jump>> jumps;
  std::vector<std::size_t> blocks;
  std::vector<int> open_calls;
  std::vector<Interval> in, out;  // of a builtin
  std::size_t open_blocks = 0;
  std::uint64_t instructions = 0, back_edges = 0;
  bool widened = false, may_give_up = false;

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
        p.stack.push_back(tightened(make(fused(a, b, c), i.op, a, b, c), {a, b, c}));
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
    if (row.image32) enclose_image(row.image_ask);
    for (const Interval& r : out) p.stack.push_back(make(r, i.op));
  }

  /// What the picture that `in` names can give, in `out`.
  void enclose_image(ImageAsk ask) {
    if (!in[0].is_point()) return;
    std::vector<const Image*> images;
    for (const ProgramImage& i : program.images) images.push_back(i.image.get());
    image_of(ask, images.data(), int(images.size()), in[0].lo).enclose(ask, &in[1], out.data());
    for (Interval& r : out) {
      const double most = r.magnitude(), slack = std::isfinite(most) ? kImageRounding * most : 0;
      // Weights are positive: what spans no negative numbers gives none.
      const double low = r.lo >= 0 ? std::max(r.lo - slack, 0.0) : r.lo - slack;
      r = reals_within(low, r.hi + slack, 1, r.nan);
    }
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
    if (open_calls[f] >= kBoundsDepth || instructions > kMost) {
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
        if (step < kBoundsSteps && instructions < kBoundsInstructions) {
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
        covered[k] = round < 2               ? next
                     : round < kBoundsRounds ? vm::widened(covered[k], next, types[k])
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
  s.start(box.inputs);
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
