// SPDX-License-Identifier: Apache-2.0
// One target as libFuzzer wants it. MMS_FUZZ_TARGET is its name.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  mms::fuzz::MMS_FUZZ_TARGET({data, size});
  return 0;
}
