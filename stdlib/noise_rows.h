// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// The rows of Perlin noise without seed and period. Their module is set by NoiseRow.

#include "stdlib/bounds.h"
#include "stdlib/noise.h"

namespace mms::stdlib::MMS_ISA {

inline constexpr vm::Builtin kNoiseRows[] = {
    NoiseRow<Perlin, 1>::value(
        {.signature = "real perlin(real x)",
         .doc = "Gradient noise in 1 dimension: smooth (its second derivative is "
                "continuous), 0 at every lattice point, in [-1, 1].",
         .example = "perlin(0.3)",
         .derivative = "perlin_gradient(x)",
         .cost = 15,
         .bounds = {vm::BoundsForm::Lipschitz, bounds::perlin1, -1, 1}}),
    NoiseRow<Perlin, 1>::gradient(
        {.signature = "real perlin_gradient(real x)",
         .doc = "Exact derivative of `perlin`.",
         .example = "perlin_gradient(0.3)",
         .derivative = "perlin_derivative(x, 2)",
         .cost = 15,
         .bounds = {vm::BoundsForm::Parts, bounds::perlin_gradient1, -10, 10}}),
    NoiseRow<Perlin, 2>::value(
        {.signature = "real perlin(real[2] p)",
         .doc = "Gradient noise in 2 dimensions: smooth (its second derivative is "
                "continuous), 0 at every lattice point, in [-1, 1].",
         .example = "perlin([0.3, 0.7])",
         .derivative = "perlin_gradient(p)",
         .cost = 40,
         .bounds = {vm::BoundsForm::Lipschitz, bounds::perlin2, -1, 1}}),
    NoiseRow<Perlin, 2>::gradient(
        {.signature = "real[2] perlin_gradient(real[2] p)",
         .doc = "Exact gradient of `perlin`.",
         .example = "perlin_gradient([0.3, 0.7])",
         .derivative = "[[perlin_derivative(p, 2, 0), perlin_derivative(p, 1, 1)], "
                       "[perlin_derivative(p, 1, 1), perlin_derivative(p, 0, 2)]]",
         .cost = 50,
         .bounds = {vm::BoundsForm::Parts, bounds::perlin_gradient2, -10, 10}}),
    NoiseRow<Perlin, 3>::value(
        {.signature = "real perlin(real[3] p)",
         .doc = "Gradient noise in 3 dimensions: smooth (its second derivative is "
                "continuous), 0 at every lattice point, in [-1, 1].",
         .example = "perlin([0.3, 0.7, 1.9])",
         .derivative = "perlin_gradient(p)",
         .cost = 110,
         .bounds = {vm::BoundsForm::Lipschitz, bounds::perlin3, -1, 1}}),
    NoiseRow<Perlin, 3>::gradient(
        {.signature = "real[3] perlin_gradient(real[3] p)",
         .doc = "Exact gradient of `perlin`.",
         .example = "perlin_gradient([0.3, 0.7, 1.9])",
         .derivative = "[[perlin_derivative(p, 2, 0, 0), perlin_derivative(p, 1, 1, 0), "
                       "perlin_derivative(p, 1, 0, 1)], [perlin_derivative(p, 1, 1, 0), "
                       "perlin_derivative(p, 0, 2, 0), perlin_derivative(p, 0, 1, 1)], "
                       "[perlin_derivative(p, 1, 0, 1), perlin_derivative(p, 0, 1, 1), "
                       "perlin_derivative(p, 0, 0, 2)]]",
         .cost = 130,
         .bounds = {vm::BoundsForm::Parts, bounds::perlin_gradient3, -10, 10}}),
    NoiseRow<Perlin, 4>::value(
        {.signature = "real perlin(real[4] p)",
         .doc = "Gradient noise in 4 dimensions: smooth (its second derivative is "
                "continuous), 0 at every lattice point, in [-1, 1].",
         .example = "perlin([0.3, 0.7, 1.9, 2.2])",
         .derivative = "perlin_gradient(p)",
         .cost = 250,
         .bounds = {vm::BoundsForm::Lipschitz, bounds::perlin4, -1, 1}}),
    NoiseRow<Perlin, 4>::gradient(
        {.signature = "real[4] perlin_gradient(real[4] p)",
         .doc = "Exact gradient of `perlin`.",
         .example = "perlin_gradient([0.3, 0.7, 1.9, 2.2])",
         .derivative = "[[perlin_derivative(p, 2, 0, 0, 0), perlin_derivative(p, 1, 1, 0, 0), "
                       "perlin_derivative(p, 1, 0, 1, 0), perlin_derivative(p, 1, 0, 0, 1)], "
                       "[perlin_derivative(p, 1, 1, 0, 0), perlin_derivative(p, 0, 2, 0, 0), "
                       "perlin_derivative(p, 0, 1, 1, 0), perlin_derivative(p, 0, 1, 0, 1)], "
                       "[perlin_derivative(p, 1, 0, 1, 0), perlin_derivative(p, 0, 1, 1, 0), "
                       "perlin_derivative(p, 0, 0, 2, 0), perlin_derivative(p, 0, 0, 1, 1)], "
                       "[perlin_derivative(p, 1, 0, 0, 1), perlin_derivative(p, 0, 1, 0, 1), "
                       "perlin_derivative(p, 0, 0, 1, 1), perlin_derivative(p, 0, 0, 0, 2)]]",
         .cost = 330,
         .bounds = {vm::BoundsForm::Parts, bounds::perlin_gradient4, -10, 10}}),
    NoiseRow<Perlin, 1>::mixed(
        {.signature = "real perlin_derivative(real x, integer n)",
         .doc = "Derivative of order n of `perlin`; a negative order counts as 0.",
         .example = "perlin_derivative(0.3, 2)",
         .derivative = "perlin_derivative(x, max(n, 0) + 1); 0",
         .cost = 25,
         .bounds = {vm::BoundsForm::Range, bounds::perlin_derivative1}}),
    NoiseRow<Perlin, 2>::mixed(
        {.signature = "real perlin_derivative(real[2] p, integer i, j)",
         .doc = "Mixed derivative of `perlin`: i and j times along the axes in turn; a "
                "negative order counts as 0.",
         .example = "perlin_derivative([0.3, 0.7], 2, 0)",
         .derivative = "[perlin_derivative(p, max(i, 0) + 1, j), perlin_derivative(p, i, max(j, 0) "
                       "+ 1)]; 0; 0",
         .cost = 70,
         .bounds = {vm::BoundsForm::Range, bounds::perlin_derivative2}}),
    NoiseRow<Perlin, 3>::mixed(
        {.signature = "real perlin_derivative(real[3] p, integer i, j, k)",
         .doc = "Mixed derivative of `perlin`: i, j and k times along the axes in "
                "turn; a negative order counts as 0.",
         .example = "perlin_derivative([0.3, 0.7, 1.9], 2, 0, 0)",
         .derivative =
             "[perlin_derivative(p, max(i, 0) + 1, j, k), perlin_derivative(p, i, max(j, 0) + 1, "
             "k), perlin_derivative(p, i, j, max(k, 0) + 1)]; 0; 0; 0",
         .cost = 200,
         .bounds = {vm::BoundsForm::Range, bounds::perlin_derivative3}}),
    NoiseRow<Perlin, 4>::mixed(
        {.signature = "real perlin_derivative(real[4] p, integer i, j, k, l)",
         .doc = "Mixed derivative of `perlin`: i, j, k and l times along the axes in "
                "turn; a negative order counts as 0.",
         .example = "perlin_derivative([0.3, 0.7, 1.9, 2.2], 2, 0, 0, 0)",
         .derivative =
             "[perlin_derivative(p, max(i, 0) + 1, j, k, l), perlin_derivative(p, i, max(j, 0) + "
             "1, "
             "k, l), perlin_derivative(p, i, j, max(k, 0) + 1, l), perlin_derivative(p, i, "
             "j, k, max(l, 0) + 1)]; 0; 0; 0; 0",
         .cost = 600,
         .bounds = {vm::BoundsForm::Range, bounds::perlin_derivative4}}),
};

}  // namespace mms::stdlib::MMS_ISA
