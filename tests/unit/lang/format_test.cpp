// SPDX-License-Identifier: Apache-2.0
// The formatter changes white space only, and nothing the second time.
#include "lang/format.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include <doctest/doctest.h>

#include "lang/lexer.h"
#include "lang/parser.h"
#include "tests/source_dir.h"

namespace {

using namespace mms::lang;
namespace fs = std::filesystem;

std::string format(const std::string& text) {
  Diagnostics diagnostics;
  const auto out = mms::lang::format(make_source("test.mms", text), diagnostics);
  return out ? *out : "syntax error";
}

/// `text` is as it should be; so is `from` after formatting.
void check_format(const std::string& from, const std::string& text) {
  CHECK(format(from) == text);
  CHECK(format(text) == text);
}

std::string without_trailing_space(std::string text) {
  return text.substr(0, text.find_last_not_of(" \t\r") + 1);
}

/// Every token and every comment, in the order of the text, and the documentation of all items.
std::vector<std::string> contents(const SourcePtr& source) {
  Diagnostics diagnostics;
  Lexer lexer(*source, diagnostics);
  std::vector<std::pair<std::uint32_t, std::string>> all;
  for (Token t = lexer.next(); t.tok != Tok::Eof; t = lexer.next())
    all.emplace_back(t.begin, source->text.substr(t.begin, t.end - t.begin));
  for (const Comment& c : lexer.comments())
    all.emplace_back(c.begin, without_trailing_space(
                                  std::string(source->text.substr(c.begin, c.end - c.begin))));
  std::sort(all.begin(), all.end());
  std::vector<std::string> texts;
  for (auto& [place, text] : all) texts.push_back(std::move(text));
  const Graph graph = parse(source, diagnostics);
  for (const Function& f : graph.functions) texts.push_back("function " + f.doc);
  for (const Descriptor& d : graph.descriptors) texts.push_back("descriptor " + d.doc);
  for (const Param& p : graph.params) texts.push_back("param " + p.doc);
  for (const Constant& k : graph.constants) texts.push_back("const " + k.doc);
  return texts;
}

std::vector<fs::path> scripts() {
  std::vector<fs::path> all;
  for (const char* folder : {"tests/golden", "stdlib", "examples", "bench/shaders"})
    for (const auto& e : fs::recursive_directory_iterator(mms::source_dir() / folder))
      if (e.path().extension() == ".mms") all.push_back(e.path());
  return all;
}

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("formatting keeps the tokens, comments and documentation of every script there is") {
  int formatted = 0;
  for (const fs::path& path : scripts()) {
    INFO(path.string());
    Diagnostics diagnostics;
    const SourcePtr before = make_source(path.string(), read(path));
    const auto once = mms::lang::format(before, diagnostics);
    CHECK(once.has_value() != diagnostics.has_errors());
    if (!once) continue;
    ++formatted;
    CHECK(contents(make_source("after", *once)) == contents(before));
    CHECK(format(*once) == *once);
  }
  CHECK(formatted > 150);
}

TEST_CASE("the examples and the library are laid out") {
  for (const fs::path& path : scripts()) {
    const std::string folder = path.parent_path().filename().string();
    if (folder != "examples" && folder != "stdlib") continue;
    INFO("mms fmt ", path.string());
    CHECK(format(read(path)) == read(path));
  }
}

TEST_CASE("a script with syntax errors is not formatted") {
  Diagnostics diagnostics;
  CHECK_FALSE(mms::lang::format(make_source("bad.mms", "surface s bsdf = ; end"), diagnostics));
  CHECK(diagnostics.has_errors());
}

TEST_CASE("spaces") {
  check_format("const a=-( 1+2 )*f( x ,[1 ,2;3, 4] )^ - 2 ;",
               "const a = -(1 + 2) * f(x, [1, 2; 3, 4])^-2;\n");
  check_format("real[ 3 ] f(real[ n ]v,function( real )->real g=#sin)=fold(# + ,0,v[ 0 ]. x) ;",
               "real[3] f(real[n] v, function(real) -> real g = #sin) = fold(#+, 0, v[0].x);\n");
  check_format("const b=not(a<b)and -1<x or#^(2,3)==n :: m ;",
               "const b = not (a < b) and -1 < x or #^(2, 3) == n::m;\n");
  check_format("const c=select -1,if x; -  2 otherwise end - 1;",
               "const c = select -1, if x; -2 otherwise end - 1;\n");
  check_format("param real s=4.0 in[0.1,20],label=\"S\";",
               "param real s = 4.0 in [0.1, 20], label = \"S\";\n");
  check_format("const d=$uv [ 0 ]-$uv.y - - 1;", "const d = $uv[0] - $uv.y - -1;\n");
}

TEST_CASE("a block with a line break has a line for each statement") {
  check_format("surface s bsdf=matte(1); end surface t bsdf=matte(1);\nend",
               "surface s bsdf = matte(1); end\n"
               "surface t\n    bsdf = matte(1);\nend\n");
  check_format(
      "real f(real x)\ny=x; real g(real z) u = z; return u; return g(y);",
      "real f(real x)\n    y = x;\n    real g(real z) u = z; return u;\n    return g(y);\n");
  check_format("real f(real x) = select\n1,if x<0;2 otherwise;end;",
               "real f(real x) = select\n    1, if x < 0;\n    2 otherwise;\nend;\n");
  check_format("r typeid struct real a;\nreal b; end\n;",
               "r typeid struct\n    real a;\n    real b;\nend;\n");
}

TEST_CASE("a statement goes on one step further in, and brackets do") {
  check_format(
      "real f(real x)\nreturn\nselect\n1,\nif x<0;2 otherwise;end;",
      "real f(real x)\n    return\n        select\n            1,\n                if x < 0;\n"
      "            2 otherwise;\n        end;\n");
  check_format("const m = [\n1, 2;\n3, 4\n];", "const m = [\n    1, 2;\n    3, 4\n];\n");
  check_format("const m = f(g(\n1), [\n2\n]);", "const m = f(g(\n    1), [\n        2\n    ]);\n");
}

TEST_CASE("assignments of a body stand in line") {
  check_format("surface s\na=1;\nlong_name=2;\n\nbb=3; // three\nspectrum c=4;\nend",
               "surface s\n    a         = 1;\n    long_name = 2;\n\n"
               "    bb         = 3;  // three\n    spectrum c = 4;\nend\n");
  check_format(
      "surface s\na=1;\nreal f(real x)=x;\nbb=2;\nconst real k=3;\nend",
      "surface s\n    a = 1;\n    real f(real x) = x;\n    bb = 2;\n    const real k = 3;\nend\n");
  check_format("surface s\na=select\n1,if x;2 otherwise end;\nbbb=2;\nend",
               "surface s\n    a = select\n        1, if x;\n        2 otherwise\n    end;\n"
               "    bbb = 2;\nend\n");
}

TEST_CASE("comments and blank lines") {
  check_format("\n\n// first\n\n\n\n// second  \nconst a=1;// one\nconst bb=2;   /* two */\n\n\n",
               "// first\n\n// second\nconst a = 1;  // one\nconst bb = 2; /* two */\n");
  check_format("surface s\n\n// inside\na=1;\n\n// at the end\n\nend\n//after",
               "surface s\n    // inside\n    a = 1;\n\n    // at the end\nend\n//after\n");
  check_format("/// Doc.\nreal f(/* in */real x)=x+ // why\n1;",
               "/// Doc.\nreal f(/* in */ real x) = x +  // why\n    1;\n");
  check_format("/* a\n  b */ const a=1;", "/* a\n  b */ const a = 1;\n");
  check_format("// only a comment", "// only a comment\n");
}

TEST_CASE("lines of at most 100 columns") {
  const std::string wide(40, 'w');
  check_format("const a = f(" + wide + ", " + wide + ", " + wide + ");",
               "const a = f(" + wide + ", " + wide + ",\n    " + wide + ");\n");
  const std::string fits = "real f() = g(" + wide + ", " + wide + ", 1);";
  REQUIRE(fits.size() == 100);
  check_format(fits, fits + "\n");
  check_format("real f(real x) = g(" + wide + ", " + wide + ", x + 1);",
               "real f(real x) =\n    g(" + wide + ", " + wide + ", x + 1);\n");
  check_format(
      "const a = select " + wide + ", if " + wide + "; " + wide + " otherwise end;",
      "const a = select\n    " + wide + ", if " + wide + ";\n    " + wide + " otherwise\nend;\n");
  check_format("surface s bsdf = matte(" + wide + "); height = " + wide + "; end",
               "surface s\n    bsdf   = matte(" + wide + ");\n    height = " + wide + ";\nend\n");
  check_format("const a = " + wide + wide + wide + "; // " + wide,
               "const a =\n    " + wide + wide + wide + ";  // " + wide + "\n");
}

TEST_CASE("a large array does not take long, or lines that are too wide") {
  std::string text = "const a = [0";
  for (int i = 1; i < 4000; ++i) text += ", " + std::to_string(i);
  const std::string out = format(text + "];");
  std::size_t widest = 0, begin = 0;
  for (std::size_t end; (end = out.find('\n', begin)) != out.npos; begin = end + 1)
    widest = std::max(widest, end - begin);
  CHECK(widest <= 100);
  CHECK(widest > 90);
  CHECK(format(out) == out);
}
