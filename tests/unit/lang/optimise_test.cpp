// SPDX-License-Identifier: Apache-2.0
#include "lang/optimise.h"

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <set>
#include <string>

#include "lang/fold.h"
#include "lang/parser.h"

using namespace mms::lang;
using mms::vm::Op;
using mms::vm::SlotType;

namespace {

/// One function of one real parameter `x` that returns x (x + 1), with the constant 1.
Module square_and_more() {
  Module m;
  m.constant({SlotType::Real, 1, 1, 0});
  IrFunction f;
  f.name = "f";
  f.params = {SlotType::Real};
  const Ref x = add_node(f, 0, {Op::LoadLocal, 0, 0, {}, {SlotType::Real}, {}, -1});
  const Ref one = add_node(f, 0, {Op::PushConst, 0, 0, {}, {SlotType::Real}, {}, 0});
  const Ref sum = add_node(f, 0, {Op::AddR, 0, 0, {x, one}, {}, {}, -1});
  f.results = {add_node(f, 0, {Op::MulR, 0, 0, {x, sum}, {}, {}, -1})};
  m.functions.push_back(std::move(f));
  return m;
}

std::string fault(void (*broken)(Module&)) {
  Module m = square_and_more();
  broken(m);
  return check_ir(m, m.functions[0]);
}

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a sound graph has no fault") {
  const Module m = square_and_more();
  CHECK(check_ir(m, m.functions[0]).empty());
}

TEST_CASE("every kind of broken graph is found") {
  CHECK(has(fault([](Module& m) { m.functions[0].nodes[2].args.pop_back(); }), "takes `rr`"));
  CHECK(has(fault([](Module& m) { m.functions[0].nodes[2].op = Op::And; }), "takes `ll`"));
  CHECK(has(fault([](Module& m) { m.functions[0].nodes[2].results = {SlotType::Logic}; }),
            "gives `r`, marked `l`"));
  CHECK(has(fault([](Module& m) { m.functions[0].nodes[2].args[0] = {3, 0, 0}; }), "comes later"));
  CHECK(has(fault([](Module& m) { m.functions[0].nodes[2].args[0] = {9, 0, 0}; }), "not there"));
  CHECK(has(fault([](Module& m) { m.functions[0].nodes[2].args[0].result = 1; }), "not there"));
  CHECK(has(fault([](Module& m) { m.functions[0].nodes[0].a = 1; }), "operand 1"));
  CHECK(has(fault([](Module& m) { m.functions[0].nodes[1].a = 7; }), "operand 7"));
  CHECK(has(fault([](Module& m) { m.functions[0].nodes[2].known = 7; }), "constant 7"));
  CHECK(has(fault([](Module& m) {
              m.constants[0].type = SlotType::Integer;
              m.functions[0].nodes[1].results = {SlotType::Integer};
              m.functions[0].nodes[2].op = Op::AddI;
            }),
            "takes `ii`, found `ri`"));
  CHECK(has(fault([](Module& m) { m.functions[0].nodes[3].op = Op::Return; }), "no operation"));
  CHECK(has(fault([](Module& m) { m.functions[0].results = {{4, 0, 0}}; }), "result %4"));
}

TEST_CASE("passes have names of their own and a sentence; higher levels only add passes") {
  std::set<std::string_view> names;
  for (const PassInfo& p : passes()) {
    CAPTURE(p.name);
    CHECK(names.insert(p.name).second);
    CHECK(p.doc.size() > 20);
    CHECK(p.from <= Level::O2);
  }
  CHECK(names.contains("fold"));
}

TEST_CASE("a pass is dumped by its name, at the levels that run it") {
  const SourcePtr source = make_source("t", "real v() = $position[0];\nreal f() = v() * 1;\n");
  Diagnostics diagnostics;
  const Graph graph = parse(source, diagnostics);
  const auto dump_of = [&](Level level, std::string_view pass) {
    LinkOptions options;
    options.level = level;
    options.dump_after = pass;
    const auto linked = link({&graph, 1}, {}, options, diagnostics);
    REQUIRE(linked);
    return linked->dump;
  };
  CHECK(has(dump_of(Level::O0, "dead"), "MulR"));
  CHECK(dump_of(Level::O0, "simplify").empty());
  CHECK_FALSE(has(dump_of(Level::O2, "dead-again"), "MulR"));
  CHECK(dump_of(Level::O2, "no-such-pass").empty());
  CHECK(dump_of(Level::O2, "").empty());
}

namespace {

using Known = mms::vm::Constant;

Known real(float x) { return {SlotType::Real, x, static_cast<double>(x), 0}; }

bool same_bits(const Known& a, const Known& b) {
  return std::bit_cast<std::uint32_t>(a.f32) == std::bit_cast<std::uint32_t>(b.f32) &&
         std::bit_cast<std::uint64_t>(a.f64) == std::bit_cast<std::uint64_t>(b.f64);
}

/// Every sign, exponent and upper mantissa: both zeros, denormals, infinities, quiet NaNs. The
/// machine makes no signalling ones.
template <class F>
void for_floats(F f) {
  for (std::uint32_t high = 0; high < 1u << 16; ++high) {
    const std::uint32_t bits = high << 16;
    const bool signalling = (bits & 0x7FC00000u) == 0x7F800000u && (bits & 0x003FFFFFu) != 0;
    if (!signalling) f(real(std::bit_cast<float>(bits)));
  }
}

/// Whether O2 leaves `op` in `real f() = EXPRESSION` of a value `v()` known only at the hit.
bool stays(const std::string& expression, std::string_view op) {
  Diagnostics diagnostics;
  const Graph graph = parse(
      make_source("t", "real v() = $position[0];\nreal f() = " + expression + ";\n"), diagnostics);
  LinkOptions options;
  options.dump_after = "dead-again";
  const auto linked = link({&graph, 1}, {}, options, diagnostics);
  REQUIRE_MESSAGE(linked, render(diagnostics));
  return has(linked->dump, op);
}

}  // namespace

TEST_CASE("what is rewritten is the same for every float, bit for bit") {
  const Known one = real(1);
  int wrong = 0;
  for_floats([&](const Known& x) {
    const Known rewritten[] = {
        *fold(Op::MulR, std::array{x, one}),
        *fold(Op::MulR, std::array{one, x}),
        *fold(Op::DivR, std::array{x, one}),
        *fold(Op::NegR, std::array{*fold(Op::NegR, std::array{x})}),
        *fold(Op::SelectR, std::array{Known{SlotType::Logic, 0, 0, 0}, x, x}),
        *fold(Op::SelectR, std::array{Known{SlotType::Logic, 0, 0, 1}, x, x})};
    for (const Known& r : rewritten) wrong += !same_bits(r, x);
  });
  CHECK(wrong == 0);
  CHECK_FALSE(stays("v() * 1", "MulR"));
  CHECK_FALSE(stays("1 * v()", "MulR"));
  CHECK_FALSE(stays("v() / 1", "DivR"));
  CHECK_FALSE(stays("-(-v())", "NegR"));
  CHECK_FALSE(stays("select v(), if v() < 1; v() otherwise end", "Select"));
}

TEST_CASE("what holds for numbers only is left alone") {
  // Each has a float for which the tempting answer is wrong: -0, NaN, infinity, or rounding.
  const float inf = std::numeric_limits<float>::infinity();
  CHECK_FALSE(same_bits(*fold(Op::AddR, std::array{real(-0.0f), real(0)}), real(-0.0f)));
  CHECK_FALSE(same_bits(*fold(Op::SubR, std::array{real(inf), real(inf)}), real(0)));
  CHECK_FALSE(same_bits(*fold(Op::MulR, std::array{real(-1), real(0)}), real(0)));
  CHECK_FALSE(same_bits(*fold(Op::DivR, std::array{real(0), real(0)}), real(1)));
  CHECK(stays("v() + 0", "AddR"));
  CHECK(stays("v() - v()", "SubR"));
  CHECK(stays("v() * 0", "MulR"));
  CHECK(stays("v() / v()", "DivR"));
  CHECK(stays("0 - v()", "SubR"));
  CHECK(stays("v() / 3", "DivR"));
  CHECK(stays("(v() + 1) - 1", "SubR"));
}
