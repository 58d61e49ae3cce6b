// SPDX-License-Identifier: Apache-2.0
#include "lang/emit.h"

#include <algorithm>
#include <vector>

namespace mms::lang {

using vm::Op;
using vm::SlotType;

/// Emits one function.
///
/// Regions are the function's body and the arms of its choices; they form a tree. A value is
/// computed in the innermost region that holds all its uses, once, before anything that needs it. A
/// value that may not end (it calls a recursive function) is never moved to a region that does not
/// use it itself: it is computed in each region that does.
class FunctionEmitter {
 public:
  FunctionEmitter(Emitter& parent, const IrFunction& f, std::span<const Ref> results,
                  FunctionId number, vm::Function& out)
      : parent_(parent),
        f_(f),
        results_(results.begin(), results.end()),
        number_(number),
        out_(out) {}

  void run();

 private:
  using Region = std::uint32_t;
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  struct RegionInfo {
    Region parent = 0;
    std::uint32_t depth = 0;
    std::vector<std::uint32_t> stored;  ///< nodes computed here into locals, in order
  };
  struct Placement {
    Region region = 0;
    std::uint32_t local = kNone;  ///< of the first result, where the node is stored
    Region arms[2] = {0, 0};      ///< of a choice
  };

  void place();
  void place_node(std::uint32_t n);
  ShortList<Region, 2> homes(std::uint32_t n) const;
  Region common(Region a, Region b) const;
  bool inside(Region r, Region ancestor) const;
  bool leaf(std::uint32_t n) const {
    return f_.nodes[n].args.empty() && f_.nodes[n].op != Op::Call &&
           f_.nodes[n].op != Op::CallBuiltin;
  }
  Placement& placement(std::uint32_t n, Region r);
  std::vector<std::uint32_t> live_order() const;

  void begin_region(Region r);
  void push(Ref ref, Region r);
  void compute(std::uint32_t n, Placement& p);
  void tail(const std::vector<Ref>& values, Region r);
  bool is_tail_node(const std::vector<Ref>& values) const;
  void code(Op op, const Node& n, std::uint32_t a = 0, std::uint32_t b = 0);
  std::uint32_t block_type(const std::vector<SlotType>& types);

  Emitter& parent_;
  const IrFunction& f_;
  std::vector<Ref> results_;
  FunctionId number_;
  vm::Function& out_;
  std::vector<RegionInfo> regions_{1};
  std::vector<ShortList<Region, 2>> uses_;
  std::vector<std::uint32_t> use_count_;
  std::vector<ShortList<Placement, 1>> placements_;
  std::vector<bool> may_not_end_;
};

bool FunctionEmitter::inside(Region r, Region ancestor) const {
  while (regions_[r].depth > regions_[ancestor].depth) r = regions_[r].parent;
  return r == ancestor;
}

FunctionEmitter::Region FunctionEmitter::common(Region a, Region b) const {
  while (a != b) {
    if (regions_[a].depth < regions_[b].depth) std::swap(a, b);
    a = regions_[a].parent;
  }
  return a;
}

/// Where node `n` is computed, given the regions that use it.
ShortList<FunctionEmitter::Region, 2> FunctionEmitter::homes(std::uint32_t n) const {
  if (!may_not_end_[n]) {
    Region home = uses_[n][0];
    for (Region r : uses_[n]) home = common(home, r);
    return {home};
  }
  std::vector<Region> uses = uses_[n];
  std::ranges::sort(uses);
  uses.erase(std::unique(uses.begin(), uses.end()), uses.end());
  std::vector<Region> outermost;
  for (Region r : uses) {
    const bool covered =
        std::any_of(uses.begin(), uses.end(), [&](Region o) { return o != r && inside(r, o); });
    if (!covered) outermost.push_back(r);
  }
  return outermost;
}

/// Nodes that the results need, arguments first.
std::vector<std::uint32_t> FunctionEmitter::live_order() const {
  std::vector<std::uint32_t> order, stack;
  std::vector<std::uint8_t> state(f_.nodes.size(), 0);  // 0 new, 1 open, 2 done
  for (Ref r : results_) stack.push_back(r.node);
  std::reverse(stack.begin(), stack.end());
  while (!stack.empty()) {
    const std::uint32_t n = stack.back();
    if (state[n] == 0) {
      state[n] = 1;
      for (std::size_t k = f_.nodes[n].args.size(); k-- > 0;)
        if (state[f_.nodes[n].args[k].node] == 0) stack.push_back(f_.nodes[n].args[k].node);
      continue;
    }
    stack.pop_back();
    if (state[n] == 2) continue;
    state[n] = 2;
    order.push_back(n);
  }
  return order;
}

void FunctionEmitter::place_node(std::uint32_t n) {
  const Node& node = f_.nodes[n];
  for (Region home : homes(n)) {
    Placement p{home};
    if (node.op == Op::If) {
      for (Region& arm : p.arms) {
        arm = static_cast<Region>(regions_.size());
        regions_.push_back({home, regions_[home].depth + 1, {}});
      }
      const std::size_t count = node.results.size();
      uses_[node.args[0].node].push_back(home);
      for (std::size_t k = 0; k < count; ++k) {
        uses_[node.args[1 + k].node].push_back(p.arms[0]);
        uses_[node.args[1 + count + k].node].push_back(p.arms[1]);
      }
    } else {
      for (Ref a : node.args) uses_[a.node].push_back(home);
    }
    for (Ref a : node.args) ++use_count_[a.node];
    placements_[n].push_back(p);
  }
}

void FunctionEmitter::place() {
  const std::size_t count = f_.nodes.size();
  uses_.resize(count);
  use_count_.resize(count, 0);
  placements_.resize(count);
  may_not_end_.resize(count, false);
  const std::vector<std::uint32_t> order = live_order();
  for (std::uint32_t n : order) {
    const Node& node = f_.nodes[n];
    may_not_end_[n] =
        node.op == Op::Call || std::any_of(node.args.begin(), node.args.end(),
                                           [&](Ref a) { return may_not_end_[a.node]; });
  }
  for (Ref r : results_) {
    uses_[r.node].push_back(0);
    ++use_count_[r.node];
  }
  for (std::size_t i = order.size(); i-- > 0;)
    if (!leaf(order[i])) place_node(order[i]);
  // A long chain of values used once is stored now and then: that bounds the machine's stack, and
  // the recursion here.
  constexpr std::uint32_t kChain = 64;
  std::vector<std::uint32_t> chain(count, 0);
  const bool tail_node = is_tail_node(results_);
  for (std::uint32_t n : order) {
    const bool tail_root = tail_node && n == results_[0].node;
    if (leaf(n) || tail_root) continue;
    for (Ref a : f_.nodes[n].args) chain[n] = std::max(chain[n], chain[a.node] + 1);
    const bool shared = use_count_[n] > placements_[n].size();
    if (!shared && f_.nodes[n].results.size() == 1 && chain[n] < kChain) continue;
    chain[n] = 0;
    for (Placement& p : placements_[n]) regions_[p.region].stored.push_back(n);
  }
}

FunctionEmitter::Placement& FunctionEmitter::placement(std::uint32_t n, Region r) {
  for (Placement& p : placements_[n])
    if (inside(r, p.region)) return p;
  return placements_[n].front();
}

void FunctionEmitter::code(Op op, const Node& n, std::uint32_t a, std::uint32_t b) {
  out_.code.push_back({op, a, b});
  out_.lines.push_back(n.line);
}

std::uint32_t FunctionEmitter::block_type(const std::vector<SlotType>& types) {
  std::vector<std::vector<SlotType>>& all = parent_.program_.block_types;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i] == types) return static_cast<std::uint32_t>(i);
  all.push_back(types);
  return static_cast<std::uint32_t>(all.size() - 1);
}

/// Leaves the results of node `n` on the stack.
void FunctionEmitter::compute(std::uint32_t n, Placement& p) {
  const Node& node = f_.nodes[n];
  if (node.op == Op::If) {
    const std::size_t count = node.results.size();
    const Region arms[2] = {p.arms[0], p.arms[1]};
    push(node.args[0], p.region);
    code(Op::If, node, block_type(node.results));
    for (std::size_t arm = 0; arm < 2; ++arm) {
      if (arm) code(Op::Else, node);
      begin_region(arms[arm]);
      for (std::size_t k = 0; k < count; ++k) push(node.args[1 + arm * count + k], arms[arm]);
    }
    code(Op::End, node);
    return;
  }
  const Region home = p.region;
  for (Ref a : node.args) push(a, home);
  std::uint32_t a = node.a;
  if (node.op == Op::Call) a = parent_.callee(node.a);
  code(node.op, node, a, node.b);
}

void FunctionEmitter::push(Ref ref, Region r) {
  const Node& node = f_.nodes[ref.node];
  if (leaf(ref.node))
    return code(node.op, node, node.op == Op::PushConst ? parent_.constant(node.a) : node.a,
                node.b);
  Placement& p = placement(ref.node, r);
  if (p.local != kNone) return code(Op::LoadLocal, node, p.local + ref.result);
  compute(ref.node, p);
}

/// Computes into locals what several places of the region need.
void FunctionEmitter::begin_region(Region r) {
  const std::vector<std::uint32_t> stored = regions_[r].stored;
  for (std::uint32_t n : stored) {
    std::size_t which = 0;
    while (placements_[n][which].region != r) ++which;
    Placement p = placements_[n][which];
    compute(n, p);
    const auto first = static_cast<std::uint32_t>(out_.locals.size());
    for (SlotType t : f_.nodes[n].results) out_.locals.push_back(t);
    for (auto local = static_cast<std::uint32_t>(out_.locals.size()); local-- > first;)
      code(Op::StoreLocal, f_.nodes[n], local);
    placements_[n][which].local = first;
  }
}

/// The values are all results, in order, of one node that nothing else uses.
bool FunctionEmitter::is_tail_node(const std::vector<Ref>& values) const {
  if (values.empty()) return false;
  const std::uint32_t n = values[0].node;
  const Node& node = f_.nodes[n];
  const bool self_call = node.op == Op::Call && node.a == number_;
  if ((node.op != Op::If && !self_call) || node.results.size() != values.size()) return false;
  if (use_count_[n] != values.size() * std::max<std::size_t>(placements_[n].size(), 1))
    return false;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (values[k].node != n || values[k].result != k) return false;
  return true;
}

void FunctionEmitter::tail(const std::vector<Ref>& values, Region r) {
  static const Node kNowhere;
  const Node& first = values.empty() ? kNowhere : f_.nodes[values[0].node];
  if (!is_tail_node(values)) {
    for (Ref v : values) push(v, r);
    return code(Op::Return, first);
  }
  if (first.op == Op::Call) {
    for (Ref a : first.args) push(a, r);
    return code(Op::TailCall, first);
  }
  const Placement p = placement(values[0].node, r);
  push(first.args[0], r);
  code(Op::If, first, block_type({}));
  const std::size_t count = first.results.size();
  for (std::size_t arm = 0; arm < 2; ++arm) {
    if (arm) code(Op::Else, first);
    const std::vector<Ref> inner(
        first.args.begin() + static_cast<std::ptrdiff_t>(1 + arm * count),
        first.args.begin() + static_cast<std::ptrdiff_t>(1 + (arm + 1) * count));
    std::vector<std::uint32_t>& stored = regions_[p.arms[arm]].stored;
    if (is_tail_node(inner)) std::erase(stored, inner[0].node);
    begin_region(p.arms[arm]);
    tail(inner, p.arms[arm]);
  }
  code(Op::End, first);
}

void FunctionEmitter::run() {
  out_.params = f_.params;
  out_.locals = f_.params;
  for (Ref r : results_) out_.results.push_back(f_.type(r));
  place();
  begin_region(0);
  tail(results_, 0);
}

Emitter::Emitter(const Module& module, vm::Program& program) : module_(module), program_(program) {}

std::uint32_t Emitter::emit(FunctionId f, std::span<const Ref> results, std::string name) {
  const std::uint32_t index = static_cast<std::uint32_t>(program_.functions.size());
  program_.functions.emplace_back();
  vm::Function out;
  out.name = std::move(name);
  FunctionEmitter(*this, module_.functions[f], results, f, out).run();
  program_.functions[index] = std::move(out);
  return index;
}

std::uint32_t Emitter::constant(std::uint32_t k) {
  if (constants_.size() <= k) constants_.resize(module_.constants.size());
  if (!constants_[k]) {
    constants_[k] = static_cast<std::uint32_t>(program_.constants.size());
    program_.constants.push_back(module_.constants[k]);
  }
  return *constants_[k];
}

std::uint32_t Emitter::callee(FunctionId f) {
  auto it = emitted_.find(f);
  if (it != emitted_.end()) return it->second;
  const std::uint32_t index = static_cast<std::uint32_t>(program_.functions.size());
  emitted_[f] = index;
  program_.functions.emplace_back();
  vm::Function out;
  out.name = module_.functions[f].name;
  FunctionEmitter(*this, module_.functions[f], module_.functions[f].results, f, out).run();
  program_.functions[index] = std::move(out);
  return index;
}

}  // namespace mms::lang
