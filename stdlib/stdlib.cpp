// SPDX-License-Identifier: Apache-2.0
#include "stdlib/stdlib.h"

#include "stdlib/isa.h"

namespace mms::stdlib {

bool has_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

std::span<const vm::Builtin> builtins() { return has_avx2() ? avx2_rows() : baseline_rows(); }

}  // namespace mms::stdlib
