// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Measured curves over the wavelength: the standard observer, illuminants, indices of refraction.
/// Linear between rows, ends held. Static data of constant size; every function is pure.

#include <cstdint>
#include <string_view>

namespace mms::materials {

struct OpticalTable {
  std::string_view name;
  int rows;
  const double* nm;     ///< ascending, nanometres
  const double* value;  ///< as many
  /// For each whole nanometre from kFirstNm on: the last row that is not above it, but never the
  /// last row of all, nor one below the first.
  const std::uint16_t* row_at;

  static constexpr int kFirstNm = 280, kCells = 630;

  /// The row k so that `nm`, in [nm[0], nm[rows - 1]], lies between rows k and k + 1.
  [[gnu::always_inline]] int row_before(double at) const {
    int k = row_at[static_cast<int>(at) - kFirstNm];
    while (k + 2 < rows && this->nm[k + 1] <= at) ++k;
    return k;
  }
  /// The value at a wavelength in nanometres; the first row's where that is no number.
  [[gnu::always_inline]] double at(double wavelength) const {
    const double first = nm[0], last = nm[rows - 1];
    const double x = wavelength > first ? (wavelength < last ? wavelength : last) : first;
    const int k = row_before(x);
    const double u = (x - nm[k]) / (nm[k + 1] - nm[k]);
    return value[k] * (1 - u) + value[k + 1] * u;
  }
  /// Its change for each nanometre; 0 outside.
  [[gnu::always_inline]] double slope(double wavelength) const {
    if (!(wavelength >= nm[0] && wavelength < nm[rows - 1])) return 0;
    const int k = row_before(wavelength);
    return (value[k + 1] - value[k]) / (nm[k + 1] - nm[k]);
  }
};

/// The rows of optical_tables.def: their numbers in scripts are their order.
enum class Optical {
#define OPTICAL_TABLE(name, ...) name,
#include "materials/optical_tables.def"
#undef OPTICAL_TABLE
  Count
};
inline constexpr int kOpticalTables = static_cast<int>(Optical::Count);
extern const OpticalTable optical_tables[kOpticalTables];

inline const OpticalTable& optical_table(Optical which) {
  return optical_tables[static_cast<int>(which)];
}

}  // namespace mms::materials
