// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What a material's numbers say of the light it keeps, at run time as lang/conservation.h does at
/// link time.

#include "materials/layout.h"

namespace mms::materials {

/// At least so much of the light do the colours and factors of a material reflect or transmit, at
/// the wavelength where it is most: sums add, mixtures lie between their parts, and so does glass
/// between the tints of both of its sides. What has no colour counts as 0, so more than 1 is more
/// than comes in. 0 of no material.
float stated_weight(const Layout& layout, const float* params);

}  // namespace mms::materials
