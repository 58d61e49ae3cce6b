// SPDX-License-Identifier: Apache-2.0
// The `mms` command. Everything that can go wrong past the verbs' own messages ends here.
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "lang/diagnostics.h"
#include "tools/commands.h"
#include "tools/script.h"

namespace {

using mms::tools::Exit;

std::vector<std::string> verb_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::App* verb : command.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(verb->get_name());
  return names;
}

/// A first word that is no verb, or a mistake in the options of one.
Exit usage_error(CLI::App& command, const CLI::ParseError& e, int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "";
  for (const CLI::App* verb : command.get_subcommands()) {
    mms::tools::print_error({"mms " + verb->get_name(), e.what(),
                             "`mms " + verb->get_name() + " --help` shows the options"});
    return Exit::Usage;
  }
  if (word.empty() || word[0] == '-') {
    mms::tools::print_error(
        {"mms", word.empty() ? "a verb is missing" : e.what(), "`mms --help` lists the verbs"});
    return Exit::Usage;
  }
  const std::string near = mms::lang::nearest(word, verb_names(command));
  mms::tools::print_error(
      {"mms", "no such verb: " + word,
       near.empty() ? "`mms --help` lists the verbs" : "did you mean `mms " + near + "`?"});
  return Exit::Usage;
}

Exit run(int argc, char** argv) {
  Exit exit = Exit::Ok;
  CLI::App command;
  mms::tools::build_command(command, exit);
  try {
    command.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return static_cast<Exit>(command.exit(e));
    return usage_error(command, e, argc, argv);
  }
  if (std::fflush(stdout) != 0) {
    mms::tools::print_error({"standard output", "cannot be written", "is the disk full?"});
    return Exit::File;
  }
  return exit;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return static_cast<int>(run(argc, argv));
  } catch (const std::bad_alloc&) {
    mms::tools::print_error({"mms", "out of memory", "try a smaller picture or script"});
  } catch (const std::exception& e) {
    mms::tools::print_error({"mms", std::string("internal failure: ") + e.what(),
                             "this is our fault: please report it with the script"});
  }
  return static_cast<int>(Exit::Internal);
}
