// SPDX-License-Identifier: Apache-2.0
#include "vm/input_use.h"

#include <array>
#include <bitset>

namespace mms::vm {
namespace {

constexpr std::size_t kBlocks = std::size_t(input_block(input_count()));
using Blocks = std::bitset<kBlocks>;

/// For each block of the inputs, how many a spectrum operand there stands for.
constexpr auto kRuns = [] {
  std::array<std::uint32_t, kBlocks> runs{};
  runs.fill(1);
  for (int i = 0, block = 0; i < input_count(); block += block_count(input_type(i++)))
    runs[std::size_t(block)] = std::uint32_t(block_count(input_type(i)));
  return runs;
}();

/// What the instructions of one function read themselves.
Blocks own_use(const LoweredCode& code, const LoweredFunction& f) {
  Blocks used;
  const auto read = [&](Operand o, std::uint32_t count) {
    for (std::uint32_t k = 0; o.base() == Operand::Input && k < count; ++k) used.set(o.index() + k);
  };
  for (std::uint32_t pc = f.begin; pc < f.end; ++pc) {
    const LoweredInstruction& i = code.instructions[pc];
    for (const Operand o : {i.a, i.b, i.c, i.d, i.e})
      if (o.base() == Operand::Input) read(o, o.splat() ? 1 : kRuns[o.index()]);
    if (i.op != LoweredOp::Call && i.op != LoweredOp::CallBuiltin) continue;
    const CallSite& site = code.sites[i.target];
    for (std::uint32_t k = 0; k < site.args * site.repeats; ++k)
      read(code.operands[site.first_arg + k], 1);
  }
  return used;
}

}  // namespace

void find_input_use(LoweredCode& code, const CallGraph& graph) {
  // What is called is read too. Functions that reach one another read the same: they share a set,
  // which is whole before anything outside looks at it.
  std::vector<Blocks> used(code.functions.size());
  for (const std::uint32_t f : graph.order) {
    Blocks& shared = used[graph.cycle[f]];
    shared |= own_use(code, code.functions[f]);
    for (std::uint32_t pc = code.functions[f].begin; pc < code.functions[f].end; ++pc)
      if (code.instructions[pc].op == LoweredOp::Call)
        shared |= used[graph.cycle[code.sites[code.instructions[pc].target].function]];
  }
  for (std::size_t k = 0; k < used.size(); ++k) {
    LoweredFunction& f = code.functions[k];
    f.first_input = std::uint32_t(code.operands.size());
    for (std::uint32_t b = 0; b < kBlocks; ++b)
      if (used[graph.cycle[k]][b]) {
        code.operands.push_back(Operand::make(Operand::Input, b));
        f.input_end = b + 1;
      }
    f.inputs = std::uint32_t(code.operands.size()) - f.first_input;
  }
}

}  // namespace mms::vm
