// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the verbs share: options about scripts, from files to a linked program, and messages.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "lang/link.h"
#include "tools/verb.h"

namespace mms::tools {

/// Options that every verb over scripts takes.
struct ScriptOptions {
  std::vector<std::string> files;
  std::vector<std::string> import_path, params;  ///< params as written: `name=value`
  std::vector<std::string> warnings;             ///< words after -W
  std::string level = "2", colour = "auto", format = "text";

  bool json() const { return format == "json"; }
};

/// `FILE...`, required; `doc` says what the files are to the verb.
void add_files(Verb& verb, ScriptOptions& options, const std::string& doc);
/// Adds everything but `files` and `format`. `options` outlives the verb.
void add_script_options(Verb& verb, ScriptOptions& options);
void add_format_option(Verb& verb, ScriptOptions& options);

/// Whether messages get ANSI colours.
bool colours(const ScriptOptions& options);

/// `error: where: what`, and `  = help: hint`, to standard error.
void print_error(const Error& error, bool colour = false);
Exit fail(Exit code, const Error& error, const ScriptOptions& options);

/// `name=value` taken apart, or an error that names the option.
Result<std::pair<std::string, std::string>> split_setting(const std::string& option,
                                                          const std::string& text);

/// Parses and links `sources` into one program; prints every diagnostic (as JSON lines where
/// asked). Empty on errors, or on warnings under -Werror.
std::optional<lang::Linked> compile(const std::vector<lang::SourcePtr>& sources,
                                    const ScriptOptions& options, Exit& exit);

/// The same from files; `-` is standard input.
std::optional<lang::Linked> compile_files(const std::vector<std::string>& files,
                                          const ScriptOptions& options, Exit& exit);

}  // namespace mms::tools
