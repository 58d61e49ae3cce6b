// SPDX-License-Identifier: Apache-2.0
#include "renderer/enclosure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "renderer/shape.h"

namespace mms::renderer {
namespace {

using vm::Interval;
using vm::Variable;

/// An interval with room for the rounding of a point that is found along a ray.
Interval roomy(double low, double high) {
  const double room = 1e-4 * (high - low) + 1e-6 * std::max(std::abs(low), std::abs(high));
  return vm::reals(low - room, high + room);
}

/// How often a flight through the middle of a volume looks for coefficients that are not a number.
constexpr double kLeastCollisions = 4;

/// The inputs that any of `values` of an entry reads and that `box` does not fix.
std::vector<int> positions_read(const vm::Descriptor& d, std::span<const vm::Output> outputs) {
  std::uint32_t variables = 0;
  for (const vm::Output o : outputs) variables |= d.output(o).variables;
  std::vector<int> axes;
  for (const Variable v : {Variable::Position, Variable::ObjectPosition})
    if (variables >> int(v) & 1)
      for (int c = 0; c < 3; ++c) axes.push_back(vm::input_index(v, c));
  // Both at once would be a grid in six dimensions.
  if (axes.size() > 3) axes.resize(3);
  return axes;
}

/// The largest of `f(box)` over a grid.
template <class F>
double largest(const vm::Box& box, std::span<const int> axes, F f) {
  double most = -Interval::kInf;
  vm::each_part(box, axes, kRateCells, [&](const vm::Box& part) {
    most = std::max(most, f(part));
    return std::isfinite(most);
  });
  return most;
}

/// Says that points are in `world`.
void set_positions(vm::Box& box, const Bounds& world, const Transform& transform) {
  Bounds local;
  for (int corner = 0; corner < 8; ++corner)
    local.add(transform.inverse_point({corner & 1 ? world.high.x : world.low.x,
                                       corner & 2 ? world.high.y : world.low.y,
                                       corner & 4 ? world.high.z : world.low.z}));
  for (int k = 0; k < 3; ++k) {
    box.at(Variable::Position, k) = roomy(world.low[k], world.high[k]);
    box.at(Variable::ObjectPosition, k) = roomy(local.low[k], local.high[k]);
  }
}

/// `f(box)` for each of kRateCells^3 parts of the box around `o`.
template <class F>
std::vector<float> over_cells(const Object& o, F f) {
  constexpr int n = kRateCells;
  std::vector<float> values;
  for (int i = 0; i < n * n * n; ++i) {
    vm::Box box = box_of(o);
    set_positions(box, cell_of(bounds(o.shape), n, i), o.transform);
    values.push_back(f(box));
  }
  return values;
}

/// What a value of an entry is, as the function of that says or as it is a constant.
Interval enclosed(const vm::Program& program, const vm::ValueSource& v, const vm::Enclosure& e) {
  return v.constant ? vm::interval_of(program.constants[v.index]) : e.results[v.index];
}

}  // namespace

vm::Box box_of(const Object& o) {
  constexpr double kInf = Interval::kInf;
  vm::Box box = vm::Box::unit_sphere();
  set_positions(box, bounds(o.shape), o.transform);
  for (int k = 0; k < 3; ++k) {
    for (const Variable v : {Variable::ObjectTangent, Variable::ObjectBitangent,
                             Variable::NormalTangent, Variable::NormalBitangent})
      box.at(v, k) = {-kInf, kInf, false};
  }
  // The parameters of a mesh are its author's.
  if (std::holds_alternative<Mesh>(o.shape))
    for (int k = 0; k < 2; ++k) box.at(Variable::Uv, k) = {-kInf, kInf, false};
  return box;
}

RateGrid majorants_of(const vm::Program& program, const vm::Descriptor& d, const Object& o,
                      double bound) {
  vm::BoundsMachine machine(program);
  std::vector<bool> met;  // of the cells: whether a flight is to meet them, however thin
  std::vector<float> values = over_cells(o, [&](const vm::Box& box) {
    vm::Enclosure e;
    if (d.pass.function) e = machine.run(*d.pass.function, box);
    met.push_back(false);
    const auto most = [&](const vm::ValueSource& v) {
      const Interval r = enclosed(program, v, e);
      met.back() = met.back() || !r.has_number();  // to be told
      return std::max(r.hi, 0.0);                  // negative coefficients count as 0
    };
    const double found = most(d.pass.scattering) + most(d.pass.absorption);
    return std::min(float(vm::float_above(found)), float(bound));
  });
  const Bounds all = bounds(o.shape);
  const float least = std::max(*std::max_element(values.begin(), values.end()) / 4,
                               float(kLeastCollisions / length(all.high - all.low)));
  for (std::size_t i = 0; i < values.size(); ++i)
    if (met[i]) values[i] = std::max(values[i], least);
  return {all, kRateCells, std::move(values)};
}

std::vector<float> most_emission(const vm::Program& program, const vm::Descriptor& d,
                                 const Object& o) {
  vm::BoundsMachine machine(program);
  float brightest = 0;
  std::vector<float> values = over_cells(o, [&](const vm::Box& box) {
    vm::Enclosure e;
    if (d.emit.function) e = machine.run(*d.emit.function, box);
    const Interval r = enclosed(program, d.emit.emission, e);
    const float most = r.has_number() ? float(std::max(r.hi, 0.0)) : float(Interval::kInf);
    if (std::isfinite(most)) brightest = std::max(brightest, most);
    return most;
  });
  if (brightest == 0) brightest = 1;
  for (float& v : values) v = std::min(v, brightest);
  return values;
}

double largest_height(const vm::Program& program, const vm::Descriptor& d, const Object& o) {
  vm::BoundsMachine machine(program);
  constexpr std::array outputs = {vm::Output::Height};
  return largest(box_of(o), positions_read(d, outputs), [&](const vm::Box& part) {
    return vm::enclose(machine, program, d.displace, d.displace.height, part).hi;
  });
}

}  // namespace mms::renderer
