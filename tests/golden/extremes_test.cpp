// SPDX-License-Identifier: Apache-2.0
// Sources that nobody writes: each ends in the message that is expected, or in none.
#include <doctest/doctest.h>

#include <functional>

#include "tests/golden/corpus.h"
#include "tests/golden/evaluate.h"
#include "tests/sanitized.h"

namespace mms::golden {
namespace {

constexpr int kMany = kSanitized ? 10000 : 100000;
constexpr int kMillion = 10 * kMany;

std::string lines(int n, const std::function<std::string(int)>& line) {
  std::string text;
  for (int i = 0; i < n; ++i) text += line(i);
  return text;
}

struct Extreme {
  std::string what;
  std::function<std::string()> text;
  std::string code;  ///< of the first message; empty where there is none
};

const std::vector<Extreme> kExtremes = {
    {"brackets", [] { return "const a = " + repeated("(", kMillion); }, "E0160"},
    {"brackets of types", [] { return "real f(" + repeated("(", kMillion); }, "E0160"},
    {"a long name",
     [] {
       return "const " + repeated("a", 1 << 20) + " = 1; const b = " + repeated("a", 1 << 20) + ";";
     },
     ""},
    {"a long unknown name", [] { return "const b = " + repeated("a", 1 << 20) + ";"; }, "E0201"},
    {"NUL bytes", [] { return std::string(1 << 20, '\0'); }, "E0104"},
    {"bytes that are no text", [] { return repeated("\xFF\xFE", 1 << 19); }, "E0103"},
    {"errors of the form", [] { return repeated("const a = ;", kMillion); }, "E0101"},
    {"unknown names",
     [] { return lines(kMany, [](int i) { return fmt::format("const a{0} = n{0};\n", i); }); },
     "E0201"},
    {"one name again and again", [] { return repeated("const a = 1;\n", kMany); }, "E0212"},
    {"operators", [] { return "const a = 1" + repeated(" + 1", kMany) + ";"; }, "E0161"},
    {"signs", [] { return "const a = " + repeated("-", kMany) + "1;"; }, "E0160"},
    {"comparisons", [] { return "const a = 1" + repeated(" < 2", kMany) + ";"; }, "E0161"},
    {"elements", [] { return "const a = [1" + repeated(", 1", kMany) + "];"; }, "E0223"},
    {"arms",
     [] {
       return "real f(real x) = select " +
              lines(kMany, [](int i) { return fmt::format("{0}, if x < {0};\n", i); }) +
              "x otherwise end;";
     },
     "E0316"},
    {"constants, each of the next",
     [] {
       return lines(kMany, [](int i) { return fmt::format("const k{} = k{};\n", i, i + 1); }) +
              fmt::format("const k{} = 1;", kMany);
     },
     "E0316"},
    {"more constants than 16 bits count, each of the last",
     [] {
       return "const k0 = 1;\n" +
              lines(70000, [](int i) { return fmt::format("const k{} = k{} + 1;\n", i + 1, i); });
     },
     ""},
    {"constants in a circle",
     [] {
       return lines(1000,
                    [](int i) { return fmt::format("const k{} = k{};\n", i, (i + 1) % 1000); });
     },
     "E0220"},
    {"types that double",
     [] {
       return "t0 typeid struct real a; end;\n" + lines(100, [](int i) {
                return fmt::format("   t{} typeid struct t{} a, b; end;\n", i + 1, i);
              });
     },
     "E0223"},
    {"a type of itself", [] { return std::string("t typeid struct t a; end;"); }, "E0220"},
    {"types of one another", [] { return std::string("t typeid u; u typeid t;"); }, "E0220"},
    {"definitions of types",
     [] {
       return "t0 typeid real;\n" +
              lines(kMany, [](int i) { return fmt::format("t{} typeid t{};\n", i + 1, i); });
     },
     ""},
    {"definitions of functions",
     [] {
       return lines(kMany, [](int i) { return fmt::format("real f{0}(real x) = x + {0};\n", i); });
     },
     ""},
    {"spaces", [] { return repeated(" ", 1 << 26); }, "E0311"},
    {"one comment", [] { return "//" + repeated("x", 1 << 20); }, "E0311"},
    {"an import of itself", [] { return std::string("import \"extreme\"; const a = 1;"); },
     "E0313"},
};

TEST_CASE("extreme sources end in a message") {
  for (const Extreme& e : kExtremes) {
    CAPTURE(e.what);
    const Compiled c = compile(lang::make_source("extreme", e.text()));
    const auto& all = c.diagnostics.all();
    REQUIRE(all.size() <= lang::kMaxErrors + 1);
    CHECK(c.linked.has_value() == e.code.empty());
    const std::string first = all.empty() ? "" : std::string(lang::info(all[0].id).code);
    CHECK(first == e.code);
    CHECK(c.text_of_errors().size() < 200000);  // a few hundred lines at most
  }
}

}  // namespace
}  // namespace mms::golden
