// SPDX-License-Identifier: Apache-2.0
#include "vm/lower.h"

#include <algorithm>

#include "vm/call_graph.h"
#include "vm/input_use.h"
#include "vm/lower_function.h"
#include "vm/uniform.h"

namespace mms::vm {

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
