// SPDX-License-Identifier: Apache-2.0
#include "materials/glass_coat.h"

namespace mms::materials {

#include "glass_tables.inc"  // made by the build: materials/tables/glass.cpp

const GlassTables kGgxGlass{{kGgxRoundOutside, kGgxRoundInside}, {kGgxBentOutside, kGgxBentInside}};
const GlassTables kBeckmannGlass{{kBeckmannRoundOutside, kBeckmannRoundInside},
                                 {kBeckmannBentOutside, kBeckmannBentInside}};

}  // namespace mms::materials
