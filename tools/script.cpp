// SPDX-License-Identifier: Apache-2.0
#include "tools/script.h"

#include <unistd.h>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>

#include "api/library.h"
#include "lang/parser.h"

namespace mms::tools {

void add_files(Verb& verb, ScriptOptions& o, const std::string& doc) {
  verb.add({"FILE", &o.files, "", doc + "; - is standard input", {}, true});
}

void add_script_options(Verb& verb, ScriptOptions& o) {
  verb.add({"-I", &o.import_path, "DIR", "Folder to look for imports in, after the script's own"});
  verb.add({"-O",
            &o.level,
            "LEVEL",
            "Optimisation level: -O0, -O1 or -O2; the values never differ",
            {"0", "1", "2"}});
  verb.add({"--param", &o.params, "NAME=VALUE", "Value of a `param` of the script"});
  verb.add({"-W", &o.warnings, "WORD",
            "-Werror makes errors of warnings, -Werror=NAME of one, -Wno-NAME silences it; "
            "docs/errors.md has the names"});
  verb.add({"--color",
            &o.colour,
            "WHEN",
            "Colour messages: auto, always or never",
            {"auto", "always", "never"}});
}

void add_format_option(Verb& verb, ScriptOptions& o) {
  verb.add({"--format",
            &o.format,
            "FORMAT",
            "text (the default) is for people, json for pipelines",
            {"text", "json"}});
}

bool colours(const ScriptOptions& options) {
  if (options.colour != "auto") return options.colour == "always";
  const char* no = std::getenv("NO_COLOR");
  return !(no && *no) && isatty(STDERR_FILENO);
}

void print_error(const Error& error, bool colour) {
  fmt::print(stderr, "{}error:{} {}{}{}\n", colour ? "\x1b[1;31m" : "", colour ? "\x1b[0m" : "",
             error.where, error.where.empty() ? "" : ": ", error.what);
  if (!error.hint.empty()) fmt::print(stderr, "  = help: {}\n", error.hint);
}

Exit fail(Exit code, const Error& error, const ScriptOptions& options) {
  print_error(error, colours(options));
  return code;
}

Result<std::pair<std::string, std::string>> split_setting(const std::string& option,
                                                          const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == 0 || at == std::string::npos)
    return Error{option, fmt::format("`{}` is not a setting", text),
                 fmt::format("write {} name=value", option)};
  return std::pair(text.substr(0, at), text.substr(at + 1));
}

namespace {

/// A message that has no help of its own names its page.
lang::Diagnostic with_help(lang::Diagnostic d) {
  if (d.helps.empty()) d.help(fmt::format("`mms explain {}` says more", lang::info(d.id).code));
  return d;
}

void print(const lang::Diagnostics& diagnostics, const ScriptOptions& options) {
  const bool colour = colours(options);
  const char* separator = "";
  for (const lang::Diagnostic& d : diagnostics.all()) {
    if (options.json()) {
      fmt::print("{}\n", lang::render_json(d));
      continue;
    }
    fmt::print(stderr, "{}{}", separator, lang::render(with_help(d), colour));
    separator = "\n";
  }
}

Result<lang::LinkOptions> link_options(const ScriptOptions& options) {
  lang::LinkOptions link;
  link.level = static_cast<lang::Level>(options.level[0] - '0');
  link.import_path = options.import_path;
  for (const std::string& text : options.params) {
    auto setting = split_setting("--param", text);
    if (!setting) return setting.error();
    link.params.push_back(std::move(*setting));
  }
  return link;
}

}  // namespace

std::optional<lang::Linked> compile(const std::vector<lang::SourcePtr>& sources,
                                    const ScriptOptions& options, Exit& exit) {
  const Result<lang::LinkOptions> link = link_options(options);
  if (!link) {
    exit = fail(Exit::Usage, link.error(), options);
    return std::nullopt;
  }
  const Result<lang::WarningPolicy> warnings = lang::WarningPolicy::of(options.warnings);
  if (!warnings) {
    exit = fail(Exit::Usage, warnings.error(), options);
    return std::nullopt;
  }
  lang::Diagnostics diagnostics(*warnings);
  std::vector<lang::Graph> graphs;
  for (const lang::SourcePtr& source : sources) graphs.push_back(lang::parse(source, diagnostics));
  std::optional<lang::Linked> linked;
  if (!diagnostics.has_errors())
    linked = lang::link(graphs, api::standard_library(), *link, diagnostics);
  print(diagnostics, options);
  if (linked && !diagnostics.has_errors()) return linked;
  exit = Exit::Script;
  return std::nullopt;
}

std::optional<lang::Linked> compile_files(const std::vector<std::string>& files,
                                          const ScriptOptions& options, Exit& exit) {
  std::vector<lang::SourcePtr> sources;
  for (const std::string& file : files) {
    Result<lang::SourcePtr> source = api::read_source(file);
    if (!source) {
      exit = fail(Exit::File, source.error(), options);
      return std::nullopt;
    }
    sources.push_back(*source);
  }
  return compile(sources, options, exit);
}

}  // namespace mms::tools
