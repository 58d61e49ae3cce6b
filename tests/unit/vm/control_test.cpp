// SPDX-License-Identifier: Apache-2.0
// Arms, loops, calls and faults, in programs written by hand. Expected values are closed forms or
// plain C++, and every program is compared with the reference too.
#include "harness.h"
#include "vm/lower.h"

namespace mms::vm::test {
namespace {

constexpr int kX = input_index(Variable::Position, 0), kY = input_index(Variable::Position, 1);

template <class T>
std::vector<Point<T>> points_of(std::initializer_list<std::pair<double, double>> xy) {
  std::vector<Point<T>> points;
  for (const auto& [x, y] : xy) {
    points.push_back(zero_point<T>());
    points.back()[kX].r[0] = T(x);
    points.back()[kY].r[0] = T(y);
  }
  return points;
}

/// `n` points whose x are first, first + 1, ...
template <class T>
std::vector<Point<T>> counting(int n, int first = 0) {
  std::vector<Point<T>> points;
  for (int k = 0; k < n; ++k) {
    points.push_back(zero_point<T>());
    points.back()[kX].r[0] = T(first + k);
  }
  return points;
}

template <class T>
std::vector<Outcome<T>> run_once(const Program& p, std::uint32_t function,
                                 const std::vector<Point<T>>& points) {
  REQUIRE(fault_text(p) == "");
  Interpreter<T> machine(int(points.size()));
  return run(machine, Executable(p), p, function, points);
}

Assembler& push_x(Assembler& a) { return a.op(Op::PushInput, kX); }
Assembler& push_y(Assembler& a) { return a.op(Op::PushInput, kY); }

TEST_CASE("nested arms that diverge choose each lane's own value") {
  Assembler a;  // x < 0 ? (y < 0 ? 1 : 2) : (y < 0 ? 3 : x)
  a.function("f", {}, {R});
  push_x(a).real(0).op(Op::LtR).begin({R});
  push_y(a).real(0).op(Op::LtR).begin({R}).real(1).other().real(2).end();
  a.other();
  push_y(a).real(0).op(Op::LtR).begin({R}).real(3).other();
  push_x(a).end().end().ret();
  const auto points = points_of<float>({{-1, -1}, {-1, 1}, {1, -1}, {5, 1}, {-2, 3}});
  const auto out = run_once(a.program, 0, points);
  const float expected[] = {1, 2, 3, 5, 2};
  for (int k = 0; k < 5; ++k) CHECK(out[k].results[0].r[0] == expected[k]);
  check_against_reference(a.program, 0, points);
}

TEST_CASE("a return inside an arm keeps its lanes out of what follows") {
  Assembler a;  // if x < 2: return 10; local = x < 4 ? x : return 20; return -local
  a.function("f", {}, {R}, {R});
  push_x(a).real(2).op(Op::LtR).begin().real(10).ret().end();
  push_x(a).real(4).op(Op::LtR).begin();
  push_x(a).store(0).other().real(20).ret().end();
  a.load(0).op(Op::NegR).ret();
  const auto out = run_once(a.program, 0, counting<float>(6));
  const float expected[] = {10, 10, -2, -3, 20, 20};
  for (int k = 0; k < 6; ++k) CHECK(out[k].results[0].r[0] == expected[k]);
  check_against_reference(a.program, 0, counting<float>(6));
}

TEST_CASE("a local stored in both arms holds each lane's own value") {
  Assembler a;
  a.function("f", {}, {R}, {R});
  push_x(a).real(3).op(Op::LtR).begin().real(7).store(0).other();
  push_x(a).store(0).end().load(0).ret();
  const auto out = run_once(a.program, 0, counting<float>(6));
  const float expected[] = {7, 7, 7, 3, 4, 5};
  for (int k = 0; k < 6; ++k) CHECK(out[k].results[0].r[0] == expected[k]);
}

/// Function 0 is `entry() = steps(integer(x * x + 1), 0)`, function 1 counts Collatz steps in a
/// loop.
Program collatz() {
  Assembler a;
  a.function("entry", {}, {I});
  push_x(a);
  push_x(a).real(1).ops({Op::FmaR, Op::IntOfReal}).integer(0).call(1).ret();
  a.function("steps", {I, I}, {I});
  a.load(0).integer(1).op(Op::EqI).begin().load(1).ret().end();
  a.load(0).integer(2).op(Op::ModI).integer(0).op(Op::EqI).begin({I});
  a.load(0).op(Op::RealOfInt).real(0.5).ops({Op::MulR, Op::IntOfReal}).other();
  a.load(0).integer(3).op(Op::MulI).integer(1).op(Op::AddI).end();
  a.load(1).integer(1).op(Op::AddI).again();
  return a.program;
}

TEST_CASE_TEMPLATE("a tail loop runs as often as each lane needs", T, float, double) {
  const auto out = run_once(collatz(), 0, counting<T>(100));
  for (int k = 0; k < 100; ++k) {
    int steps = 0;
    for (int n = k * k + 1; n != 1; n = n % 2 ? 3 * n + 1 : n / 2) ++steps;
    CHECK(out[k].results[0].i == steps);
  }
}

TEST_CASE("arguments of a tail call are read before any parameter is assigned") {
  Assembler a;  // Euclid: gcd(a, b) = b == 0 ? a : gcd(b, a % b), and a rotation of three
  a.function("gcd_entry", {}, {I});
  push_x(a).op(Op::IntOfReal);
  push_y(a).op(Op::IntOfReal).call(1).ret();
  a.function("gcd", {I, I}, {I});
  a.load(1).integer(0).op(Op::EqI).begin().load(0).ret().end();
  a.load(1).load(0).load(1).op(Op::ModI).again();
  a.function("rotate_entry", {}, {R, R, S});
  push_x(a).real(1).real(2).input(Variable::Wavelength).call(3).ret();
  a.function("rotate", {R, R, R, S}, {R, R, S});
  a.load(0).real(0).op(Op::LeR).begin().load(1).load(2).load(3).ret().end();
  a.load(0).real(1).op(Op::SubR).load(2).load(1).load(3).load(1).ops({Op::Splat, Op::AddS});
  a.again();
  const auto out = run_once(a.program, 0, points_of<float>({{12, 18}, {17, 5}, {0, 9}, {9, 0}}));
  const int expected[] = {6, 1, 9, 9};
  for (int k = 0; k < 4; ++k) CHECK(out[k].results[0].i == expected[k]);
  check_against_reference(a.program, 2, counting<float>(9));
}

/// Function 0 is `entry() = fib(integer(x))`.
Program fibonacci() {
  Assembler a;
  a.function("entry", {}, {I});
  push_x(a).op(Op::IntOfReal).call(1).ret();
  a.function("fib", {I}, {I});
  a.load(0).integer(2).op(Op::LtI).begin().load(0).ret().end();
  a.load(0).integer(1).op(Op::SubI).call(1);
  a.load(0).integer(2).op(Op::SubI).call(1);
  a.op(Op::AddI).ret();
  return a.program;
}

TEST_CASE("recursion that diverges ends for each lane where it should") {
  const auto out = run_once(fibonacci(), 0, counting<float>(16));
  int f = 0, next = 1;
  for (int k = 0; k < 16; ++k) {
    CHECK(out[k].results[0].i == f);
    f = std::exchange(next, f + next);
  }
}

TEST_CASE("calls give several results, builtins too, and reals stand for spectra") {
  Assembler a;
  a.function("f", {}, {R, R, R, S, S});
  push_x(a);
  push_y(a).call(1);
  push_x(a);
  push_y(a).op(Op::CallBuiltin, kSumAndDifference).op(Op::MulR);
  a.input(Variable::Wavelength);
  push_y(a).input(Variable::RgbRed).op(Op::CallSpectral, kScaleAndShift, 0b101);
  push_x(a).op(Op::Splat).real(3).real(1).op(Op::CallSpectral, kScaleAndShift, 0b001).ret();
  a.function("swap", {R, R}, {R, R}).load(1).load(0).ret();
  std::vector<Point<double>> points = points_of<double>({{2, 5}, {3, 7}});
  for (Point<double>& p : points)
    for (int w = 0; w < kWavelengths; ++w) {
      p[input_index(Variable::Wavelength)].r[w] = 1 + w;
      p[input_index(Variable::RgbRed)].r[w] = 0.5 * w;
    }
  const auto out = run_once(a.program, 0, points);
  CHECK(out[0].results[0].r[0] == 5);
  CHECK(out[0].results[1].r[0] == 2);
  CHECK(out[0].results[2].r[0] == (2 + 5) * (2 - 5));
  for (int w = 0; w < kWavelengths; ++w) {
    CHECK(out[0].results[3].r[w] == (1 + w) * 5 - 0.5 * w);
    CHECK(out[1].results[4].r[w] == 3 * 3 - 1);
  }
  check_against_reference(a.program, 0, points);
}

// Faults

/// `entry() = loop(x)`, where `loop(n) = n == 0 ? 7 : loop(n - 1)`; endless for negative n.
Program countdown() {
  Assembler a;
  a.function("entry", {}, {R});
  push_x(a).call(1).ret();
  a.function("loop", {R}, {R});
  a.load(0).real(0).op(Op::EqR).begin().real(7).ret().end();
  a.load(0).real(1).op(Op::SubR).again();
  return a.program;
}

TEST_CASE("a lane may take exactly the stated number of back edges") {
  const auto points =
      points_of<float>({{limits::kBackEdges, 0}, {limits::kBackEdges + 1, 0}, {3, 0}});
  const auto out = run_once(countdown(), 0, points);
  CHECK(out[0].results[0].r[0] == 7);
  CHECK(!out[0].fault);
  CHECK(out[1].results[0].r[0] == 0);
  REQUIRE(out[1].fault);
  CHECK(out[1].fault->cause == Fault::Cause::BackEdges);
  CHECK(out[1].fault->line == SourceLine{0, 11});
  CHECK(out[2].results[0].r[0] == 7);
}

TEST_CASE("an endless loop of every lane ends, and each lane is reported once") {
  Interpreter<float> machine(20);
  const Program p = countdown();
  const Executable exe(p);
  run(machine, exe, p, 0, counting<float>(20, -20));
  CHECK(machine.faults().size() == 20);
  std::vector<bool> seen(20);
  for (const Fault& f : machine.faults()) {
    CHECK(!seen[f.lane]);
    seen[f.lane] = true;
  }
  // and the next run starts afresh
  const auto out = run(machine, exe, p, 0, counting<float>(20));
  CHECK(machine.faults().empty());
  CHECK(out[19].results[0].r[0] == 7);
}

/// `entry() = 2 * deep(x)`, where `deep(n) = n == 0 ? 1 : 1 + deep(n - 1)`.
Program deep() {
  Assembler a;
  a.function("entry", {}, {R, L});
  push_x(a).call(1).real(2).op(Op::MulR).logic(true).ret();
  a.function("deep", {R}, {R});
  a.load(0).real(0).op(Op::EqR).begin().real(1).ret().end();
  a.real(1).load(0).real(1).op(Op::SubR).call(1).op(Op::AddR).ret();
  return a.program;
}

TEST_CASE("a lane may have exactly the stated number of calls open") {
  const int most = limits::kCallDepth - 1;  // deep(n) has n + 1 calls open
  const auto out =
      run_once(deep(), 0, points_of<float>({{0, 0}, {most, 0}, {most + 1, 0}, {-1, 0}}));
  CHECK(out[0].results[0].r[0] == 2);
  CHECK(out[1].results[0].r[0] == 2 * (most + 1));
  for (int k = 2; k < 4; ++k) {
    REQUIRE(out[k].fault);
    CHECK(out[k].fault->cause == Fault::Cause::CallDepth);
    CHECK(out[k].fault->line == SourceLine{0, 12});
    CHECK(out[k].results[0].r[0] == 0);
    CHECK(out[k].results[1].i == 0);
  }
  CHECK(out[1].results[1].i == 1);
}

TEST_CASE("recursive calls are counted like back edges") {
  const auto out = run_once(fibonacci(), 0, points_of<float>({{40, 0}, {10, 0}}));
  REQUIRE(out[0].fault);
  CHECK(out[0].fault->cause == Fault::Cause::BackEdges);
  CHECK(out[0].results[0].i == 0);
  CHECK(out[1].results[0].i == 55);
}

TEST_CASE("a lane given up in a callee does nothing more in its callers") {
  Assembler a;  // a loop that calls `endless` for odd x and would go on for ever itself
  a.function("entry", {}, {R});
  push_x(a).real(0).call(1).ret();
  a.function("outer", {R, R}, {R});
  a.load(0).real(0).op(Op::LtR).begin({R}).load(0).call(2).other().real(1).end();
  a.load(1).op(Op::AddR).real(5).op(Op::LtR).begin();
  a.load(0).load(1).real(1).op(Op::AddR).again().other().load(1).ret().end();
  a.function("endless", {R}, {R}).load(0).again();
  const auto out = run_once(a.program, 0, points_of<float>({{1, 0}, {-1, 0}, {2, 0}}));
  CHECK(out[0].results[0].r[0] == 4);
  CHECK(out[2].results[0].r[0] == 4);
  REQUIRE(out[1].fault);
  CHECK(out[1].fault->line == SourceLine{0, 2});
  CHECK(out[1].results[0].r[0] == 0);
}

// Batches

/// What every lane comes to must not depend on the batch it is in.
template <class T>
void check_batches(const Program& p) {
  REQUIRE(fault_text(p) == "");
  const Executable exe(p);
  const auto points = counting<T>(70, -3);
  Interpreter<T> one(1), wide(80);
  std::vector<Outcome<T>> alone;
  for (const Point<T>& point : points) alone.push_back(run(one, exe, p, 0, {point})[0]);
  for (int n = 1; n <= 70; ++n) {  // the last n points, so each stands in many positions
    const std::vector<Point<T>> batch(points.end() - n, points.end());
    const auto out = run(wide, exe, p, 0, batch);
    for (int k = 0; k < n; ++k) CHECK(out[k] == alone[70 - n + k]);
  }
}

TEST_CASE_TEMPLATE("results do not depend on the batch", T, float, double) {
  check_batches<T>(deep());
  check_batches<T>(collatz());
}

TEST_CASE("an interpreter tells executables apart, and one may follow another") {
  Assembler a, b;
  a.function("f", {}, {R}).real(1).ret();
  b.function("f", {}, {R}).real(2).ret();
  Interpreter<float> machine(4);
  for (int k = 0; k < 20; ++k) {
    const Program& p = k % 2 ? b.program : a.program;
    const Executable exe(p);  // often where the last one was
    CHECK(run(machine, exe, p, 0, counting<float>(4))[3].results[0].r[0] == 1 + k % 2);
  }
}

TEST_CASE("interpreters hold no executable that is gone, though several have run it") {
  Assembler a;
  a.function("f", {}, {R}).real(1).ret();
  Interpreter<float> one(4), other(4);
  std::weak_ptr<const char> identity;
  {
    const Executable exe(a.program);
    identity = exe.code().identity;
    for (Interpreter<float>* machine : {&one, &other})
      run(*machine, exe, a.program, 0, counting<float>(4));
  }
  CHECK(identity.expired());
}

TEST_CASE("the width fits the working set to the cache") {
  Assembler small, large;
  small.function("f", {}, {R}).real(1).ret();
  CHECK(Executable(small.program).width() == 512);
  large.function("f", {}, std::vector<SlotType>(240, S));
  for (int k = 0; k < 240; ++k) large.real(k).op(Op::Splat);
  large.ret();
  CHECK(Executable(large.program).width() == 32);
}

}  // namespace
}  // namespace mms::vm::test
