// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A wish to the system about a large block of memory.

#include <cstddef>
#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace mms {

/// Has the block, which is to be filled from its beginning on, come in pages of two megabytes where
/// the system can: one fault then instead of 512. Does nothing for small blocks and elsewhere.
inline void prefer_large_pages([[maybe_unused]] const void* block,
                               [[maybe_unused]] std::size_t bytes) {
#ifdef __linux__
  constexpr std::uintptr_t kPage = std::uintptr_t{2} << 20;
  const auto at = reinterpret_cast<std::uintptr_t>(block);
  const std::uintptr_t begin = (at + kPage - 1) / kPage * kPage, end = (at + bytes) / kPage * kPage;
  if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

}  // namespace mms
