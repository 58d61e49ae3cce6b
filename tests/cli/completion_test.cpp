// SPDX-License-Identifier: Apache-2.0
// mms completion: what bash offers where, by running the function it would run.
#include <set>
#include <sstream>
#include <string>

#include <doctest/doctest.h>

#include "tests/cli/command.h"

using mms::cli::Folder;
using mms::cli::Outcome;

namespace {

/// What bash offers after `words`, which it has cut at blanks and at `=`.
std::set<std::string> offered(const Folder& folder, const std::string& words) {
  const Outcome run = folder.bash("eval \"$(mms completion bash)\"\nCOMP_WORDS=(mms " + words +
                                  ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_mms\n"
                                  "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
  INFO(words, ": ", run.err);
  CHECK(run.exit == 0);
  CHECK(run.err == "");
  std::set<std::string> all;
  std::istringstream in(run.out);
  for (std::string word; std::getline(in, word);)
    if (!word.empty()) all.insert(word);
  return all;
}

using Words = std::set<std::string>;

}  // namespace

TEST_CASE("verbs complete, and nothing that is none") {
  const Folder folder;
  CHECK(offered(folder, "ch") == Words{"check"});
  CHECK(offered(folder, "d") == Words{"disasm", "doc"});
  CHECK(offered(folder, "xyz") == Words{});
  // Every verb of the help, which the command-line library prints.
  const std::string help = folder.mms("--help").out;
  for (const std::string& word : offered(folder, "''")) CHECK(help.find(word) != std::string::npos);
}

TEST_CASE("options of the verb complete, and their values") {
  const Folder folder;
  CHECK(offered(folder, "check --co") == Words{"--color"});
  CHECK(offered(folder, "check --color = a") == Words{"always", "auto"});
  CHECK(offered(folder, "check --color =") == Words{"always", "auto", "never"});
  CHECK(offered(folder, "check --color n") == Words{"never"});
  CHECK(offered(folder, "check -O") == Words{"-O0", "-O1", "-O2"});
  CHECK(offered(folder, "eval --pre") == Words{"--precision"});
  CHECK(offered(folder, "check --pre") == Words{});
  CHECK(offered(folder, "disasm --dump-after = fo").contains("fold"));
  CHECK(offered(folder, "completion ''") == Words{"bash", "fish", "zsh"});
}

TEST_CASE("every option that a verb's help lists is offered") {
  const Folder folder;
  for (const std::string verb : {"check", "render", "info", "eval", "fmt", "test", "doc"}) {
    const Words all = offered(folder, verb + " --");
    std::istringstream help(folder.mms(verb + " --help").out);
    int seen = 0;
    for (std::string word; help >> word;) {
      if (word.starts_with("-h,")) word = "--help";
      if (const auto comma = word.find(",--"); comma != word.npos) word = word.substr(comma + 1);
      word = word.substr(0, word.find_first_of("=:,{["));
      if (!word.starts_with("--") || word.size() < 4 || word.find_first_of("`'\"") != word.npos)
        continue;
      INFO(verb, " ", word);
      CHECK(all.contains(word));
      ++seen;
    }
    CHECK(seen >= 3);
  }
}

TEST_CASE("files and folders complete") {
  const Folder folder;
  folder.write("marble.mms", "");
  CHECK(offered(folder, "check mar") == Words{"marble.mms"});
  CHECK(offered(folder, "check -I mar") == Words{});  // no folder
  CHECK(offered(folder, "render -o mar") == Words{"marble.mms"});
}

TEST_CASE("scripts for zsh and fish name every verb") {
  const Folder folder;
  for (const char* shell : {"zsh", "fish"}) {
    const Outcome run = folder.mms(std::string("completion ") + shell);
    CHECK(run.exit == 0);
    for (const char* verb : {"check", "render", "info", "eval", "disasm", "fmt", "test", "doc"})
      CHECK(run.out.find(verb) != std::string::npos);
  }
  // Where the shell is installed, it says whether the script is one.
  CHECK(folder.bash("mms completion zsh > z; ! command -v zsh >/dev/null || zsh -n z").exit == 0);
  CHECK(folder.bash("mms completion fish > f; ! command -v fish >/dev/null || fish -n f").exit ==
        0);
  CHECK(folder.mms("completion tcsh").exit == 2);
}
