// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The outputs of a descriptor, as scripts name them: the one table.

#include <cstddef>
#include <string_view>

#include "vm/program.h"

namespace mms::vm {

inline constexpr std::size_t kOutputCount = static_cast<std::size_t>(Output::Count);

struct OutputRow {
  std::string_view surface, volume;  ///< names; empty: that form of descriptor has no such output
  enum class Shape : std::uint8_t { Material, Spectrum, Real, Real2 } shape;
};

/// Rows in the order of Output.
inline constexpr OutputRow kOutputs[kOutputCount] = {
    {"bsdf", "phase", OutputRow::Shape::Material},
    {"scattering", "scattering", OutputRow::Shape::Spectrum},
    {"absorption", "absorption", OutputRow::Shape::Spectrum},
    {"emission_function", "emission_function", OutputRow::Shape::Material},
    {"emission", "emission", OutputRow::Shape::Spectrum},
    {"height", "", OutputRow::Shape::Real},
    {"gradient", "", OutputRow::Shape::Real2},
    {"bound", "bound", OutputRow::Shape::Real},
};

/// The name of `output` in a descriptor of that form; empty where it has none.
constexpr std::string_view output_name(DescriptorForm form, Output output) {
  const OutputRow& row = kOutputs[static_cast<std::size_t>(output)];
  return form == DescriptorForm::Surface ? row.surface : row.volume;
}

}  // namespace mms::vm
