// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// The rows of cellular noise in its general form. They give ways between points, whose derivatives
/// are constant, and distances, which are differentiated as formulas.mms forms them of the ways.

#include "stdlib/bounds.h"
#include "stdlib/worley.h"

namespace mms::stdlib::MMS_ISA {

/// A row of worley_kernel.
template <int N, WorleyPart part, bool border>
constexpr vm::Builtin worley_row(const vm::Builtin& row) {
  return kernels(row, worley_kernel<float, N, part, border>,
                 worley_kernel<double, N, part, border>);
}

template <int N>
constexpr vm::Builtin worley_edge_row(const vm::Builtin& row) {
  return kernels(row, worley_edge_kernel<float, N>, worley_edge_kernel<double, N>);
}

// clang-format off: what is alike stands in columns.

// Of a number of dimensions: identity and zero matrices as derivatives of 1, 2 and 3 ways.
#define MMS_ONE1 "[1]"
#define MMS_NONE1 "[0]"
#define MMS_NIL1 "0"
#define MMS_WAYS1 "3"
#define MMS_BOTH1 "2"
#define MMS_PLACE1 "([0.3], 7, [6], 0.9"
#define MMS_ONE2 "[1, 0], [0, 1]"
#define MMS_NONE2 "[0, 0], [0, 0]"
#define MMS_NIL2 "0, 0"
#define MMS_WAYS2 "6"
#define MMS_BOTH2 "4"
#define MMS_PLACE2 "([0.3, 0.7], 7, [6, 3], 0.9"
#define MMS_ONE3 "[1, 0, 0], [0, 1, 0], [0, 0, 1]"
#define MMS_NONE3 "[0, 0, 0], [0, 0, 0], [0, 0, 0]"
#define MMS_NIL3 "0, 0, 0"
#define MMS_WAYS3 "9"
#define MMS_BOTH3 "6"
#define MMS_PLACE3 "([0.3, 0.7, 1.9], 7, [6, 3, 0], 0.9"
#define MMS_ONE4 "[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]"
#define MMS_NONE4 "[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]"
#define MMS_NIL4 "0, 0, 0, 0"
#define MMS_WAYS4 "12"
#define MMS_BOTH4 "8"
#define MMS_PLACE4 "([0.3, 0.7, 1.9, 2.2], 7, [6, 3, 0, 9], 0.9"
// clang-format on

#define MMS_THREE(what) "[" what ", " what ", " what "]"
#define MMS_TWO(what) "[" what ", " what "]"
#define MMS_FORMALS(N) "(real[" #N "] p, integer seed, real[" #N "] period, real jitter"

// What is differentiated in the row's place: formulas.mms.
#define MMS_TWIN(name) "= " name "(p, seed, period, jitter, exponent)"

#define MMS_WORLEY(N, price)                                                                       \
  worley_row<N, WorleyPart::Ways, false>(                                                          \
      {.signature = "real[" MMS_WAYS##N "] worley_ways" MMS_FORMALS(N) ", exponent)",              \
       .doc = "The ways to p from the nearest three of random points, nearest first: one point "   \
              "in each "                                                                           \
              "unit cell, in its middle for jitter 0 and anywhere in it for 1. Distances are "     \
              "Minkowski's of that exponent: 1 is Manhattan, "                                     \
              "2 Euclid, above 64 Chebyshev; less than 1 counts as 1. By Manhattan's several "     \
              "points may be equally far over whole regions: rounding chooses then. It repeats "   \
              "after `period` as `perlin` does.",                                                  \
       .example = "worley_ways" MMS_PLACE##N ", 2.0)",                                             \
       .derivative = MMS_THREE(MMS_ONE##N) "; 0; " MMS_THREE(                                      \
           MMS_NONE##N) "; "                                                                       \
                        "-worley_shifts(p, seed, period, jitter, exponent); " MMS_THREE(           \
                            MMS_NIL##N),                                                           \
       .cost = price,                                                                              \
       .bounds = {vm::BoundsForm::Range, bounds::worley_ways##N}}),                                \
      worley_row<N, WorleyPart::Distances, false>(                                                 \
          {.signature = "real[3] worley_nearest" MMS_FORMALS(N) ", exponent)",                     \
           .doc = "How long the ways of `worley_ways` are: F1, F2 and F3.",                        \
           .example = "worley_nearest" MMS_PLACE##N ", 2.0)",                                      \
           .derivative = MMS_TWIN("worley_nearest_formula"),                                       \
           .cost = price,                                                                          \
           .bounds = {vm::BoundsForm::Lipschitz, bounds::worley_nearest##N, 0}}),                  \
      worley_row<N, WorleyPart::Squares, false>(                                                   \
          {.signature = "real[3] worley_nearest_squared" MMS_FORMALS(N) ", exponent)",             \
           .doc = "The squares of Euclid's lengths of the ways of `worley_ways`.",                 \
           .example = "worley_nearest_squared" MMS_PLACE##N ", 2.0)",                              \
           .derivative = MMS_TWIN("worley_nearest_squared_formula"),                               \
           .cost = price,                                                                          \
           .bounds = {vm::BoundsForm::Lipschitz, bounds::worley_squares##N, 0}}),                  \
      worley_edge_row<N>(                                                                          \
          {.signature = "real worley_border_distance" MMS_FORMALS(N) ")",                          \
           .doc = "How far the border is that is between the points of `worley_border`.",          \
           .example = "worley_border_distance" MMS_PLACE##N ")",                                   \
           .derivative = "= worley_border_distance_formula(p, seed, period, jitter)",              \
           .cost = price + price / 2,                                                              \
           .bounds = {vm::BoundsForm::Lipschitz, bounds::worley_edge##N, 0}}),                     \
      worley_row<N, WorleyPart::Shifts, false>(                                                    \
          {.signature = "real[" MMS_WAYS##N "] worley_shifts" MMS_FORMALS(N) ", exponent)",        \
           .doc = "How jitter moves the three points of `worley_ways` out of the middle of their " \
                  "cells, "                                                                        \
                  "for each unit of jitter: in [-1/2, 1/2).",                                      \
           .example = "worley_shifts" MMS_PLACE##N ", 2.0)",                                       \
           .derivative = MMS_THREE(MMS_NONE##N) "; 0; " MMS_THREE(MMS_NONE##N) "; " MMS_THREE(     \
               MMS_NIL##N) "; " MMS_THREE(MMS_NIL##N),                                             \
           .cost = price,                                                                          \
           .bounds = {vm::BoundsForm::Range, nullptr, -0.5, 0.5}}),                                \
      worley_row<N, WorleyPart::Number, false>(                                                    \
          {.signature = "real worley_cell" MMS_FORMALS(N) ", exponent)",                           \
           .doc = "A number in [0, 1) for each cell of the points of `worley_ways`: of the "       \
                  "nearest one.",                                                                  \
           .example = "worley_cell" MMS_PLACE##N ", 2.0)",                                         \
           .derivative = "[" MMS_NIL##N "]; 0; [" MMS_NIL##N "]; 0; 0",                            \
           .cost = price,                                                                          \
           .bounds = {vm::BoundsForm::Range, nullptr, 0, 1}}),                                     \
      worley_row<N, WorleyPart::Ways, true>(                                                       \
          {.signature = "real[" MMS_BOTH##N "] worley_border" MMS_FORMALS(N) ")",                  \
           .doc =                                                                                  \
               "The ways to p from the nearest point of `worley_ways` by Euclid's distance and "   \
               "from its neighbour across the border that is nearest to p.",                       \
           .example = "worley_border" MMS_PLACE##N ")",                                            \
           .derivative = MMS_TWO(MMS_ONE##N) "; 0; " MMS_TWO(                                      \
               MMS_NONE##N) "; "                                                                   \
                            "-worley_border_shifts(p, seed, period, jitter)",                      \
           .cost = price + price / 2,                                                              \
           .bounds = {vm::BoundsForm::Range, bounds::worley_border##N}}),                          \
      worley_row<N, WorleyPart::Shifts, true>(                                                     \
          {.signature = "real[" MMS_BOTH##N "] worley_border_shifts" MMS_FORMALS(N) ")",           \
           .doc = "As `worley_shifts`, of the two points of `worley_border`.",                     \
           .example = "worley_border_shifts" MMS_PLACE##N ")",                                     \
           .derivative =                                                                           \
               MMS_TWO(MMS_NONE##N) "; 0; " MMS_TWO(MMS_NONE##N) "; " MMS_TWO(MMS_NIL##N),         \
           .cost = price + price / 2,                                                              \
           .bounds = {vm::BoundsForm::Range, nullptr, -0.5, 0.5}})

inline constexpr vm::Builtin kWorleyRows[] = {MMS_WORLEY(1, 200), MMS_WORLEY(2, 750),
                                              MMS_WORLEY(3, 3500), MMS_WORLEY(4, 9000)};

}  // namespace mms::stdlib::MMS_ISA
