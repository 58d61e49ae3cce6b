// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the constants in a material say of the light it keeps.

#include <optional>

#include "lang/value.h"

namespace mms::lang {

/// The number that `r` is at link time, also where it stands for a flat spectrum.
std::optional<double> known_number(const Module& module, Ref r);

/// At least so much of the light do the stated colours and factors of `m` reflect or transmit: sums
/// add, mixtures lie between their parts, and so does glass between the tints of both of its sides.
/// What is known only at run time, or has no colour, counts as 0, so a result above 1 is certain.
double stated_weight(const Module& module, const MaterialTree& m);

/// The index of a coat with no other above it, where that is known and below 1, so that it counts
/// as its inverse (materials/coat.h).
std::optional<double> inverted_coat_index(const Module& module, const MaterialTree& m);

/// The one part that the combiner `m` is equal to in every direction, by its constants: a `mix` of
/// 0 or 1, a factor of 1, a turn or tilt by 0, a coat of index 1 that absorbs nothing, a layer of
/// weight 0. Null where there is none.
MaterialPtr sole_part(const Module& module, const MaterialTree& m);

}  // namespace mms::lang
