// SPDX-License-Identifier: Apache-2.0
#include "api/bounds.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "api/evaluation.h"
#include "api/handles.h"
#include "api/inputs.h"
#include "api/outputs.h"
#include "materials/table.h"

namespace mms::api {

namespace {

using vm::Interval;

constexpr double kInf = Interval::kInf;

/// The components of positions that an output reads and that are not points.
std::vector<int> axes_of(const vm::Descriptor& d, vm::Output output, const vm::Box& box) {
  // A gradient that was derived reads what the height reads.
  const std::uint32_t variables = d.output(output).variables;
  std::vector<int> axes;
  for (const vm::Variable v :
       {vm::Variable::Position, vm::Variable::ObjectPosition, vm::Variable::Uv})
    for (int c = 0; c < vm::info(v).components(); ++c)
      if ((variables >> static_cast<int>(v) & 1u) && box.at(v, c).width() > 0 &&
          !box.at(v, c).contains_infinity())
        axes.push_back(vm::input_index(v, c));
  return axes;
}

int affordable(int grid, std::size_t axes) {
  while (grid > 1 && std::pow(grid, double(axes)) > kMostParts) --grid;
  return grid;
}

/// Weighs light by node `k` and what is below it, at most.
class Weights {
 public:
  Weights(const vm::Program& program, const vm::MaterialLayout& layout, const vm::Enclosure& e)
      : program_(program), layout_(layout), enclosure_(e) {}

  double at(std::size_t k) const {
    using materials::Lobe;
    const vm::LayoutNode& node = layout_.nodes[k];
    switch (Lobe(node.lobe)) {
      case Lobe::Mix:
      case Lobe::FresnelMix:
      case Lobe::FilmMix:
      case Lobe::Coat:
      case Lobe::Layer:
        return std::max(at(node.children[0]), at(node.children[1]));
      case Lobe::Scale:
        return most(node, 0) * at(node.children[0]);
      case Lobe::Add:
        return at(node.children[0]) + at(node.children[1]);
      case Lobe::Turn:
      case Lobe::Tilt:
        return at(node.children[0]);
      default:
        return tint(node);
    }
  }

 private:
  /// Models keep to their colours; those without any lose at most all.
  double tint(const vm::LayoutNode& node) const {
    const materials::Formals& f = materials::formals(materials::Lobe(node.lobe));
    double bound = 0;
    bool any = false;
    for (int i = 0; i < f.count; ++i) {  // a model takes no materials: arguments are parameters
      if (!f.tint[i]) continue;
      bound = std::max(bound, most(node, std::size_t(i)));
      any = true;
    }
    return any ? bound : 1;
  }

  double most(const vm::LayoutNode& node, std::size_t param) const {
    const vm::ValueSource& v = node.params[param];
    const Interval i =
        v.constant ? vm::interval_of(program_.constants[v.index]) : enclosure_.results[v.index];
    return i.nan ? kInf : std::max(i.hi, 0.0);
  }
  const vm::Program& program_;
  const vm::MaterialLayout& layout_;
  const vm::Enclosure& enclosure_;
};

}  // namespace

Result<vm::Variable> set_box(vm::Box& box, std::string_view name, std::span<const double> lo,
                             std::span<const double> hi) {
  if (name.starts_with('$')) name.remove_prefix(1);
  const Result<vm::Variable> v = find_variable(name);
  if (!v) return v;
  const auto components = static_cast<std::size_t>(vm::info(*v).components());
  if (lo.size() != hi.size() || (lo.size() != components && lo.size() != 1))
    return Error{
        std::string(name), fmt::format("{} intervals", lo.size()),
        fmt::format("it takes {}{}", components, components > 1 ? ", or one for all" : "")};
  for (std::size_t c = 0; c < components; ++c) {
    const double from = lo[lo.size() == 1 ? 0 : c], to = hi[hi.size() == 1 ? 0 : c];
    if (!(from <= to))
      return Error{std::string(name), fmt::format("[{}, {}] is no interval", from, to),
                   "the lower end comes first"};
    box.at(*v, static_cast<int>(c)) = vm::reals(from, to);
  }
  return v;
}

OutputBounds output_bounds(const vm::Program& program, const vm::Descriptor& d, vm::Output output,
                           const vm::Box& box, int grid) {
  OutputBounds all;
  const auto sources = number_sources(d, output);
  if (!sources) return all;
  vm::BoundsMachine machine(program);
  all.values.assign(sources->sources.size(), Interval::empty());
  const std::vector<int> axes = axes_of(d, output, box);
  vm::each_part(box, axes, affordable(grid, axes.size()), [&](const vm::Box& part) {
    vm::Enclosure e;
    if (sources->entry->function) e = machine.run(*sources->entry->function, part);
    all.widened |= e.widened;
    for (std::size_t k = 0; k < sources->sources.size(); ++k) {
      const vm::ValueSource& v = sources->sources[k];
      all.values[k] = join(all.values[k], v.constant ? vm::interval_of(program.constants[v.index])
                                                     : e.results[v.index]);
    }
    return true;
  });
  return all;
}

double largest_weight(const vm::Program& program, const vm::Descriptor& d) {
  constexpr int grid = 8;
  const vm::MaterialLayout& layout = d.shade.material;
  if (layout.nodes.empty()) return 0;
  vm::BoundsMachine machine(program);
  const vm::Box box = vm::Box::unit_sphere();
  const auto weight = [&](const vm::Box& part) {
    vm::Enclosure e;
    if (d.shade.function) e = machine.run(*d.shade.function, part);
    return Weights(program, layout, e).at(layout.nodes.size() - 1);
  };
  const double whole = weight(box);
  if (whole <= 1 || !d.shade.function) return whole;
  const std::vector<int> axes = axes_of(d, vm::Output::Material, box);
  if (axes.size() > 3) return whole;
  double most = 0;
  vm::each_part(box, axes, grid, [&](const vm::Box& part) {
    most = std::max(most, weight(part));
    return most < whole;
  });
  return std::min(most, whole);
}

}  // namespace mms::api

using namespace mms;

namespace {

template <class Handle>
int bound(MMsContext* context, const Handle* handle, const char* output, const MMsInterval* box,
          size_t count, int grid, float* lo, float* hi) {
  if (!context || !handle || !output || (!box && count) || !lo || !hi) return 0;
  return api::guarded(context->messages, [&] {
    const MMsPoints none{0, nullptr, 0};
    api::Evaluation evaluation(*context, none);
    if (!evaluation.of_this_program(handle->owner)) return false;
    const vm::Descriptor& d = *handle->descriptor;
    vm::Box domain = vm::Box::unit_sphere();
    for (size_t k = 0; k < count; ++k) {
      if (!box[k].name || !box[k].lo || !box[k].hi)
        return evaluation.complain({"box", "an interval without name or ends", "give all three"});
      const Result<vm::Variable> v = api::find_variable(box[k].name);
      if (!v) return evaluation.complain(v.error());
      const int n = vm::info(*v).components();
      const std::vector<double> low(box[k].lo, box[k].lo + n), high(box[k].hi, box[k].hi + n);
      if (const auto set = api::set_box(domain, box[k].name, low, high); !set)
        return evaluation.complain(set.error());
    }
    const auto found = api::find_output(d.form, output);
    const api::OutputBounds r = found ? api::output_bounds(context->linked->linked.program, d,
                                                           *found, domain, std::max(grid, 1))
                                      : api::OutputBounds{};
    if (r.values.empty())
      return evaluation.complain(
          {output, "no output that is made of numbers",
           "try height, gradient, bound, scattering, absorption or emission"});
    for (size_t k = 0; k < r.values.size(); ++k) {
      const bool any = r.values[k].nan;
      lo[k] = any ? -HUGE_VALF : float(r.values[k].lo);
      hi[k] = any ? HUGE_VALF : float(r.values[k].hi);
    }
    return true;
  });
}

}  // namespace

int mmsBoundSurface(MMsContext* context, const MMsSurface* surface, const char* output,
                    const MMsInterval* box, size_t box_count, int grid, float* lo, float* hi) {
  return bound(context, surface, output, box, box_count, grid, lo, hi);
}

int mmsBoundVolume(MMsContext* context, const MMsVolume* volume, const char* output,
                   const MMsInterval* box, size_t box_count, int grid, float* lo, float* hi) {
  return bound(context, volume, output, box, box_count, grid, lo, hi);
}
