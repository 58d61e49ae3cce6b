// SPDX-License-Identifier: Apache-2.0
#include "lang/diagnostics.h"

#include <doctest/doctest.h>

#include <set>
#include <string>

using namespace mms::lang;

namespace {

Span at(const SourcePtr& s, std::string_view what) {
  const auto begin = static_cast<std::uint32_t>(s->text.find(what));
  return {s.get(), begin, begin + static_cast<std::uint32_t>(what.size())};
}

}  // namespace

TEST_CASE("codes and names are unique, codes are well formed") {
  std::set<std::string_view> codes, names;
  for (const DiagInfo& row : all_diagnostics()) {
    CAPTURE(row.code);
    CHECK(codes.insert(row.code).second);
    CHECK(names.insert(row.name).second);
    CHECK(row.code.size() == 5);
    CHECK(row.code[0] == (row.severity == Severity::Error ? 'E' : 'W'));
    CHECK_FALSE(row.text.empty());
    CHECK_FALSE(row.explain.empty());
  }
  CHECK(info(Diag::MissingEnd).code == "E0122");
}

TEST_CASE("each message is kept once for each place") {
  const SourcePtr s = make_source("t", "abc");
  Diagnostics d;
  d.add(Diag::StrayEnd, at(s, "a"));
  d.add(Diag::StrayEnd, at(s, "a")).help("dropped");
  d.add(Diag::StrayEnd, at(s, "b"));
  d.add(Diag::StrayReturn, at(s, "a"));
  CHECK(d.all().size() == 3);
  CHECK(d.error_count() == 3);
  CHECK(d.all()[0].helps.empty());
}

TEST_CASE("after the largest number of errors comes one more") {
  const SourcePtr s = make_source("t", std::string(1000, ' '));
  Diagnostics d;
  for (std::uint32_t i = 0; i < 1000; ++i) d.add(Diag::StrayEnd, Span{s.get(), i, i + 1});
  REQUIRE(d.all().size() == kMaxErrors + 1);
  CHECK(d.all().back().id == Diag::TooManyErrors);
  CHECK(d.error_count() == kMaxErrors + 1);
  CHECK(d.warning_count() == 0);
}

TEST_CASE("a message with a place, a label, notes and help") {
  const SourcePtr s = make_source("marble.mms", "\n\n\nreal p = 1;\n\n\n  bsdf = noise(p);\n");
  const SourcePtr other = make_source("lib.mms", "real noise(real[3] p)\n");
  Diagnostics d;
  d.add(Diag::StrayEnd, at(s, "noise(p)"))
      .labelled("this is `real`")
      .note(at(s, "real p"), "declared here")
      .note(at(other, "noise"), "the candidate")
      .note({}, "no place")
      .help("try this");
  CHECK(render(d.all()[0]) ==
        "error[E0123]: this `end` ends nothing\n"
        "  --> marble.mms:7:10\n"
        "   |\n"
        " 4 | real p = 1;\n"
        "   | ------ declared here\n"
        " 7 |   bsdf = noise(p);\n"
        "   |          ^^^^^^^^ this is `real`\n"
        "  ::: lib.mms:1:6\n"
        "   |\n"
        " 1 | real noise(real[3] p)\n"
        "   |      ----- the candidate\n"
        "   = note: no place\n"
        "   = help: try this\n");
}

TEST_CASE("carets stand right after tabs, UTF-8 and wide characters") {
  const auto excerpt = [](std::string text, std::string_view what) {
    const SourcePtr s = make_source("t", std::move(text));
    Diagnostics d;
    d.add(Diag::StrayEnd, at(s, what));
    const std::string all = render(d.all()[0]);
    return all.substr(all.find("   |\n") + 5);
  };
  CHECK(excerpt("\tx", "x") == " 1 |     x\n   |     ^\n");
  CHECK(excerpt("ab\tx = y;", "x = y") == " 1 | ab  x = y;\n   |     ^^^^^\n");
  CHECK(excerpt("a\tb\tc", "\tb") == " 1 | a   b   c\n   |  ^^^^\n");
  CHECK(excerpt("\xC3\xA9\xE2\x82\xAC x", "x") == " 1 | \xC3\xA9\xE2\x82\xAC x\n   |    ^\n");
  CHECK(excerpt("\xE6\xBC\xA2\xE5\xAD\x97 x", "x") ==
        " 1 | \xE6\xBC\xA2\xE5\xAD\x97 x\n   |      ^\n");               // two columns each
  CHECK(excerpt("e\xCC\x81 x", "x") == " 1 | e\xCC\x81 x\n   |   ^\n");  // combining accent
  CHECK(excerpt("a\xFF\x1B"
                "b",
                "b") ==
        " 1 | a\xEF\xBF\xBD\xEF\xBF\xBD"
        "b\n   |    ^\n");
  CHECK(excerpt("ab\r\ncd", "b\r\nc") == " 1 | ab\n   |  ^\n");  // to the end of its line
}

TEST_CASE("a place at the end, an empty line, no place, a byte outside") {
  const SourcePtr s = make_source("t", "ab\n\n");
  Diagnostics d;
  d.add(Diag::StrayEnd, Span{s.get(), 2, 2});
  d.add(Diag::StrayEnd, Span{s.get(), 3, 3});
  d.add(Diag::StrayEnd, Span{s.get(), 4, 4});
  d.add(Diag::StrayEnd, Span{}).help("h");
  CHECK(render(d.all()[0]) ==
        "error[E0123]: this `end` ends nothing\n  --> t:1:3\n   |\n 1 | ab\n   |   ^\n");
  CHECK(render(d.all()[1]) ==
        "error[E0123]: this `end` ends nothing\n  --> t:2:1\n   |\n 2 |\n   | ^\n");
  CHECK(render(d.all()[2]) ==
        "error[E0123]: this `end` ends nothing\n  --> t:3:1\n   |\n 3 |\n   | ^\n");
  CHECK(render(d.all()[3]) == "error[E0123]: this `end` ends nothing\n   = help: h\n");
}

TEST_CASE("of what has no place each sentence is said once") {
  Diagnostics d;
  for (const char* name : {"a", "b", "a"}) d.add(Diag::UnknownParam, Span{}, name);
  REQUIRE(d.all().size() == 2);
  CHECK(d.all()[0].text != d.all()[1].text);
}

TEST_CASE("long lines are cut round the carets") {
  for (const std::size_t before : {0, 50, 99, 150, 399, 5000, 1000000}) {
    CAPTURE(before);
    const SourcePtr s =
        make_source("t", std::string(before, 'a') + "XYZ" + std::string(1000000, 'b'));
    Diagnostics d;
    d.add(Diag::StrayEnd, at(s, "XYZ"));
    const std::string out = render(d.all()[0]);
    CHECK(out.size() < 400);
    // The carets stand under what they mark.
    const std::size_t text = out.find(" 1 | "), carets = out.find("   | ", text);
    REQUIRE(text != std::string::npos);
    REQUIRE(carets != std::string::npos);
    CHECK(out.find("XYZ") - text == out.find("^^^") - carets);
    CHECK(out.find("^^^^") == std::string::npos);
  }
}

TEST_CASE("colour only adds escapes") {
  const SourcePtr s = make_source("t", "abc");
  Diagnostics d;
  d.add(Diag::StrayEnd, at(s, "b")).labelled("l").note(at(s, "a"), "n").help("h");
  const std::string plain = render(d.all()[0]), colour = render(d.all()[0], true);
  CHECK(colour.find("\x1b[1;31m") != std::string::npos);
  std::string stripped;
  for (std::size_t i = 0; i < colour.size(); ++i) {
    if (colour[i] == '\x1b')
      i = colour.find('m', i);
    else
      stripped += colour[i];
  }
  CHECK(stripped == plain);
}

TEST_CASE("JSON") {
  const SourcePtr s = make_source("a\"b.mms", "ab\ncd\xC3\xA9");
  Diagnostics d;
  d.add(Diag::StrayEnd, at(s, "b\nc"))
      .labelled("tab\there")
      .note(at(s, "d"), "x\\y")
      .help("h1")
      .help(std::string("\xFF\x01", 2));
  CHECK(render_json(d.all()[0]) ==
        "{\"code\":\"E0123\",\"name\":\"StrayEnd\",\"severity\":\"error\",\"warning\":\"\","
        "\"message\":\"this `end` ends nothing\",\"file\":\"a\\\"b.mms\",\"line\":1,\"column\":2,"
        "\"end_line\":2,\"end_column\":2,\"label\":\"tab\\there\",\"notes\":[{\"file\":\"a\\\"b."
        "mms\","
        "\"line\":2,\"column\":2,\"end_line\":2,\"end_column\":3,\"text\":\"x\\\\y\"}],"
        "\"helps\":[\"h1\",\"\xEF\xBF\xBD\\u0001\"]}");
}

TEST_CASE("the members of the JSON objects are those that are documented") {
  const SourcePtr s = make_source("t", "abc");
  Diagnostics d;
  d.add(Diag::StrayEnd, at(s, "b")).note(at(s, "a"), "n");
  // Of a text without quotes inside, what stands before a colon is a member.
  const auto members = [](std::string_view text) {
    std::vector<std::string> all;
    for (std::size_t colon = text.find("\":"); colon != text.npos;
         colon = text.find("\":", colon + 1)) {
      const std::size_t begin = text.rfind('"', colon - 1) + 1;
      all.emplace_back(text.substr(begin, colon - begin));
    }
    return all;
  };
  std::vector<std::string> documented;
  for (const JsonMember& m : json_members()) {
    CHECK_FALSE(m.doc.empty());
    documented.emplace_back(m.name);
    if (m.name != "notes") continue;
    for (const JsonMember& n : json_note_members()) documented.emplace_back(n.name);
  }
  CHECK(members(render_json(d.all()[0])) == documented);
}

namespace {

/// What becomes of one warning of each of three kinds, and of an error: `-` silent, `w`, `e`.
std::string outcome(const std::vector<std::string>& words) {
  const auto policy = WarningPolicy::of(words);
  REQUIRE(policy);
  std::string text;
  for (const Diag id :
       {Diag::Unused, Diag::ViewDependent, Diag::NonConserving, Diag::UnexpectedToken}) {
    const SourcePtr s = make_source("t", "abc");
    Diagnostics d(*policy);
    d.add(id, at(s, "a"), "x", "y").help("kept or dropped");
    text += d.all().empty() ? '-' : d.all()[0].severity == Severity::Error ? 'e' : 'w';
    CHECK(d.has_errors() == (text.back() == 'e'));
  }
  return text;
}

}  // namespace

TEST_CASE("warnings are silenced, or made errors, by name") {
  CHECK(outcome({}) == "wwwe");
  CHECK(outcome({"error"}) == "eeee");
  CHECK(outcome({"error", "no-error"}) == "wwwe");
  CHECK(outcome({"no-unused"}) == "-wwe");
  CHECK(outcome({"no-unused", "unused"}) == "wwwe");
  CHECK(outcome({"error=view-dependent"}) == "wewe");
  CHECK(outcome({"error", "no-view-dependent"}) == "e-ee");
  CHECK(outcome({"error", "no-error=non-conserving"}) == "eewe");
  CHECK(outcome({"no-error=unused", "error=unused"}) == "ewwe");
  const auto unknown = WarningPolicy::of(std::vector<std::string>{"no-unusd"});
  REQUIRE(!unknown);
  CHECK(unknown.error().where == "-Wno-unusd");
  CHECK(unknown.error().what == "no warning is called `unusd`");
  CHECK(unknown.error().hint == "did you mean `unused`?");
  for (const std::string word : {"", "all", "error=", "no-", "error=unusedx1", "no-error=all"})
    CHECK(!WarningPolicy::of(std::vector<std::string>{word}));
}

TEST_CASE("every warning has a name of its own, and no error has") {
  std::set<std::string_view> flags;
  for (const DiagInfo& row : all_diagnostics()) {
    CAPTURE(row.code);
    CHECK(row.flag.empty() == (row.severity == Severity::Error));
    if (row.flag.empty()) continue;
    CHECK(flags.insert(row.flag).second);
    CHECK(row.flag.find_first_not_of("abcdefghijklmnopqrstuvwxyz-") == row.flag.npos);
    CHECK_FALSE(row.flag.starts_with("no-"));
    CHECK_FALSE(row.flag.starts_with("error"));
  }
}

TEST_CASE("a message inside a call tells the innermost calls and the outermost") {
  const SourcePtr s = make_source("t", "abcdefghij");
  const auto notes = [&](std::size_t calls) {
    Diagnostics d;
    for (std::uint32_t k = 0; k < calls; ++k) d.enter_call({s.get(), k + 1, k + 2}, "f");
    d.add(Diag::StrayEnd, at(s, "a"));
    std::string text;
    for (const Note& n : d.all()[0].notes) text += n.span ? s->text[n.span.begin] : '+';
    return text;
  };
  CHECK(notes(0) == "");
  CHECK(notes(1) == "b");
  CHECK(notes(4) == "edcb");
  CHECK(notes(5) == "fedb+");
  CHECK(notes(9) == "jihb+");
}

TEST_CASE("the nearest word") {
  const std::vector<std::string> words = {"height", "gradient", "bsdf", "scattering", "x"};
  CHECK(nearest("heigth", words) == "height");  // neighbours swapped
  CHECK(nearest("heght", words) == "height");   // left out
  CHECK(nearest("scatering", words) == "scattering");
  CHECK(nearest("bsdg", words) == "bsdf");  // one replaced
  CHECK(nearest("grid", words) == "");
  CHECK(nearest("y", words) == "");  // too short to be near
  CHECK(nearest("", words) == "");
  CHECK(nearest(std::string(1 << 20, 'a'), words) == "");
  CHECK(nearest("bsdx", {"bsda", "bsdb"}) == "bsda");  // the first of equals
}
