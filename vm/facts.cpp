// SPDX-License-Identifier: Apache-2.0
#include "vm/facts.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "vm/call_graph.h"
#include "vm/limits.h"
#include "vm/lower.h"
#include "vm/uniform.h"

namespace mms::vm {
namespace {

constexpr std::uint32_t bit(Variable v) { return 1u << static_cast<int>(v); }
constexpr std::uint32_t kOfTheFrame = bit(kUniformVariable);
constexpr std::uint32_t kOfTheRay =
    bit(Variable::View) | bit(Variable::Distance) | bit(Variable::Footprint);

std::uint64_t saturating_add(std::uint64_t a, std::uint64_t b) {
  return a + b < a ? std::numeric_limits<std::uint64_t>::max() : a + b;
}

int cost_of(const Program& program, const Instruction& i) {
  if (i.op == Op::CallBuiltin) return program.builtins[i.a]->cost;
  if (i.op == Op::CallSpectral) return 8 * program.builtins[i.a]->cost;
  return info(i.op).cost;
}

class Analysis {
 public:
  explicit Analysis(const Program& program)
      : program_(program), graph_(call_graph(program)), code_(lower(program)) {
    const std::size_t n = program.functions.size();
    callees_.resize(n);
    for (std::size_t f = 0; f < n; ++f)
      for (const Instruction& i : program.functions[f].code)
        if (i.op == Op::Call) callees_[f].push_back(i.a);
  }

  std::vector<CodeFacts> run() {
    std::vector<CodeFacts> all;
    for (std::uint32_t f = 0; f < callees_.size(); ++f) all.push_back(of(f));
    return all;
  }

 private:
  CodeFacts of(std::uint32_t root) {
    const std::vector<std::uint32_t> order = reached(root);
    CodeFacts facts;
    for (const std::uint32_t f : order) {
      facts.instructions += program_.functions[f].code.size();
      facts.loops |= code_.functions[f].loops;
      facts.recursive |= graph_.recursive[f];
    }
    bounds(order, facts);
    if (facts.limited()) facts.back_edges = limits::kBackEdges;
    return facts;
  }

  /// `root` and what it reaches; callees before their callers, but for recursion.
  std::vector<std::uint32_t> reached(std::uint32_t root) const {
    struct Visit {
      std::uint32_t function;
      std::size_t next = 0;
    };
    std::vector<bool> seen(callees_.size(), false);
    std::vector<std::uint32_t> order;
    std::vector<Visit> open{{root}};
    seen[root] = true;
    while (!open.empty()) {
      Visit& v = open.back();
      if (v.next == callees_[v.function].size()) {
        order.push_back(v.function);
        open.pop_back();
        continue;
      }
      const std::uint32_t g = callees_[v.function][v.next++];
      if (seen[g]) continue;
      seen[g] = true;
      open.push_back({g});
    }
    return order;
  }

  /// Along the calls: what each function costs, and the deepest row of open calls. Where there is
  /// recursion, the machine's limit on open calls holds, each at most as wide as the widest.
  void bounds(const std::vector<std::uint32_t>& order, CodeFacts& facts) const {
    std::vector<std::uint64_t> cost(callees_.size(), 0), calls(cost), stack(cost);
    std::uint64_t widest = 0;
    for (const std::uint32_t f : order) {
      const LoweredFunction& lowered = code_.functions[f];
      const std::uint64_t frame = std::uint64_t(lowered.masks) + lowered.blocks;
      for (const Instruction& i : program_.functions[f].code)
        cost[f] = saturating_add(cost[f], static_cast<std::uint64_t>(cost_of(program_, i)));
      for (const std::uint32_t g : callees_[f]) {
        cost[f] = saturating_add(cost[f], cost[g]);
        calls[f] = std::max(calls[f], calls[g] + 1);
        stack[f] = std::max(stack[f], stack[g]);
      }
      stack[f] += frame;
      widest = std::max(widest, frame);
    }
    const std::uint32_t root = order.back();
    facts.cost = cost[root];
    facts.calls = std::min<std::uint64_t>(calls[root], limits::kCallDepth);
    facts.stack_blocks = stack[root];
    if (!facts.recursive) return;
    facts.calls = limits::kCallDepth;
    facts.stack_blocks =
        widest + std::min<std::uint64_t>(limits::kStackBlocks, limits::kCallDepth * widest);
  }

  const Program& program_;
  const CallGraph graph_;
  const LoweredCode code_;
  std::vector<std::vector<std::uint32_t>> callees_;
};

}  // namespace

Rate rate(const OutputInfo& output) {
  if (output.variables == 0) return Rate::Constant;
  return (output.variables & ~kOfTheFrame) == 0 ? Rate::Uniform : Rate::Varying;
}

bool reciprocal(const OutputInfo& output) { return (output.variables & kOfTheRay) == 0; }

bool reciprocal(const Descriptor& descriptor) {
  constexpr Output kScatter[] = {Output::Material, Output::Scattering, Output::Absorption,
                                 Output::Height, Output::Gradient};
  return std::all_of(std::begin(kScatter), std::end(kScatter),
                     [&](Output o) { return reciprocal(descriptor.output(o)); });
}

std::vector<CodeFacts> code_facts(const Program& program) { return Analysis(program).run(); }

}  // namespace mms::vm
