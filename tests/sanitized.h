// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Whether this is a build under the address or the thread sanitizer, which find bad memory
/// accesses and races, and take ten to a hundred times as long: tests may then do the same with
/// fewer samples or lanes.

namespace mms {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

/// Whether it is the thread sanitizer, which keeps much of every small piece of memory that was
/// ever taken: what takes half a gigabyte and has one thread may be left out.
#if defined(__SANITIZE_THREAD__)
inline constexpr bool kThreadSanitized = true;
#else
inline constexpr bool kThreadSanitized = false;
#endif

}  // namespace mms
