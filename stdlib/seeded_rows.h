// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// The rows of noise with a seed and periods: three for each kind and number of dimensions, and for
/// the kinds that are not in noise_rows.h a fourth without them.

#include "stdlib/bounds.h"
#include "stdlib/cells.h"
#include "stdlib/noise.h"
#include "stdlib/noise_texts.h"
#include "stdlib/simplex.h"

namespace mms::stdlib::MMS_ISA {

/// `about`: what the noise is; `steps`: how periods are rounded. `slope`: no component of the
/// gradient is larger. `slow`: what a derivative costs over the value.
#define MMS_SEEDED_ROWS(Kind, name, N, about, steps, slope, price, slow, enclose, form,           \
                        enclose_gradient)                                                         \
  NoiseRow<Kind, N>::value_of(                                                                    \
      {.signature = "real " name "(" MMS_OF##N ")",                                               \
       .doc =                                                                                     \
           about " Another one for every seed; it repeats along each axis after `period`, which"  \
                 " is rounded to " steps "; 0 is none.",                                          \
       .example = name MMS_EXAMPLE_OF##N ")",                                                     \
       .derivative = name "_gradient(" MMS_ARGUMENT##N ", seed, period); 0; " MMS_ZEROS##N,       \
       .cost = price,                                                                             \
       .bounds = {vm::BoundsForm::Lipschitz, enclose, -1, 1}}),                                   \
      NoiseRow<Kind, N>::gradient_of(                                                             \
          {.signature = MMS_VECTOR##N " " name "_gradient(" MMS_OF##N ")",                        \
           .doc = "Exact gradient of `" name "` with that seed and period.",                      \
           .example = name "_gradient" MMS_EXAMPLE_OF##N ")",                                     \
           .derivative = MMS_CURVATURE##N(name) "; 0; " MMS_NO_SLOPES##N,                         \
           .cost = price + price / 4,                                                             \
           .bounds = {form, enclose_gradient, -slope, slope}}),                                   \
      NoiseRow<Kind, N>::mixed_of(                                                                \
          {.signature = "real " name "_derivative(" MMS_OF##N MMS_ORDERS##N ")",                  \
           .doc = MMS_ORDERS_TEXT##N " of `" name "` with that seed and period; a negative order" \
                                     " counts as 0.",                                             \
           .example = name "_derivative" MMS_EXAMPLE_OF##N MMS_SECOND##N ")",                     \
           .derivative = MMS_HIGHER##N(name),                                                     \
           .cost = slow * price,                                                                  \
           .bounds = {vm::BoundsForm::Range}})

#define MMS_PLAIN_ROW(Kind, name, N, about, price, enclose)                      \
  NoiseRow<Kind, N>::value(                                                      \
      {.signature = "real " name "(" MMS_AT##N ")",                              \
       .doc = about,                                                             \
       .example = name MMS_EXAMPLE##N ")",                                       \
       .derivative = name "_gradient(" MMS_ARGUMENT##N ", 0, " MMS_ZEROS##N ")", \
       .cost = price,                                                            \
       .bounds = {vm::BoundsForm::Lipschitz, enclose, -1, 1}})

#define MMS_PERLIN(N, price)                                                                  \
  MMS_SEEDED_ROWS(Perlin, "perlin", N,                                                        \
                  "Gradient noise: smooth (its second derivative is continuous), 0 at every " \
                  "lattice point, in [-1, 1].",                                               \
                  "whole cells", 10, price, 5, bounds::perlin_of##N, vm::BoundsForm::Parts,   \
                  bounds::perlin_gradient_of##N)

#define MMS_VALUE_NOISE(N, plain, price)                                                           \
  MMS_PLAIN_ROW(ValueNoise, "valuenoise", N, MMS_ABOUT_VALUE, plain, bounds::valuenoise##N),       \
      MMS_SEEDED_ROWS(ValueNoise, "valuenoise", N, MMS_ABOUT_VALUE, "whole cells", 3.75, price, 5, \
                      bounds::valuenoise_of##N, vm::BoundsForm::Parts,                             \
                      bounds::valuenoise_gradient_of##N)
#define MMS_ABOUT_VALUE                                                                            \
  "Value noise: random numbers at the lattice points, smooth between them (the second derivative " \
  "is continuous); in [-1, 1]."

#define MMS_SIMPLEX(N, steps, plain, price)                                                     \
  MMS_PLAIN_ROW(Simplex, "simplex", N, MMS_ABOUT_SIMPLEX, plain, bounds::simplex##N),           \
      MMS_SEEDED_ROWS(Simplex, "simplex", N, MMS_ABOUT_SIMPLEX, steps, kSimplexSlope<N>, price, \
                      45, bounds::simplex_of##N, vm::BoundsForm::Lipschitz,                     \
                      bounds::simplex_gradient_of##N)
#define MMS_ABOUT_SIMPLEX                                                                 \
  "Simplex noise: rounder than `perlin`, and cheaper in 4 dimensions; smooth (its third " \
  "derivative is continuous), in [-1, 1]."

/// The rows of CellCalls.
template <std::size_t N>
struct CellRow {
  template <class R>
  using Calls = CellCalls<R, std::make_index_sequence<N>>;
  static constexpr vm::Builtin hash(vm::Builtin row) {
    return kernels(row, vm::kernel_of<&Calls<float>::hash>, vm::kernel_of<&Calls<double>::hash>);
  }
  static constexpr vm::Builtin cell(vm::Builtin row) {
    return kernels(row, vm::kernel_of<&Calls<float>::cell>, vm::kernel_of<&Calls<double>::cell>);
  }
};

#define MMS_CELLS(N)                                                                               \
  CellRow<N>::hash({.signature = "real hash(" MMS_AT##N ", integer seed)",                         \
                    .doc = "White noise in [0, 1), another one for every seed. -0 counts as 0.",   \
                    .example = "hash" MMS_EXAMPLE##N ", 7)",                                       \
                    .derivative = MMS_ZEROS##N "; 0",                                              \
                    .cost = 3 + 2 * N,                                                             \
                    .bounds = {vm::BoundsForm::Range, bounds::hash_of##N, 0, 1}}),                 \
      CellRow<N>::cell(                                                                            \
          {.signature = "real cellnoise(" MMS_OF##N ")",                                           \
           .doc = "A number in [0, 1) for each unit cell, another one for every seed; it repeats " \
                  "along each axis after `period`, which is rounded to whole cells; 0 is none.",   \
           .example = "cellnoise" MMS_EXAMPLE_OF##N ")",                                           \
           .derivative = MMS_ZEROS##N "; 0; " MMS_ZEROS##N,                                        \
           .cost = 5 + 12 * N,                                                                     \
           .bounds = {vm::BoundsForm::Exact, bounds::cells_of##N, 0, 1}})

inline constexpr vm::Builtin kSeededRows[] = {MMS_PERLIN(1, 43),
                                              MMS_PERLIN(2, 87),
                                              MMS_PERLIN(3, 170),
                                              MMS_PERLIN(4, 335),
                                              MMS_VALUE_NOISE(1, 12, 41),
                                              MMS_VALUE_NOISE(2, 28, 70),
                                              MMS_VALUE_NOISE(3, 55, 114),
                                              MMS_VALUE_NOISE(4, 107, 188),
                                              MMS_SIMPLEX(1, "whole cells", 29, 57),
                                              MMS_SIMPLEX(2, "multiples of 3 cells", 90, 170),
                                              MMS_SIMPLEX(3, "multiples of 3 cells", 140, 280),
                                              MMS_SIMPLEX(4, "multiples of 3 cells", 187, 400),
                                              MMS_CELLS(1),
                                              MMS_CELLS(2),
                                              MMS_CELLS(3),
                                              MMS_CELLS(4)};

}  // namespace mms::stdlib::MMS_ISA
