// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What is certain of an object's script without running it at points: enclosures over the box
/// around its shape (vm/bounds.h).

#include <vector>

#include "renderer/rate_grid.h"
#include "renderer/scene.h"
#include "vm/bounds.h"

namespace mms::renderer {

/// What a script can be told of any point in the box around `o`, or on its surface.
vm::Box box_of(const Object& o);

/// The largest scattering + absorption of the volume `d` at any wavelength in each of
/// kRateCells^3 parts of the box around `o`, and nowhere above `bound`. Infinite where none is
/// found and `bound` is infinite. Coefficients that are not a number are found at collisions: where
/// there is no number at all, no cell has less than a quarter of the largest, nor less than makes
/// four collisions along the diagonal.
RateGrid majorants_of(const vm::Program& program, const vm::Descriptor& d, const Object& o,
                      double bound);
inline constexpr int kRateCells = 16;

/// The largest emission of the volume `d` at any wavelength in each of those parts; where none is
/// found, that of the brightest part where one is, or 1.
std::vector<float> most_emission(const vm::Program& program, const vm::Descriptor& d,
                                 const Object& o);

/// The largest `height` of the surface `d` anywhere on `o`, m: what its `bound` is where the author
/// states none. Infinite where none is found.
double largest_height(const vm::Program& program, const vm::Descriptor& d, const Object& o);

}  // namespace mms::renderer
