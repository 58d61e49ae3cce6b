// SPDX-License-Identifier: Apache-2.0
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <sys/resource.h>

#include <algorithm>

#include "tests/sanitized.h"
#include "tests/source_dir.h"

/// Frames are many times as large under the sanitizers, and vm/limits.h is for those of a release.
static void grow_stack() {
  constexpr rlim_t kBytes = rlim_t(64) << 20;
  rlimit limit{};
  getrlimit(RLIMIT_STACK, &limit);
  limit.rlim_cur = std::min(std::max(limit.rlim_cur, kBytes), limit.rlim_max);
  setrlimit(RLIMIT_STACK, &limit);
}

const std::filesystem::path& mms::source_dir() {
  static const std::filesystem::path root = MMS_SOURCE_DIR;
  return root;
}

int main(int argc, char** argv) {
  if (mms::kSanitized) grow_stack();
  return doctest::Context(argc, argv).run();
}
