// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the enclosures of several rows are put together from. In double, ends not rounded outward.

#include "vm/interval.h"

namespace mms::stdlib::bounds {

vm::Interval magnitude(const vm::Interval& x);
vm::Interval sine(const vm::Interval& x);
vm::Interval cosine(const vm::Interval& x);
/// atan2(y, x): [-pi, pi] where the box touches the cut along the negative x axis.
vm::Interval angle(const vm::Interval& y, const vm::Interval& x);
vm::Interval length(const vm::Interval& x, const vm::Interval& y);

}  // namespace mms::stdlib::bounds
