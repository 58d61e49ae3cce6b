// SPDX-License-Identifier: Apache-2.0
#include "materials/glass_coat.h"

namespace mms::materials {
namespace {

#include "glass_tables.inc"  // made by the build: materials/tables/glass.cpp

}  // namespace

const GlassTables kGgxGlass{{kGgxOutside, kGgxInside}, {kGgxBentOutside, kGgxBentInside}};
const GlassTables kBeckmannGlass{{kBeckmannOutside, kBeckmannInside},
                                 {kBeckmannBentOutside, kBeckmannBentInside}};

}  // namespace mms::materials
