// SPDX-License-Identifier: Apache-2.0
#include "materials/spectra.h"

#include <algorithm>
#include <iterator>

#include "materials/colour.h"

namespace mms::materials {
namespace {

constexpr double kD65[] = {
#include "materials/illuminant_d65.inc"
};
constexpr double kA[] = {
#include "materials/illuminant_a.inc"
};
static_assert(std::size(kD65) == 107 && std::size(kA) == 107);

/// The 300-830 nm, 5 nm tables above, 100 at 560 nm.
double relative_power(const double (&table)[107], double lambda_nm) {
  const double t = std::clamp((lambda_nm - 300) / 5, 0.0, 106.0);
  const int i = std::min(int(t), 105);
  const double u = t - i;
  return (table[i] * (1 - u) + table[i + 1] * u) / 100;
}

#define MATERIAL(name, ...) constexpr IndexTable::Row k_##name[] = {__VA_ARGS__};
#include "materials/conductors.inc"
#include "materials/glasses.inc"
#undef MATERIAL

#define MATERIAL(name, ...) IndexTable(#name, k_##name),
constexpr IndexTable kConductors[] = {
#include "materials/conductors.inc"
};
constexpr IndexTable kGlasses[] = {
#include "materials/glasses.inc"
};
#undef MATERIAL

}  // namespace

double illuminant_d65(double lambda_nm) { return relative_power(kD65, lambda_nm); }
double illuminant_a(double lambda_nm) { return relative_power(kA, lambda_nm); }

double illuminant_d65_luminance() {
  static const double y = xyz_of_spectrum(illuminant_d65).y;
  return y;
}

ComplexIndex IndexTable::at(double lambda_nm) const {
  const auto above = std::upper_bound(rows_.begin(), rows_.end(), lambda_nm,
                                      [](double l, const Row& row) { return l < row.lambda_nm; });
  if (above == rows_.begin()) return {above->n, above->k};
  const Row& a = above[-1];
  if (above == rows_.end()) return {a.n, a.k};
  const double u = (lambda_nm - a.lambda_nm) / (above->lambda_nm - a.lambda_nm);
  return {a.n + u * (above->n - a.n), a.k + u * (above->k - a.k)};
}

std::span<const IndexTable> conductors() { return kConductors; }
std::span<const IndexTable> glasses() { return kGlasses; }

const IndexTable* find_index(std::span<const IndexTable> tables, std::string_view name) {
  for (const IndexTable& table : tables)
    if (table.name() == name) return &table;
  return nullptr;
}

}  // namespace mms::materials
