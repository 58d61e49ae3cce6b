// SPDX-License-Identifier: Apache-2.0
// Compiled with -mavx2 -mfma on x86-64.
#include "stdlib/isa.h"

#define MMS_ISA avx2
#include "stdlib/rows_isa.h"

namespace mms::stdlib {

std::span<const vm::Builtin> avx2_rows() { return avx2::kRows; }

}  // namespace mms::stdlib
