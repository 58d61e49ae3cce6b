// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The pages of docs/ that are made from the tables of the code.

#include <map>
#include <span>
#include <string>
#include <string_view>

namespace mms::tools {

struct Document {
  std::string_view name;  ///< file name without `.md`
  std::string_view doc;   ///< one sentence
  std::string (*text)();
};

std::span<const Document> documents();

/// What the library's page says of the functions and materials of each name, and the page of inputs
/// of each `$variable`.
std::map<std::string, std::string> entry_documents();

std::string stdlib_document();
std::string bytecode_document();
std::string errors_document();
std::string inputs_document();
std::string cli_document();
std::string info_document();
std::string passes_document();

}  // namespace mms::tools
