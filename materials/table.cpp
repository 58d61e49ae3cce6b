// SPDX-License-Identifier: Apache-2.0
#include "materials/table.h"

#include "materials/rows.h"

namespace mms::materials {
namespace {

constexpr Formals kFormals[] = {
#define LOBE(name, signature, ...) formals(signature),
#include "materials/lobes.def"
#undef LOBE
};

}  // namespace

std::span<const vm::Builtin> rows() { return kRows; }

const Formals& formals(Lobe lobe) { return kFormals[static_cast<int>(lobe)]; }

}  // namespace mms::materials
