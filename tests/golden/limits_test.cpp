// SPDX-License-Identifier: Apache-2.0
// The limits of vm/limits.h that a script can reach: one script at the limit, which links, and one
// past it, which says so. What is too long for a file under tests/golden is written here.
#include <doctest/doctest.h>

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "stdlib/stdlib.h"
#include "tests/golden/corpus.h"
#include "tests/golden/evaluate.h"
#include "tests/sanitized.h"
#include "tests/source_dir.h"
#include "vm/limits.h"

namespace mms::golden {
namespace {

namespace limits = vm::limits;

/// The codes of all messages, each once for each message.
std::vector<std::string> codes(const Compiled& c) {
  std::vector<std::string> all;
  for (const lang::Diagnostic& d : c.diagnostics.all()) all.emplace_back(lang::info(d.id).code);
  return all;
}

using Codes = std::vector<std::string>;

double only_value(const Compiled& c) {
  REQUIRE(c.linked);
  REQUIRE(!vm::verify(c.linked->program));
  const vm::Program& p = c.linked->program;
  auto in = points<float>(vm::kLaneMultiple);
  const Point point = points_of(p).at(p.exports.size() - 1);
  const Run r = evaluate(p, vm::Executable(p), point, in, 1);
  REQUIRE(r.faults.empty());
  return r.values.at(0).at(0);
}

/// The fault of the last value, as golden scripts name it; empty if there is none.
std::string fault_of(const Compiled& c) {
  const vm::Program& p = c.linked->program;
  if (p.exports.empty()) return "";
  auto in = points<float>(vm::kLaneMultiple);
  const Run r = evaluate(p, vm::Executable(p), points_of(p).at(p.exports.size() - 1), in, 1);
  if (r.faults.empty()) return "";
  return r.faults[0].cause == vm::Fault::Cause::BackEdges ? "BackEdges" : "CallDepth";
}

TEST_CASE("each limit is kept by one script and broken by another, which is told") {
  if (kThreadSanitized) return;
  for (const Limit& l : limit_scripts()) {
    CAPTURE(l.name);
    {
      const Compiled kept = compile(l.kept);
      REQUIRE_MESSAGE(kept.linked, kept.text_of_errors());
      CHECK(kept.diagnostics.all().empty());
      CHECK(fault_of(kept) == "");
    }
    const Compiled broken = compile(l.broken);
    if (l.code.empty()) {
      REQUIRE_MESSAGE(broken.linked, broken.text_of_errors());
      CHECK(fault_of(broken) == l.fault);
      continue;
    }
    CHECK(!broken.linked);
    REQUIRE(!broken.diagnostics.all().empty());
    for (const lang::Diagnostic& d : broken.diagnostics.all()) {
      CHECK(lang::info(d.id).code == l.code);
      CHECK(d.text.find(l.text) != std::string::npos);
    }
  }
}

TEST_CASE("every number of vm/limits.h has its two scripts") {
  std::ifstream in(mms::source_dir() / "vm/limits.h");
  REQUIRE(in);
  std::ostringstream text;
  text << in.rdbuf();
  const std::string all = text.str();
  std::set<std::string> there, tested;
  const std::regex name(R"(constexpr \w+ (k\w+) =)");
  for (std::sregex_iterator it(all.begin(), all.end(), name), end; it != end; ++it)
    there.insert((*it)[1]);
  for (const Limit& l : limit_scripts()) CHECK(tested.insert(l.name).second);
  CHECK(there.size() > 10);
  CHECK(there == tested);
}

TEST_CASE("errors: after a hundred, one more") {
  const Codes all = codes(compile(flood()));
  REQUIRE(all.size() == lang::kMaxErrors + 1);
  CHECK(all.back() == "E0100");
}

TEST_CASE("nesting of brackets") {
  auto brackets = [](int n) {
    return compile("const a = " + repeated("(", n) + "1" + repeated(")", n) + ";");
  };
  // The expression itself is one level.
  CHECK(only_value(brackets(limits::kNesting - 1)) == 1);
  CHECK(codes(brackets(limits::kNesting)) == Codes{"E0160"});
}

TEST_CASE("operations deep") {
  auto sum = [](int terms) { return compile("real a() = $time" + repeated(" + 1", terms) + ";"); };
  CHECK(only_value(sum(4 * limits::kNesting - 1)) == 4 * limits::kNesting - 1);
  CHECK(codes(sum(4 * limits::kNesting)) == Codes{"E0161"});
}

TEST_CASE("bytes of a source") {
  const std::string text = "const a = 1;";
  const int room = limits::kSourceBytes - static_cast<int>(text.size());
  CHECK(only_value(compile(text + std::string(static_cast<std::size_t>(room), ' '))) == 1);
  CHECK(codes(compile(text + std::string(static_cast<std::size_t>(room) + 1, ' '))) ==
        Codes{"E0162"});
}

TEST_CASE("operations after inlining") {
  if (kThreadSanitized) return;
  // Each function calls the one before twice: 2^n sums of something nobody knows.
  auto doubling = [](int n) {
    std::string text = "real f0(real x) = sin(x + $time);\n";
    for (int i = 1; i <= n; ++i)
      text += fmt::format("real f{0}(real x) = f{1}(x + {0}) + f{1}(x - {0});\n", i, i - 1);
    return compile(text + fmt::format("real a() = f{}($position.z);\n", n));
  };
  CHECK(std::isfinite(only_value(doubling(8))));
  CHECK(codes(doubling(20)) == Codes{"E0303"});
}

TEST_CASE("functions inlined into one another") {
  auto chain = [](int n) {
    std::string text = "real f1(real x) = x + 1;\n";
    for (int i = 2; i <= n; ++i)
      text += fmt::format("real f{0}(real x) = f{1}(x) + 1;\n", i, i - 1);
    return compile(text + fmt::format("real a() = f{}(0);\n", n));
  };
  CHECK(only_value(chain(limits::kInlineDepth - 1)) == limits::kInlineDepth - 1);
  const Codes all = codes(chain(limits::kInlineDepth + 1));
  REQUIRE(!all.empty());
  for (const std::string& code : all) CHECK(code == "E0305");
}

TEST_CASE("a param that is not there") {
  lang::LinkOptions options;
  options.params = {{"scal", "2"}};
  const Compiled c =
      compile(lang::make_source("t", "param real scale = 1; const a = scale;"), options);
  REQUIRE(codes(c) == Codes{"E0306"});
  CHECK(c.diagnostics.all()[0].helps == std::vector<std::string>{"did you mean `scale`?"});
}

TEST_CASE("a library function without a derivative rule") {
  std::vector<vm::Builtin> rows(stdlib::builtins().begin(), stdlib::builtins().end());
  for (vm::Builtin& row : rows)
    if (row.signature == "real sin(real x)") row.derivative = {};
  const auto source = lang::make_source("test.mms", "surface s height = sin($uv.x); end\n");
  lang::Library library = api::standard_library();
  library.builtins = rows;
  Compiled c;
  c.source = source;
  c.graphs.push_back(lang::parse(source, c.diagnostics));
  c.linked = lang::link(c.graphs, library, {}, c.diagnostics);
  CHECK(codes(c) == Codes{"E0310"});
}

TEST_CASE("lobes of a material") {
  auto lobes = [](int n) {  // n scattering models and n - 1 combiners
    std::string text = "surface s bsdf = matte(0.001)";
    return compile(text + repeated(" + matte(0.001)", n - 1) + "; end");
  };
  const Compiled most = lobes(limits::kLobes / 2);
  REQUIRE(most.linked);
  CHECK(!vm::verify(most.linked->program));
  CHECK(most.linked->program.descriptors[0].shade.material.nodes.size() == limits::kLobes - 1);
  CHECK(codes(lobes(limits::kLobes / 2 + 1)) == Codes{"E0302"});
}

}  // namespace
}  // namespace mms::golden
