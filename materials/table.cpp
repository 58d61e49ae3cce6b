// SPDX-License-Identifier: Apache-2.0
#include "materials/table.h"

namespace mms::materials {
namespace {

constexpr vm::Builtin kRows[] = {
#define LOBE(name, prototype, traits, documentation, expression) \
  {.signature = prototype,                                       \
   .module = "materials",                                        \
   .doc = documentation,                                         \
   .example = expression,                                        \
   .derivative = {},                                             \
   .cost = 0,                                                    \
   .lobe = static_cast<int>(Lobe::name)},
#include "materials/lobes.def"
#undef LOBE
};

constexpr Formals kFormals[] = {
#define LOBE(name, signature, ...) formals(signature),
#include "materials/lobes.def"
#undef LOBE
};

static_assert(std::size(kRows) == kLobeCount);

}  // namespace

std::span<const vm::Builtin> rows() { return kRows; }

const Formals& formals(Lobe lobe) { return kFormals[static_cast<int>(lobe)]; }

}  // namespace mms::materials
