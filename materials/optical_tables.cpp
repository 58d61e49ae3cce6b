// SPDX-License-Identifier: Apache-2.0
#include "materials/optical_tables.h"

#include <array>
#include <cstddef>

namespace mms::materials {
namespace {

// 0 a step beyond both ends, and so outside.
constexpr double kObserver[][3] = {{0, 0, 0},
#include "materials/cie1931.inc"
                                   {0, 0, 0}};
constexpr double kIlluminantD65[] = {
#include "materials/illuminant_d65.inc"
};
constexpr double kIlluminantA[] = {
#include "materials/illuminant_a.inc"
};
constexpr double kDaylight[][3] = {
#include "materials/daylight_components.inc"
};
constexpr double kIlluminantsF[][12] = {
#include "materials/illuminants_f.inc"
};
#define MATERIAL(name, ...) constexpr double k_##name[][3] = {__VA_ARGS__};
#include "materials/conductors.inc"
#undef MATERIAL

/// Wavelengths at equal steps.
struct Every {
  double first, step;
};
/// Wavelengths in column 0.
struct Column0 {};

template <std::size_t N>
struct Curve {
  std::array<double, N> nm{}, value{};
  std::array<std::uint16_t, OpticalTable::kCells> row_at{};
};

template <std::size_t C>
consteval double number(const double (&row)[C], int column) {
  return row[column];
}
consteval double number(const double& row, int) { return row; }

template <std::size_t N, class Row>
consteval double wavelength(const Row (&)[N], Every x, int k) {
  return x.first + x.step * k;
}
template <std::size_t N, class Row>
consteval double wavelength(const Row (&rows)[N], Column0, int k) {
  return number(rows[k], 0);
}

template <std::size_t N, class X, class Row>
consteval Curve<N> curve(const Row (&rows)[N], X x, int column, double scale) {
  Curve<N> c;
  for (std::size_t k = 0; k < N; ++k) {
    c.nm[k] = wavelength(rows, x, int(k));
    c.value[k] = number(rows[k], column) * scale;
  }
  std::uint16_t k = 0;
  for (std::size_t cell = 0; cell < OpticalTable::kCells; ++cell) {
    while (k + 2u < N && c.nm[k + 1u] <= double(OpticalTable::kFirstNm) + double(cell)) ++k;
    c.row_at[cell] = k;
  }
  return c;
}

#define OPTICAL_TABLE(name, data, x, column, scale) \
  constexpr auto k_curve_##name = curve(data, x, column, scale);
#include "materials/optical_tables.def"
#undef OPTICAL_TABLE

}  // namespace

const OpticalTable optical_tables[kOpticalTables] = {
#define OPTICAL_TABLE(name, ...)                                                                \
  {#name, int(k_curve_##name.nm.size()), k_curve_##name.nm.data(), k_curve_##name.value.data(), \
   k_curve_##name.row_at.data()},
#include "materials/optical_tables.def"
#undef OPTICAL_TABLE
};

}  // namespace mms::materials
