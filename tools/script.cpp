// SPDX-License-Identifier: Apache-2.0
#include "tools/script.h"

#include <unistd.h>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "api/images.h"
#include "api/inputs.h"
#include "api/library.h"
#include "lang/parser.h"
#include "tools/stored.h"

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
  verb.add({"--set", &o.settings, "NAME=VALUE",
            o.at_points ? "Value of a `param` of the script, or of a $variable: an expression"
                        : "Value of a `param` of the script: an expression"});
  verb.add({"-W", &o.warnings, "WORD",
            "-Werror makes errors of warnings, -Werror=NAME of one, -Wno-NAME silences it; "
            "docs/errors.md has the names"});
  verb.add({"--missing",
            &o.missing,
            "WHAT",
            "An image that cannot be read is an error (the default), or a warning and magenta",
            {"error", "magenta"}});
  verb.add({"--image-memory", &o.image_memory, "MB", "Memory that images may take [1024]"});
  add_colour_option(verb, o);
}

void add_colour_option(Verb& verb, ScriptOptions& o) {
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

std::string counted(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
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

namespace {

constexpr std::string_view kSet = "--set";

/// A message that has no help of its own names its page.
lang::Diagnostic with_help(lang::Diagnostic d) {
  if (d.helps.empty()) d.help(fmt::format("`mms explain {}` says more", lang::info(d.id).code));
  return d;
}

/// What a message is about: of one place each is said once, whatever numbers it has. One without a
/// place says in its notes what it is about.
std::string subject(const lang::Diagnostic& d) {
  std::string place =
      d.span ? fmt::format("{}:{}:{}", d.span.source->name, d.span.begin, d.span.end) : d.text;
  if (!d.span)
    for (const lang::Note& note : d.notes) place += " " + note.text;
  return fmt::format("{} {}", lang::info(d.id).code, place);
}

struct Settings {
  std::vector<std::pair<std::string, std::string>> plain, variables;  ///< `name`, `$name`
};

/// `name=value` and `$name=value` taken apart.
Result<Settings> split(const std::vector<std::string>& texts) {
  Settings settings;
  for (const std::string& text : texts) {
    const std::size_t at = text.find('=');
    const bool dollar = text[0] == '$';
    if (at == std::string::npos || at == (dollar ? 1 : 0))
      return Error{std::string(kSet), fmt::format("`{}` is not a setting", text),
                   "write --set name=value"};
    (dollar ? settings.variables : settings.plain)
        .emplace_back(text.substr(dollar, at - dollar), text.substr(at + 1));
  }
  return settings;
}

/// Nothing has that name: says so, and names the nearest thing that can be set.
Error no_such(const std::string& name, const std::vector<lang::ParamInfo>& params, bool at_points) {
  std::vector<std::string> names;
  for (const lang::ParamInfo& p : params) names.push_back(p.name);
  if (at_points)
    for (const vm::VariableInfo& row : vm::kVariables)
      if (row.visibility == vm::Visibility::Public) names.push_back(fmt::format("${}", row.name));
  std::string near = lang::nearest(name, names);
  if (near.empty()) near = lang::nearest("$" + name, names);
  std::string hint = "no script here has a param";
  if (!near.empty())
    hint = fmt::format("did you mean `{}`?", near);
  else if (!names.empty())
    hint = fmt::format("there are: {}", fmt::join(names, ", "));
  else if (api::find_variable(name))
    hint = "only verbs that evaluate points, as `mms eval` does, set variables";
  return {std::string(kSet), fmt::format("nothing is called `{}`", name), hint};
}

/// Imports are not looked for in what is no folder.
void warn_of_folders(const ScriptOptions& options) {
  std::error_code ignored;
  for (const std::string& folder : options.import_path)
    if (!std::filesystem::is_directory(folder, ignored) && is_news("-I " + folder, options))
      fmt::print(stderr,
                 "warning: -I {}: there is no such folder\n  = help: the path starts from {}\n",
                 folder, std::filesystem::current_path(ignored).string());
}

/// What is left of the settings once the params have had theirs.
Result<std::vector<VariableSetting>> variables(const Settings& settings, const lang::Linked& linked,
                                               bool at_points) {
  auto all = settings.variables;
  for (const std::string& name : linked.unknown_params)
    all.push_back(*std::find_if(settings.plain.begin(), settings.plain.end(),
                                [&](const auto& s) { return s.first == name; }));
  std::vector<VariableSetting> out;
  for (const auto& [name, value] : all) {
    const auto variable = api::find_variable(name);
    if (!variable || !at_points) return no_such(name, linked.params, at_points);
    out.push_back({*variable, value});
  }
  return out;
}

/// Whether all that is wrong stands in values of the command line.
bool only_settings(const lang::Diagnostics& diagnostics) {
  return std::all_of(diagnostics.all().begin(), diagnostics.all().end(),
                     [](const lang::Diagnostic& d) {
                       return d.severity != lang::Severity::Error ||
                              (d.span.source && d.span.source->name.starts_with(kSet));
                     });
}

/// What opens the images of scripts; the error is one of the option.
Result<std::unique_ptr<vm::ImageSource>> image_library(const ScriptOptions& options) {
  double megabytes = api::kImageMegabytes;
  if (const std::string& text = options.image_memory; !text.empty()) {
    const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), megabytes);
    if (wrong != std::errc() || end != text.data() + text.size() ||
        !(megabytes >= 1 && megabytes <= api::kMostImageMegabytes))
      return Error{"--image-memory",
                   fmt::format("`{}` is not a number from 1 to {}", text, api::kMostImageMegabytes),
                   "megabytes, as in --image-memory 4096"};
  }
  return std::unique_ptr<vm::ImageSource>(std::make_unique<api::ImageLibrary>(megabytes));
}

std::optional<lang::Linked> link(const std::vector<lang::SourcePtr>& sources,
                                 const Settings& settings, const ScriptOptions& options,
                                 vm::ImageSource& images, lang::Diagnostics& diagnostics,
                                 Exit& exit) {
  lang::LinkOptions link;
  link.level = static_cast<lang::Level>(options.level[0] - '0');
  link.dump_after = options.dump_after;
  link.import_path = options.import_path;
  link.params = settings.plain;
  link.unknown_params = lang::UnknownParams::Report;
  link.images = &images;
  link.looked_for = options.looked_for;
  if (options.missing == "magenta") link.missing_images = lang::MissingImages::Magenta;
  std::vector<lang::Graph> graphs;
  for (const lang::SourcePtr& source : sources) {
    diagnostics.keep(source);
    graphs.push_back(lang::parse(source, diagnostics));
  }
  std::optional<lang::Linked> linked;
  if (!diagnostics.has_errors())
    linked = lang::link(graphs, api::standard_library(), link, diagnostics);
  if (!linked) exit = only_settings(diagnostics) ? Exit::Usage : Exit::Script;
  return linked;
}

/// The same where one of the sources is a compiled program, in which params are what they are.
std::optional<lang::Linked> load(const std::vector<lang::SourcePtr>& sources,
                                 const Settings& settings, const ScriptOptions& options,
                                 vm::ImageSource& images, lang::Diagnostics& diagnostics,
                                 Exit& exit) {
  auto loaded = load_stored(sources, options, images, diagnostics);
  if (!loaded) {
    exit = fail(sources.size() > 1 ? Exit::Usage : Exit::File, loaded.error(), options);
    return std::nullopt;
  }
  for (const auto& [name, value] : settings.plain) {
    const bool param = std::any_of(loaded->params.begin(), loaded->params.end(),
                                   [&, &n = name](const auto& p) { return p.name == n; });
    if (param) {
      exit = fail(
          Exit::Usage,
          {sources[0]->name, fmt::format("is a compiled program: its param `{}` has a value", name),
           "give the value to `mms compile`"},
          options);
      return std::nullopt;
    }
    loaded->unknown_params.push_back(name);
  }
  return std::move(*loaded);
}

}  // namespace

bool is_news(const std::string& subject, const ScriptOptions& options) {
  return !options.said || options.said->insert(subject).second;
}

void print(const lang::Diagnostics& diagnostics, const ScriptOptions& options) {
  const bool colour = colours(options);
  const char* separator = "";
  for (const lang::Diagnostic& d : diagnostics.all()) {
    if (!is_news(subject(d), options)) continue;
    if (options.json()) {
      fmt::print("{}\n", lang::render_json(d));
      continue;
    }
    fmt::print(stderr, "{}{}", separator, lang::render(with_help(d), colour));
    separator = "\n";
  }
}

std::optional<Compiled> compile(const std::vector<lang::SourcePtr>& sources,
                                const ScriptOptions& options, lang::Diagnostics& diagnostics,
                                Exit& exit) {
  warn_of_folders(options);
  const Result<Settings> settings = split(options.settings);
  if (!settings) {
    exit = fail(Exit::Usage, settings.error(), options);
    return std::nullopt;
  }
  const Result<lang::WarningPolicy> warnings = lang::WarningPolicy::of(options.warnings);
  if (!warnings) {
    exit = fail(Exit::Usage, warnings.error(), options);
    return std::nullopt;
  }
  diagnostics = lang::Diagnostics(*warnings);
  const auto images = image_library(options);
  if (!images) {
    exit = fail(Exit::Usage, images.error(), options);
    return std::nullopt;
  }
  auto linked = any_stored(sources)
                    ? load(sources, *settings, options, **images, diagnostics, exit)
                    : link(sources, *settings, options, **images, diagnostics, exit);
  if (!linked) return std::nullopt;
  auto set = variables(*settings, *linked, options.at_points);
  if (!set) {
    exit = fail(Exit::Usage, set.error(), options);
    return std::nullopt;
  }
  return Compiled{std::move(*linked), std::move(*set)};
}

std::optional<Compiled> compile(const std::vector<lang::SourcePtr>& sources,
                                const ScriptOptions& options, Exit& exit) {
  lang::Diagnostics diagnostics;
  auto compiled = compile(sources, options, diagnostics, exit);
  print(diagnostics, options);
  if (compiled && !diagnostics.has_errors()) return compiled;
  if (compiled) exit = Exit::Script;
  return std::nullopt;
}

Result<lang::SourcePtr> read_script(const std::string& file) {
  Result<lang::SourcePtr> source = api::read_source(file);
  constexpr std::size_t kLooked = 8000;  // bytes, as git looks at
  if (!source || any_stored({*source}) ||
      (*source)->text.substr(0, kLooked).find('\0') == std::string::npos)
    return source;
  return Error{(*source)->name, "is no text", "scripts are UTF-8; is it the file that you mean?"};
}

std::optional<std::vector<lang::SourcePtr>> read_sources(const std::vector<std::string>& files,
                                                         const ScriptOptions& options, Exit& exit) {
  std::vector<lang::SourcePtr> sources;
  for (const std::string& file : files) {
    Result<lang::SourcePtr> source = read_script(file);
    if (!source) {
      exit = fail(Exit::File, source.error(), options);
      return std::nullopt;
    }
    sources.push_back(*source);
  }
  return sources;
}

std::optional<Compiled> compile_files(const std::vector<std::string>& files,
                                      const ScriptOptions& options, Exit& exit) {
  const auto sources = read_sources(files, options, exit);
  if (!sources) return std::nullopt;
  return compile(*sources, options, exit);
}

}  // namespace mms::tools
