// SPDX-License-Identifier: Apache-2.0
// The execution loop for any machine that the compiler targets.
#define MMS_ISA baseline
#include "vm/interpreter_isa.h"
