// SPDX-License-Identifier: Apache-2.0
// mms fmt: scripts laid out in the one way there is.
#include <cstdio>
#include <memory>

#include <fmt/format.h>

#include "api/library.h"
#include "base/file.h"
#include "lang/format.h"
#include "tools/commands.h"
#include "tools/script.h"
#include "tools/stored.h"

namespace mms::tools {

namespace {

struct FormatOptions : ScriptOptions {
  bool check = false;
};

Exit format_one(const std::string& file, const FormatOptions& options) {
  const Result<lang::SourcePtr> source = read_script(file);
  if (!source) return fail(Exit::File, source.error(), options);
  if (any_stored({*source}))
    return fail(Exit::File,
                {(*source)->name, "is a compiled program, which has no layout",
                 "lay out the scripts that it was made from"},
                options);
  lang::Diagnostics diagnostics;
  const auto text = lang::format(*source, diagnostics);
  print(diagnostics, options);
  if (!text) return Exit::Script;
  if (options.check) {
    if (*text == (*source)->text) return Exit::Ok;
    return fail(Exit::Script,
                {(*source)->name, "is not laid out", fmt::format("`mms fmt {}` does it", file)},
                options);
  }
  if (file == "-") {
    fmt::print("{}", *text);
    return Exit::Ok;
  }
  if (*text == (*source)->text) return Exit::Ok;
  if (const auto error = replace_file(file, *text)) return fail(Exit::File, *error, options);
  return Exit::Ok;
}

Exit format_all(const FormatOptions& options) {
  Exit worst = Exit::Ok;
  for (const std::string& file : options.files) worst = std::max(worst, format_one(file, options));
  return worst;
}

}  // namespace

Verb fmt_verb() {
  auto options = std::make_shared<FormatOptions>();
  Verb verb{
      "fmt",
      "Lay scripts out: indentation, spaces, lines of 100 columns; nothing to choose",
      "A script with syntax errors is left alone. Tokens and comments are never changed. The\n"
      "options of linking are taken as by every verb that reads scripts; the layout does not\n"
      "depend on them.\n\n"
      "Examples:\n  mms fmt marble.mms\n  mms fmt --check *.mms\n  mms fmt - < marble.mms",
      {},
      [options] { return format_all(*options); }};
  add_files(verb, *options, "Scripts, each written anew in its place");
  verb.add({"--check", &options->check, "", "Change nothing; fail if a script is not laid out"});
  add_script_options(verb, *options);
  return verb;
}

}  // namespace mms::tools
