// SPDX-License-Identifier: Apache-2.0
// Every instruction that computes, against the reference, on edge values and random ones.
#include <random>

#include "harness.h"
#include "tests/sanitized.h"

namespace mms::vm::test {
namespace {

template <class T>
std::vector<T> real_edges() {
  using Lim = std::numeric_limits<T>;
  const T edges[] = {T(0),
                     T(1),
                     T(0.1),
                     T(2.5),
                     T(3),
                     T(1e-30),
                     T(7e20),
                     Lim::min(),
                     Lim::denorm_min(),
                     Lim::max(),
                     T(2147483647.0),
                     T(2147483648.0),
                     T(2147483520.0),
                     Lim::infinity(),
                     T(1) + Lim::epsilon(),
                     T(16777217.0)};
  std::vector<T> both;
  for (const T x : edges) both.insert(both.end(), {x, -x});
  both.push_back(Lim::quiet_NaN());
  return both;
}

const std::vector<std::int32_t> kIntegerEdges = {0,
                                                 1,
                                                 -1,
                                                 2,
                                                 -2,
                                                 3,
                                                 -3,
                                                 7,
                                                 -7,
                                                 10,
                                                 65535,
                                                 -65536,
                                                 16777217,
                                                 -33554435,
                                                 std::numeric_limits<std::int32_t>::max(),
                                                 std::numeric_limits<std::int32_t>::max() - 1,
                                                 std::numeric_limits<std::int32_t>::min(),
                                                 std::numeric_limits<std::int32_t>::min() + 1};

/// Draws operands: an edge value three times in four.
template <class T>
class Draw {
 public:
  T real() {
    if (pick() % 4) return edges_[pick() % edges_.size()];
    return T(std::ldexp(double(std::int32_t(pick())) / 2147483648.0, int(pick() % 80) - 40));
  }
  /// A real that the builtin `bits` makes that integer of.
  T integer() {
    const std::int32_t i =
        pick() % 4 ? kIntegerEdges[pick() % kIntegerEdges.size()] : std::int32_t(pick());
    if constexpr (sizeof(T) == 8) return T(i);
    T x;
    std::memcpy(&x, &i, sizeof i);
    return x;
  }
  T logic() { return T(pick() % 2); }
  T operand(char letter) { return letter == 'i' ? integer() : letter == 'l' ? logic() : real(); }

 private:
  std::uint32_t pick() { return std::uint32_t(random_()); }
  std::mt19937 random_{20};
  std::vector<T> edges_ = real_edges<T>();
};

constexpr Variable kSpectra[] = {Variable::Wavelength, Variable::RgbRed, Variable::RgbGreen};

/// A function that applies one instruction to operands that come from the inputs.
Program apply_program(Op op) {
  Assembler a;
  const OpInfo& row = info(op);
  const auto type = [](char c) { return c == 'r' ? R : c == 'i' ? I : c == 'l' ? L : S; };
  a.function("apply", {}, {type(row.pushes[0])});
  for (int k = 0; k < int(row.pops.size()); ++k) {
    const char c = row.pops[k];
    if (c == 's')
      a.input(kSpectra[k]);
    else
      a.input(Variable::Position, k);
    if (c == 'i') a.op(Op::CallBuiltin, kBits);
    if (c == 'l') a.op(Op::CallBuiltin, kIsNonzero);
  }
  a.op(op).ret();
  return a.program;
}

template <class T>
void check_instruction(Op op) {
  const OpInfo& row = info(op);
  CAPTURE(row.name);
  const Program p = apply_program(op);
  Draw<T> draw;
  for (int batch = 0; batch < (kSanitized ? 4 : 16); ++batch) {
    std::vector<Point<T>> points(250, zero_point<T>());
    for (Point<T>& point : points)
      for (int k = 0; k < int(row.pops.size()); ++k) {
        if (row.pops[k] == 's')
          for (T& x : point[input_index(kSpectra[k])].r) x = draw.real();
        else
          point[input_index(Variable::Position, k)].r[0] = draw.operand(row.pops[k]);
      }
    check_against_reference<T>(p, 0, points);
  }
}

bool computes(const OpInfo& row) {
  return row.operand == OperandForm::None && !row.pushes.empty() && row.pushes != "?";
}

TEST_CASE_TEMPLATE("every instruction that computes agrees with the oracle", T, float, double) {
  int checked = 0;
  for (int k = 0; k < kOpCount; ++k)
    if (computes(kOps[k])) {
      check_instruction<T>(static_cast<Op>(k));
      ++checked;
    }
  CHECK(checked == 37);
}

TEST_CASE("integer edge cases have the values that the table states") {
  const auto value = [](Op op, std::int32_t x, std::int32_t y) {
    Assembler a;
    a.function("f", {}, {I}).integer(x);
    if (info(op).pops.size() == 2) a.integer(y);
    a.op(op).ret();
    REQUIRE(fault_text(a.program) == "");
    Interpreter<float> machine(1);
    return run(machine, Executable(a.program), a.program, 0, {zero_point<float>()})[0].results[0].i;
  };
  constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min();
  CHECK(value(Op::ModI, -7, 3) == 2);
  CHECK(value(Op::ModI, 7, -3) == -2);
  CHECK(value(Op::ModI, 5, 0) == 0);
  CHECK(value(Op::ModI, least, -1) == 0);
  CHECK(value(Op::NegI, least, 0) == least);
  CHECK(value(Op::AddI, least, -1) == std::numeric_limits<std::int32_t>::max());
}

TEST_CASE_TEMPLATE("spectrum operations take a splatted real in any place", T, float, double) {
  for (const Op op : {Op::AddS, Op::SubS, Op::MulS, Op::DivS, Op::NegS, Op::FmaS, Op::SelectS})
    for (int splats = 0; splats < 8; ++splats) {
      Assembler a;
      a.function("f", {}, {S});
      const std::string_view pops = info(op).pops;
      for (int k = 0; k < int(pops.size()); ++k) {
        if (pops[k] == 'l')
          a.input(Variable::Time).op(Op::CallBuiltin, kIsNonzero);
        else if (splats >> k & 1)
          a.input(Variable::Position, k).op(Op::Splat);
        else
          a.input(kSpectra[k]);
      }
      a.op(op).ret();
      Draw<T> draw;
      std::vector<Point<T>> points(33, zero_point<T>());
      for (Point<T>& point : points) {
        for (Cell<T>& c : point)
          for (T& x : c.r) x = draw.real();
        point[input_index(Variable::Time)].r[0] = draw.logic();
      }
      check_against_reference<T>(a.program, 0, points);
    }
}

TEST_CASE("a double machine never sees a constant that was rounded to float") {
  Assembler a;
  a.function("f", {}, {R}).real(0.1).ret();
  Interpreter<double> machine(1);
  const auto out = run(machine, Executable(a.program), a.program, 0, {zero_point<double>()});
  CHECK(out[0].results[0].r[0] == 0.1);
}

}  // namespace
}  // namespace mms::vm::test
