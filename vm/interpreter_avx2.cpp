// SPDX-License-Identifier: Apache-2.0
// The execution loop for x86 with AVX2 and FMA; entered only after a check at run time.
#if defined(__x86_64__)
#define MMS_ISA avx2
#include "vm/interpreter_isa.h"
#endif
