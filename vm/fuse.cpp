// SPDX-License-Identifier: Apache-2.0
#include "vm/fuse.h"

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

namespace mms::vm {
namespace {

/// The kernels' types by name: R, or L for integers and truth values.
enum class Cell : std::uint8_t { R, L };
constexpr Cell R = Cell::R, L = Cell::L;

struct KernelRow {
  LoweredOp op;
  Cell result;
  std::array<Cell, 3> operands;
  int count;
};

template <class... C>
constexpr KernelRow kernel_row(LoweredOp op, Cell result, C... operands) {
  return {op, result, {operands...}, sizeof...(C)};
}

constexpr KernelRow kKernels[] = {
#define KERNEL(op, functor, ...) kernel_row(LoweredOp::op, __VA_ARGS__),
#include "vm/kernels.def"
#undef KERNEL
};

const KernelRow* kernel(LoweredOp op) {
  const auto row = std::find_if(std::begin(kKernels), std::end(kKernels),
                                [&](const KernelRow& k) { return k.op == op; });
  return row == std::end(kKernels) ? nullptr : row;
}

struct PairRow {
  LoweredOp op;
  Pair pair;
};
constexpr PairRow kPairs[] = {
#define PAIR(first, second, position, constants)           \
  {LoweredOp::first##_##second##_##position##_##constants, \
   {LoweredOp::first, LoweredOp::second, position, constants}},
#include "vm/pairs.def"
#undef PAIR
};

/// The two operations of a fused one, or null.
const Pair* tabled(LoweredOp op) {
  const auto row = std::find_if(std::begin(kPairs), std::end(kPairs),
                                [&](const PairRow& p) { return p.op == op; });
  return row == std::end(kPairs) ? nullptr : &row->pair;
}

/// Where control may leave the straight line, or a callee may take lanes away.
bool ends_line(LoweredOp op) {
  switch (op) {
    case LoweredOp::If:
    case LoweredOp::SkipIfNone:
    case LoweredOp::Call:
    case LoweredOp::TailCall:
    case LoweredOp::Return:
      return true;
    default:
      return false;
  }
}

class Fusion {
 public:
  Fusion(LoweredCode& code, std::uint32_t begin, const PairOf& pair_of)
      : code_(code), begin_(begin), pair_of_(pair_of), gone_(code.instructions.size() - begin) {}

  void run() {
    find_targets();
    std::size_t target = 0;
    for (std::uint32_t pc = begin_; pc < code_.instructions.size(); ++pc) {
      while (target < targets_.size() && targets_[target] < pc) ++target;
      if (target < targets_.size() && targets_[target] == pc) written_.clear();
      LoweredInstruction& i = code_.instructions[pc];
      if (const KernelRow* row = kernel(i.op)) absorb(i, *row);
      note_writes(i, pc);
      if (ends_line(i.op)) written_.clear();
    }
    if (fused_) compact();
  }

 private:
  void find_targets() {
    for (std::uint32_t pc = begin_; pc < code_.instructions.size(); ++pc) {
      const LoweredInstruction& i = code_.instructions[pc];
      if (i.op == LoweredOp::If || i.op == LoweredOp::SkipIfNone) targets_.push_back(i.target);
    }
    std::sort(targets_.begin(), targets_.end());
  }

  /// Takes into `i` an instruction before it that makes one of its operands, if there is one.
  void absorb(LoweredInstruction& i, const KernelRow& row) {
    const Operand operands[] = {i.a, i.b, i.c};
    for (int k = 0; k < row.count; ++k) {
      const auto first = writer(operands[k]);
      if (!first || !code_.instructions[*first].read_once) continue;
      if (try_pair(*first, i, row, k)) return;
    }
  }

  bool try_pair(std::uint32_t first_pc, LoweredInstruction& i, const KernelRow& second, int k) {
    const LoweredInstruction& first = code_.instructions[first_pc];
    const KernelRow* const row = kernel(first.op);
    if (!row) return false;
    const int position = k == 1 && commutes(i.op) ? 0 : k;
    LoweredInstruction pair = i;
    Operand* const to[] = {&pair.a, &pair.b, &pair.c, &pair.d, &pair.e};
    const Operand firsts[] = {first.a, first.b, first.c}, seconds[] = {i.a, i.b, i.c};
    unsigned constants = 0;
    int next = 0;
    const auto take = [&](Operand o) {
      constants |= unsigned(o.base() == Operand::Constant) << next;
      *to[next++] = o;
    };
    for (int j = 0; j < row->count; ++j) take(firsts[j]);
    for (int j = 0; j < second.count; ++j)
      if (j != k) take(seconds[j]);
    const auto op = pair_of_({first.op, i.op, position, constants});
    if (!op || !unharmed(first, *row, first_pc, i, second)) return false;
    pair.op = *op;
    i = pair;
    gone_[first_pc - begin_] = fused_ = true;
    return true;
  }

  /// Whether the first's operands still stand where the second runs, and the result may be written
  /// over them lane by lane: cells of two sizes (in double) may not share a block.
  bool unharmed(const LoweredInstruction& first, const KernelRow& row, std::uint32_t first_pc,
                const LoweredInstruction& i, const KernelRow& second) const {
    const Operand operands[] = {first.a, first.b, first.c};
    for (int j = 0; j < row.count; ++j) {
      const auto w = writer(operands[j]);
      if (w && *w > first_pc) return false;
      if (operands[j] == i.dst && row.operands[j] != second.result) return false;
    }
    return true;
  }

  std::optional<std::uint32_t> writer(Operand o) const {
    const auto at = written_.find(o.bits);
    return at == written_.end() ? std::nullopt : std::optional(at->second);
  }

  void note_writes(const LoweredInstruction& i, std::uint32_t pc) {
    if (i.op == LoweredOp::CallBuiltin) {
      const CallSite& site = code_.sites[i.target];
      for (std::uint32_t k = 0; k < site.results * site.repeats; ++k)
        written_[code_.operands[site.first_result + k].bits] = pc;
      return;
    }
    // Whatever is no kernel may have made a spectrum.
    const int blocks = kernel(i.op) || i.op == LoweredOp::Copy ? 1 : kWavelengths;
    for (int k = 0; k < blocks; ++k) written_[i.dst.component(k).bits] = pc;
  }

  /// Closes the gaps that the firsts left.
  void compact() {
    std::vector<std::uint32_t> to(gone_.size() + 1);
    std::uint32_t next = begin_;
    for (std::size_t k = 0; k < gone_.size(); ++k) {
      to[k] = next;
      if (gone_[k]) continue;
      code_.instructions[next] = code_.instructions[begin_ + k];
      code_.lines[next] = code_.lines[begin_ + k];
      ++next;
    }
    to.back() = next;
    code_.instructions.resize(next);
    code_.lines.resize(next);
    for (std::uint32_t pc = begin_; pc < next; ++pc) {
      LoweredInstruction& i = code_.instructions[pc];
      if (i.op == LoweredOp::If || i.op == LoweredOp::SkipIfNone) i.target = to[i.target - begin_];
    }
  }

  LoweredCode& code_;
  const std::uint32_t begin_;
  const PairOf& pair_of_;
  std::vector<bool> gone_;  ///< by instruction from begin_
  std::vector<std::uint32_t> targets_;
  /// The last instruction of the straight line that wrote each operand.
  std::unordered_map<std::uint32_t, std::uint32_t> written_;
  bool fused_ = false;
};

}  // namespace

bool commutes(LoweredOp op) {
  switch (op) {
    case LoweredOp::AddR:
    case LoweredOp::MulR:
    case LoweredOp::FmaR:
    case LoweredOp::FmaS:
    case LoweredOp::FmsR:
    case LoweredOp::FnmaR:
    case LoweredOp::AddI:
    case LoweredOp::MulI:
    case LoweredOp::MadI:
    case LoweredOp::EqR:
    case LoweredOp::NeR:
    case LoweredOp::EqI:
    case LoweredOp::NeI:
    case LoweredOp::And:
    case LoweredOp::Or:
      return true;
    default:
      return false;
  }
}

int operand_count(LoweredOp op) {
  if (const KernelRow* row = kernel(op)) return row->count;
  const Pair* pair = tabled(op);
  return pair ? operand_count(pair->first) + operand_count(pair->second) - 1 : 1;
}

int cost_of(LoweredOp op) {
  if (const Pair* pair = tabled(op)) return cost_of(pair->first) + cost_of(pair->second);
  const auto k = static_cast<std::size_t>(op);
  return k < static_cast<std::size_t>(kOpCount) ? kOps[k].cost : 1;
}

void fuse(LoweredCode& code, std::uint32_t begin, const PairOf& pair_of) {
  Fusion(code, begin, pair_of).run();
}

std::optional<LoweredOp> tabled_pair(const Pair& pair) {
  const auto row = std::find_if(std::begin(kPairs), std::end(kPairs),
                                [&](const PairRow& p) { return p.pair == pair; });
  return row == std::end(kPairs) ? std::nullopt : std::optional(row->op);
}

}  // namespace mms::vm
