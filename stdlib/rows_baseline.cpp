// SPDX-License-Identifier: Apache-2.0
#include "stdlib/isa.h"

#define MMS_ISA baseline
#include "stdlib/rows_isa.h"

namespace mms::stdlib {

std::span<const vm::Builtin> baseline_rows() { return baseline::kRows; }

}  // namespace mms::stdlib
