// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Names and arguments of every scattering model, phase function, emission shape and combiner:
/// the one table (lobes.def), as builtin rows whose result is `material`.

#include <span>
#include <string_view>

#include "vm/builtin.h"

namespace mms::materials {

/// One member for each row of lobes.def; `vm::Builtin::lobe` and `vm::LayoutNode::lobe` hold it.
enum class Lobe : int {
#define LOBE(name, ...) name,
#include "materials/lobes.def"
#undef LOBE
};

/// What a row of lobes.def says it can do, as bits.
enum Trait : unsigned {
  Reflects = 1,        ///< scatters to the side the path came from
  Transmits = 2,       ///< scatters to the other side
  Specular = 4,        ///< always a delta
  Polished = 8,        ///< a delta where its roughness (or gloss) argument says so
  Dispersive = 16,     ///< directions depend on wavelength
  Combiner = 32,       ///< weighs its material arguments
  PhaseFunction = 64,  ///< for volumes
};

inline constexpr unsigned kTraits[] = {
#define LOBE(name, signature, traits, ...) traits,
#include "materials/lobes.def"
#undef LOBE
};
inline constexpr int kLobeCount = static_cast<int>(std::size(kTraits));

/// The bits of `lobe`.
constexpr unsigned traits(Lobe lobe) { return kTraits[static_cast<int>(lobe)]; }

/// Kinds of the arguments of a row, in formal order: 'm'aterial, 's'pectrum or 'r'eal.
struct Formals {
  char kinds[8] = {};
  bool index[8] = {};  ///< a refractive index
  bool tint[8] = {};   ///< a colour (vm::is_colour)
  int count = 0;
};

/// Read off the signature: a type holds for the names after it up to the next type.
constexpr Formals formals(std::string_view signature) {
  Formals f;
  char kind = 0;
  std::string_view rest = signature.substr(signature.find('(') + 1);
  rest = rest.substr(0, rest.rfind(')'));
  while (!rest.empty()) {
    std::string_view item = rest.substr(0, rest.find(','));
    rest = item.size() < rest.size() ? rest.substr(item.size() + 1) : std::string_view{};
    while (item.starts_with(' ')) item.remove_prefix(1);
    for (std::string_view type : {"material ", "spectrum ", "real "})
      if (item.starts_with(type)) kind = type[0];
    if (item.empty()) continue;
    f.tint[f.count] = kind == 's' && vm::is_colour(item);
    f.index[f.count] = kind == 's' && item.find("ior") != item.npos;
    f.kinds[f.count++] = kind;
  }
  return f;
}

/// The arguments of `lobe`.
const Formals& formals(Lobe lobe);

/// The rows, in the order of lobes.def; row i has lobe i.
std::span<const vm::Builtin> rows();

}  // namespace mms::materials
