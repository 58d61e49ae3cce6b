// SPDX-License-Identifier: Apache-2.0
#include "lang/parser.h"

#include <doctest/doctest.h>

#include <string>

#include "syntax.h"
#include "vm/limits.h"

using namespace mms::lang;
using test::expression;
using test::parse_text;
using test::reported;
using test::shape;
using test::type;

TEST_CASE("precedence and associativity") {
  CHECK(expression("a + b * c - d") == "(- (+ a (* b c)) d)");
  CHECK(expression("a / b % c * d") == "(* (% (/ a b) c) d)");
  CHECK(expression("2^3^2") == "(^ 2 (^ 3 2))");
  CHECK(expression("-x^2") == "(- (^ x 2))");
  CHECK(expression("2^-x^2") == "(^ 2 (- (^ x 2)))");
  CHECK(expression("a--b") == "(- a (- b))");
  CHECK(expression("- -a * b") == "(* (- (- a)) b)");
  CHECK(expression("not a == b and c or d") == "(or (and (not (== a b)) c) d)");
  CHECK(expression("a or not not b") == "(or a (not (not b)))");
  CHECK(expression("a < b == c > d") == "(== (< a b) (> c d))");
  CHECK(expression("(a + b) * c") == "(* (+ a b) c)");
}

TEST_CASE("comparisons chain") {
  CHECK(expression("0 < x") == "(< 0 x)");
  CHECK(expression("0 < x <= 1") == "(chain 0 < x <= 1)");
  CHECK(expression("a < b < c < d + 1") == "(chain a < b < c < (+ d 1))");
  CHECK(expression("a == b != c") == "(chain a == b != c)");
}

TEST_CASE("literals") {
  CHECK(expression("12") == "12");
  CHECK(expression("2.5") == "2.5r");
  CHECK(expression("500nm") == "5e-07r");
  CHECK(expression("3m") == "3r");
  CHECK(expression("1.5i") == "1.5i");
  CHECK(expression("2i") == "2i");
  CHECK(expression("\"a\\n\"") == "'a\n'");
  CHECK(expression("true and false") == "(and true false)");
  CHECK(expression("2147483647") == "2147483647");
  CHECK(expression("-2147483648") == "(- 2147483648)");
  CHECK(expression("2^-2147483648") == "(^ 2 (- 2147483648))");
  CHECK(expression("2147483648") == "E0113@1:1-11");
  CHECK(expression("-2147483648^2") == "E0113@1:2-12");
  CHECK(expression("1-2147483648") == "E0113@1:3-13");
  CHECK(expression("99999999999999999999999") == "E0113@1:1-24");
  CHECK(expression("1e999") == "E0114@1:1-6");
}

TEST_CASE("operands") {
  CHECK(expression("n::perlin(p)") == "(call n::perlin p)");
  CHECK(expression("$uv[0]") == "(index $uv 0)");
  CHECK(expression("m[1, 2].x") == "(field (index m 1 2) x)");
  CHECK(expression("f(1, ior = 1.5)(2)") == "(call (call f 1 ior=1.5r) 2)");
  CHECK(expression("f()") == "(call f)");
  CHECK(expression("real(x)") == "(convert 2 x)");
  CHECK(expression("integer(x).y") == "(field (convert 1 x) y)");
  CHECK(expression("(a + b)(c)") == "(call (+ a b) c)");
  CHECK(expression("fold(#+, 0, #n::f)") == "(call fold #+ 0 #n::f)");
  for (const char* op :
       {"+", "-", "*", "/", "%", "^", "and", "or", "==", "!=", "<", ">", "<=", ">="})
    CHECK(expression(std::string("f(#") + op + ", 1)") == std::string("(call f #") + op + " 1)");
  CHECK(expression("[1, 2, 3]") == "(array 1 1 2 3)");
  CHECK(expression("[1, 2; 3, 4; 5, 6]") == "(array 3 1 2 3 4 5 6)");
  CHECK(expression("[[1, 2], [3, 4]]") == "(array 1 (array 1 1 2) (array 1 3 4))");
}

TEST_CASE("lambdas and selects") {
  CHECK(expression("function(x, real y) -> x + y") == "(lambda [_ x,real y] (+ x y))");
  CHECK(expression("function() -> function(a) -> a") == "(lambda [] (lambda [_ a] a))");
  CHECK(expression("map(function(real[n] x) -> x, s)") == "(call map (lambda [real[n] x] x) s)");
  CHECK(expression("(function(x) -> x^2)(3)") == "(call (lambda [_ x] (^ x 2)) 3)");
  CHECK(expression("select a otherwise end") == "(select a)");
  CHECK(expression("select a, if b; c, if d; e otherwise; end + 1") == "(+ (select a b c d e) 1)");
  CHECK(expression("select select a otherwise end, if b; [1; 2] otherwise end") ==
        "(select (select a) b (array 2 1 2))");
}

TEST_CASE("types") {
  for (const char* t : {"logic", "integer", "real", "complex", "spectrum", "material", "string"})
    CHECK(type(t) == t);
  CHECK(type("a::b") == "a::b");
  CHECK(type("generic T") == "generic T");
  CHECK(type("generic T[3]") == "generic T[3]");
  CHECK(type("real[]") == "real[*]");
  CHECK(type("real[n, generic m]") == "real[n,generic m]");
  CHECK(type("real[2][3]") == "real[3,2]");
  CHECK(type("(real)[2]") == "real[2]");
  CHECK(type("(function(real) -> real)[2]") == "function(real)->real[2]");
  CHECK(type("function(real, (integer)) -> function() -> real") ==
        "function(real,integer)->function()->real");
  CHECK(type("real[2, 3][4]") == "E0130@1:1-14");
  CHECK(type("real[3,]") == "E0101@1:8-9");
  CHECK(type("real[2.5]") == "E0101@1:6-9");
}

TEST_CASE("items of the top level") {
  const auto p = parse_text(R"(
import "noise" as n; import "lib/wood.mms";
/// How large.
/// In metres.
param real s = 4.0 in [0.1, 20], label = "Scale", unit = "m";
const integer k = 3; const c = 1;
outside alias n::inside; "text" alias "inner";
v3 typeid real[3];
finish typeid enum raw, oiled;
ray typeid struct v3 origin, dir; real t; end
/// One line.
real sq(real x) = x^2;
generic T mix(generic T a, b, real t = 0.5) d = b - a; return a + t * d;
real f() real g(real x) = x; integer j typeid real; const q = 1; real y = 2; y2 = 3;; return y;
/// Shiny.
surface "marble" bsdf = matte(1); end
volume fog end;
)");
  const Graph& g = p.graph;
  // `integer j typeid` is no definition; everything else is in order.
  CHECK(reported(p.diagnostics) == "E0101@14:40-46");
  REQUIRE(g.imports.size() == 2);
  CHECK(g.imports[0].file == "noise");
  CHECK(g.imports[0].as->text == "n");
  CHECK_FALSE(g.imports[1].as);
  REQUIRE(g.params.size() == 1);
  CHECK(g.params[0].doc == "How large.\nIn metres.");
  CHECK(shape(g, g.params[0].value) == "4r");
  CHECK(shape(g, g.params[0].lower) == "0.1r");
  CHECK(shape(g, g.params[0].upper) == "20");
  REQUIRE(g.params[0].meta.size() == 2);
  CHECK(g.params[0].meta[1].key.text == "unit");
  CHECK(shape(g, g.params[0].meta[1].value) == "'m'");
  REQUIRE(g.constants.size() == 2);
  CHECK(shape(g, g.constants[0].type) == "integer");
  CHECK(shape(g, g.constants[1].type) == "_");
  REQUIRE(g.aliases.size() == 2);
  CHECK(g.aliases[0].outside.text == "outside");
  CHECK(shape(g.aliases[0].inside) == "n::inside");
  CHECK(g.aliases[1].outside.text == "text");
  CHECK(g.aliases[1].inside[0].text == "inner");
  REQUIRE(g.type_definitions.size() == 3);
  CHECK(shape(g, g.type_definitions[0].type) == "real[3]");
  CHECK(g.type_definitions[1].enumerators.at(1).text == "oiled");
  REQUIRE(g.type_definitions[2].fields.size() == 3);
  CHECK(shape(g, g.type_definitions[2].fields[1].type) == "v3");
  CHECK(g.type_definitions[2].fields[1].name.text == "dir");
  REQUIRE(g.top_functions.size() == 3);
  const Function& sq = g[g.top_functions[0]];
  CHECK(sq.doc == "One line.");
  CHECK(shape(g, sq.value) == "(^ x 2)");
  CHECK(sq.body.items.empty());
  const Function& mix = g[g.top_functions[1]];
  REQUIRE(mix.formals.size() == 3);
  CHECK(mix.formals[1].type == mix.formals[0].type);
  CHECK(shape(g, mix.formals[2].default_value) == "0.5r");
  CHECK(mix.body.assignments.at(0).name.text == "d");
  const Function& f = g[g.top_functions[2]];
  REQUIRE(f.body.items.size() == 4);
  CHECK(f.body.items[0].form == Item::Form::Function);
  CHECK(f.body.items[1].form == Item::Form::Constant);
  CHECK(f.body.items[2].form == Item::Form::Assignment);
  CHECK(shape(g, f.body.assignments[0].type) == "real");
  CHECK(shape(g, f.body.assignments[1].type) == "_");
  REQUIRE(g.descriptors.size() == 2);
  CHECK(g.descriptors[0].name.text == "marble");
  CHECK(g.descriptors[0].doc == "Shiny.");
  CHECK(g.descriptors[1].form == Descriptor::Form::Volume);
  CHECK(g.descriptors[1].name.text == "fog");
}

TEST_CASE("spans are exact") {
  const std::string text = "real f(real a)\n  b = (a + 1) * 2;\n  return g(b);\n";
  const auto p = parse_text(text);
  REQUIRE(reported(p.diagnostics) == "");
  const auto cut = [&](Span s) { return text.substr(s.begin, s.end - s.begin); };
  const Function& f = p.graph[p.graph.top_functions.at(0)];
  CHECK(cut(f.header) == "real f(real a)");
  CHECK(cut(f.span) == text.substr(0, text.size() - 1));
  CHECK(cut(f.body.assignments.at(0).span) == "b = (a + 1) * 2;");
  const Expr& product = p.graph[f.body.assignments[0].value];
  CHECK(cut(product.span) == "(a + 1) * 2");
  CHECK(product.op == Operator::Mul);
  CHECK(p.graph[product.args[0]].parenthesised);
  CHECK(cut(p.graph[product.args[0]].span) == "(a + 1)");
  CHECK(cut(p.graph[f.value].span) == "g(b)");
}

TEST_CASE("signatures and single expressions") {
  Diagnostics d;
  const Graph g = parse_signature(
      make_source("row", "generic T fold(function(generic T, T) -> T f, T start, T[generic n] xs)"),
      d);
  CHECK(reported(d) == "");
  REQUIRE(g.functions.size() == 1);
  CHECK(g.functions[0].name.text == "fold");
  CHECK(shape(g, g.functions[0].formals.at(0).type) == "function(generic T,T)->T");
  CHECK(shape(g, g.functions[0].formals.at(2).type) == "T[generic n]");
  CHECK_FALSE(g.functions[0].value);

  Diagnostics trailing;
  const Graph kept = parse_signature(make_source("row", "real f(real x) = 1"), trailing);
  CHECK(reported(trailing) == "E0101@1:16-17");
  CHECK(expression("a b") == "E0101@1:3-4");
  CHECK(expression("") == "E0101@1:1-1");

  Diagnostics none;
  const Graph root = parse_expression(make_source("e", "(f(a, (b)))"), none);
  CHECK(root.exprs.back().form == Expr::Form::Call);
}
