// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// How the command ends: the one table of exit codes, which `--help` and docs/cli.md print.

#include <string_view>

namespace mms::tools {

enum class Exit : int {
  Ok = 0,
  Script = 1,
  Usage = 2,
  File = 3,
  Budget = 4,
  Differs = 5,
  Internal = 70,
  Interrupted = 130
};

struct ExitInfo {
  Exit code;
  std::string_view doc;
};

inline constexpr ExitInfo kExits[] = {
    {Exit::Ok, "all is well"},
    {Exit::Script, "errors in the script or in the scene that uses it"},
    {Exit::Usage, "the command was not understood, or an option's value is out of range"},
    {Exit::File, "a file could not be read or written"},
    {Exit::Budget, "the script ran out of its budget of steps or depth while running"},
    {Exit::Differs, "pictures differ by more than --threshold"},
    {Exit::Internal, "out of memory, or a fault of our own: please report it"},
    {Exit::Interrupted, "stopped by Ctrl-C; what was there has been written"},
};

}  // namespace mms::tools
