// SPDX-License-Identifier: Apache-2.0
#include "materials/glass_coat.h"

namespace mms::materials {

#include "glass_tables.inc"  // made by the build: materials/tables/glass.cpp

const GlassTables kGgxGlass{
    {{kGgxRoundOutsideDense, kGgxRoundOutsideRare}, {kGgxRoundInsideDense, kGgxRoundInsideRare}},
    {{kGgxBentOutsideDense, kGgxBentOutsideRare}, {kGgxBentInsideDense, kGgxBentInsideRare}}};
const GlassTables kBeckmannGlass{{{kBeckmannRoundOutsideDense, kBeckmannRoundOutsideRare},
                                  {kBeckmannRoundInsideDense, kBeckmannRoundInsideRare}},
                                 {{kBeckmannBentOutsideDense, kBeckmannBentOutsideRare},
                                  {kBeckmannBentInsideDense, kBeckmannBentInsideRare}}};

}  // namespace mms::materials
