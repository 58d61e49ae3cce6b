// SPDX-License-Identifier: Apache-2.0
// mms explain: the pages of the error index about messages.
#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tools/commands.h"
#include "tools/script.h"

namespace mms::tools {

namespace {

/// Whether `what` is meant as a script and not as a code.
bool is_script(const std::string& what) {
  return what == "-" || what.find_first_of("./") != std::string::npos;
}

/// Whether the title of a message, `MissingSemicolon`, or its text has a word.
bool speaks_of(const lang::DiagInfo& row, const std::string& word) {
  const auto same = [](unsigned char a, unsigned char b) {
    return std::tolower(a) == std::tolower(b);
  };
  return std::ranges::any_of(std::array{row.name, row.text}, [&](std::string_view text) {
    return std::search(text.begin(), text.end(), word.begin(), word.end(), same) != text.end();
  });
}

Exit explain_code(const std::string& code, const ScriptOptions& options) {
  std::string upper = code;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::vector<std::string> codes, same_word;
  for (const lang::DiagInfo& row : lang::all_diagnostics()) {
    if (row.code == upper || row.name == code || (!row.flag.empty() && row.flag == code)) {
      fmt::print("{}", lang::page(row));
      return Exit::Ok;
    }
    for (const std::string_view name : {row.code, row.name, row.flag})
      if (!name.empty()) codes.emplace_back(name);
    if (speaks_of(row, code)) same_word.emplace_back(row.code);
  }
  std::string near = lang::nearest(code, codes);
  if (near.empty()) near = lang::nearest(upper, codes);
  return fail(
      Exit::Usage,
      {"mms explain", fmt::format("no message has the code `{}`", code),
       !near.empty()        ? fmt::format("did you mean `{}`? docs/errors.md lists all", near)
       : !same_word.empty() ? fmt::format("these speak of it: {}", fmt::join(same_word, ", "))
                            : "codes look like E0203; docs/errors.md lists them"},
      options);
}

/// The page of each message that there is to say of a script, once each.
Exit explain_script(const std::string& file, const ScriptOptions& options) {
  Exit exit = Exit::Ok;
  const auto sources = read_sources({file}, options, exit);
  if (!sources) return exit;
  lang::Diagnostics diagnostics;
  compile(*sources, options, diagnostics, exit);
  print(diagnostics, options);
  std::set<lang::Diag> explained;
  for (const lang::Diagnostic& d : diagnostics.all())
    if (explained.insert(d.id).second) fmt::print("{}", lang::page(lang::info(d.id)));
  return exit;
}

Exit explain(const ScriptOptions& options) {
  Exit worst = Exit::Ok;
  for (const std::string& what : options.files)
    worst = std::max(worst,
                     is_script(what) ? explain_script(what, options) : explain_code(what, options));
  return worst;
}

}  // namespace

Verb explain_verb() {
  auto options = std::make_shared<ScriptOptions>();
  Verb verb{"explain",
            "Explain messages: by their codes, or those of scripts",
            "Examples:\n  mms explain E0203\n  mms explain marble.mms",
            {},
            [options] { return explain(*options); }};
  verb.add(
      {"CODE",
       &options->files,
       "",
       "The code in brackets, as in error[E0203]; or a script, whose messages are explained; - "
       "is standard input",
       {},
       true});
  add_script_options(verb, *options);
  return verb;
}

}  // namespace mms::tools
