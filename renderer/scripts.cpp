// SPDX-License-Identifier: Apache-2.0
#include "renderer/scripts.h"

#include <algorithm>

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
  if (!entry.function || points.empty()) return;
  const std::uint32_t variables = compiled_->of(&d).all_variables;
  for (int lane = 0; lane < int(points.size()); ++lane) fill(*points[lane], lane, variables);
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

void Scripts::put(Variable v, int lane, Vec3d value) {
  inputs_->lanes(v, 0)[lane] = float(value.x);
  inputs_->lanes(v, 1)[lane] = float(value.y);
  inputs_->lanes(v, 2)[lane] = float(value.z);
}

void Scripts::fill(const ScriptPoint& p, int lane, std::uint32_t variables) {
  const auto put2 = [&](Variable v, const std::array<double, 2>& value) {
    inputs_->lanes(v, 0)[lane] = float(value[0]);
    inputs_->lanes(v, 1)[lane] = float(value[1]);
  };
  const auto put_spectrum = [&](Variable v, const Spectrumf& s, float scale) {
    for (int k = 0; k < kWavelengths; ++k) inputs_->lanes(v, k)[lane] = s[k] * scale;
  };
  const SurfacePoint& s = p.surface;
  const Transform& to_world = p.object->transform;
  for (std::uint32_t left = variables; left != 0; left &= left - 1) {
    const auto v = Variable(__builtin_ctz(left));
    switch (v) {
      case Variable::Position:
        put(v, lane, s.position);
        break;
      case Variable::ObjectPosition:
        put(v, lane, to_world.inverse_point(s.position));
        break;
      case Variable::Normal:
        put(v, lane, s.normal);
        break;
      case Variable::GeometricNormal:
        put(v, lane, s.geometric_normal);
        break;
      case Variable::Tangent:
        put(v, lane, s.tangent);
        break;
      case Variable::Bitangent:
        put(v, lane, s.bitangent);
        break;
      case Variable::Uv:
        put2(v, s.uv);
        break;
      case Variable::View:
        put(v, lane, p.view);
        break;
      case Variable::Distance:
        inputs_->lanes(v)[lane] = float(p.distance);
        break;
      case Variable::Footprint: {
        // Where the pixel's edges, carried along the ray, meet the tangent plane; a grazing ray
        // stretches them by at most 1 / 0.05.
        const double c = dot(p.view, s.normal);
        const double held = std::copysign(std::max(std::abs(c), 0.05), c);
        const auto column = [&](Vec3d axis) {
          const Vec3d step = (axis - p.view * (dot(axis, s.normal) / held)) * p.cone;
          return std::array<double, 2>{dot(step, s.tangent), dot(step, s.bitangent)};
        };
        const auto x = column(p.screen_x), y = column(p.screen_y);
        const double m[4] = {x[0], y[0], x[1], y[1]};  // [row, column], row by row
        for (int k = 0; k < 4; ++k) inputs_->lanes(v, k)[lane] = float(m[k]);
        break;
      }
      case Variable::Time:
        inputs_->lanes(v)[lane] = 0;
        break;
      case Variable::Wavelength:
        put_spectrum(v, p.cluster->lambda.nm, 1e-9f);
        break;
      case Variable::RgbRed:
        put_spectrum(v, p.cluster->red, 1);
        break;
      case Variable::RgbGreen:
        put_spectrum(v, p.cluster->green, 1);
        break;
      case Variable::ObjectTangent:
        put(v, lane, to_world.inverse_step(s.tangent));
        break;
      case Variable::ObjectBitangent:
        put(v, lane, to_world.inverse_step(s.bitangent));
        break;
      case Variable::NormalTangent:
        put(v, lane, s.normal_tangent);
        break;
      case Variable::NormalBitangent:
        put(v, lane, s.normal_bitangent);
        break;
      case Variable::UvTangent:
        put2(v, s.uv_tangent);
        break;
      case Variable::UvBitangent:
        put2(v, s.uv_bitangent);
        break;
      case Variable::Count:
        break;
    }
  }
}

}  // namespace mms::renderer
