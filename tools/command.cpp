// SPDX-License-Identifier: Apache-2.0
#include "tools/command.h"

#include <algorithm>
#include <cstdio>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "lang/diagnostics.h"
#include "tools/commands.h"
#include "tools/script.h"

namespace mms::tools {

namespace {

std::string footer() {
  std::string text =
      "Examples:\n  mms check marble.mms\n  mms render marble.mms -o marble.png\n"
      "\nExit codes:\n";
  for (const ExitInfo& row : kExits)
    text += fmt::format("  {:<4}{}\n", static_cast<int>(row.code), row.doc);
  return text + "\n`mms VERB --help` says more about a verb.";
}

CLI::Option* add_value(CLI::App& app, const Option& o) {
  if (auto* const* flag = std::get_if<bool*>(&o.target))
    return app.add_flag(o.names, **flag, o.doc);
  if (auto* const* many = std::get_if<std::vector<std::string>*>(&o.target)) {
    CLI::Option* option = app.add_option(o.names, **many, o.doc);
    return o.positional() ? option : option->allow_extra_args(false);
  }
  std::string& text = *std::get<std::string*>(o.target);
  if (o.bare.empty()) return app.add_option(o.names, text, o.doc);
  return app.add_flag(fmt::format("{}{{{}}}", o.names, o.bare), text, o.doc);
}

/// Empty if `word` is one that the option takes; else what is wrong, and on a second line what to
/// try.
std::string no_such_word(const Option& o, const std::string& word) {
  if (std::ranges::find(o.words, word) != o.words.end()) return "";
  const std::string near = lang::nearest(word, o.words);
  return fmt::format("`{}` is none of its words\n{}{}", word,
                     near.empty() ? "" : fmt::format("did you mean `{}`? ", near),
                     fmt::format("there are: {}", fmt::join(o.words, ", ")));
}

void add_option(CLI::App& app, const Option& o) {
  CLI::Option* option = add_value(app, o);
  if (!std::holds_alternative<bool*>(o.target) && o.bare.empty()) option->type_name(o.value);
  if (!o.words.empty())
    option->check(CLI::Validator([&o](std::string& word) { return no_such_word(o, word); }, ""));
  if (o.required) option->required();
}

/// The whole command; the chosen verb leaves its end in `exit`. `verbs` outlives `app`.
void build(CLI::App& app, const std::vector<Verb>& verbs, Exit& exit) {
  app.name("mms");
  app.description("Procedural materials: checks scripts, and renders them on a test sphere.");
  app.set_version_flag("--version", "mms " MMS_VERSION, "Print the version and exit");
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  app.footer(footer());
  for (const Verb& verb : verbs) {
    CLI::App* sub = app.add_subcommand(verb.name, verb.doc);
    for (const Option& o : verb.options) add_option(*sub, o);
    sub->footer(verb.footer);
    sub->callback([&verb, &exit] { exit = verb.run(); });
  }
}

/// The option that a verb does not have, or empty where `text` says another thing.
std::string unknown_option(const std::string& text) {
  const std::size_t at = text.find(" not expected: -");
  if (at == text.npos) return "";
  const std::string word = text.substr(text.find('-', at));
  return word.substr(0, word.find_first_of(" =\n"));
}

/// What to try in place of an option that `verb` does not have.
std::string near_option(const CLI::App& verb, const std::string& wrong) {
  std::vector<std::string> names;
  for (const CLI::Option* o : verb.get_options())
    names.insert(names.end(), o->get_lnames().begin(), o->get_lnames().end());
  const std::string near = lang::nearest(wrong.substr(wrong.find_first_not_of('-')), names);
  return near.empty() ? fmt::format("`mms {} --help` shows the options", verb.get_name())
                      : fmt::format("did you mean `--{}`?", near);
}

/// A first word that is no verb, or a mistake in the options of one.
Exit usage_error(const CLI::App& app, const CLI::ParseError& e, const std::string& word) {
  for (const CLI::App* verb : app.get_subcommands()) {
    const std::string name = "mms " + verb->get_name();
    const std::string text = e.what();
    const std::size_t end = text.find('\n');
    if (const std::string wrong = unknown_option(text); !wrong.empty()) {
      print_error({name, "no such option: " + wrong, near_option(*verb, wrong)});
      return Exit::Usage;
    }
    const std::size_t count = text.find(": At Most 1 required but received ");
    print_error({name,
                 count == text.npos ? text.substr(0, end)
                                    : text.substr(0, count) + " is given more than once",
                 end == text.npos ? fmt::format("`{} --help` shows the options", name)
                                  : text.substr(end + 1)});
    return Exit::Usage;
  }
  if (word.empty() || word[0] == '-') {
    print_error(
        {"mms", word.empty() ? "a verb is missing" : e.what(), "`mms --help` lists the verbs"});
    return Exit::Usage;
  }
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(verb->get_name());
  const std::string near = lang::nearest(word, names);
  print_error({"mms", "no such verb: " + word,
               near.empty() ? "`mms --help` lists the verbs"
                            : fmt::format("did you mean `mms {}`?", near)});
  return Exit::Usage;
}

Exit output_failed() {
  print_error({"standard output", "cannot be written", "is the disk full?"});
  return Exit::File;
}

}  // namespace

std::vector<Verb> verbs() {
  std::vector<Verb> all;
  for (const auto make : kVerbs) all.push_back(make());
  return all;
}

Exit run_command(int argc, const char* const* argv) {
  Exit exit = Exit::Ok;
  const std::vector<Verb> all = verbs();
  CLI::App app;
  build(app, all, exit);
  try {
    app.parse(argc, argv);
  } catch (const std::system_error&) {  // what fmt::print throws
    if (!std::ferror(stdout)) throw;
    return output_failed();
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0) return usage_error(app, e, argc > 1 ? argv[1] : "");
    app.exit(e);  // prints the help or the version
  }
  // An error of an earlier flush leaves nothing to write, but is remembered.
  return std::fflush(stdout) == 0 && !std::ferror(stdout) ? exit : output_failed();
}

std::string command_help() {
  Exit exit = Exit::Ok;
  const std::vector<Verb> all = verbs();
  CLI::App app;
  build(app, all, exit);
  return app.help();
}

std::vector<std::string> verb_helps() {
  Exit exit = Exit::Ok;
  const std::vector<Verb> all = verbs();
  CLI::App app;
  build(app, all, exit);
  std::vector<std::string> helps;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
    helps.push_back(verb->help("mms"));
  return helps;
}

}  // namespace mms::tools
