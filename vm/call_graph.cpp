// SPDX-License-Identifier: Apache-2.0
#include "vm/call_graph.h"

#include <algorithm>
#include <limits>

namespace mms::vm {
namespace {

constexpr std::uint32_t kUnseen = std::numeric_limits<std::uint32_t>::max();

std::uint64_t saturating_add(std::uint64_t a, std::uint64_t b) {
  return a + b < a ? std::numeric_limits<std::uint64_t>::max() : a + b;
}

/// Strongly connected components (Tarjan 1972) without recursion of our own: a hostile program may
/// be as deep as it has functions. Components are finished callees first.
class Components {
 public:
  Components(const Program& program, CallGraph& graph)
      : graph_(graph),
        callees_(program.functions.size()),
        index_(program.functions.size(), kUnseen),
        low_(program.functions.size()) {
    for (std::size_t f = 0; f < callees_.size(); ++f)
      for (const Instruction& i : program.functions[f].code)
        if (i.op == Op::Call) callees_[f].push_back(i.a);
    graph_.recursive.assign(callees_.size(), false);
    graph_.expansion.assign(callees_.size(), 0);
    graph_.cycle.assign(callees_.size(), kUnseen);
    for (std::uint32_t f = 0; f < callees_.size(); ++f)
      if (index_[f] == kUnseen) visit(f);
  }

 private:
  struct Visit {
    std::uint32_t function;
    std::size_t next = 0;
  };

  void visit(std::uint32_t root) {
    enter(root);
    while (!visits_.empty()) {
      Visit& v = visits_.back();
      const std::uint32_t f = v.function;
      if (v.next < callees_[f].size()) {
        const std::uint32_t g = callees_[f][v.next++];
        if (index_[g] == kUnseen)
          enter(g);
        else if (graph_.cycle[g] == kUnseen)
          low_[f] = std::min(low_[f], index_[g]);
        continue;
      }
      visits_.pop_back();
      if (!visits_.empty()) {
        const std::uint32_t parent = visits_.back().function;
        low_[parent] = std::min(low_[parent], low_[f]);
      }
      if (low_[f] == index_[f]) finish(f);
    }
  }

  void enter(std::uint32_t f) {
    index_[f] = low_[f] = count_++;
    open_.push_back(f);
    visits_.push_back({f});
  }

  void finish(std::uint32_t root) {
    const auto begin = std::find(open_.rbegin(), open_.rend(), root).base() - 1;
    for (auto f = begin; f != open_.end(); ++f) graph_.cycle[*f] = root;
    for (auto f = begin; f != open_.end(); ++f)
      for (const std::uint32_t g : callees_[*f]) {
        if (graph_.cycle[g] == root)
          graph_.recursive[*f] = true;
        else
          graph_.expansion[*f] =
              saturating_add(graph_.expansion[*f], saturating_add(graph_.expansion[g], 1));
      }
    graph_.order.insert(graph_.order.end(), begin, open_.end());
    open_.erase(begin, open_.end());
  }

  CallGraph& graph_;
  std::vector<std::vector<std::uint32_t>> callees_;
  std::vector<std::uint32_t> index_, low_;
  std::vector<std::uint32_t> open_;
  std::vector<Visit> visits_;
  std::uint32_t count_ = 0;
};

}  // namespace

CallGraph call_graph(const Program& program) {
  CallGraph graph;
  Components(program, graph);
  return graph;
}

}  // namespace mms::vm
