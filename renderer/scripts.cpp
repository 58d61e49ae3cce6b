// SPDX-License-Identifier: Apache-2.0
#include "renderer/scripts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace mms::renderer {
namespace {

using vm::Output;
using vm::Variable;

constexpr std::uint32_t bit(Variable v) { return 1u << int(v); }

/// What is the same wherever a path goes: its wavelengths and the time.
constexpr std::uint32_t kPlaceless = bit(Variable::Wavelength) | bit(Variable::RgbRed) |
                                     bit(Variable::RgbGreen) | bit(Variable::Time);

bool constant_equal(const vm::Program& p, const vm::ValueSource& v, float value) {
  return v.constant && p.constants[v.index].f32 == value;
}

const vm::ValueSource* index_of(const vm::MaterialLayout& material) {
  for (const vm::LayoutNode& node : material.nodes) {
    const auto lobe = materials::Lobe(node.lobe);
    const materials::Formals& formals = materials::formals(lobe);
    if (!(materials::traits(lobe) & materials::Dispersive)) continue;
    for (int i = 0; i < formals.count; ++i)  // no argument of such a lobe is a material
      if (formals.index[i]) return &node.params[std::size_t(i)];
  }
  return nullptr;
}

bool placeless(const vm::OutputInfo& o) { return (o.variables & ~kPlaceless) == 0; }

CompiledDescriptor compile(const vm::Program& p, const vm::Descriptor& d) {
  CompiledDescriptor c;
  c.descriptor = &d;
  c.material = materials::Layout(d.shade.material);
  c.shade_emission = materials::Layout(d.shade.emission_material);
  c.emit_emission = materials::Layout(d.emit.emission_material);
  for (const vm::OutputInfo& o : d.outputs) c.all_variables |= o.variables;
  c.emits = !constant_equal(p, d.shade.emission, 0);
  c.bumps =
      !constant_equal(p, d.shade.gradient[0], 0) || !constant_equal(p, d.shade.gradient[1], 0);
  c.index = index_of(d.shade.material);
  c.placeless_material = placeless(d.output(Output::Material));
  c.constant_material = true;
  for (const vm::LayoutNode& node : d.shade.material.nodes)
    for (const vm::ValueSource& v : node.params) c.constant_material &= v.constant;
  if (d.form == vm::DescriptorForm::Surface) {
    c.semi_transparent = !constant_equal(p, d.shade.scattering, 1);
  } else {
    c.homogeneous = placeless(d.output(Output::Scattering)) &&
                    placeless(d.output(Output::Absorption)) &&
                    placeless(d.output(Output::Emission));
    if (d.displace.bound.constant) c.majorant = p.constants[d.displace.bound.index].f64;
  }
  return c;
}

}  // namespace

const vm::Entry& entry_of(const vm::Descriptor& d, EntryKind kind) {
  switch (kind) {
    case EntryKind::Shade:
      return d.shade;
    case EntryKind::Pass:
      return d.pass;
    case EntryKind::Emit:
      return d.emit;
    case EntryKind::Displace:
      break;
  }
  return d.displace;
}

Compiled::Compiled(const vm::Program& program) : program_(&program) {
  bool any_code = false;
  for (const vm::Descriptor& d : program.descriptors) {
    all_.push_back(compile(program, d));
    any_code |= d.shade.function || d.pass.function || d.emit.function;
    max_params_ = std::max({max_params_, all_.back().material.param_count(),
                            all_.back().shade_emission.param_count(),
                            all_.back().emit_emission.param_count()});
  }
  if (any_code) executable_ = std::make_unique<vm::Executable>(program);
}

Scripts::Scripts(const Compiled& compiled) : compiled_(&compiled) {
  if (!compiled.executable()) return;
  machine_ = std::make_unique<vm::Interpreter<float>>(compiled.width());
  inputs_ = std::make_unique<vm::InputBatch<float>>(compiled.width());
}

void Scripts::run(const vm::Descriptor& d, EntryKind kind,
                  std::span<const ScriptPoint* const> points) {
  given_up_.clear();
  const vm::Entry& entry = entry_of(d, kind);
  if (points.empty()) return;
  if (!entry.function) {
    if (watching_) inspect(d, entry, 1);
    return;
  }
  const std::uint32_t variables = compiled_->of(&d).all_variables;
  fill(points, variables);
  machine_->run(*compiled_->executable(), *entry.function, *inputs_, int(points.size()));
  ++counters_.runs;
  counters_.points += points.size();
  counters_.pass_runs += kind == EntryKind::Pass;
  counters_.emission_runs += kind == EntryKind::Emit;
  counters_.medium_runs += d.form == vm::DescriptorForm::Volume;
  for (const vm::Fault& f : machine_->faults()) {
    given_up_.resize(points.size());
    given_up_[f.lane] = true;
    ++faults_[{f.line.source, f.line.line, f.cause}];
    ++fault_lanes_;
  }
  if (watching_) inspect(d, entry, int(points.size()));
}

float Scripts::real(const vm::ValueSource& v, int lane) const {
  if (v.constant) return compiled_->program().constants[v.index].f32;
  return machine_->result(int(v.index))[lane];
}

Spectrumf Scripts::spectrum(const vm::ValueSource& v, int lane) const {
  if (v.constant || v.type != vm::SlotType::Spectrum) return Spectrumf(real(v, lane));
  Spectrumf s;
  for (int k = 0; k < kWavelengths; ++k) s[k] = machine_->result(int(v.index), k)[lane];
  return s;
}

void Scripts::params(const vm::MaterialLayout& layout, int lane, float* out) const {
  for (const vm::LayoutNode& node : layout.nodes) {
    const materials::Formals& formals = materials::formals(materials::Lobe(node.lobe));
    std::size_t next = 0;
    for (int i = 0; i < formals.count; ++i) {
      if (formals.kinds[i] == 'm') continue;
      const vm::ValueSource& v = node.params[next++];
      if (formals.kinds[i] == 's') {
        const Spectrumf s = spectrum(v, lane);
        out = std::copy(s.v.begin(), s.v.end(), out);
      } else {
        *out++ = real(v, lane);
      }
    }
  }
}

namespace {

/// Change along the surface (tangent, bitangent) for a pixel's width along each axis of the
/// picture: where its edges, carried along the ray, meet the tangent plane; a grazing ray stretches
/// them by at most 1 / 0.05. Row by row.
std::array<double, 4> footprint(const ScriptPoint& p) {
  const SurfacePoint& s = p.surface;
  const double c = dot(p.view, s.normal);
  const double held = std::copysign(std::max(std::abs(c), 0.05), c);
  const auto step = [&](Vec3d axis) {
    return (axis - p.view * (dot(axis, s.normal) / held)) * p.cone;
  };
  const Vec3d x = step(p.screen_x), y = step(p.screen_y);
  return {dot(x, s.tangent), dot(y, s.tangent), dot(x, s.bitangent), dot(y, s.bitangent)};
}

std::array<double, 3> triple(Vec3d v) { return {v.x, v.y, v.z}; }

}  // namespace

/// One variable for all points: `value` makes its numbers.
template <class F>
void Scripts::put(Variable v, std::span<const ScriptPoint* const> points, F value) {
  constexpr std::size_t kCount = std::tuple_size_v<decltype(value(*points[0]))>;
  float* const first = inputs_->lanes(v, 0);
  const std::ptrdiff_t stride = inputs_->width();
  for (std::size_t lane = 0; lane < points.size(); ++lane) {
    const auto numbers = value(*points[lane]);
    for (std::size_t k = 0; k < kCount; ++k)
      first[std::ptrdiff_t(k) * stride + std::ptrdiff_t(lane)] = float(numbers[k]);
  }
}

void Scripts::fill(std::span<const ScriptPoint* const> points, std::uint32_t variables) {
  using P = const ScriptPoint&;
  for (std::uint32_t left = variables; left != 0; left &= left - 1) {
    const auto v = Variable(__builtin_ctz(left));
    const auto number = [&](auto f) {
      put(v, points, [&](P p) { return std::array<double, 1>{double(f(p))}; });
    };
    const auto vector = [&](auto f) { put(v, points, [&](P p) { return triple(f(p)); }); };
    const auto world_vector = [&](Vec3d SurfacePoint::*member) {
      vector([&](P p) { return p.surface.*member; });
    };
    const auto object_step = [&](Vec3d SurfacePoint::*member) {
      vector([&](P p) { return p.object->transform.inverse_step(p.surface.*member); });
    };
    const auto pair = [&](std::array<double, 2> SurfacePoint::*member) {
      put(v, points, [&](P p) { return p.surface.*member; });
    };
    switch (v) {
      case Variable::Position:
        world_vector(&SurfacePoint::position);
        break;
      case Variable::ObjectPosition:
        vector([](P p) { return p.object->transform.inverse_point(p.surface.position); });
        break;
      case Variable::Normal:
        world_vector(&SurfacePoint::normal);
        break;
      case Variable::GeometricNormal:
        world_vector(&SurfacePoint::geometric_normal);
        break;
      case Variable::Tangent:
        world_vector(&SurfacePoint::tangent);
        break;
      case Variable::Bitangent:
        world_vector(&SurfacePoint::bitangent);
        break;
      case Variable::Uv:
        pair(&SurfacePoint::uv);
        break;
      case Variable::View:
        vector([](P p) { return p.view; });
        break;
      case Variable::Distance:
        number([](P p) { return p.distance; });
        break;
      case Variable::Footprint:
        put(v, points, footprint);
        break;
      case Variable::Time:
        number([](P) { return 0; });
        break;
      case Variable::Wavelength:
        put(v, points, [](P p) { return (p.cluster->lambda.nm * 1e-9f).v; });
        break;
      case Variable::RgbRed:
        put(v, points, [](P p) { return p.cluster->red.v; });
        break;
      case Variable::RgbGreen:
        put(v, points, [](P p) { return p.cluster->green.v; });
        break;
      case Variable::ObjectTangent:
        object_step(&SurfacePoint::tangent);
        break;
      case Variable::ObjectBitangent:
        object_step(&SurfacePoint::bitangent);
        break;
      case Variable::NormalTangent:
        world_vector(&SurfacePoint::normal_tangent);
        break;
      case Variable::NormalBitangent:
        world_vector(&SurfacePoint::normal_bitangent);
        break;
      case Variable::UvTangent:
        pair(&SurfacePoint::uv_tangent);
        break;
      case Variable::UvBitangent:
        pair(&SurfacePoint::uv_bitangent);
        break;
      case Variable::Count:
        break;
    }
  }
}

}  // namespace mms::renderer
