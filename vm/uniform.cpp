// SPDX-License-Identifier: Apache-2.0
#include "vm/uniform.h"

#include <algorithm>

#include "vm/program.h"

namespace mms::vm {
namespace {

/// The slots of one function. Code only ever jumps ahead and a slot is read only where it was
/// written on the way, so what the last instruction before wrote is what is read.
class UniformSlots {
 public:
  explicit UniformSlots(std::uint32_t blocks) : uniform_(blocks, false) {}

  bool has(Operand o) const {
    switch (o.base()) {
      case Operand::Constant:
        return true;
      case Operand::Input:
        return o.index() == std::uint32_t(input_block(input_index(kUniformVariable)));
      case Operand::Slot:
        return uniform_[o.index()];
      default:
        return false;  // a mask
    }
  }
  bool have(const Operand* first, std::size_t count) const {
    return std::all_of(first, first + count, [this](Operand o) { return has(o); });
  }
  void set(Operand o, bool uniform, int blocks = 1) {
    if (o.base() != Operand::Slot) return;
    for (int k = 0; k < blocks; ++k) uniform_[o.index() + std::uint32_t(k)] = uniform;
  }

 private:
  std::vector<bool> uniform_;
};

bool makes_spectrum(LoweredOp op) {
  const std::size_t row = std::size_t(op);
  return row < std::size(kOps) && kOps[row].pushes == "s";
}

}  // namespace

void find_uniform_sites(LoweredCode& code) {
  for (const LoweredFunction& f : code.functions) {
    UniformSlots slots(f.blocks);
    for (std::uint32_t pc = f.begin; pc < f.end; ++pc) {
      const LoweredInstruction& i = code.instructions[pc];
      if (i.op == LoweredOp::Call || i.op == LoweredOp::CallBuiltin) {
        CallSite& site = code.sites[i.target];
        site.uniform = i.op == LoweredOp::CallBuiltin &&
                       slots.have(&code.operands[site.first_arg], site.args * site.repeats);
        code.uniform_sites |= site.uniform;
        for (std::uint32_t k = 0; k < site.results * site.repeats; ++k)
          slots.set(code.operands[site.first_result + k], site.uniform);
      } else if (makes_spectrum(i.op)) {
        slots.set(i.dst, false, kWavelengths);
      } else {
        const Operand operands[] = {i.a, i.b, i.c, i.d, i.e};
        slots.set(i.dst, slots.have(operands, std::size(operands)));
      }
    }
  }
}

}  // namespace mms::vm
