// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// The rows of noise.

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
                          .cost = 15}),
    vm::builtin<PerlinGradient1>({.signature = "real perlin_gradient(real x)",
                                  .module = "noise",
                                  .doc = "Exact derivative of `perlin`.",
                                  .example = "perlin_gradient(0.3)",
                                  .derivative = "",
                                  .cost = 15}),
    vm::builtin<Perlin2>({.signature = "real perlin(real[2] p)",
                          .module = "noise",
                          .doc = "Gradient noise in 2 dimensions: smooth (its second derivative is "
                                 "continuous), 0 at every lattice point, in [-1, 1].",
                          .example = "perlin([0.3, 0.7])",
                          .derivative = "perlin_gradient(p)",
                          .cost = 40}),
    vm::builtin<PerlinGradient2>({.signature = "real[2] perlin_gradient(real[2] p)",
                                  .module = "noise",
                                  .doc = "Exact gradient of `perlin`.",
                                  .example = "perlin_gradient([0.3, 0.7])",
                                  .derivative = "",
                                  .cost = 50}),
    vm::builtin<Perlin3>({.signature = "real perlin(real[3] p)",
                          .module = "noise",
                          .doc = "Gradient noise in 3 dimensions: smooth (its second derivative is "
                                 "continuous), 0 at every lattice point, in [-1, 1].",
                          .example = "perlin([0.3, 0.7, 1.9])",
                          .derivative = "perlin_gradient(p)",
                          .cost = 110}),
    vm::builtin<PerlinGradient3>({.signature = "real[3] perlin_gradient(real[3] p)",
                                  .module = "noise",
                                  .doc = "Exact gradient of `perlin`.",
                                  .example = "perlin_gradient([0.3, 0.7, 1.9])",
                                  .derivative = "",
                                  .cost = 130}),
    vm::builtin<Perlin4>({.signature = "real perlin(real[4] p)",
                          .module = "noise",
                          .doc = "Gradient noise in 4 dimensions: smooth (its second derivative is "
                                 "continuous), 0 at every lattice point, in [-1, 1].",
                          .example = "perlin([0.3, 0.7, 1.9, 2.2])",
                          .derivative = "perlin_gradient(p)",
                          .cost = 250}),
    vm::builtin<PerlinGradient4>({.signature = "real[4] perlin_gradient(real[4] p)",
                                  .module = "noise",
                                  .doc = "Exact gradient of `perlin`.",
                                  .example = "perlin_gradient([0.3, 0.7, 1.9, 2.2])",
                                  .derivative = "",
                                  .cost = 330}),
};

}  // namespace mms::stdlib::MMS_ISA
