// SPDX-License-Identifier: Apache-2.0
#include "materials/glass_coat.h"

namespace mms::materials {

#include "glass_tables.inc"  // made by the build: materials/tables/glass.cpp

const GlassTables kGgxGlass{{kGgxSteepOutside, kGgxSteepInside},
                            {kGgxRestOutside, kGgxRestInside},
                            {kGgxBentSteepOutside, kGgxBentSteepInside},
                            {kGgxBentRestOutside, kGgxBentRestInside}};
const GlassTables kBeckmannGlass{{kBeckmannSteepOutside, kBeckmannSteepInside},
                                 {kBeckmannRestOutside, kBeckmannRestInside},
                                 {kBeckmannBentSteepOutside, kBeckmannBentSteepInside},
                                 {kBeckmannBentRestOutside, kBeckmannBentRestInside}};

}  // namespace mms::materials
