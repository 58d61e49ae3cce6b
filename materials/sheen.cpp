// SPDX-License-Identifier: Apache-2.0
#include "materials/sheen.h"

namespace mms::materials {

#include "materials/sheen_table.inc"  // made by materials/tables/sheen.cpp

}  // namespace mms::materials
