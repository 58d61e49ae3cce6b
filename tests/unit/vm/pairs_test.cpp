// SPDX-License-Identifier: Apache-2.0
// Every pair of vm/pairs.def against the reference, which knows no pairs.
#include <algorithm>
#include <functional>

#include "harness.h"
#include "vm/fuse.h"

namespace mms::vm::test {
namespace {

struct TabledPair {
  Pair pair;
  LoweredOp op;
};
constexpr TabledPair kPairs[] = {
#define PAIR(first, second, position, constants)               \
  {{LoweredOp::first, LoweredOp::second, position, constants}, \
   LoweredOp::first##_##second##_##position##_##constants},
#include "vm/pairs.def"
#undef PAIR
};

/// The types of an operation's operands, by the letters of vm/opcodes.def.
std::string_view letters(LoweredOp op) {
  switch (op) {
    case LoweredOp::FloorR:
    case LoweredOp::AbsR:
    case LoweredOp::SqrtR:
      return "r";
    case LoweredOp::FmsR:
    case LoweredOp::FnmaR:
    case LoweredOp::ModByR:
      return "rrr";
    case LoweredOp::MadI:
      return "iii";
    default:
      return info(static_cast<Op>(op)).pops;
  }
}

using Push = std::function<void()>;

/// What is lowered to `op`.
void write(Assembler& a, LoweredOp op, const std::vector<Push>& push) {
  const auto all = [&](std::size_t count) -> Assembler& {
    for (std::size_t k = 0; k < count; ++k) push[k]();
    return a;
  };
  switch (op) {
    case LoweredOp::FloorR:
      all(1).op(Op::CallBuiltin, kFloor);
      return;
    case LoweredOp::AbsR:
      all(1).op(Op::CallBuiltin, kAbs);
      return;
    case LoweredOp::SqrtR:
      all(1).op(Op::CallBuiltin, kSqrt);
      return;
    case LoweredOp::FmsR:
      all(3).ops({Op::NegR, Op::FmaR});
      return;
    case LoweredOp::FnmaR:
      push[0](), a.op(Op::NegR), push[1](), push[2](), a.op(Op::FmaR);
      return;
    case LoweredOp::ModByR:
      all(2).op(Op::ModR);  // the third is the second's reciprocal
      return;
    case LoweredOp::MadI:
      all(2).op(Op::MulI), push[2](), a.op(Op::AddI);
      return;
    default:
      all(push.size()).op(static_cast<Op>(op));
  }
}

enum Locals : std::uint32_t { kI, kJ, kLess };

/// Operand `k` of `op`: a constant, or lanes that something else reads too.
Push operand(Assembler& a, LoweredOp op, std::size_t k, bool constant) {
  const char type = letters(op)[k];
  const auto variable = k % 2 == 0 ? Variable::Position : Variable::Normal;
  if (constant && type == 'r') return [&a, op] { a.real(op == LoweredOp::ModByR ? -4 : 2.75); };
  if (constant && type == 'i') return [&a] { a.integer(-1234567); };
  if (constant) return [&a] { a.logic(true); };
  if (type == 'r') return [&a, variable] { a.input(variable); };
  if (type == 'i') return [&a, k] { a.load(k % 2 == 0 ? kI : kJ); };
  return [&a] { a.load(kLess); };
}

Program program_of(const Pair& pair) {
  Assembler a;
  const std::string_view first = letters(pair.first), second = letters(pair.second);
  a.function("f", {}, {}, {I, I, L});
  a.input(Variable::Position).op(Op::IntOfReal).store(kI);
  a.input(Variable::Normal).op(Op::IntOfReal).store(kJ);
  a.input(Variable::Position).input(Variable::Normal).op(Op::LtR).store(kLess);
  std::size_t next = 0;
  const auto constant = [&] { return (pair.constants >> next++ & 1) != 0; };
  std::vector<Push> inner, outer;
  for (std::size_t k = 0; k < first.size(); ++k)
    inner.push_back(operand(a, pair.first, k, constant()));
  for (std::size_t k = 0; k < second.size(); ++k)
    outer.push_back(int(k) == pair.position ? [&] { write(a, pair.first, inner); }
                                            : operand(a, pair.second, k, constant()));
  write(a, pair.second, outer);
  a.load(kI).load(kJ).load(kLess).load(kI).load(kJ).load(kLess).ret();
  Function& f = a.program.functions.back();
  const char result = pair.second == LoweredOp::MadI ? 'i'
                      : pair.second > LoweredOp::SkipIfNone
                          ? 'r'
                          : info(static_cast<Op>(pair.second)).pushes[0];
  f.results = {result == 'r' ? R : result == 'i' ? I : L, I, I, L, I, I, L};
  return std::move(a.program);
}

TEST_CASE_TEMPLATE("pairs of the table are their halves", T, float, double) {
  std::vector<Point<T>> points;
  for (const double x : {0.0, -0.0, 1.0, -1.5, 3e-39, 1e38, 7.0, -2e9, 0.333, 1e300 * 1e300})
    for (const double y : {0.0, 1.0, -0.7, 123.4, -1e-30, 5e9}) {
      points.push_back(zero_point<T>());
      points.back()[input_index(Variable::Position)].r[0] = T(x);
      points.back()[input_index(Variable::Normal)].r[0] = T(y);
    }
  for (const TabledPair& row : kPairs) {
    CAPTURE(name(row.op));
    const Program program = program_of(row.pair);
    check_against_reference(program, 0, points);
    const LoweredCode code = lower(program);
    CHECK(std::any_of(code.instructions.begin(), code.instructions.end(),
                      [&](const LoweredInstruction& i) { return i.op == row.op; }));
  }
}

TEST_CASE("what is read twice stays in memory") {
  Assembler a;
  a.function("f", {}, {R, R, I, I}, {R, I});
  a.input(Variable::Position).input(Variable::Normal).op(Op::MulR).store(0);
  a.load(0).input(Variable::Position).op(Op::AddR).load(0);
  // A product that its sum takes over in place, and whose sum has two readers.
  a.input(Variable::Position).op(Op::IntOfReal).integer(3).op(Op::MulI).integer(5).op(Op::AddI);
  a.store(1).load(1).integer(7).op(Op::MulI).load(1).ret();
  std::vector<Point<float>> points(20, zero_point<float>());
  for (std::size_t k = 0; k < points.size(); ++k) {
    points[k][input_index(Variable::Position)].r[0] = float(k) - 7.5f;
    points[k][input_index(Variable::Normal)].r[0] = 1.25f * float(k);
  }
  check_against_reference(a.program, 0, points);
}

}  // namespace
}  // namespace mms::vm::test
