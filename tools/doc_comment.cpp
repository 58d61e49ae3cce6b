// SPDX-License-Identifier: Apache-2.0
#include "tools/doc_comment.h"

#include "lang/lexer.h"

namespace mms::tools {

namespace {

constexpr std::string_view kPrompt = ">>>";

std::string_view trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

std::vector<Example> examples_of(const lang::Source& source) {
  lang::Diagnostics ignored;
  lang::Lexer lexer(source, ignored);
  while (lexer.next().tok != lang::Tok::Eof) {
  }
  std::vector<Example> all;
  bool open = false;  // the last example goes on
  std::uint32_t last_line = 0;
  for (const lang::Comment& c : lexer.comments()) {
    const std::uint32_t line = lang::position_at(source, c.begin).line;
    const std::string_view text = source.text.substr(c.begin, c.end - c.begin);
    const std::string_view doc =
        c.form == lang::Comment::Form::Doc ? trim(lang::doc_text(text)) : std::string_view();
    open = open && line == last_line + 1 && !doc.empty();
    last_line = line;
    if (doc.starts_with(kPrompt)) {
      all.push_back({line, std::string(trim(doc.substr(kPrompt.size()))), {}});
      open = true;
    } else if (open) {
      std::string& expected = all.back().expected;
      expected += expected.empty() ? "" : " ";
      expected += doc;
    }
  }
  return all;
}

std::string doc_markdown(std::string_view doc) {
  std::string out;
  bool open = false;
  while (!doc.empty()) {
    const std::size_t end = std::min(doc.find('\n'), doc.size());
    const std::string_view line = trim(doc.substr(0, end));
    doc.remove_prefix(std::min(end + 1, doc.size()));
    if (!open && line.starts_with(kPrompt)) {
      out += out.empty() || out.ends_with("\n\n") ? "```\n" : "\n```\n";
      open = true;
    }
    if (open && line.empty()) {
      out += "```\n";
      open = false;
    }
    out += line;
    out += '\n';
  }
  if (open) out += "```\n";
  return out;
}

}  // namespace mms::tools
