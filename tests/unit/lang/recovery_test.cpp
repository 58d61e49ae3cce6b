// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <set>
#include <string>
#include <string_view>

#include "syntax.h"
#include "vm/limits.h"

using namespace mms::lang;
using test::parse_text;
using test::reported;

namespace {

struct Case {
  std::string text, reported;
};

std::string in_body(const std::string& line) { return "surface s\n" + line + "\nend\n"; }

/// Every syntax message, where it belongs, and nothing else.
const Case kCases[] = {
    {in_body("x = f(1 2);"), "E0101@2:9-10"},
    {in_body("x = ;"), "E0101@2:5-6"},
    {in_body("x[0] = 3;"), "E0101@2:6-7"},
    {in_body("x = 2(y);"), "E0101@2:6-7"},
    {in_body("x = a == not b;"), "E0101@2:10-13"},
    {in_body("x = [];"), "E0101@2:6-7"},
    {in_body("x = 3 @ 4;"), "E0102@2:7-8"},
    {in_body("x = a & b;"), "E0102@2:7-8"},
    {in_body("x = \xFF;"), "E0103@2:5-6"},
    {in_body(std::string("x\0 = 1;", 7)), "E0104@2:2-3"},
    {in_body("x = \"abc;\ny = 2;"), "E0105@2:5-6"},
    {"x typeid real; /* y", "E0106@1:16-18"},
    {"import \"a\\b\";", "E0107@1:10-12"},
    {"surface 'a' end", "E0108@1:9-12"},
    {in_body("x = .5 + 5.;"), "E0109@2:5-7 E0109@2:10-12"},
    {in_body("x = a.5;"), "E0109@2:6-8"},
    {in_body("x = 1e-;"), "E0110@2:5-8"},
    {in_body("x = 2x + 1;"), "E0111@2:6-7"},
    {in_body("x = 0x1F;"), "E0112@2:5-9"},
    {in_body("x = 3000000000;"), "E0113@2:5-15"},
    {"real f(real[4000000000] x) = 1;", "E0113@1:13-23"},
    {in_body("x = 1e400;"), "E0114@2:5-10"},
    {in_body("x = $ y;"), "E0115@2:5-6"},
    {in_body("x = 1\ny = 2;"), "E0120@2:6-6"},
    {in_body("x = 1 y = 2;"), "E0120@2:6-6"},
    {in_body("x = 1"), "E0120@2:6-6"},
    {"import \"a\"\nimport \"b\"\n", "E0120@1:11-11 E0120@2:11-11"},
    {in_body("x = (1 + 2;\ny = 3;"), "E0121@2:11-11"},
    {in_body("x = f(g(1, 2);\ny = 3;"), "E0121@2:14-14"},
    {in_body("x = f(a];"), "E0121@2:8-9"},
    {"real f(real a = 1;", "E0121@1:18-18 E0124@1:19-19"},
    {"surface s\nx = 1;\n", "E0122@3:1-1"},
    {"surface s\nx = 1;\nsurface t end", "E0122@3:1-8"},
    {in_body("x = select 1, if a; 2 otherwise;\ny = 3;"), "E0122@2:33-33"},
    {"t typeid struct real a;\nimport \"x\";", "E0122@2:1-7"},
    {"real f(real x) return x; end", "E0123@1:26-29"},
    {"real f(real x) y = x;\nsurface s end", "E0124@2:1-8"},
    {in_body("real f(real x) y = x;"), "E0124@3:1-4"},
    {in_body("return 3;"), "E0125@2:1-7"},
    {"return 3;", "E0125@1:1-7"},
    {in_body("end = 3;"), "E0126@2:1-4"},
    {in_body("real in = 3;"), "E0126@2:6-8"},
    {in_body("x = f(end = 3);"), "E0126@2:7-10"},
    {"const if = 3;", "E0126@1:7-9"},
    {"real f(a, b) = a;", "E0127@1:8-9"},
    {"f(real x) = x;", "E0128@1:1-2"},
    {"x = 1; y = 2; const z = 3;", "E0129@1:1-2"},
    {"real x = 1;", "E0129@1:6-7"},
    {"real f(real[1, 2, 3] x) = 1;", "E0130@1:8-21"},
    {in_body("x = [1, 2; 3];"), "E0131@2:12-13"},
    {in_body("x = select 1, if a; end;"), "E0132@2:21-24"},
    {in_body("x = select 1, if a; 2; end;"), "E0132@2:22-22"},
    {in_body("x = select 1, if a; else 2; end;"), "E0133@2:21-25"},
    {in_body("x = a && b || !c;"), "E0140@2:7-9 E0140@2:12-14 E0140@2:15-16"},
    {in_body("x = a ** 2;"), "E0141@2:7-9"},
    {in_body("x++;"), "E0142@2:2-4"},
    {in_body("x += 2;"), "E0142@2:3-5"},
    {in_body("x = y++;"), "E0142@2:6-8"},
    {in_body("x = a ? b : c;"), "E0143@2:7-8"},
    {in_body("x = f(50%, 20%);"), "E0144@2:9-10 E0144@2:14-15"},
    {in_body("x = 50%;"), "E0144@2:7-8"},
    {in_body("x = select 1, if a = b; 2 otherwise end;"), "E0145@2:20-21"},
    {in_body("x = 1 + (a = b);"), "E0145@2:12-13"},
    {"real f(real x) { return x; }", "E0146@1:16-17"},
    {"surface s { x = 1; }", "E0146@1:11-12"},
    {in_body("x = {1, 2};"), "E0146@2:5-6"},
    {in_body("if (a) x = 1; else x = 2;"), "E0147@2:1-3"},
    {in_body("if (a) { x = 1; y = 2; } else { x = 2; } z = 3 3;"), "E0147@2:1-3 E0101@2:48-49"},
    {in_body("for (i = 0; i < 3; i++) x = 2;"), "E0147@2:1-4"},
    {in_body("foo(3);"), "E0147@2:1-4"},
    {in_body("x = if a then b;"), "E0148@2:5-7"},
    {"float f(vec3 x) = 1;", "E0149@1:1-6 E0149@1:9-13"},
    {in_body("x = 2 * function(y) -> y;"), "E0150@2:9-17"},
    {in_body("x = real;"), "E0151@2:5-9"},
    {"const x = " + std::string(mms::vm::limits::kNesting, '(') + "1;",
     fmt::format("E0160@1:{}-{}", 11 + mms::vm::limits::kNesting, 12 + mms::vm::limits::kNesting)},
};

/// `head`, then `n` times `unit`.
std::string many(const std::string& head, const std::string& unit, std::size_t n) {
  std::string text = head;
  text.reserve(head.size() + n * unit.size());
  for (std::size_t i = 0; i < n; ++i) text += unit;
  return text;
}

}  // namespace

TEST_CASE("every syntax error is reported at its place, once, and nothing follows from it") {
  for (const Case& c : kCases) {
    CAPTURE(c.text);
    CHECK(reported(c.text) == c.reported);
  }
}

TEST_CASE("every row of the syntax section has a case, an explanation and an example") {
  std::string all = "E0100 E0161 E0162";  // below: they need large sources
  for (const Case& c : kCases) all += " " + c.reported;
  for (const DiagInfo& row : all_diagnostics()) {
    if (!row.code.starts_with("E01")) continue;
    CAPTURE(row.code);
    CHECK(all.find(row.code) != std::string::npos);
    CHECK(row.explain.size() + row.wrong.size() + row.right.size() > 60);
    CHECK_FALSE(row.text.ends_with('.'));
  }
}

TEST_CASE("independent errors are all reported, and what is in order is kept") {
  const auto p = parse_text(R"(
param real a = ;
real f(real x) = x +;
real g(real) return 2;
real good(real x) = x;
surface "s"
  a = [1, 2 3; 4, 5, 6];
  b = select 1, if x y; 2, if z; 3 4 otherwise; end;
  c = g(1, (2, 3);
  d = 4;
end
volume "v"
  e = f(1;
end
)");
  CHECK(reported(p.diagnostics) ==
        "E0101@2:16-17 E0101@3:21-22 E0101@4:12-13 E0101@7:13-14 E0101@8:22-23 E0101@8:36-37 "
        "E0121@9:14-14 E0121@13:10-10");
  REQUIRE(p.graph.descriptors.size() == 2);
  CHECK(p.graph.descriptors[0].body.assignments.back().name.text == "d");
  CHECK(p.graph.top_functions.size() == 3);
}

TEST_CASE("a script's own type may have a foreign name") {
  CHECK(reported("vec3 typeid real[3]; real f(vec3 v) = 1;") == "");
  CHECK(reported("import \"types\"; real f(vec3 v) = 1;") == "");
  CHECK(reported("import \"types\" as t; real f(vec3 v) = 1;") == "E0149@1:29-33");
}

TEST_CASE("second spans say where it began") {
  const auto bracket = parse_text("surface s\n x = (1;\nend");
  REQUIRE(bracket.diagnostics.all().size() == 1);
  REQUIRE(bracket.diagnostics.all()[0].notes.size() == 1);
  CHECK(bracket.diagnostics.all()[0].notes[0].span.begin == 15);
  CHECK(bracket.diagnostics.all()[0].text == "expected `)`, found `;`");
  const auto end = parse_text("surface s\n x = 1;\n");
  REQUIRE(end.diagnostics.all().size() == 1);
  REQUIRE(end.diagnostics.all()[0].notes.size() == 1);
  CHECK(end.diagnostics.all()[0].notes[0].span.begin == 0);
  CHECK(end.diagnostics.all()[0].notes[0].span.end == 9);
}

TEST_CASE("nesting is limited, whatever nests") {
  constexpr std::size_t kN = 1000000;
  for (const std::string unit : {"(", "[", "-", "not ", "select ", "2^", "function() -> ", "f(",
                                 "a[", "[1, (", "select 1, if "}) {
    CAPTURE(unit);
    CHECK(reported(many("const x = ", unit, kN)).starts_with("E0160"));
    CHECK(parse_text(many("const x = ", unit, 1000)).diagnostics.all().size() <= 3);
  }
  CHECK(reported(many("real f(", "(", kN)).starts_with("E0160"));
  CHECK(reported(many("", "function(", kN)).starts_with("E0160"));
  CHECK(reported(many("", "real f() ", kN)).starts_with("E0160"));
  for (const std::string unit : {"1+", "a.b.", "f()()", "a[1][2].c^"}) {
    CAPTURE(unit);
    CHECK(parse_text(many("const x = a", unit, kN)).diagnostics.all().size() <= 2);
  }
  CHECK(reported(many("const x = 1", "+1", kN)).starts_with("E0161"));
  CHECK(reported(many("const x = 1", "+1", 1000) + ";") == "");
}

TEST_CASE("a source is limited") {
  CHECK(reported(many("const x = [1", ",1", 1100000)).starts_with("E0162"));
  CHECK(reported(many("real f(real x", ",x", 3000000)).find("E0162") != std::string::npos);
  Diagnostics d;
  const Graph kept =
      parse(make_source("big", std::string(mms::vm::limits::kSourceBytes + 1, ' ')), d);
  CHECK(reported(d) == "E0162@1:1-1");
}

TEST_CASE("floods of errors end with one message that says so") {
  for (const std::string unit :
       {"a b c;\n", "@ ", "x = !", "\" ;\n", "{", "}", "end ", "surface ", "param ", "$ ",
        "const = ;", "\xFF ", "0x1 ", "x = 1 +;real f() = ;"}) {
    CAPTURE(unit);
    const auto p = parse_text(many("", unit, 100000));
    CHECK(p.diagnostics.all().size() <= kMaxErrors + 1);
    CHECK(p.diagnostics.has_errors());
    std::size_t last = 0;
    for (const Diagnostic& d : p.diagnostics.all()) last += d.id == Diag::TooManyErrors;
    CHECK(last == (p.diagnostics.all().size() > kMaxErrors ? 1 : 0));
  }
}

TEST_CASE("large tokens make small messages") {
  constexpr std::size_t kN = 1 << 20;
  for (const std::string& text :
       {many("surface s x = a ", "b", kN) + "; end", many("", "a", kN) + " " + many("", "b", kN),
        many("const x = ", "1", kN) + ";", many("const x = 2", "z", kN) + ";",
        many("const x = \"", "s", kN), many("/*", "c", kN), many("'", "c", kN),
        many("", std::string(1, '\0'), kN), many("", "\xFF", kN), many("", "@", kN)}) {
    const auto p = parse_text(text);
    CHECK(p.diagnostics.has_errors());
    CHECK(render(p.diagnostics).size() < 2000);
  }
}
