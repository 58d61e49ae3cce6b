// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <doctest/doctest.h>

namespace mms {

/// The suite of cases that sum f over many directions, and do no more. ctest leaves it out under
/// sanitizers, which see the same code in random calls, a hundred times as fast.
inline const doctest::test_suite kSum("sums");

}  // namespace mms
