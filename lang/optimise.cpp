// SPDX-License-Identifier: Apache-2.0
#include "lang/optimise.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include <fmt/format.h>

#include "base/hash.h"

namespace mms::lang {
namespace {

using vm::Op;
using vm::SlotType;

/// Rewrites a function node by node, arguments first, and knows where each value went.
class Rewrite {
 public:
  Rewrite(IrFunction& f, Room& room)
      : out{std::move(f.name), std::move(f.params), {}, std::move(room), f.recursive},
        room_(room),
        first_(f.nodes.size()) {
    std::uint32_t values = 0;
    for (std::size_t i = 0; i < f.nodes.size(); ++i) {
      first_[i] = values;
      values += static_cast<std::uint32_t>(f.nodes[i].results.size());
    }
    where_.resize(values);
    out.nodes.clear();
    out.nodes.reserve(f.nodes.size());
  }

  IrFunction out;

  Ref at(Ref r) const { return where_[first_[r.node] + r.result]; }
  void put(std::size_t index, std::size_t result, Ref r) { where_[first_[index] + result] = r; }
  /// All results of node `index` are those of `r.node`.
  void put_all(std::size_t index, std::size_t count, Ref r) {
    for (std::size_t k = 0; k < count; ++k)
      put(index, k, {r.node, static_cast<std::uint16_t>(k), r.function});
  }
  void map(Refs& args) const {
    for (Ref& a : args) a = at(a);
  }
  /// Keeps `n`, whose arguments have been mapped.
  void keep_mapped(std::size_t index, Node n, FunctionId function) {
    const std::size_t count = n.results.size();
    put_all(index, count, add_node(out, function, std::move(n)));
  }
  void keep(std::size_t index, Node n, FunctionId function) {
    map(n.args);
    keep_mapped(index, std::move(n), function);
  }
  IrFunction finish(IrFunction& f) {
    for (Ref r : f.results) out.results.push_back(at(r));
    room_ = std::move(f.nodes);
    return std::move(out);
  }

 private:
  Room& room_;
  std::vector<std::uint32_t> first_;  ///< of each node, in `where_`
  std::vector<Ref> where_;
};

FunctionId number_of(const IrFunction& f) { return f.results.empty() ? 0 : f.results[0].function; }

/// Leaves stand first, so that arguments always precede what uses them.
std::vector<std::uint32_t> order(const IrFunction& f) {
  std::vector<std::uint32_t> o;
  for (int leaves = 1; leaves >= 0; --leaves)
    for (std::uint32_t i = 0; i < f.nodes.size(); ++i)
      if (f.nodes[i].args.empty() == (leaves == 1)) o.push_back(i);
  return o;
}

IrFunction fold_known(const Module&, IrFunction f, Room&) {
  for (Node& n : f.nodes) {
    if (n.known < 0 || n.op == Op::PushConst) continue;
    n = {Op::PushConst, static_cast<std::uint32_t>(n.known), 0, {}, n.results, n.line, n.known};
  }
  return f;
}

/// Finds nodes that compute the same, whatever their arguments are.
class DistinctNodes {
 public:
  DistinctNodes(const std::vector<Node>& nodes, std::size_t most)
      : nodes_(nodes), table_(std::bit_ceil(2 * most + 1), kNone) {}

  /// The first of the nodes so far that node `i` equals; `i` itself if it is the first.
  std::uint32_t first_like(std::uint32_t i) {
    const Node& n = nodes_[i];
    for (std::size_t at = hash(n);; ++at) {
      std::uint32_t& k = table_[at & (table_.size() - 1)];
      if (k == kNone) k = i;
      if (k == i || same(nodes_[k], n)) return k;
    }
  }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  static std::size_t hash(const Node& n) {
    std::uint64_t h = hash_combine(
        static_cast<std::uint64_t>(n.op) + (std::uint64_t{n.a} << 8) + (std::uint64_t{n.b} << 40),
        n.args.size());
    for (Ref r : n.args) h = mix64(h ^ (r.node + (std::uint64_t{r.result} << 32)));
    return h;
  }
  static bool same(const Node& x, const Node& y) {
    return x.op == y.op && x.a == y.a && x.b == y.b && x.args == y.args;
  }

  const std::vector<Node>& nodes_;
  std::vector<std::uint32_t> table_;
};

/// Each node is appended, and taken off again where an equal one stands already.
IrFunction share(const Module&, IrFunction f, Room& room) {
  Rewrite w(f, room);
  DistinctNodes distinct(w.out.nodes, f.nodes.size());
  for (std::uint32_t i : order(f)) {
    const std::size_t count = f.nodes[i].results.size();
    w.map(f.nodes[i].args);
    const Ref r = add_node(w.out, number_of(f), std::move(f.nodes[i]));
    const std::uint32_t first = distinct.first_like(r.node);
    w.put_all(i, count, {first, 0, r.function});
    if (first != r.node) w.out.nodes.pop_back();
  }
  return w.finish(f);
}

/// Identities that hold for every float, NaN, infinity and signed zero included.
IrFunction simplify(const Module& m, IrFunction f, Room& room) {
  Rewrite w(f, room);
  auto is = [&](Ref r, double v) {
    const Node* n = &w.out.nodes[r.node];
    if (n->op == Op::Splat) n = &w.out.nodes[n->args[0].node];
    return n->known >= 0 && m.constants[n->known].type == SlotType::Real &&
           m.constants[n->known].f64 == v && m.constants[n->known].f32 == static_cast<float>(v);
  };
  for (std::uint32_t i : order(f)) {
    Node& n = f.nodes[i];
    auto arg = [&](std::size_t k) { return w.at(n.args[k]); };
    auto inner = [&](Ref r) -> const Node& { return w.out.nodes[r.node]; };
    std::optional<Ref> same;
    switch (n.op) {
      case Op::MulR:
      case Op::MulS:
        if (is(arg(1), 1))
          same = arg(0);
        else if (is(arg(0), 1))
          same = arg(1);
        break;
      case Op::DivR:
      case Op::DivS:
        if (is(arg(1), 1)) same = arg(0);
        break;
      case Op::NegR:
      case Op::NegS:
      case Op::Not:
        if (inner(arg(0)).op == n.op) same = inner(arg(0)).args[0];
        break;
      case Op::SelectR:
      case Op::SelectI:
      case Op::SelectL:
      case Op::SelectS:
        if (arg(1) == arg(2)) same = arg(1);
        break;
      default:
        break;
    }
    if (same)
      w.put(i, 0, *same);
    else
      w.keep(i, std::move(n), number_of(f));
  }
  return w.finish(f);
}

/// Drops nodes nobody reads, and the results of choices that nobody reads.
IrFunction remove_dead(const Module&, IrFunction f, Room& room) {
  // Which results are read; an argument counts only if its choice's result does.
  std::vector<ShortList<bool, 8>> read(f.nodes.size());
  std::vector<Ref> pending = f.results;
  while (!pending.empty()) {
    const Ref r = pending.back();
    pending.pop_back();
    ShortList<bool, 8>& seen = read[r.node];
    const Node& n = f.nodes[r.node];
    const bool first = seen.empty();
    while (seen.size() < n.results.size()) seen.push_back(false);
    if (seen[r.result]) continue;
    seen[r.result] = true;
    if (n.op == Op::If) {
      if (first) pending.push_back(n.args[0]);
      pending.push_back(n.args[1 + r.result]);
      pending.push_back(n.args[1 + n.results.size() + r.result]);
    } else if (first) {
      pending.insert(pending.end(), n.args.begin(), n.args.end());
    }
  }
  Rewrite w(f, room);
  for (std::uint32_t i : order(f)) {
    if (read[i].empty()) continue;
    Node& n = f.nodes[i];
    const bool whole =
        n.op != Op::If || std::all_of(read[i].begin(), read[i].end(), [](bool b) { return b; });
    if (whole) {
      w.keep(i, std::move(n), number_of(f));
      continue;
    }
    Node kept{Op::If, n.a, n.b, {w.at(n.args[0])}, {}, n.line, -1};
    for (int arm = 0; arm < 2; ++arm)
      for (std::size_t k = 0; k < n.results.size(); ++k)
        if (read[i][k])
          kept.args.push_back(
              w.at(n.args[1 + static_cast<std::size_t>(arm) * n.results.size() + k]));
    for (std::size_t k = 0; k < n.results.size(); ++k)
      if (read[i][k]) kept.results.push_back(n.results[k]);
    const Ref r = add_node(w.out, number_of(f), std::move(kept));
    std::uint16_t next = 0;
    for (std::size_t k = 0; k < n.results.size(); ++k)
      if (read[i][k]) w.put(i, k, {r.node, next++, r.function});
  }
  return w.finish(f);
}

Op select_of(SlotType t) {
  switch (t) {
    case SlotType::Integer:
      return Op::SelectI;
    case SlotType::Logic:
      return Op::SelectL;
    case SlotType::Spectrum:
      return Op::SelectS;
    default:
      return Op::SelectR;
  }
}

/// What computing `r` costs, up to a bit above `limit`; anything that may not end is too dear.
int cost_of(const Module& m, const IrFunction& f, Ref r, int limit,
            std::vector<std::uint32_t>& counted) {
  const Node& n = f.nodes[r.node];
  if (n.args.empty() && vm::info(n.op).cost == 0) return 0;  // there may be thousands of them
  if (std::find(counted.begin(), counted.end(), r.node) != counted.end()) return 0;
  counted.push_back(r.node);
  if (n.op == Op::Call || n.op == Op::If) return limit + 1;
  int cost = n.op == Op::CallBuiltin    ? m.builtins[n.a]->cost
             : n.op == Op::CallSpectral ? 8 * m.builtins[n.a]->cost
                                        : vm::info(n.op).cost;
  for (Ref a : n.args) {
    if (cost > limit) break;
    cost += cost_of(m, f, a, limit - cost, counted);
  }
  return cost;
}

/// A choice between cheap values computes both: that costs less than a branch over a batch.
IrFunction convert_ifs(const Module& m, IrFunction f, Room& room) {
  constexpr int kCheap = 16;  // measured: an arm that is skipped saves about this much
  Rewrite w(f, room);
  for (std::uint32_t i : order(f)) {
    Node& n = f.nodes[i];
    int cost = 0;
    if (n.op == Op::If) {
      std::vector<std::uint32_t> counted;
      for (std::size_t k = 1; k < n.args.size() && cost <= kCheap; ++k)
        cost += cost_of(m, w.out, w.at(n.args[k]), kCheap - cost, counted);
    }
    if (n.op != Op::If || cost > kCheap) {
      w.keep(i, std::move(n), number_of(f));
      continue;
    }
    const std::size_t count = n.results.size();
    for (std::size_t k = 0; k < count; ++k) {
      const Refs args{w.at(n.args[0]), w.at(n.args[1 + k]), w.at(n.args[1 + count + k])};
      if (args[1] == args[2]) {
        w.put(i, k, args[1]);
        continue;
      }
      w.put(i, k,
            add_node(w.out, number_of(f), {select_of(n.results[k]), 0, 0, args, {}, n.line, -1}));
    }
  }
  return w.finish(f);
}

constexpr Pass kPipeline[] = {
    {{"inline",
      "inline every call, specialise generics, lambdas and materials; only recursion whose end "
      "depends on the hit is left as a function",
      Level::O0},
     nullptr},
    {{"dead", "drop values nobody reads", Level::O0}, remove_dead},
    {{"fold",
      "replace what is known at link time by constants, computed with the machine's kernels",
      Level::O1},
     fold_known},
    {{"share", "compute equal pure expressions once", Level::O1}, share},
    {{"simplify", "apply identities that hold for every float", Level::O2}, simplify},
    {{"if-convert", "compute both sides of a cheap choice instead of branching", Level::O2},
     convert_ifs},
    {{"share-again", "compute once what the last passes made equal", Level::O2}, share},
    {{"dead-again", "drop what the last passes left behind", Level::O1}, remove_dead},
};

/// What a pass left of `f` is a graph that the next one may trust; looked at where assertions are.
void recheck(const Module& m, const IrFunction& f, const Pass& p) {
#if !defined(NDEBUG) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  if (const std::string fault = check_ir(m, f); !fault.empty())
    throw std::logic_error(
        fmt::format("after the pass {}: {}\n{}", p.info.name, fault, dump(m, f)));
#else
  (void)m, (void)f, (void)p;
#endif
}

}  // namespace

std::span<const Pass> pipeline() { return kPipeline; }

std::span<const PassInfo> passes() {
  static const std::vector<PassInfo> infos = [] {
    std::vector<PassInfo> v;
    for (const Pass& p : kPipeline) v.push_back(p.info);
    return v;
  }();
  return infos;
}

std::string optimise(Module& module, const LinkOptions& options) {
  std::string text;
  Room room;
  // All passes over one function before the next: it is in the processor's cache then.
  for (IrFunction& f : module.functions) {
    if (f.results.empty()) continue;
    for (const Pass& p : kPipeline) {
      if (options.level < p.info.from) continue;
      if (p.run) {
        f = p.run(module, std::move(f), room);
        recheck(module, f, p);
        if (options.stage_done) options.stage_done(p.info.name);
      }
      if (p.info.name == options.dump_after) text += dump(module, f);
    }
  }
  return text;
}

}  // namespace mms::lang
