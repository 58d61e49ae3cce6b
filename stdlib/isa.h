// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The same rows, compiled for each instruction set; equal but for their kernels, and those return
/// the same bits (a test compares them).

#include <span>

#include "vm/builtin.h"

namespace mms::stdlib {

/// Runs on any processor.
std::span<const vm::Builtin> baseline_rows();

/// The rows for AVX2 and FMA; may be entered only where `has_avx2()`. On other architectures the
/// same as `baseline_rows()`.
std::span<const vm::Builtin> avx2_rows();

bool has_avx2();

}  // namespace mms::stdlib
