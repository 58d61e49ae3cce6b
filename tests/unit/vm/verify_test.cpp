// SPDX-License-Identifier: Apache-2.0
// Each rule of the verifier: one program that breaks just it, and the message that says so.
#include <doctest/doctest.h>

#include <functional>

#include "assembler.h"
#include "vm/limits.h"

namespace mms::vm::test {
namespace {

std::string what(const Program& p) {
  const auto fault = verify(p);
  return fault ? fault->what : "";
}

/// What is wrong with `f() -> results`, written by `write`.
std::string what_of_code(std::vector<SlotType> results, std::vector<SlotType> locals,
                         const std::function<void(Assembler&)>& write) {
  Assembler a;
  a.function("f", {}, std::move(results), std::move(locals));
  write(a);
  return what(a.program);
}

TEST_CASE("stack: operands are there, have their types, and nothing is left") {
  CHECK(what_of_code({R}, {}, [](Assembler& a) { a.real(1).ret(); }) == "");
  CHECK(what_of_code({R}, {}, [](Assembler& a) { a.real(1).op(Op::AddR).ret(); }) ==
        "an operand is missing");
  CHECK(what_of_code({R}, {}, [](Assembler& a) { a.real(1).integer(1).op(Op::AddR).ret(); }) ==
        "an operand has the wrong type");
  CHECK(what_of_code({R}, {}, [](Assembler& a) { a.integer(1).ret(); }) ==
        "an operand has the wrong type");
  CHECK(what_of_code({R}, {}, [](Assembler& a) { a.real(1).real(1).ret(); }) ==
        "values are left under those of Return or TailCall");
  CHECK(what_of_code({}, {}, [](Assembler& a) { a.real(1).again(); }) ==
        "values are left under those of Return or TailCall");
}

TEST_CASE("code: every path leaves, and nothing follows that is not reached") {
  CHECK(what_of_code({}, {}, [](Assembler&) {}) == "the end is reached without Return or TailCall");
  CHECK(what_of_code({}, {}, [](Assembler& a) { a.logic(true).begin().ret().end(); }) ==
        "the end is reached without Return or TailCall");
  CHECK(what_of_code({}, {}, [](Assembler& a) { a.ret().ret(); }) ==
        "nothing reaches this instruction");
  CHECK(what_of_code({}, {}, [](Assembler& a) {
          a.logic(true).begin().ret().other().again().end().ret();
        }) == "nothing reaches this instruction");
  CHECK(what_of_code({}, {}, [](Assembler& a) { a.op(static_cast<Op>(kOpCount)); }) ==
        "no such instruction");
}

TEST_CASE("code: operands are in range") {
  for (const Op op : {Op::PushConst, Op::PushInput, Op::LoadLocal, Op::Call, Op::CallBuiltin,
                      Op::CallSpectral, Op::Component}) {
    CAPTURE(info(op).name);
    CHECK(what_of_code({}, {}, [&](Assembler& a) { a.op(op, 100000).ret(); }) ==
          "the operand is out of range");
  }
  CHECK(what_of_code({}, {}, [](Assembler& a) { a.real(1).op(Op::StoreLocal, 0).ret(); }) ==
        "the operand is out of range");
  CHECK(what_of_code({R}, {}, [](Assembler& a) {
          a.input(Variable::Wavelength).op(Op::Component, kWavelengths).ret();
        }) == "the operand is out of range");
  CHECK(what_of_code({R}, {}, [](Assembler& a) {
          a.input(Variable::Wavelength).op(Op::Component, kWavelengths - 1).ret();
        }) == "");
  CHECK(what_of_code({}, {}, [](Assembler& a) { a.logic(true).op(Op::If, 0).end().ret(); }) ==
        "the operand is out of range");
}

TEST_CASE("arms: nesting and values") {
  CHECK(what_of_code({R}, {}, [](Assembler& a) {
          a.logic(true).begin({R}).real(1).other().real(2).end().ret();
        }) == "");
  CHECK(what_of_code({}, {}, [](Assembler& a) { a.logic(true).begin().end().ret(); }) == "");
  CHECK(what_of_code({R}, {}, [](Assembler& a) { a.logic(true).begin({R}).real(1).end().ret(); }) ==
        "an If with results has no Else");
  CHECK(what_of_code({}, {}, [](Assembler& a) { a.other().ret(); }) == "Else without If");
  CHECK(what_of_code({}, {}, [](Assembler& a) { a.end().ret(); }) == "End without If");
  CHECK(what_of_code({}, {}, [](Assembler& a) {
          a.logic(true).begin().other().other().end().ret();
        }) == "Else without If");
  CHECK(what_of_code({}, {}, [](Assembler& a) { a.logic(true).begin().ret(); }) ==
        "If without End");
  CHECK(what_of_code({}, {}, [](Assembler& a) {
          a.logic(true).begin().real(1).other().end().ret();
        }) == "an arm leaves more values than its block type");
  CHECK(what_of_code({R}, {}, [](Assembler& a) {
          a.logic(true).begin({R}).real(1).other().integer(1).end().ret();
        }) == "an operand has the wrong type");
  CHECK(what_of_code({R}, {}, [](Assembler& a) {  // an arm may not take what was there before it
          a.real(1).logic(true).begin().op(Op::NegR).other().end().ret();
        }) == "an operand is missing");
  CHECK(what_of_code({R}, {}, [](Assembler& a) {  // and may not leave while something is under it
          a.real(1).logic(true).begin().real(2).ret().end().ret();
        }) == "values are left under those of Return or TailCall");
  CHECK(what_of_code({}, {}, [](Assembler& a) {
          for (int k = 0; k <= limits::kIfDepth; ++k) a.logic(true).begin();
        }) == "If is nested too deeply");
}

TEST_CASE("locals: stored before they are loaded, on every path, and once") {
  const auto what_of = [](const std::function<void(Assembler&)>& write) {
    return what_of_code({R}, {R, R}, write);
  };
  CHECK(what_of([](Assembler& a) { a.load(0).ret(); }) == "a local is loaded before it is stored");
  CHECK(what_of([](Assembler& a) { a.integer(1).store(0).load(0).ret(); }) ==
        "an operand has the wrong type");
  CHECK(what_of([](Assembler& a) { a.real(1).store(0).real(2).store(0).load(0).ret(); }) ==
        "a local is stored twice");
  const auto arms = [&](bool first, bool second) {
    return what_of([=](Assembler& a) {
      a.logic(true).begin();
      if (first) a.real(1).store(0);
      a.other();
      if (second) a.real(2).store(0);
      a.end().load(0).ret();
    });
  };
  CHECK(arms(true, true) == "");
  CHECK(arms(true, false) == "a local is loaded before it is stored");
  CHECK(arms(false, true) == "a local is loaded before it is stored");
  CHECK(what_of([](Assembler& a) {  // the arm that does not store it does not arrive
          a.logic(true).begin().real(1).ret().other().real(1).store(0).end().load(0).ret();
        }) == "");
  CHECK(what_of([](Assembler& a) {
          a.logic(true).begin().real(1).store(0).other().real(1).ret().end().load(0).ret();
        }) == "");
  CHECK(what_of([](Assembler& a) {  // stored on some path already
          a.logic(true).begin().real(1).store(0).end().real(2).store(0).load(0).ret();
        }) == "a local is stored twice");
  CHECK(what_of([](Assembler& a) {  // the arms do not see each other
          a.logic(true).begin({R}).real(1).store(0).load(0).other().load(0).end().ret();
        }) == "a local is loaded before it is stored");
  Assembler a;
  a.function("f", {R}, {R}).real(1).store(0).load(0).ret();
  CHECK(what(a.program) == "a local is stored twice");
}

TEST_CASE("calls: signatures, kernels and budgets") {
  CHECK(what_of_code({R}, {}, [](Assembler& a) {
          a.real(1).op(Op::CallSpectral, kSumAndDifference).ret();
        }) == "only a builtin from reals to one real works at each wavelength");
  CHECK(what_of_code({R}, {}, [](Assembler& a) {
          a.real(1).op(Op::CallSpectral, kScaleAndShift, 8).ret();
        }) == "a bit says that an argument which is not there is a spectrum");
  CHECK(what_of_code({R}, {}, [](Assembler& a) { a.real(1).op(Op::CallBuiltin, kBits).ret(); }) ==
        "an operand has the wrong type");

  Assembler a;
  a.function("f", {}, {R}).real(1).call(1).ret();
  a.function("g", {I}, {R}).real(1).ret();
  CHECK(what(a.program) == "an operand has the wrong type");

  Assembler kernel;
  constexpr Builtin none{.signature = "integer none(real x)"};
  kernel.program.builtins[kBits] = &none;
  kernel.function("f", {}, {I}).real(1).op(Op::CallBuiltin, kBits).ret();
  CHECK(what(kernel.program) == "the builtin has no kernel");

  Assembler many;  // 2^40 calls that no counter sees
  for (std::uint32_t k = 0; k < 40; ++k)
    many.function("f" + std::to_string(k), {}, {}).call(k + 1).call(k + 1).ret();
  many.function("leaf", {}, {}).ret();
  CHECK(what(many.program) == "it makes too many calls");
}

TEST_CASE("values that calls move are counted before they are moved") {
  // `wide` has as many results as fit and is not sound: that is found once the count has passed.
  const auto calls = [](int n) {
    Assembler a;
    a.function("f", {}, {});
    for (int k = 0; k < n; ++k) a.call(1);
    a.ret();
    a.function("wide", {}, std::vector<SlotType>(1 << 15, R)).ret();
    return what(a.program);
  };
  constexpr int kMost = limits::kMoves / (1 << 15);
  CHECK(calls(kMost - 2) == "too many values and locals");
  CHECK(calls(kMost) == "its instructions move too many values");
}

TEST_CASE("tables: types, signatures and lines") {
  const auto broken = [](const std::function<void(Program&)>& edit) {
    Assembler a;
    a.function("f", {R}, {R}).load(0).real(1).op(Op::AddR).ret();
    REQUIRE(what(a.program) == "");
    edit(a.program);
    return what(a.program);
  };
  constexpr SlotType none = static_cast<SlotType>(4);
  CHECK(broken([](Program& p) { p.constants[0].type = none; }) ==
        "a constant has no constant's type");
  CHECK(broken([](Program& p) { p.constants[0].type = S; }) == "a constant has no constant's type");
  CHECK(broken([](Program& p) {
          p.constants.push_back({L, 0, 0, 2});
        }) == "a logic constant is neither 0 nor 1");
  CHECK(broken([](Program& p) { p.block_types.push_back({none}); }) ==
        "a block type is no list of types or too long");
  CHECK(broken([](Program& p) { p.builtin_params.pop_back(); }) ==
        "not every builtin has a signature");
  CHECK(broken([](Program& p) { p.builtins[0] = nullptr; }) == "a builtin is missing");
  CHECK(broken([](Program& p) { p.builtin_results[0] = {none}; }) ==
        "a builtin's signature is no list of types or too long");
  CHECK(broken([](Program& p) { p.builtin_params[0].push_back(R); }) ==
        "a builtin's signature is not that of its row");
  CHECK(broken([](Program& p) { p.builtin_results[1] = {I}; }) ==
        "a builtin's signature is not that of its row");
  CHECK(broken([](Program& p) { p.functions[0].results = {none}; }) ==
        "the results are no list of types or too many");
  CHECK(broken([](Program& p) { p.functions[0].locals.assign(limits::kSlots + 1, R); }) ==
        "the locals are no list of types or too many");
  CHECK(broken([](Program& p) { p.functions[0].locals.clear(); }) ==
        "the parameters are not the first locals");
  CHECK(broken([](Program& p) { p.functions[0].locals = {I}; }) ==
        "the parameters are not the first locals");
  CHECK(broken([](Program& p) { p.functions[0].lines.pop_back(); }) ==
        "not every instruction has a source line");
  CHECK(broken([](Program& p) { p.functions[0].lines[0].source = 1; }) ==
        "a source line names no source");
  CHECK(broken([](Program& p) {
          p.exports.push_back({"x", "real", 1});
        }) == "an export's function is out of range");
  CHECK(broken([](Program& p) {
          p.exports.push_back({"x", "real", 0});
        }) == "an export's function has parameters");
  CHECK(broken([](Program& p) {
          Function& f = p.functions[0];
          f.code.insert(f.code.begin(), limits::kSlots, {Op::LoadLocal, 0, 0});
          f.lines.resize(f.code.size());
        }) == "too many values and locals");
}

/// A descriptor whose every value is a constant or the result of function 0.
Program described() {
  Assembler a;
  a.function("shade", {}, {S, R}).real(0.5).op(Op::Splat).real(1).ret();
  a.function("other", {R}, {}).ret();
  a.integer(3);  // a constant of the wrong type; its instruction is not wanted
  a.program.functions[1].code = {{Op::Return}};
  a.program.functions[1].lines = {{0, 1}};
  Descriptor d;
  d.name = "d";
  const ValueSource spectrum{S, true, 0}, real{R, true, 0};
  for (Entry* e : {&d.shade, &d.pass, &d.emit, &d.displace}) {
    e->scattering = e->absorption = e->emission = spectrum;
    e->height = e->bound = e->gradient[0] = e->gradient[1] = real;
  }
  d.shade.function = 0;
  d.shade.scattering = {S, false, 0};
  d.shade.height = {R, false, 1};
  d.shade.material.nodes = {{0, {spectrum}, {}}, {1, {real}, {}}, {2, {spectrum}, {0, 1}}};
  a.program.descriptors = {d};
  return a.program;
}

TEST_CASE("descriptors: values and layouts") {
  REQUIRE(what(described()) == "");
  const auto broken = [](const std::function<void(Descriptor&)>& edit) {
    Program p = described();
    edit(p.descriptors[0]);
    return what(p);
  };
  CHECK(broken([](Descriptor& d) { d.form = static_cast<DescriptorForm>(2); }) ==
        "a descriptor is neither surface nor volume");
  CHECK(broken([](Descriptor& d) { d.line = {3, 1}; }) == "a source line names no source");
  CHECK(broken([](Descriptor& d) { d.outputs[0].variables = 1u << 31; }) ==
        "an output reads a variable that is not there");
  CHECK(broken([](Descriptor& d) { d.emit.function = 2; }) ==
        "an entry's function is out of range");
  CHECK(broken([](Descriptor& d) { d.emit.function = 1; }) == "an entry's function has parameters");
  CHECK(broken([](Descriptor& d) { d.pass.absorption.index = 99; }) ==
        "a value's constant is out of range");
  CHECK(broken([](Descriptor& d) { d.pass.absorption.index = 2; }) ==
        "a value's constant has the wrong type");
  CHECK(broken([](Descriptor& d) { d.shade.scattering.index = 2; }) ==
        "a value's result is out of range");
  CHECK(broken([](Descriptor& d) { d.shade.scattering.index = 1; }) ==
        "a value's result has the wrong type");
  CHECK(broken([](Descriptor& d) {
          d.pass.scattering = {S, false, 0};
        }) == "a value's result is out of range");  // the entry has no function
  CHECK(broken([](Descriptor& d) { d.displace.bound.type = S; }) == "a value has the wrong type");
  CHECK(broken([](Descriptor& d) { d.pass.scattering = {}; }) == "a value has the wrong type");
  CHECK(broken([](Descriptor& d) { d.pass.height = {}; }) == "");  // `pass` does not compute it
  CHECK(broken([](Descriptor& d) { d.shade.material.nodes[1].params[0].type = SlotType(7); }) ==
        "a value has no type");
  CHECK(broken([](Descriptor& d) { d.shade.material.nodes[0].lobe = -1; }) ==
        "a lobe is out of range");
  CHECK(broken([](Descriptor& d) { d.shade.material.nodes[2].children[0] = 2; }) ==
        "a lobe's child does not precede it");
  CHECK(broken([](Descriptor& d) { d.shade.material.nodes[2].children[0] = 1; }) ==
        "a lobe has two parents");
  CHECK(broken([](Descriptor& d) { d.emit.emission_material.nodes.resize(limits::kLobes + 1); }) ==
        "a material has too many lobes");
}

TEST_CASE("the fault says where it is") {
  Assembler a;
  a.function("fine", {}, {}).ret();
  a.function("broken", {}, {R}).real(1).real(2).op(Op::AddI).ret();
  CHECK(fault_text(a.program) == "broken:2: an operand has the wrong type");
}

TEST_CASE("a disassembly names constants, variables, functions and lines") {
  Assembler a;
  a.function("entry", {}, {R}, {R}).input(Variable::Position, 1).real(0.25).call(1).store(0);
  a.load(0).logic(true).begin().real(1).op(Op::CallBuiltin, kIsNonzero).op(Op::Not);
  a.op(Op::PushConst, 77);
  a.function("half", {R, R}, {R}).ret();
  a.program.sources = {"wood.mms"};
  const std::string text = disassemble(a.program);
  for (const char* part : {"function 0 entry() -> (real)", "function 1 half(real, real) -> (real)",
                           "$position[1]", "0.25", "Call           half", "local 0", "true",
                           "logic is_nonzero(real x)", "constant 77?", "wood.mms:10"}) {
    CAPTURE(part);
    CHECK(text.find(part) != std::string::npos);
  }
  const std::string layout = disassemble(described());
  CHECK(layout.find("surface d") != std::string::npos);
  CHECK(layout.find("scattering: spectrum result 0") != std::string::npos);
  CHECK(layout.find("material node 2: lobe 2(spectrum 0.5) node 0 node 1") != std::string::npos);
}

}  // namespace
}  // namespace mms::vm::test
