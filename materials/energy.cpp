// SPDX-License-Identifier: Apache-2.0
#include "materials/energy.h"

namespace mms::materials {

#include "energy_tables.inc"  // made by the build: materials/tables/energy.cpp

const FacetTables kGgxTables{kGgxLoss, kGgxMean, kGgxStretched, kGgxStretchedMean};
const FacetTables kBeckmannTables{kBeckmannLoss, kBeckmannMean, kBeckmannStretched,
                                  kBeckmannStretchedMean};
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
