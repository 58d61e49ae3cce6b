// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// The rows of white and cellular noise.

#include "stdlib/bounds.h"
#include "stdlib/cells.h"
#include "vm/builtin.h"

namespace mms::stdlib::MMS_ISA {

inline constexpr vm::Builtin kCellsRows[] = {
    vm::builtin<Hash1>(
        {.signature = "real hash(real x)",
         .module = "noise",
         .doc = "White noise in [0, 1): another number for every argument. -0 counts as 0.",
         .example = "hash(0.3)",
         .derivative = "0",
         .cost = 3,
         .bounds = {vm::BoundsForm::Range, bounds::hash1, 0, 1}}),
    vm::builtin<Hash2>(
        {.signature = "real hash(real[2] p)",
         .module = "noise",
         .doc = "White noise in [0, 1): another number for every argument. -0 counts as 0.",
         .example = "hash([0.3, 0.7])",
         .derivative = "[0, 0]",
         .cost = 5,
         .bounds = {vm::BoundsForm::Range, bounds::hash2, 0, 1}}),
    vm::builtin<Hash3>(
        {.signature = "real hash(real[3] p)",
         .module = "noise",
         .doc = "White noise in [0, 1): another number for every argument. -0 counts as 0.",
         .example = "hash([0.3, 0.7, 1.9])",
         .derivative = "[0, 0, 0]",
         .cost = 7,
         .bounds = {vm::BoundsForm::Range, bounds::hash3, 0, 1}}),
    vm::builtin<Hash4>(
        {.signature = "real hash(real[4] p)",
         .module = "noise",
         .doc = "White noise in [0, 1): another number for every argument. -0 counts as 0.",
         .example = "hash([0.3, 0.7, 1.9, 2.2])",
         .derivative = "[0, 0, 0, 0]",
         .cost = 9,
         .bounds = {vm::BoundsForm::Range, bounds::hash4, 0, 1}}),
    vm::builtin<Cells1>(
        {.signature = "real cellnoise(real x)",
         .module = "noise",
         .doc =
             "A number in [0, 1) for each unit cell: constant where floor of every coordinate is.",
         .example = "cellnoise(0.3)",
         .derivative = "0",
         .cost = 4,
         .bounds = {vm::BoundsForm::Exact, bounds::cells1, 0, 1}}),
    vm::builtin<Cells2>(
        {.signature = "real cellnoise(real[2] p)",
         .module = "noise",
         .doc =
             "A number in [0, 1) for each unit cell: constant where floor of every coordinate is.",
         .example = "cellnoise([0.3, 0.7])",
         .derivative = "[0, 0]",
         .cost = 7,
         .bounds = {vm::BoundsForm::Exact, bounds::cells2, 0, 1}}),
    vm::builtin<Cells3>(
        {.signature = "real cellnoise(real[3] p)",
         .module = "noise",
         .doc =
             "A number in [0, 1) for each unit cell: constant where floor of every coordinate is.",
         .example = "cellnoise([0.3, 0.7, 1.9])",
         .derivative = "[0, 0, 0]",
         .cost = 10,
         .bounds = {vm::BoundsForm::Exact, bounds::cells3, 0, 1}}),
    vm::builtin<Cells4>(
        {.signature = "real cellnoise(real[4] p)",
         .module = "noise",
         .doc =
             "A number in [0, 1) for each unit cell: constant where floor of every coordinate is.",
         .example = "cellnoise([0.3, 0.7, 1.9, 2.2])",
         .derivative = "[0, 0, 0, 0]",
         .cost = 15,
         .bounds = {vm::BoundsForm::Exact, bounds::cells4, 0, 1}}),
    vm::builtin<Worley2>({.signature = "real worley(real[2] p)",
                          .module = "noise",
                          .doc =
                              "Distance to the nearest of random points, one in each unit cell. "
                              "The 9 cells around are searched, so it is exact up to 1; a larger "
                              "one is too large at one place in 600 000. `worley_f1` is not.",
                          .example = "worley([0.3, 0.7])",
                          .derivative = "worley_gradient(p)",
                          .cost = 75,
                          .bounds = {vm::BoundsForm::Lipschitz, bounds::worley2, 0, kInf<double>}}),
    vm::builtin<WorleyPair2>(
        {.signature = "real[2] worley_pair(real[2] p)",
         .module = "noise",
         .doc = "Distances to the nearest and to the second nearest point of `worley`. They are "
                "exact up "
                "to 1; a larger second one is too large at one place in 6500. `worley_f2` is not.",
         .example = "worley_pair([0.3, 0.7])",
         .derivative = "[worley_gradient(p), worley_second_gradient(p)]",
         .cost = 160,
         .bounds = {vm::BoundsForm::Lipschitz, bounds::worley_pair2, 0, kInf<double>}}),
    vm::builtin<WorleyGradient2>({.signature = "real[2] worley_gradient(real[2] p)",
                                  .module = "noise",
                                  .doc = "Gradient of `worley`: the unit vector away from the "
                                         "nearest point; 0 at the point itself.",
                                  .example = "worley_gradient([0.3, 0.7])",
                                  .derivative =
                                      "[[1 - worley_gradient(p)[0] * worley_gradient(p)[0], "
                                      "-worley_gradient(p)[0] * worley_gradient(p)[1]], "
                                      "[-worley_gradient(p)[1] * worley_gradient(p)[0], 1 - "
                                      "worley_gradient(p)[1] * worley_gradient(p)[1]]] / worley(p)",
                                  .cost = 85,
                                  .bounds = {vm::BoundsForm::Range, nullptr, -1.000001, 1.000001}}),
    vm::builtin<WorleySecondGradient2>(
        {.signature = "real[2] worley_second_gradient(real[2] p)",
         .module = "noise",
         .doc = "Gradient of the second part of `worley_pair`: the unit vector away from the "
                "second nearest point.",
         .example = "worley_second_gradient([0.3, 0.7])",
         .derivative = "[[1 - worley_second_gradient(p)[0] * worley_second_gradient(p)[0], "
                       "-worley_second_gradient(p)[0] * worley_second_gradient(p)[1]], "
                       "[-worley_second_gradient(p)[1] * worley_second_gradient(p)[0], 1 - "
                       "worley_second_gradient(p)[1] * worley_second_gradient(p)[1]]] / "
                       "worley_pair(p)[1]",
         .cost = 190,
         .bounds = {vm::BoundsForm::Range, nullptr, -1.000001, 1.000001}}),
    vm::builtin<Voronoi2>(
        {.signature = "real voronoi(real[2] p)",
         .module = "noise",
         .doc = "A number in [0, 1) for each Voronoi cell of the points of `worley`.",
         .example = "voronoi([0.3, 0.7])",
         .derivative = "[0, 0]",
         .cost = 90,
         .bounds = {vm::BoundsForm::Range, nullptr, 0, 1}}),
    vm::builtin<Worley3>({.signature = "real worley(real[3] p)",
                          .module = "noise",
                          .doc =
                              "Distance to the nearest of random points, one in each unit cell. "
                              "The 27 cells around are searched, so it is exact up to 1; a larger "
                              "one may be too large: not at one of 20 000 random places.",
                          .example = "worley([0.3, 0.7, 1.9])",
                          .derivative = "worley_gradient(p)",
                          .cost = 310,
                          .bounds = {vm::BoundsForm::Lipschitz, bounds::worley3, 0, kInf<double>}}),
    vm::builtin<WorleyPair3>(
        {.signature = "real[2] worley_pair(real[3] p)",
         .module = "noise",
         .doc = "Distances to the nearest and to the second nearest point of `worley`. They are "
                "exact up "
                "to 1; larger ones may be too large: not at one of 20 000 random places.",
         .example = "worley_pair([0.3, 0.7, 1.9])",
         .derivative = "[worley_gradient(p), worley_second_gradient(p)]",
         .cost = 590,
         .bounds = {vm::BoundsForm::Lipschitz, bounds::worley_pair3, 0, kInf<double>}}),
    vm::builtin<WorleyGradient3>(
        {.signature = "real[3] worley_gradient(real[3] p)",
         .module = "noise",
         .doc = "Gradient of `worley`: the unit vector away from the "
                "nearest point; 0 at the point itself.",
         .example = "worley_gradient([0.3, 0.7, 1.9])",
         .derivative = "[[1 - worley_gradient(p)[0] * worley_gradient(p)[0], "
                       "-worley_gradient(p)[0] * worley_gradient(p)[1], "
                       "-worley_gradient(p)[0] * worley_gradient(p)[2]], "
                       "[-worley_gradient(p)[1] * worley_gradient(p)[0], 1 - "
                       "worley_gradient(p)[1] * worley_gradient(p)[1], -worley_gradient(p)[1] "
                       "* worley_gradient(p)[2]], [-worley_gradient(p)[2] * "
                       "worley_gradient(p)[0], -worley_gradient(p)[2] * "
                       "worley_gradient(p)[1], 1 - worley_gradient(p)[2] * "
                       "worley_gradient(p)[2]]] / worley(p)",
         .cost = 390,
         .bounds = {vm::BoundsForm::Range, nullptr, -1.000001, 1.000001}}),
    vm::builtin<WorleySecondGradient3>(
        {.signature = "real[3] worley_second_gradient(real[3] p)",
         .module = "noise",
         .doc = "Gradient of the second part of `worley_pair`: the unit vector away from the "
                "second nearest point.",
         .example = "worley_second_gradient([0.3, 0.7, 1.9])",
         .derivative = "[[1 - worley_second_gradient(p)[0] * worley_second_gradient(p)[0], "
                       "-worley_second_gradient(p)[0] * worley_second_gradient(p)[1], "
                       "-worley_second_gradient(p)[0] * worley_second_gradient(p)[2]], "
                       "[-worley_second_gradient(p)[1] * worley_second_gradient(p)[0], 1 - "
                       "worley_second_gradient(p)[1] * worley_second_gradient(p)[1], "
                       "-worley_second_gradient(p)[1] * worley_second_gradient(p)[2]], "
                       "[-worley_second_gradient(p)[2] * worley_second_gradient(p)[0], "
                       "-worley_second_gradient(p)[2] * worley_second_gradient(p)[1], 1 - "
                       "worley_second_gradient(p)[2] * worley_second_gradient(p)[2]]] / "
                       "worley_pair(p)[1]",
         .cost = 720,
         .bounds = {vm::BoundsForm::Range, nullptr, -1.000001, 1.000001}}),
    vm::builtin<Voronoi3>(
        {.signature = "real voronoi(real[3] p)",
         .module = "noise",
         .doc = "A number in [0, 1) for each Voronoi cell of the points of `worley`.",
         .example = "voronoi([0.3, 0.7, 1.9])",
         .derivative = "[0, 0, 0]",
         .cost = 370,
         .bounds = {vm::BoundsForm::Range, nullptr, 0, 1}}),
};

}  // namespace mms::stdlib::MMS_ISA
