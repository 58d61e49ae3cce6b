// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A linked program in its portable form: typed stack bytecode, and what the linker found out
/// about every descriptor. A value: copied, compared and stored freely. It may run only after
/// `verify` has passed it and `lower` has prepared it.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "vm/builtin.h"
#include "vm/images.h"
#include "vm/types.h"
#include "vm/variables.h"

namespace mms::vm {

enum class Op : std::uint8_t {
#define OP(name, ...) name,
#include "vm/opcodes.def"
#undef OP
};

enum class OperandForm : std::uint8_t {
  None,
  Constant,
  Input,
  Local,
  BlockType,
  Function,
  Builtin,
  Wavelength  ///< number of a wavelength of the path
};

struct OpInfo {
  std::string_view name;
  OperandForm operand;
  std::string_view pops, pushes;
  int cost;
  std::string_view derivative, doc;
};

inline constexpr OpInfo kOps[] = {
#define OP(name, operand, pops, pushes, cost, derivative, doc) \
  OpInfo{#name, OperandForm::operand, pops, pushes, cost, derivative, doc},
#include "vm/opcodes.def"
#undef OP
};
inline constexpr int kOpCount = static_cast<int>(std::size(kOps));
constexpr const OpInfo& info(Op op) { return kOps[static_cast<std::size_t>(op)]; }

struct Instruction {
  Op op;
  std::uint32_t a = 0, b = 0;
  friend bool operator==(const Instruction&, const Instruction&) = default;
};

/// Where code came from: an index into `Program::sources`, a 1-based line (0: nowhere) and a
/// 1-based column in bytes (0: not known).
struct SourceLine {
  std::uint32_t source = 0, line = 0, column = 0;
  friend bool operator==(const SourceLine&, const SourceLine&) = default;
};

/// A constant holds what either machine needs: both are folded with their own kernels, so the
/// double machine never sees a constant that was rounded to float.
struct Constant {
  SlotType type = SlotType::Real;
  float f32 = 0;
  double f64 = 0;
  std::int32_t integer = 0;  ///< Integer, and Logic as 0 or 1
  friend bool operator==(const Constant&, const Constant&) = default;
};  // a constant Spectrum is PushConst of a Real and Splat

struct Function {
  std::string name;
  std::vector<SlotType> params, results;
  std::vector<SlotType> locals;  ///< parameters first
  std::vector<Instruction> code;
  std::vector<SourceLine> lines;  ///< one for each instruction
  friend bool operator==(const Function&, const Function&) = default;
};

/// Where the machine or the layout of a material finds a value.
struct ValueSource {
  SlotType type = SlotType::Real;
  bool constant = true;  ///< then `index` is a constant (a Real one is splatted for a
                         ///< Spectrum), else a result of the entry's function
  std::uint32_t index = 0;
  friend bool operator==(const ValueSource&, const ValueSource&) = default;
};

/// One lobe or combiner of a material, with everything resolved but the numbers.
struct LayoutNode {
  int lobe = 0;                         ///< materials/table.h
  std::vector<ValueSource> params;      ///< non-material arguments, flattened, in formal order
  std::vector<std::uint32_t> children;  ///< nodes that are its material arguments
  friend bool operator==(const LayoutNode&, const LayoutNode&) = default;
};

/// A material expression, compiled away to a static tree. Children precede their parent; the
/// root is the last node.
struct MaterialLayout {
  std::vector<LayoutNode> nodes;
  friend bool operator==(const MaterialLayout&, const MaterialLayout&) = default;
};

/// One way to run a descriptor: which outputs it computes, and where each is found.
/// An entry whose every value is constant has no function and is never executed.
struct Entry {
  std::optional<std::uint32_t> function;
  ValueSource scattering, absorption, emission;  ///< Spectrum
  ValueSource height, bound;                     ///< Real
  ValueSource gradient[2];                       ///< Real
  MaterialLayout material;                       ///< bsdf or phase
  MaterialLayout emission_material;
  friend bool operator==(const Entry&, const Entry&) = default;
};

/// The outputs of a descriptor, for `Descriptor::outputs`.
enum class Output : std::uint8_t {
  Material,
  Scattering,
  Absorption,
  EmissionMaterial,
  Emission,
  Height,
  Gradient,
  Bound,
  Count
};

struct OutputInfo {
  bool stated = false;    ///< the author wrote it (or it was derived: `gradient` from `height`)
  bool constant = true;   ///< the same everywhere
  bool spectral = false;  ///< reads `$wavelength` or a spectrum that depends on it
  std::uint32_t variables = 0;  ///< bit v: reads Variable v
  friend bool operator==(const OutputInfo&, const OutputInfo&) = default;
};

enum class DescriptorForm : std::uint8_t { Surface, Volume };

struct Descriptor {
  DescriptorForm form = DescriptorForm::Surface;
  std::string name;
  SourceLine line;
  Entry shade;     ///< every output but `height` and `bound`: what a path vertex needs
  Entry pass;      ///< scattering and absorption: what a shadow ray needs
  Entry emit;      ///< emission and emission_function: what sampling an emitter needs
  Entry displace;  ///< height and bound
  OutputInfo outputs[static_cast<std::size_t>(Output::Count)];
  const OutputInfo& output(Output o) const { return outputs[static_cast<std::size_t>(o)]; }
  friend bool operator==(const Descriptor&, const Descriptor&) = default;
};

/// A function or constant visible from outside by name, for `mms eval` and embedding.
struct Export {
  std::string name;
  std::string type;        ///< result type in the language's syntax
  std::uint32_t function;  ///< without parameters
  friend bool operator==(const Export&, const Export&) = default;
};

struct Program {
  std::vector<std::string> sources;  ///< names of the files
  std::vector<Constant> constants;
  std::vector<std::vector<SlotType>> block_types;
  std::vector<Function> functions;
  std::vector<const Builtin*> builtins;  ///< borrowed from the library, which outlives it
  std::vector<std::vector<SlotType>> builtin_params, builtin_results;  ///< flattened signatures
  std::vector<Descriptor> descriptors;
  std::vector<Export> exports;
  std::vector<ProgramImage> images;  ///< what rows that look pictures up call by number

  /// The descriptor with that form and name, or null.
  const Descriptor* find(DescriptorForm form, std::string_view name) const {
    for (const Descriptor& d : descriptors)
      if (d.form == form && d.name == name) return &d;
    return nullptr;
  }
  friend bool operator==(const Program&, const Program&) = default;
};

/// One `param` of the scripts, as an authoring tool shows it. The machine has no use for it.
struct ParamInfo {
  std::string name, type, doc, label, unit, page;
  std::vector<double> value;  ///< flattened
  std::optional<std::pair<double, double>> range;
  friend bool operator==(const ParamInfo&, const ParamInfo&) = default;
};

}  // namespace mms::vm
