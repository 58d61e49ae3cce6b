// SPDX-License-Identifier: Apache-2.0
#include "materials/coated.h"

namespace mms::materials {

#include "coated_tables.inc"  // made by the build: materials/tables/coated.cpp

const CoatedTables kGgxCoated{
    {kGgxUnderTable0, kGgxUnderTable1, kGgxUnderTable2, kGgxUnderTable3, kGgxUnderTable4},
    kGgxCoatTable,
    {kGgxStretchedUnderTable0, kGgxStretchedUnderTable1, kGgxStretchedUnderTable2,
     kGgxStretchedUnderTable3},
    kGgxStretchedCoatTable,
    kGgxSpreadTable,
    kGgxStretchedSpreadTable,
    axes::kGgxSpreadAlpha};
const CoatedTables kBeckmannCoated{
    {kBeckmannUnderTable0, kBeckmannUnderTable1, kBeckmannUnderTable2, kBeckmannUnderTable3,
     kBeckmannUnderTable4},
    kBeckmannCoatTable,
    {kBeckmannStretchedUnderTable0, kBeckmannStretchedUnderTable1, kBeckmannStretchedUnderTable2,
     kBeckmannStretchedUnderTable3},
    kBeckmannStretchedCoatTable,
    kBeckmannSpreadTable,
    kBeckmannStretchedSpreadTable,
    axes::kBeckmannSpreadAlpha};
const CoatedTables kGlossyCoated{{kGlossyUnderTable0, kGlossyUnderTable1, kGlossyUnderTable2,
                                  kGlossyUnderTable3, kGlossyUnderTable4},
                                 kGlossyCoatTable,
                                 {},
                                 nullptr,
                                 kGlossySpreadTable,
                                 nullptr,
                                 0};
const CoatedTables kMatteCoated{
    {kMatteUnderTable0, kMatteUnderTable1, kMatteUnderTable2, kMatteUnderTable3, kMatteUnderTable4},
    nullptr,
    {},
    nullptr,
    kMatteSpreadTable,
    nullptr,
    0};

}  // namespace mms::materials
