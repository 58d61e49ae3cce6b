// SPDX-License-Identifier: Apache-2.0
// The traced run against the batch machine, and where values that are not finite come from.
#include "vm/trace.h"
#include "generator.h"
#include "harness.h"
#include "vm/lower.h"
#include "vm/profile.h"

namespace mms::vm::test {
namespace {

TEST_CASE_TEMPLATE("a traced point has the bits of the batch machine", T, float, double) {
  Interpreter<T> machine(16);
  std::mt19937 random(5);
  for (std::uint32_t seed = 3000; seed < 3200; ++seed) {
    CAPTURE(seed);
    const Program p = Generator(seed).program(seed % 2);
    REQUIRE(fault_text(p) == "");
    const Executable exe(p);
    std::vector<Point<T>> points;
    for (int k = 0; k < 3; ++k) {
      points.push_back(zero_point<T>());
      for (Cell<T>& c : points.back())
        for (T& x : c.r) x = T(int(random() % 64) - 32) / 8;
    }
    const auto expected = run(machine, exe, p, 0, points);
    InputBatch<T> in(16);
    for (int k = 0; k < 3; ++k) put(in, k, points[std::size_t(k)]);
    for (int lane = 0; lane < 3; ++lane) {
      const Trace t = trace(p, 0, in, lane);
      const auto& lane_expected = expected[std::size_t(lane)];
      REQUIRE(t.fault.has_value() == lane_expected.fault.has_value());
      if (t.fault) continue;
      REQUIRE(t.results.size() == lane_expected.results.size());
      for (std::size_t k = 0; k < t.results.size(); ++k) {
        CHECK(t.results[k].integer == lane_expected.results[k].i);
        for (int w = 0; w < block_count(t.results[k].type); ++w)
          CHECK(same(T(t.results[k].real[w]), lane_expected.results[k].r[w]));
      }
      CHECK(t.steps.size() == t.step_count);
    }
  }
}

/// f(x) = (sqrt-like quotient) 0 / x + x * 2, each operation on a line of its own.
Program quotient() {
  Program p;
  p.sources = {"test"};
  p.constants = {{SlotType::Real, 0, 0, 0}, {SlotType::Real, 2, 2, 0}};
  Function f;
  f.results = {SlotType::Real};
  const auto x = std::uint32_t(input_index(Variable::Position));
  f.code = {{Op::PushConst, 0}, {Op::PushInput, x}, {Op::DivR}, {Op::PushInput, x},
            {Op::PushConst, 1}, {Op::MulR},         {Op::AddR}, {Op::Return}};
  for (std::uint32_t k = 0; k < f.code.size(); ++k) f.lines.push_back({0, k + 1, k + 2});
  p.functions = {f};
  return p;
}

TEST_CASE("a NaN is traced to the instruction that made it, not to those that passed it on") {
  const Program p = quotient();
  REQUIRE(!verify(p));
  InputBatch<float> in(16);
  in.lanes(Variable::Position)[0] = 0;
  in.lanes(Variable::Position)[1] = 3;
  in.lanes(Variable::Position)[2] = INFINITY;
  const Trace zero = trace(p, 0, in, 0);
  REQUIRE(zero.results.size() == 1);
  CHECK(std::isnan(zero.results[0].real[0]));
  REQUIRE(zero.results[0].origin >= 0);
  CHECK(zero.origins[std::size_t(zero.results[0].origin)].line == SourceLine{0, 3, 4});
  const Trace three = trace(p, 0, in, 1);
  CHECK(three.results[0].real[0] == 6);
  CHECK(three.results[0].origin == -1);
  CHECK(three.steps.size() == 5);  // two inputs, three operations
  CHECK(three.steps[3].value.real[0] == 6);
  // What came in infinite was made by nobody here.
  const Trace infinite = trace(p, 0, in, 2);
  CHECK(std::isinf(infinite.results[0].real[0]));
  CHECK(infinite.results[0].origin == -1);
  CHECK(trace(p, 0, in, 1, 2).steps.size() == 2);
}

TEST_CASE("a profile counts every instruction that ran, and watching changes no value") {
  const Program p = quotient();
  const Executable exe(p);
  InputBatch<float> in(32);
  for (int i = 0; i < 32; ++i) in.lanes(Variable::Position)[i] = float(i + 1);
  Interpreter<float> machine(32);
  machine.run(exe, 0, in, 32);
  const std::vector<float> plain(machine.result(0), machine.result(0) + 32);
  Profile profile(exe);
  for (int k = 0; k < 3; ++k) profile.run(machine, 0, in, 32);
  CHECK(std::vector<float>(machine.result(0), machine.result(0) + 32) == plain);
  REQUIRE(profile.costs().size() == exe.code().instructions.size());
  for (const Profile::Cost& c : profile.costs()) {
    CHECK(c.runs == 3);
    CHECK(c.seconds >= 0);
  }
  double total = 0;
  for (const Profile::LineCost& line : profile.by_line()) total += line.share;
  CHECK(total == doctest::Approx(1));
}

}  // namespace
}  // namespace mms::vm::test
