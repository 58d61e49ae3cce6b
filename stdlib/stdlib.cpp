// SPDX-License-Identifier: Apache-2.0
#include "stdlib/stdlib.h"

#include <vector>

#include "materials/table.h"
#include "stdlib/images_rows.h"
#include "stdlib/isa.h"

namespace mms::stdlib {

bool has_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

std::span<const vm::Builtin> builtins() {
  static const std::vector<vm::Builtin> rows = [] {
    const auto ours = has_avx2() ? avx2_rows() : baseline_rows();
    const auto materials = materials::rows();
    std::vector<vm::Builtin> r(ours.begin(), ours.end());
    r.insert(r.end(), std::begin(kImageRows), std::end(kImageRows));
    r.insert(r.end(), materials.begin(), materials.end());
    return r;
  }();
  return rows;
}

}  // namespace mms::stdlib
