// SPDX-License-Identifier: Apache-2.0
#include "materials/phong_coat.h"

namespace mms::materials {

#include "phong_tables.inc"  // made by the build: materials/tables/phong.cpp

const PhongGlassTables kPhongGlass{kPhong, kLowPhong};

}  // namespace mms::materials
