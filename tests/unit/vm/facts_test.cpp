// SPDX-License-Identifier: Apache-2.0
// What programs written by hand say of themselves, counted by hand; and bounds against what the
// machine does.
#include "vm/facts.h"

#include <doctest/doctest.h>

#include "harness.h"
#include "vm/limits.h"

namespace mms::vm::test {
namespace {

std::vector<CodeFacts> facts_of(const Assembler& a) {
  REQUIRE(fault_text(a.program) == "");
  return code_facts(a.program);
}

OutputInfo reads(std::initializer_list<Variable> variables) {
  OutputInfo info;
  for (const Variable v : variables) info.variables |= 1u << static_cast<int>(v);
  return info;
}

TEST_CASE("straight code is its instructions, and a frame") {
  Assembler a;
  a.function("f", {}, {R});
  a.input(Variable::Time).real(2).op(Op::MulR).real(1).op(Op::DivR).ret();
  const CodeFacts f = facts_of(a)[0];
  CHECK(f.instructions == 6);
  CHECK(f.cost == 1 + 3);  // MulR, DivR
  CHECK(f.calls == 0);
  CHECK(f.back_edges == 0);
  CHECK_FALSE(f.limited());
  CHECK(f.stack_blocks >= 1);  // at least its result
}

TEST_CASE("calls add up, the deepest row of them is what stands on the stack") {
  Assembler a;  // f calls g and h; g calls h
  a.function("f", {}, {R});
  a.input(Variable::Time).call(1).input(Variable::Time).call(2).op(Op::AddR).ret();
  a.function("g", {R}, {R}).load(0).call(2).ret();
  a.function("h", {R}, {R}).load(0).op(Op::NegR).ret();
  const auto all = facts_of(a);
  CHECK(all[2].calls == 0);
  CHECK(all[1].calls == 1);
  CHECK(all[0].calls == 2);
  CHECK(all[0].instructions == 6 + 3 + 3);  // each function once
  CHECK(all[2].cost == 1);
  CHECK(all[1].cost == 8 + 1);
  CHECK(all[0].cost == 8 + 9 + 8 + 1 + 1);
  CHECK(all[0].stack_blocks > all[1].stack_blocks);
  CHECK(all[1].stack_blocks > all[2].stack_blocks);
  CHECK_FALSE(all[0].limited());
}

TEST_CASE("a tail call is a loop, which takes no stack") {
  Assembler a;
  a.function("f", {}, {R}).real(0).call(1).ret();
  a.function("loop", {R}, {R});
  a.load(0).real(9).op(Op::LtR).begin({}).load(0).real(1).op(Op::AddR).again().other().end();
  a.load(0).ret();
  const auto all = facts_of(a);
  CHECK(all[0].loops);
  CHECK_FALSE(all[0].recursive);
  CHECK(all[0].limited());
  CHECK(all[0].calls == 1);
  CHECK(all[0].back_edges == limits::kBackEdges);
}

TEST_CASE("a recursion is bounded by what the machine allows") {
  Assembler a;
  a.function("f", {}, {R}).input(Variable::Time).call(1).ret();
  a.function("sum", {R}, {R});
  a.load(0).real(0).op(Op::LeR).begin({R}).real(0).other();
  a.load(0).load(0).real(1).op(Op::SubR).call(1).op(Op::AddR).end().ret();
  const auto all = facts_of(a);
  CHECK(all[0].recursive);
  CHECK_FALSE(all[0].loops);
  CHECK(all[0].calls == limits::kCallDepth);
  CHECK(all[0].back_edges == limits::kBackEdges);
  CHECK(all[0].stack_blocks > limits::kCallDepth);
  // The bound is reached, and not passed: sum(n) has n + 1 calls open.
  for (const bool fits : {true, false}) {
    auto point = zero_point<float>();
    point[input_index(Variable::Time)].r[0] = float(limits::kCallDepth - (fits ? 1 : 0));
    Interpreter<float> machine(1);
    const auto out = run(machine, Executable(a.program), a.program, 0, {point});
    CHECK(machine.faults().empty() == fits);
  }
}

TEST_CASE("rates") {
  CHECK(rate(reads({})) == Rate::Constant);
  CHECK(rate(reads({Variable::Time})) == Rate::Uniform);
  CHECK(rate(reads({Variable::Time, Variable::Uv})) == Rate::Varying);
  CHECK(rate(reads({Variable::Wavelength})) == Rate::Varying);
}

TEST_CASE("what belongs to the ray breaks reciprocity") {
  for (const Variable v : {Variable::View, Variable::Distance, Variable::Footprint})
    CHECK_FALSE(reciprocal(reads({v})));
  CHECK(reciprocal(reads({Variable::Position, Variable::Normal, Variable::Wavelength})));
  Descriptor d;
  CHECK(reciprocal(d));
  d.outputs[static_cast<int>(Output::Emission)] = reads({Variable::View});
  CHECK(reciprocal(d));  // light that is emitted is not scattered
  d.outputs[static_cast<int>(Output::Scattering)] = reads({Variable::View});
  CHECK_FALSE(reciprocal(d));
}

}  // namespace
}  // namespace mms::vm::test
