// SPDX-License-Identifier: Apache-2.0
#include "materials/bsdf.h"

#include "materials/bsdf_definitions.h"

namespace mms::materials {

template class Bsdf<float>;
template class Bsdf<double>;

}  // namespace mms::materials
