// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Which folder may include what: the table of ARCHITECTURE.md, and the check of one file.

#include <map>
#include <set>
#include <string>
#include <vector>

namespace mms::structure {

/// What one row of the table allows.
struct Rule {
  std::set<std::string> folders;    ///< itself included
  std::set<std::string> libraries;  ///< third-party names as the table writes them
};
using Rules = std::map<std::string, Rule>;

/// The rows of the table whose header is `| Folder | What it is | May include |`.
Rules read_rules(const std::string& markdown);

/// One complaint for each include of `text` that the rules do not allow; `path` is relative to
/// the root, as in `lang/parser.cpp`.
std::vector<std::string> check(const Rules& rules, const std::string& path,
                               const std::string& text);

}  // namespace mms::structure
