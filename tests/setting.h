// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdlib>

namespace mms {

/// How many of something a test makes: what the environment says, at least 1, or else `otherwise`.
/// CONTRIBUTING.md lists the names.
inline long long setting(const char* name, long long otherwise) {
  const char* text = std::getenv(name);
  return text ? std::max(1LL, std::atoll(text)) : otherwise;
}

}  // namespace mms
