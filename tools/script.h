// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the verbs share: options about scripts, from files to a linked program, and messages.

#include <memory>
#include <optional>
#include <set>
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
  std::vector<std::string> import_path;
  std::vector<std::string> settings;  ///< of `--set`, as written: `name=value`
  std::vector<std::string> warnings;  ///< words after -W
  std::string dump_after;             ///< a pass of lang::passes(), for Linked::dump
  std::string level = "2", colour = "auto", format = "text";
  std::string missing = "error";  ///< images that cannot be read: `error` or `magenta`
  std::string image_memory;       ///< megabytes of `--image-memory`; empty: the default
  lang::LookedFor looked_for;     ///< is told of every file that the scripts look for
  /// What messages were about, if each is to be said once in all compilations; null: in each.
  std::shared_ptr<std::set<std::string>> said;
  bool at_points = false;  ///< the verb evaluates points, so `--set` may set `$variables`

  bool json() const { return format == "json"; }
};

/// `FILE...`, required; `doc` says what the files are to the verb.
void add_files(Verb& verb, ScriptOptions& options, const std::string& doc);
/// Adds everything but `files` and `format`. `options` outlives the verb.
void add_script_options(Verb& verb, ScriptOptions& options);
void add_format_option(Verb& verb, ScriptOptions& options);
void add_colour_option(Verb& verb, ScriptOptions& options);

/// Whether messages get ANSI colours.
bool colours(const ScriptOptions& options);

/// "1 sample", "2 samples".
std::string counted(std::uint64_t count, std::string_view noun);

/// `error: where: what`, and `  = help: hint`, to standard error.
void print_error(const Error& error, bool colour = false);
Exit fail(Exit code, const Error& error, const ScriptOptions& options);

/// Whether nothing about `subject` was said yet; from now on it was.
bool is_news(const std::string& subject, const ScriptOptions& options);

/// Every message that is news: to standard error, or as JSON lines to standard output where asked.
void print(const lang::Diagnostics& diagnostics, const ScriptOptions& options);

/// One `--set name=value` that no param of the scripts took: `$name` is to have that value.
struct VariableSetting {
  vm::Variable variable;
  std::string value;  ///< an expression
};

struct Compiled : lang::Linked {
  std::vector<VariableSetting> variables;  ///< empty unless `at_points`
};

/// Parses and links `sources` into one program; prints every diagnostic. Empty on errors, on
/// warnings under -Werror, and where `--set` names nothing that can be set.
std::optional<Compiled> compile(const std::vector<lang::SourcePtr>& sources,
                                const ScriptOptions& options, Exit& exit);

/// The same without printing: what there is to say of the sources is left in `diagnostics`.
std::optional<Compiled> compile(const std::vector<lang::SourcePtr>& sources,
                                const ScriptOptions& options, lang::Diagnostics& diagnostics,
                                Exit& exit);

/// The same from files; `-` is standard input.
std::optional<Compiled> compile_files(const std::vector<std::string>& files,
                                      const ScriptOptions& options, Exit& exit);

/// The text of a script, or a compiled program, from `file`; `-` is standard input. What is
/// neither, such as a picture, is an error rather than a hundred of its bytes.
Result<lang::SourcePtr> read_script(const std::string& file);

/// The texts of `files`; empty where one cannot be read, which has then been said.
std::optional<std::vector<lang::SourcePtr>> read_sources(const std::vector<std::string>& files,
                                                         const ScriptOptions& options, Exit& exit);

}  // namespace mms::tools
