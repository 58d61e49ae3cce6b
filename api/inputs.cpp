// SPDX-License-Identifier: Apache-2.0
#include "api/inputs.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "lang/diagnostics.h"
#include "materials/spectra.h"

namespace mms::api {

namespace {

struct Default {
  vm::Variable variable;
  std::array<double, 8> values;
};

constexpr Default kDefaults[] = {
    {vm::Variable::Position, {0, 0, 1}},
    {vm::Variable::ObjectPosition, {0, 0, 1}},
    {vm::Variable::Normal, {0, 0, 1}},
    {vm::Variable::GeometricNormal, {0, 0, 1}},
    {vm::Variable::Tangent, {1, 0, 0}},
    {vm::Variable::Bitangent, {0, 1, 0}},
    {vm::Variable::View, {0, 0, 1}},
    {vm::Variable::Distance, {1}},
    {vm::Variable::ObjectTangent, {1, 0, 0}},
    {vm::Variable::ObjectBitangent, {0, 1, 0}},
    {vm::Variable::NormalTangent, {1, 0, 0}},
    {vm::Variable::NormalBitangent, {0, 1, 0}},
    {vm::Variable::Wavelength, {400e-9, 450e-9, 500e-9, 550e-9, 600e-9, 650e-9, 700e-9, 750e-9}},
};

/// What depends on the wavelength alone: the basis curves of `rgb`, thesis Table 6.1.
template <class R>
void fill_basis(vm::InputBatch<R>& in, int lanes) {
  for (int c = 0; c < kWavelengths; ++c) {
    const R* metres = in.lanes(vm::Variable::Wavelength, c);
    R* red = in.lanes(vm::Variable::RgbRed, c);
    R* green = in.lanes(vm::Variable::RgbGreen, c);
    for (int i = 0; i < lanes; ++i) {
      const double nm = double(metres[i]) * 1e9;
      red[i] = R(materials::rgb_red(nm));
      green[i] = R(materials::rgb_green(nm));
    }
  }
}

template <class R>
void fill_lanes(vm::InputBatch<R>& in, vm::Variable v, const R* values, std::size_t stride,
                std::size_t step, int lanes) {
  for (int c = 0; c < value_count(v); ++c) {
    R* out = in.lanes(v, c);
    for (int i = 0; i < lanes; ++i)
      out[i] = values[std::size_t(c) * stride + std::size_t(i) * step];
  }
  if (v == vm::Variable::Wavelength) fill_basis(in, lanes);
}

}  // namespace

template <class R>
void fill_defaults(vm::InputBatch<R>& in) {
  for (const vm::VariableInfo& row : vm::kVariables) {
    if (!may_be_set(row.variable)) continue;
    std::vector<R> values(static_cast<std::size_t>(value_count(row.variable)), R(0));
    for (const Default& d : kDefaults)
      if (d.variable == row.variable)
        for (std::size_t c = 0; c < values.size(); ++c) values[c] = R(d.values[c]);
    fill_all<R>(in, row.variable, values);
  }
}

bool may_be_set(vm::Variable v) {
  const vm::VariableInfo& row = vm::info(v);
  return row.visibility == vm::Visibility::Public || row.slot_type() != vm::SlotType::Spectrum;
}

Result<vm::Variable> find_variable(std::string_view name) {
  std::vector<std::string> names;
  for (const vm::VariableInfo& row : vm::kVariables) {
    if (!may_be_set(row.variable)) continue;
    if (row.name == name) return row.variable;
    names.emplace_back(row.name);
  }
  const std::string near = lang::nearest(name, names);
  return Error{fmt::format("${}", name), "no variable of that name",
               near.empty() ? fmt::format("there are: {}", fmt::join(names, ", "))
                            : fmt::format("did you mean `{}`?", near)};
}

int value_count(vm::Variable v) {
  const vm::VariableInfo& row = vm::info(v);
  return row.slot_type() == vm::SlotType::Spectrum ? kWavelengths : row.components();
}

template <class R>
void fill(vm::InputBatch<R>& in, vm::Variable v, const R* values, std::size_t stride, int lanes) {
  fill_lanes(in, v, values, stride, 1, lanes);
}

template <class R>
void fill_all(vm::InputBatch<R>& in, vm::Variable v, std::span<const R> values) {
  fill_lanes(in, v, values.data(), 1, 0, in.width());
}

template void fill_defaults(vm::InputBatch<float>&);
template void fill_defaults(vm::InputBatch<double>&);
template void fill(vm::InputBatch<float>&, vm::Variable, const float*, std::size_t, int);
template void fill(vm::InputBatch<double>&, vm::Variable, const double*, std::size_t, int);
template void fill_all(vm::InputBatch<float>&, vm::Variable, std::span<const float>);
template void fill_all(vm::InputBatch<double>&, vm::Variable, std::span<const double>);

}  // namespace mms::api
