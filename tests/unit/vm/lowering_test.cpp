// SPDX-License-Identifier: Apache-2.0
// What lowering and the execution loop do for speed must not show: fused pairs, constants as one
// number, divisors that are powers of two, lanes moved together at a back edge.
#include <limits>

#include "harness.h"
#include "vm/lower.h"

namespace mms::vm::test {
namespace {

constexpr int kX = input_index(Variable::Position, 0), kY = input_index(Variable::Position, 1);

template <class T>
std::vector<Point<T>> spread(int n) {
  constexpr double special[] = {0.0,     -0.0, 1.0,  -1.0,  1e-38, -3e-39, 1e38,
                                1.5e-45, 7.0,  -7.5, 0.333, 123.4, -2e9};
  std::vector<Point<T>> points;
  for (int k = 0; k < n; ++k) {
    points.push_back(zero_point<T>());
    points.back()[kX].r[0] = T(special[k % 13]);
    points.back()[kY].r[0] = T(special[k / 13 % 13]);
  }
  return points;
}

TEST_CASE_TEMPLATE("dividing by a constant is dividing", T, float, double) {
  const double tiny = std::numeric_limits<T>::min(), huge = std::numeric_limits<T>::max();
  for (const double b : {2.0, -4.0, 0.5, 0x1p-20, 3.0, 0.0, -0.0, tiny, tiny / 2, 2 * tiny, 0x1p127,
                         -0x1p126, huge, std::numeric_limits<double>::infinity()}) {
    CAPTURE(b);
    Assembler a;
    a.function("f", {}, {R, R});
    a.op(Op::PushInput, kX).real(b).op(Op::DivR);
    a.op(Op::PushInput, kX).real(b).op(Op::ModR).ret();
    check_against_reference(a.program, 0, spread<T>(13));
  }
}

TEST_CASE_TEMPLATE("pairs with an instruction of their own", T, float, double) {
  Assembler a;
  a.function("f", {}, {R, R, R, I, I}, {R, I});
  const auto x = [&]() -> Assembler& { return a.op(Op::PushInput, kX); };
  const auto y = [&]() -> Assembler& { return a.op(Op::PushInput, kY); };
  x(), y(), x().ops({Op::NegR, Op::FmaR});                      // x y - x
  x().op(Op::NegR), a.real(3), y().op(Op::FmaR);                // y - 3 x
  y().op(Op::NegR).store(0).load(0), x().load(0).op(Op::FmaR);  // -y x + -y: read twice
  x().op(Op::IntOfReal), y().op(Op::IntOfReal).op(Op::MulI).store(1);
  a.load(1).integer(1013904223).op(Op::AddI);                        // i j + c
  a.integer(-7).load(1).integer(5).ops({Op::MulI, Op::AddI}).ret();  // c + 5 i j
  check_against_reference(a.program, 0, spread<T>(169));
}

TEST_CASE_TEMPLATE("operations of constants alone, and of spectra with constants", T, float,
                   double) {
  Assembler a;
  a.function("f", {}, {R, S, S, S});
  a.real(3).real(4).real(5).op(Op::FmaR);
  a.real(3).op(Op::Splat).real(4).ops({Op::Splat, Op::AddS});
  a.real(3).op(Op::Splat).real(4).op(Op::Splat).input(Variable::Wavelength).op(Op::FmaS);
  a.input(Variable::Wavelength).input(Variable::Position).op(Op::Splat).real(4);
  a.ops({Op::Splat, Op::FmaS}).ret();
  auto points = spread<T>(40);
  for (int k = 0; k < 40; ++k)
    for (int w = 0; w < kWavelengths; ++w)
      points[k][input_index(Variable::Wavelength)].r[w] = T(k + 0.5 * w);
  check_against_reference(a.program, 0, points);
}

TEST_CASE_TEMPLATE("components of inputs, constants and computed spectra, and spectra of them", T,
                   float, double) {
  Assembler a;
  a.function("f", {}, {R, R, R, S, S}, {S});
  a.input(Variable::Wavelength).op(Op::Component, 3);   // of an input: where it stands
  a.real(3).op(Op::Splat).op(Op::Component, 5);         // of a real that stands for a spectrum
  a.input(Variable::Wavelength).op(Op::NegS).store(0);  // of a slot: a copy
  a.load(0).op(Op::Component, 7);
  for (int k = kWavelengths; k-- > 0;) a.load(0).op(Op::Component, std::uint32_t(k));
  a.op(Op::Pack);  // reversed
  for (int k = 0; k < kWavelengths; ++k) a.op(Op::PushInput, k % 2 ? kX : kY);
  a.ops({Op::Pack, Op::NegS}).ret();
  auto points = spread<T>(40);
  for (int k = 0; k < 40; ++k)
    for (int w = 0; w < kWavelengths; ++w)
      points[std::size_t(k)][input_index(Variable::Wavelength)].r[w] = T(k + 0.5 * w);
  check_against_reference(a.program, 0, points);
}

/// `loop(n, s, c) = n <= 0 ? (s, c) : loop(n - 1, s + c y, scaled(c))`, and lanes of negative x
/// never end; `scaled` reads an input too.
Program diverging() {
  Assembler a;
  a.function("entry", {}, {R, S});
  a.op(Op::PushInput, kX).real(0).input(Variable::Wavelength).call(1).ret();
  a.function("loop", {R, R, S}, {R, S});
  a.load(0).real(0).op(Op::EqR).begin().load(1).load(2).ret().end();
  a.load(0).real(1).op(Op::SubR);
  a.load(0).op(Op::PushInput, kY).load(1).op(Op::FmaR);
  a.load(2).call(2).again();
  a.function("scaled", {S}, {S});
  a.load(0).input(Variable::RgbRed).ops({Op::MulS}).ret();
  return a.program;
}

TEST_CASE("lanes that are moved together at a back edge end as they would alone") {
  const int lanes = 400;
  std::vector<Point<float>> points;
  for (int k = 0; k < lanes; ++k) {
    points.push_back(zero_point<float>());
    points[k][kX].r[0] = float(k * 37 % 101 * (k % 3));
    points[k][kY].r[0] = float(k % 7) / 8;
    for (int w = 0; w < kWavelengths; ++w) {
      points[k][input_index(Variable::Wavelength)].r[w] = float(1 + w);
      points[k][input_index(Variable::RgbRed)].r[w] = 1 - float(k % 5) / 64;
    }
  }
  check_against_reference(diverging(), 0, points);
}

TEST_CASE("a lane that is given up after it was moved is reported as itself") {
  std::vector<Point<float>> points(300, zero_point<float>());
  for (int k = 0; k < 300; ++k) {
    points[k][kX].r[0] = k == 77 || k == 201 ? -1 : float(k % 50);
    points[k][kY].r[0] = 1;
  }
  Interpreter<float> machine(300);
  const Program p = diverging();
  const auto out = run(machine, Executable(p), p, 0, points);
  CHECK(machine.faults().size() == 2);
  for (int k = 0; k < 300; ++k) {
    CHECK(out[k].fault.has_value() == (k == 77 || k == 201));
    const int n = k % 50;
    CHECK(out[k].results[0].r[0] == (out[k].fault ? 0 : n * (n + 1) / 2));
  }
}

/// Builtins over the time, over what a builtin made of it, over the point, and in one arm.
Program timed() {
  Assembler a;
  a.function("f", {}, {R, R, R, I, R}, {R});
  const auto time = [&]() -> Assembler& { return a.input(Variable::Time); };
  time(), time().real(2).op(Op::MulR).op(Op::CallBuiltin, kSumAndDifference).op(Op::MulR).store(0);
  a.load(0);
  a.load(0).real(3).op(Op::CallBuiltin, kSumAndDifference).op(Op::SubR);
  time().op(Op::PushInput, kX).op(Op::CallBuiltin, kSumAndDifference).op(Op::MulR);
  time().op(Op::CallBuiltin, kBits);
  a.op(Op::PushInput, kX).real(0).op(Op::LtR).begin({R});
  a.load(0).op(Op::PushInput, kY).op(Op::CallBuiltin, kSumAndDifference).op(Op::AddR);
  a.op(Op::Else);
  time().real(1).op(Op::CallBuiltin, kSumAndDifference).op(Op::AddR);
  a.end().ret();
  return a.program;
}

TEST_CASE("what depends on the frame alone is computed for a few lanes") {
  const LoweredCode code = lower(timed());
  std::vector<bool> uniform;
  for (const CallSite& site : code.sites) uniform.push_back(site.uniform);
  CHECK(uniform == std::vector{true, true, false, true, false, true});
}

TEST_CASE_TEMPLATE("lanes of one time, and of times that differ in a bit", T, float, double) {
  for (const T other : {T(0), T(-0.0), T(0.75), std::numeric_limits<T>::quiet_NaN()})
    for (const int odd : {0, 1, 40}) {
      auto points = spread<T>(41);
      for (auto& p : points) p[input_index(Variable::Time)].r[0] = odd == 0 ? other : T(0);
      points[std::size_t(odd)][input_index(Variable::Time)].r[0] = other;
      check_against_reference(timed(), 0, points);
    }
}

/// Blocks of the inputs that a function reads, itself or through calls.
std::vector<std::uint32_t> inputs(const LoweredCode& code, std::uint32_t function) {
  std::vector<std::uint32_t> blocks;
  const LoweredFunction& f = code.functions[function];
  for (std::uint32_t k = 0; k < f.inputs; ++k)
    blocks.push_back(code.operands[f.first_input + k].index());
  return blocks;
}

TEST_CASE("a function reads what the functions below it read, through cycles and long chains") {
  using Blocks = std::vector<std::uint32_t>;
  const std::uint32_t x = std::uint32_t(input_block(kX)), y = std::uint32_t(input_block(kY));
  Assembler a;
  a.function("above", {}, {R}).call(1).ret();
  a.function("ping", {}, {R}).op(Op::PushInput, kX).call(2).op(Op::AddR).ret();
  a.function("pong", {}, {R}).call(1).call(3).op(Op::AddR).ret();
  a.function("below", {}, {R}).op(Op::PushInput, kY).ret();
  const LoweredCode cycle = lower(a.program);
  CHECK(inputs(cycle, 0) == Blocks{x, y});
  CHECK(inputs(cycle, 1) == Blocks{x, y});
  CHECK(inputs(cycle, 2) == Blocks{x, y});
  CHECK(inputs(cycle, 3) == Blocks{y});

  for (const bool forwards : {true, false}) {
    constexpr std::uint32_t kLong = 30000;
    Assembler chain;
    for (std::uint32_t k = 0; k < kLong; ++k) {
      chain.function("f", {}, {R});
      const bool last = k == (forwards ? kLong - 1 : 0);
      (last ? chain.op(Op::PushInput, kX) : chain.call(forwards ? k + 1 : k - 1)).ret();
    }
    REQUIRE(fault_text(chain.program) == "");
    CHECK(inputs(lower(chain.program), forwards ? 0 : kLong - 1) == Blocks{x});
  }
}

}  // namespace
}  // namespace mms::vm::test
