// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// The rows of noise.

#include "stdlib/bounds.h"
#include "stdlib/noise.h"
#include "vm/builtin.h"

namespace mms::stdlib::MMS_ISA {

inline constexpr vm::Builtin kNoiseRows[] = {
    vm::builtin<Perlin1>({.signature = "real perlin(real x)",
                          .module = "noise",
                          .doc = "Gradient noise in 1 dimension: smooth (its second derivative is "
                                 "continuous), 0 at every lattice point, in [-1, 1].",
                          .example = "perlin(0.3)",
                          .derivative = "perlin_gradient(x)",
                          .cost = 15,
                          .bounds = {vm::BoundsForm::Lipschitz, bounds::perlin1, -1, 1}}),
    vm::builtin<PerlinGradient1>(
        {.signature = "real perlin_gradient(real x)",
         .module = "noise",
         .doc = "Exact derivative of `perlin`.",
         .example = "perlin_gradient(0.3)",
         .derivative = "",
         .cost = 15,
         .bounds = {vm::BoundsForm::Parts, bounds::perlin_gradient1, -10, 10}}),
    vm::builtin<Perlin2>({.signature = "real perlin(real[2] p)",
                          .module = "noise",
                          .doc = "Gradient noise in 2 dimensions: smooth (its second derivative is "
                                 "continuous), 0 at every lattice point, in [-1, 1].",
                          .example = "perlin([0.3, 0.7])",
                          .derivative = "perlin_gradient(p)",
                          .cost = 40,
                          .bounds = {vm::BoundsForm::Lipschitz, bounds::perlin2, -1, 1}}),
    vm::builtin<PerlinGradient2>(
        {.signature = "real[2] perlin_gradient(real[2] p)",
         .module = "noise",
         .doc = "Exact gradient of `perlin`.",
         .example = "perlin_gradient([0.3, 0.7])",
         .derivative = "",
         .cost = 50,
         .bounds = {vm::BoundsForm::Parts, bounds::perlin_gradient2, -10, 10}}),
    vm::builtin<Perlin3>({.signature = "real perlin(real[3] p)",
                          .module = "noise",
                          .doc = "Gradient noise in 3 dimensions: smooth (its second derivative is "
                                 "continuous), 0 at every lattice point, in [-1, 1].",
                          .example = "perlin([0.3, 0.7, 1.9])",
                          .derivative = "perlin_gradient(p)",
                          .cost = 110,
                          .bounds = {vm::BoundsForm::Lipschitz, bounds::perlin3, -1, 1}}),
    vm::builtin<PerlinGradient3>(
        {.signature = "real[3] perlin_gradient(real[3] p)",
         .module = "noise",
         .doc = "Exact gradient of `perlin`.",
         .example = "perlin_gradient([0.3, 0.7, 1.9])",
         .derivative = "",
         .cost = 130,
         .bounds = {vm::BoundsForm::Parts, bounds::perlin_gradient3, -10, 10}}),
    vm::builtin<Perlin4>({.signature = "real perlin(real[4] p)",
                          .module = "noise",
                          .doc = "Gradient noise in 4 dimensions: smooth (its second derivative is "
                                 "continuous), 0 at every lattice point, in [-1, 1].",
                          .example = "perlin([0.3, 0.7, 1.9, 2.2])",
                          .derivative = "perlin_gradient(p)",
                          .cost = 250,
                          .bounds = {vm::BoundsForm::Lipschitz, bounds::perlin4, -1, 1}}),
    vm::builtin<PerlinGradient4>(
        {.signature = "real[4] perlin_gradient(real[4] p)",
         .module = "noise",
         .doc = "Exact gradient of `perlin`.",
         .example = "perlin_gradient([0.3, 0.7, 1.9, 2.2])",
         .derivative = "",
         .cost = 330,
         .bounds = {vm::BoundsForm::Parts, bounds::perlin_gradient4, -10, 10}}),
};

}  // namespace mms::stdlib::MMS_ISA
