// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "tools/commands.h"

namespace mms::tools {

void build_command(CLI::App& command, Exit& exit) {
  command.name("mms");
  command.description("Procedural materials: checks scripts, and renders them on a test sphere.");
  command.set_version_flag("--version", "mms " MMS_VERSION, "Print the version and exit");
  command.require_subcommand(1);
  command.get_formatter()->column_width(34);
  std::string footer =
      "Examples:\n  mms check marble.mms\n  mms render marble.mms -o marble.png\n"
      "\nExit codes:\n";
  for (const ExitInfo& row : kExits)
    footer += fmt::format("  {:<4}{}\n", static_cast<int>(row.code), row.doc);
  command.footer(footer + "\n`mms VERB --help` says more about a verb.");
  for (const AddVerb add : kVerbs) add(command, exit);
}

}  // namespace mms::tools
