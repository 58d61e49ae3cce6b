// SPDX-License-Identifier: Apache-2.0
#include "lang/lexer.h"

#include <doctest/doctest.h>

#include <set>
#include <string>
#include <vector>

#include "syntax.h"

using namespace mms::lang;
using test::reported;

namespace {

std::vector<Tok> lex(const std::string& text, Diagnostics& d) {
  const SourcePtr source = make_source("test.mms", text);
  Lexer lexer(*source, d);
  std::vector<Tok> out;
  for (Token t = lexer.next(); t.tok != Tok::Eof; t = lexer.next()) out.push_back(t.tok);
  return out;
}
std::vector<Tok> lex(const std::string& text) {
  Diagnostics d;
  const std::vector<Tok> out = lex(text, d);
  CHECK_FALSE(d.has_errors());
  return out;
}
std::string lex_errors(const std::string& text) {
  const SourcePtr source = make_source("test.mms", text);
  Diagnostics d;
  Lexer lexer(*source, d);
  while (lexer.next().tok != Tok::Eof) {
  }
  return reported(d);
}

}  // namespace

TEST_CASE("every symbol and keyword is one token, also without spaces around it") {
  std::set<std::string_view> seen;
  for (int i = static_cast<int>(Tok::StringLiteral) + 1; i <= static_cast<int>(Tok::KwVolume);
       ++i) {
    const Tok tok = static_cast<Tok>(i);
    const std::string text(spelling(tok));
    CAPTURE(text);
    REQUIRE_FALSE(text.empty());
    CHECK(seen.insert(spelling(tok)).second);
    CHECK(lex(text) == std::vector<Tok>{tok});
    CHECK(is_keyword(tok) == (std::isalpha(text[0]) != 0));
    if (is_keyword(tok)) CHECK(lex(text + "_") == std::vector<Tok>{Tok::Identifier});
  }
}

TEST_CASE("units are SI and correctly rounded") {
  // The right-hand sides are decimal literals: the compiler rounds them once.
  CHECK(real_value("550nm") == 550e-9);
  CHECK(real_value("380nm") == 380e-9);
  CHECK(real_value("0.3um") == 0.3e-6);
  CHECK(real_value("7um") == 7e-6);
  CHECK(real_value("3mm") == 3e-3);
  CHECK(real_value("25cm") == 0.25);
  CHECK(real_value("2m") == 2.0);
  CHECK(real_value("1.5km") == 1500.0);
  CHECK(real_value("180deg") == doctest::Approx(3.14159265358979323846).epsilon(1e-15));
  CHECK(real_value("1.25rad") == 1.25);
  CHECK(real_value("6500K") == 6500.0);
  CHECK(real_value("2.5e-3m") == 2.5e-3);
  CHECK(real_value("1e300km") == 1e303);
  CHECK(real_value("1e-999") == 0.0);
  CHECK(real_value("1e999") > 1e308);
}

TEST_CASE("numbers") {
  CHECK(lex("1 2.5 1e5 1.5E-3 2i 0.5i 550nm 3m 90deg") ==
        std::vector<Tok>{Tok::IntegerLiteral, Tok::RealLiteral, Tok::RealLiteral, Tok::RealLiteral,
                         Tok::ImaginaryLiteral, Tok::ImaginaryLiteral, Tok::RealLiteral,
                         Tok::RealLiteral, Tok::RealLiteral});
  CHECK(integer_value("2147483648") == 2147483648);
  CHECK(integer_value("9223372036854775807") == INT64_MAX);
  CHECK(integer_value("9223372036854775808") == -1);
}

TEST_CASE("what is no number") {
  CHECK(lex_errors("0x1F") == "E0112@1:1-5");
  CHECK(lex_errors("x = .5") == "E0109@1:5-7");
  CHECK(lex_errors("x = 5. ;") == "E0109@1:5-7");
  CHECK(lex_errors("1.2.3") == "E0109@1:1-6");
  CHECK(lex_errors("1e+") == "E0110@1:1-4");
  CHECK(lex_errors("2x") == "E0111@1:2-3");
  CHECK(lex_errors("2.5foo") == "E0111@1:4-7");
  CHECK(lex_errors("1_000") == "E0111@1:2-6");
}

TEST_CASE("strings and their escapes") {
  CHECK(string_value(R"("a\"b\\c\nd\te")") == "a\"b\\c\nd\te");
  CHECK(lex(R"("a\"b" "" "\\")").size() == 3);
  CHECK(lex_errors(R"("a\qb")") == "E0107@1:3-5");
  CHECK(lex_errors("x = \"abc\ny") == "E0105@1:5-6");
  CHECK(lex_errors("x = \"abc\\\ny") == "E0105@1:5-6");
  CHECK(lex_errors("'abc'") == "E0108@1:1-6");
  CHECK(lex_errors("\"") == "E0105@1:1-2");
}

TEST_CASE("comments") {
  CHECK(lex("a // b\n/* c \n * d */ e /**/ f").size() == 3);
  CHECK(lex_errors("a /* b") == "E0106@1:3-5");
  CHECK(lex_errors("a /*/") == "E0106@1:3-5");
  CHECK(doc_text("///  two") == " two");
  CHECK(doc_text("///") == "");

  const SourcePtr source = make_source("t", "/// d\r\na // l\n//// n\nb /* c */");
  Diagnostics d;
  Lexer lexer(*source, d);
  while (lexer.next().tok != Tok::Eof) {
  }
  const auto& c = lexer.comments();
  REQUIRE(c.size() == 4);
  CHECK(c[0].form == Comment::Form::Doc);
  CHECK(c[0].before == 0);
  CHECK(source->text.substr(c[0].begin, c[0].end - c[0].begin) == "/// d");
  CHECK(c[1].form == Comment::Form::Line);
  CHECK(c[2].form == Comment::Form::Line);
  CHECK(c[2].before == 1);
  CHECK(c[3].form == Comment::Form::Block);
  CHECK(c[3].before == 2);
}

TEST_CASE("bytes that are no text are reported once for each run, at their place") {
  CHECK(lex_errors("a @@@ b ~ c") == "E0102@1:3-6 E0102@1:9-10");
  CHECK(lex_errors(std::string("a \0\0 b", 6)) == "E0104@1:3-5");
  CHECK(lex_errors("a \xFF\xFE b") == "E0103@1:3-5");
  CHECK(lex_errors("// \xC3( \xC3\xA9\n\"\xED\xA0\x80\"") == "E0103@1:4-5 E0103@2:2-5");
  CHECK(lex_errors("\"\xC3\xA9\xE2\x82\xAC\xF0\x9F\x8E\xA8\" // \xC3\xA9") == "");
  CHECK(lex_errors("gr\xC3\xB6\xC3\x9F"
                   "e = 1") == "E0102@1:3-4");
  CHECK(lex_errors("\xEF\xBB\xBF"
                   "a") == "");  // byte-order mark
  CHECK(lex_errors("$ x") == "E0115@1:1-2");
}

TEST_CASE("columns count characters") {
  const SourcePtr s = make_source("t", "ab\n\xC3\xA9\xE2\x82\xAC\tx\r\n\nlast");
  CHECK(position_at(*s, 0).line == 1);
  CHECK(position_at(*s, 2).column == 3);
  CHECK(position_at(*s, 3).line == 2);
  CHECK(position_at(*s, 9).column == 4);  // x: after two characters and a tab
  CHECK(position_at(*s, 999).line == 4);
  CHECK(position_at(*s, 999).column == 5);
  CHECK(line_text(*s, 2) == "\xC3\xA9\xE2\x82\xAC\tx");
  CHECK(line_text(*s, 3) == "");
  CHECK(line_text(*s, 4) == "last");
  CHECK(line_text(*s, 5) == "");
}
