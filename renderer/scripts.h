// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Runs descriptors over batches of points: the only place where the renderer meets the machine.
/// `Compiled` is made once and shared; `Scripts` is one thread's.

#include <algorithm>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "materials/layout.h"
#include "renderer/cluster.h"
#include "renderer/render.h"
#include "renderer/scene.h"
#include "vm/interpreter.h"
#include "vm/program.h"

namespace mms::renderer {

/// A point that a script can be asked about.
struct ScriptPoint {
  const Object* object = nullptr;
  const Cluster* cluster = nullptr;
  SurfacePoint surface;      ///< in a volume only the position is meaningful
  Vec3d view;                ///< unit, towards where the path came from
  double distance = 0;       ///< length of the ray that came here, m
  double cone = 0;           ///< width of the pixel here, across the ray, m
  Vec3d screen_x, screen_y;  ///< world directions of the picture's axes, unit
};

/// What is known of a descriptor before any run.
struct CompiledDescriptor {
  const vm::Descriptor* descriptor = nullptr;
  materials::Layout material;        ///< bsdf or phase, of `shade`
  materials::Layout shade_emission;  ///< emission_function, of `shade`
  materials::Layout emit_emission;   ///< emission_function, of `emit`
  std::uint32_t all_variables = 0;   ///< that any output reads
  bool emits = false;                ///< emission is not constant zero
  bool semi_transparent = false;     ///< a surface whose scattering is not constant 1
  bool homogeneous = false;          ///< a volume whose coefficients do not depend on the place
  bool constant_material = false;    ///< no number of `material` depends on a run
  bool placeless_material = false;   ///< none depends on where
  /// Refractive index, inside over outside, of the first lobe that has one, of `shade`; or null.
  const vm::ValueSource* index = nullptr;
  bool bumps = false;   ///< gradient is not constant zero
  double majorant = 0;  ///< stated bound of a heterogeneous volume, 1/m
};

class Compiled {
 public:
  /// \pre `program` is verified; it outlives this.
  explicit Compiled(const vm::Program& program);

  const vm::Program& program() const { return *program_; }
  const CompiledDescriptor& of(const vm::Descriptor* d) const {
    return all_[d - program_->descriptors.data()];
  }
  /// Null where no entry has code.
  const vm::Executable* executable() const { return executable_.get(); }
  /// Points of a full batch.
  int width() const { return executable_ ? std::min(executable_->width(), kBatch) : kBatch; }
  int max_params() const { return max_params_; }

 private:
  /// The machine takes a few percent longer over a point in batches of 128 than of 512, but a
  /// wavefront of some thousand rays fills them.
  static constexpr int kBatch = 128;
  const vm::Program* program_;
  std::vector<CompiledDescriptor> all_;
  std::unique_ptr<vm::Executable> executable_;
  int max_params_ = 1;
};

struct ScriptCounters {
  std::uint64_t runs = 0, points = 0, pass_runs = 0, emission_runs = 0, medium_runs = 0;
};

enum class EntryKind : std::uint8_t { Shade, Pass, Emit, Displace };
const vm::Entry& entry_of(const vm::Descriptor& d, EntryKind kind);

class Scripts {
 public:
  explicit Scripts(const Compiled& compiled);

  /// Runs an entry for `points`, at most `width()` of them; an entry without code is not run.
  /// The answers below hold until the next call.
  void run(const vm::Descriptor& d, EntryKind kind, std::span<const ScriptPoint* const> points);
  int width() const { return compiled_->width(); }
  /// Stands in for a run where only constants will be asked for.
  void rest() { given_up_.clear(); }

  float real(const vm::ValueSource& v, int lane) const;
  Spectrumf spectrum(const vm::ValueSource& v, int lane) const;
  /// Numbers of a material in the order of materials/layout.h.
  void params(const vm::MaterialLayout& layout, int lane, float* out) const;
  /// Whether the last run gave the lane up: then its outputs have their defaults.
  bool given_up(int lane) const { return !given_up_.empty() && given_up_[lane]; }

  /// From now on looks for outputs that are not finite; `not_finite` has the first of each
  /// descriptor.
  void watch() { watching_ = true; }
  const std::map<const vm::Descriptor*, NotFinite>& not_finite() const { return not_finite_; }

  const ScriptCounters& counters() const { return counters_; }
  /// Lanes given up so far, by line and cause.
  struct FaultPlace {
    std::uint32_t source, line;
    vm::Fault::Cause cause;
    auto operator<=>(const FaultPlace&) const = default;
  };
  const std::map<FaultPlace, std::uint64_t>& faults() const { return faults_; }
  std::uint64_t fault_lanes() const { return fault_lanes_; }

 private:
  void fill(std::span<const ScriptPoint* const> points, std::uint32_t variables);
  void inspect(const vm::Descriptor& d, const vm::Entry& entry, int lanes);
  std::string settings(const vm::Descriptor& d, int lane, int wavelength) const;
  template <class F>
  void put(vm::Variable v, std::span<const ScriptPoint* const> points, F value);

  const Compiled* compiled_;
  std::unique_ptr<vm::Interpreter<float>> machine_;
  std::unique_ptr<vm::InputBatch<float>> inputs_;
  std::vector<bool> given_up_;
  bool watching_ = false;
  std::map<const vm::Descriptor*, NotFinite> not_finite_;
  ScriptCounters counters_;
  std::map<FaultPlace, std::uint64_t> faults_;
  std::uint64_t fault_lanes_ = 0;
};

}  // namespace mms::renderer
