// SPDX-License-Identifier: Apache-2.0
// mms completion: what a shell needs to complete the command, made from the verbs themselves.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "tools/command.h"
#include "tools/commands.h"

namespace mms::tools {

namespace {

/// What completes the value of an option, or a word without a dash.
enum class Values { None, Words, Files, Folders };

Values values_of(const Option& o) {
  if (std::holds_alternative<bool*>(o.target)) return Values::None;
  if (!o.words.empty()) return Values::Words;
  if (o.value == "DIR") return Values::Folders;
  const bool file = o.value.find("FILE") != std::string::npos || o.value == "PATH" ||
                    (o.positional() && o.names == "FILE") || o.names == "PAGE";
  return file ? Values::Files : Values::None;
}

/// `-o,--output` as `-o` and `--output`.
std::vector<std::string> names_of(const Option& o) {
  std::vector<std::string> names;
  std::stringstream in(o.names);
  for (std::string name; std::getline(in, name, ',');) names.push_back(name);
  return names;
}

/// A short option whose value is one of a few words is written with it: `-O2`.
bool glued(const Option& o) { return names_of(o)[0].size() == 2 && !o.words.empty(); }

std::vector<std::string> option_words(const Verb& verb) {
  std::vector<std::string> words{"--help"};
  for (const Option& o : verb.options) {
    if (o.positional()) continue;
    if (glued(o))
      for (const std::string& word : o.words) words.push_back(names_of(o)[0] + word);
    else
      for (const std::string& name : names_of(o)) words.push_back(name);
  }
  return words;
}

std::string verb_names() {
  std::string names;
  for (const Verb& verb : verbs()) names += (names.empty() ? "" : " ") + verb.name;
  return names;
}

std::string bash_values(Values values, const std::vector<std::string>& words) {
  switch (values) {
    case Values::Words:
      return fmt::format("COMPREPLY=($(compgen -W \"{}\" -- \"$current\"))", fmt::join(words, " "));
    case Values::Files:
      return "COMPREPLY=($(compgen -f -- \"$current\"))";
    case Values::Folders:
      return "COMPREPLY=($(compgen -d -- \"$current\"))";
    case Values::None:
      break;
  }
  return "COMPREPLY=()";
}

// Bash cuts words at `=` too, so an option's value may stand two words behind it.
constexpr std::string_view kBashHead =
    R"sh(# Completion of mms for bash: eval "$(mms completion bash)"
_mms() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} verb= i
  if [[ $current == '=' ]]; then
    current=
  elif [[ $previous == '=' ]]; then
    previous=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    if [[ ${COMP_WORDS[i]} != -* ]]; then
      verb=${COMP_WORDS[i]}
      break
    fi
  done
  if [[ -z $verb ]]; then
)sh";

std::string bash() {
  std::string text(kBashHead);
  text += fmt::format(
      "    COMPREPLY=($(compgen -W \"{} --help --version\" -- \"$current\"))\n    return\n  fi\n"
      "  case \"$verb $previous\" in\n",
      verb_names());
  for (const Verb& verb : verbs())
    for (const Option& o : verb.options) {
      if (o.positional() || glued(o) || std::holds_alternative<bool*>(o.target)) continue;
      std::string pattern;
      for (const std::string& name : names_of(o))
        pattern += fmt::format("{}'{} {}'", pattern.empty() ? "" : " | ", verb.name, name);
      text += fmt::format("    {}) {}; return ;;\n", pattern, bash_values(values_of(o), o.words));
    }
  text += "  esac\n  case \"$verb\" in\n";
  for (const Verb& verb : verbs()) {
    std::string plain = "COMPREPLY=()";
    for (const Option& o : verb.options)
      if (o.positional()) plain = bash_values(values_of(o), o.words);
    text += fmt::format(
        "    {})\n      if [[ $current == -* ]]; then\n        {}\n      else\n        {}\n"
        "      fi ;;\n",
        verb.name, bash_values(Values::Words, option_words(verb)), plain);
  }
  return text + "  esac\n}\ncomplete -o filenames -F _mms mms\n";
}

/// In single quotes, for zsh and fish.
std::string quoted(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + out + "'";
}

/// A sentence where `[`, `]` and `:` would mean something.
std::string zsh_sentence(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':') out += '\\';
    out += c;
  }
  return out;
}

std::string zsh_values(const Option& o) {
  const std::string name = zsh_sentence(o.value.empty() ? o.names : o.value);
  switch (values_of(o)) {
    case Values::Words:
      return fmt::format(":{}:({})", name, fmt::join(o.words, " "));
    case Values::Files:
      return fmt::format(":{}:_files", name);
    case Values::Folders:
      return fmt::format(":{}:_files -/", name);
    case Values::None:
      break;
  }
  return std::holds_alternative<bool*>(o.target) ? "" : fmt::format(":{}: ", name);
}

std::string zsh() {
  std::string text =
      "#compdef mms\n# Completion of mms for zsh: put it in a folder of $fpath, as "
      "_mms.\n_mms() {\n"
      "  local -a verbs=(\n";
  for (const Verb& verb : verbs())
    text += fmt::format("    {}\n", quoted(verb.name + ":" + zsh_sentence(verb.doc)));
  text +=
      "  )\n  if ((CURRENT == 2)); then\n    _describe verb verbs\n    return\n  fi\n"
      "  local verb=$words[2]\n  shift words\n  ((CURRENT--))\n  case $verb in\n";
  for (const Verb& verb : verbs()) {
    text += fmt::format("    {})\n      _arguments '--help[print help and exit]'", verb.name);
    for (const Option& o : verb.options) {
      if (o.positional()) {
        text += " " + quoted("*" + zsh_values(o));
        continue;
      }
      for (const std::string& name : names_of(o))
        text += " " + quoted(fmt::format("*{}{}[{}]{}", name,
                                         std::holds_alternative<bool*>(o.target) ? ""
                                         : name.size() == 2                      ? "+"
                                                                                 : "=",
                                         zsh_sentence(o.doc), zsh_values(o)));
    }
    text += " ;;\n";
  }
  return text + "  esac\n}\n_mms \"$@\"\n";
}

std::string fish() {
  std::string text =
      "# Completion of mms for fish: mms completion fish > "
      "~/.config/fish/completions/mms.fish\n"
      "complete -c mms -f\n";
  for (const Verb& verb : verbs())
    text += fmt::format("complete -c mms -n __fish_use_subcommand -a {} -d {}\n", verb.name,
                        quoted(verb.doc));
  for (const Verb& verb : verbs())
    for (const Option& o : verb.options) {
      std::string line =
          fmt::format("complete -c mms -n '__fish_seen_subcommand_from {}'", verb.name);
      if (!o.positional())
        for (const std::string& name : names_of(o))
          line += name.size() == 2 ? fmt::format(" -s {}", name[1])
                                   : fmt::format(" -l {}", name.substr(2));
      const Values values = values_of(o);
      if (values == Values::Words)
        line += fmt::format(" -x -a {}", quoted(fmt::format("{}", fmt::join(o.words, " "))));
      if (values == Values::Files) line += o.positional() ? " -F" : " -r -F";
      if (values == Values::Folders) line += " -x -a '(__fish_complete_directories)'";
      if (values == Values::None && !std::holds_alternative<bool*>(o.target)) line += " -x";
      text += fmt::format("{} -d {}\n", line, quoted(o.doc));
    }
  return text;
}

Exit completion(const std::string& shell) {
  fmt::print("{}", shell == "bash" ? bash() : shell == "zsh" ? zsh() : fish());
  return Exit::Ok;
}

}  // namespace

Verb completion_verb() {
  auto shell = std::make_shared<std::string>();
  Verb verb{"completion",
            "Print what a shell needs to complete this command",
            "Examples:\n  eval \"$(mms completion bash)\"\n"
            "  mms completion zsh > ~/.zsh/functions/_mms\n"
            "  mms completion fish > ~/.config/fish/completions/mms.fish",
            {},
            [shell] { return completion(*shell); }};
  verb.add({"SHELL", shell.get(), "", "bash, zsh or fish", {"bash", "zsh", "fish"}, true});
  return verb;
}

}  // namespace mms::tools
