// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "lang/lexer.h"
#include "lang/parser.h"
#include "tests/fuzz/targets.h"

namespace mms::fuzz {

namespace {

void render_all(const lang::Diagnostics& diagnostics) {
  for (const bool colour : {false, true}) lang::render(diagnostics, colour);
  for (const lang::Diagnostic& d : diagnostics.all()) lang::render_json(d);
}

/// Tokens follow one another within the text. Only the one that stands for the rest of an open
/// comment is empty.
void read_tokens(const lang::Source& source) {
  lang::Diagnostics diagnostics;
  lang::Lexer lexer(source, diagnostics);
  std::uint32_t end = 0;
  for (lang::Token t = lexer.next(); t.tok != lang::Tok::Eof; t = lexer.next()) {
    const bool empty = t.begin == t.end && t.tok != lang::Tok::Error;
    if (t.begin < end || t.end < t.begin || empty || t.end > source.text.size()) __builtin_trap();
    end = t.end;
  }
}

}  // namespace

void parse(Bytes input) {
  const lang::SourcePtr source =
      lang::make_source("fuzz.mms", std::string(input.begin(), input.end()));
  read_tokens(*source);
  lang::Graph (*const kEntries[])(lang::SourcePtr, lang::Diagnostics&) = {
      lang::parse, lang::parse_signature, lang::parse_expression};
  for (const auto entry : kEntries) {
    lang::Diagnostics diagnostics;
    entry(source, diagnostics);
    render_all(diagnostics);
  }
}

}  // namespace mms::fuzz
