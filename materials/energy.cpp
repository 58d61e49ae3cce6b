// SPDX-License-Identifier: Apache-2.0
#include "materials/energy.h"

namespace mms::materials {
namespace {

#include "energy_tables.inc"  // made by the build: materials/tables/make.cpp

}  // namespace

const FacetTables kGgxTables{kGgxLoss, kGgxMean, kGgxStretched, kGgxStretchedMean};
const FacetTables kBeckmannTables{kBeckmannLoss, kBeckmannMean, kBeckmannStretched,
                                  kBeckmannStretchedMean};
const float* const kGlossyCoat = kGlossyCoatTable;
const float* const kGgxCoat = kGgxCoatTable;
const InterfaceTables kGgxInterface{{kGgxDense, kGgxRare}, {kGgxDenseMean, kGgxRareMean}};

}  // namespace mms::materials
