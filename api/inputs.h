// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Fills the inputs of a batch by the names that scripts use, for hosts that have no renderer.

#include <span>
#include <string_view>

#include "base/result.h"
#include "vm/interpreter.h"

namespace mms::api {

struct Filled {};

/// The point that stands for all where nothing else is said, in every lane: the north pole of the
/// unit sphere seen from above. Wavelengths are 400 to 750 nm in steps of 50.
template <class R>
void fill_defaults(vm::InputBatch<R>& in);

/// Whether a host says what `v` is: every variable that scripts can name, and the changes along the
/// tangents that derived gradients need (`object_tangent`, ...).
bool may_be_set(vm::Variable v);

/// The values that a variable takes for one point: components, or one for each wavelength.
/// The error names the nearest variable where there is none of that name.
Result<vm::Variable> find_variable(std::string_view name);
int value_count(vm::Variable v);

/// Sets `v` in the first `lanes` lanes: value `c` of lane `i` is `values[c * stride + i]`.
/// Setting `$wavelength` (metres) also fills what depends on it.
template <class R>
void fill(vm::InputBatch<R>& in, vm::Variable v, const R* values, std::size_t stride, int lanes);

/// The same value of `v` in every lane. \pre value_count(v) values.
template <class R>
void fill_all(vm::InputBatch<R>& in, vm::Variable v, std::span<const R> values);

}  // namespace mms::api
