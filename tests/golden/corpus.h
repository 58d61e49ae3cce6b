// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The golden scripts: those of the folder, and those that are too large for a file.

#include <filesystem>
#include <string>
#include <vector>

namespace mms::golden {

/// Every script under tests/golden that is run by itself, sorted.
const std::vector<std::filesystem::path>& scripts();
/// Its path from tests/golden.
std::string name_of(const std::filesystem::path& script);

/// A number of vm/limits.h with a script that just keeps it and one that just does not.
struct Limit {
  std::string name;  ///< as in vm/limits.h
  std::string kept, broken;
  std::string code;       ///< of the messages of `broken`; empty where its value faults instead
  std::string fault;      ///< the cause of that fault
  std::string text = {};  ///< a part of the message
};
const std::vector<Limit>& limit_scripts();

/// A script of more than kMaxErrors errors.
std::string flood();
/// A sum that leans further to the left than a tree may be high.
std::string deep_sum();

std::string repeated(std::string_view what, int times);

}  // namespace mms::golden
