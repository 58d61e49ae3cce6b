// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Commands that this one starts.

#include <optional>
#include <string>

namespace mms::tools {

/// What a command printed, and how it ended as `waitpid` tells it.
struct Ended {
  std::string out;
  int status = 0;
};

/// Runs `command` by the shell; empty where it cannot be started. What stops this process
/// (`interrupted`) stops it too, whichever of both was sent the signal.
std::optional<Ended> run_child(const std::string& command);

}  // namespace mms::tools
