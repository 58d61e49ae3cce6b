// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <doctest/doctest.h>

namespace mms {

/// The suite of cases that sum f over many directions, and do no more, in files that do other
/// things too. ctest leaves it out under sanitizers, as all of tests/accuracy and tests/stats is.
inline const doctest::test_suite kSum("sums");

}  // namespace mms
