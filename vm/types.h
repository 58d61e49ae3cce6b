// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The four types of a machine slot. Everything richer (complex numbers, arrays, structures,
/// functions, materials) is taken apart by the linker and never reaches the machine.

#include <cstdint>

#include "base/spectrum.h"

namespace mms::vm {

enum class SlotType : std::uint8_t {
  Real,      ///< float in production, double in the oracle machine
  Integer,   ///< 32-bit, wraps
  Logic,     ///< 32-bit, 0 or 1
  Spectrum,  ///< kWavelengths reals: one for each wavelength of the path
};

/// Blocks of lanes that a value of this type takes.
constexpr int block_count(SlotType t) { return t == SlotType::Spectrum ? kWavelengths : 1; }

/// The letter of a type in the opcode table: r, i, l or s.
constexpr char letter(SlotType t) { return "rils"[static_cast<int>(t)]; }

}  // namespace mms::vm
