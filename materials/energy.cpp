// SPDX-License-Identifier: Apache-2.0
#include "materials/energy.h"

#include "materials/coated.h"

namespace mms::materials {
namespace {

#include "coated_tables.inc"  // made by the build: materials/tables/coated.cpp
#include "energy_tables.inc"  // made by the build: materials/tables/energy.cpp

}  // namespace

const FacetTables kGgxTables{kGgxLoss, kGgxMean, kGgxStretched, kGgxStretchedMean};
const FacetTables kBeckmannTables{kBeckmannLoss, kBeckmannMean, kBeckmannStretched,
                                  kBeckmannStretchedMean};
const CoatTables kGgxCoat{kGgxCoatTable, kGgxStretchedCoatTable, &kGgxCoated};
const CoatTables kBeckmannCoat{kBeckmannCoatTable, kBeckmannStretchedCoatTable, &kBeckmannCoated};
const CoatTables kGlossyCoat{kGlossyCoatTable, nullptr, &kGlossyCoated};
const CoatedTables kGgxCoated{kGgxCoatedTable, kGgxStretchedCoatedTable, kGgxSpreadTable};
const CoatedTables kBeckmannCoated{kBeckmannCoatedTable, kBeckmannStretchedCoatedTable,
                                   kBeckmannSpreadTable};
const CoatedTables kGlossyCoated{kGlossyCoatedTable, nullptr, kGlossySpreadTable};
const CoatedTables kMatteCoated{kMatteCoatedTable, nullptr, kMatteSpreadTable};
const float* const kFresnelProduct = kFresnelProductTable;
const InterfaceTables kGgxInterface{{kGgxDense, kGgxRare},
                                    {kGgxDenseMean, kGgxRareMean},
                                    kGgxBent,
                                    {kGgxDenseStretched, kGgxRareStretched},
                                    {kGgxDenseStretchedMean, kGgxRareStretchedMean},
                                    kGgxLeastMean,
                                    kGgxKink};
const InterfaceTables kBeckmannInterface{{kBeckmannDense, kBeckmannRare},
                                         {kBeckmannDenseMean, kBeckmannRareMean},
                                         kBeckmannBent,
                                         {kBeckmannDenseStretched, kBeckmannRareStretched},
                                         {kBeckmannDenseStretchedMean, kBeckmannRareStretchedMean},
                                         kBeckmannLeastMean,
                                         kBeckmannKink};

}  // namespace mms::materials
