// SPDX-License-Identifier: Apache-2.0
#include "tools/overwrite.h"

#include <filesystem>
#include <system_error>

namespace mms::tools {

std::optional<Error> overwrites(const std::string& output, std::span<const std::string> inputs) {
  std::error_code absent;
  for (const std::string& input : inputs)
    if (std::filesystem::equivalent(output, input, absent))
      return Error{output, "would be written over what it is made from", "name another file"};
  return std::nullopt;
}

}  // namespace mms::tools
