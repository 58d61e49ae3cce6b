// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// The rows of spectra and Fresnel's equations.

#include "stdlib/bounds.h"
#include "stdlib/physics.h"
#include "vm/builtin.h"

namespace mms::stdlib::MMS_ISA {

inline constexpr vm::Builtin kPhysicsRows[] = {
    vm::builtin<Planck>(
        {.signature = "real planck(real wavelength, temperature)",
         .module = "spectra",
         .doc = "Spectral radiance of a black body, W m^-2 sr^-1 nm^-1, at a wavelength in metres "
                "and a temperature in kelvin; 0 at and below 0 K.",
         .example = "planck(550nm, 2856K)",
         .derivative =
             "planck(wavelength, temperature) * (0.014387768775039338 / (wavelength * temperature) "
             "/ (1 - exp(-0.014387768775039338 / (wavelength * temperature))) - 5) / wavelength; "
             "planck(wavelength, temperature) * 0.014387768775039338 / (wavelength * temperature) "
             "/ "
             "(1 - exp(-0.014387768775039338 / (wavelength * temperature))) / temperature",
         .max_ulp = 0.51,
         .cost = 40,
         .bounds = {vm::BoundsForm::Exact, bounds::planck, 0, kInf<double>}}),
    vm::builtin<Sellmeier>({.signature = "real sellmeier(real wavelength, b1, c1, b2, c2, b3, c3)",
                            .module = "physics",
                            .doc = "Refractive index sqrt(1 + sum of b l^2 / (l^2 - c)) with l in "
                                   "micrometres and c in um^2, as glass catalogues print them; the "
                                   "wavelength is in metres. 1 where the sum is below -1.",
                            .example = "sellmeier(550nm, 1.03961212, 0.00600069867, 0.231792344, "
                                       "0.0200179144, 1.01046945, 103.560653)",
                            .derivative = "= sellmeier_formula(wavelength, b1, c1, b2, c2, b3, c3)",
                            .max_ulp = 0.51,
                            .cost = 30,
                            .bounds = {vm::BoundsForm::Parts, bounds::sellmeier, 0, kInf<double>}}),
    vm::builtin<Cauchy>(
        {.signature = "real cauchy(real wavelength, a, b)",
         .module = "physics",
         .doc = "Refractive index a + b / l^2 with l in micrometres; the wavelength is in metres.",
         .example = "cauchy(550nm, 1.5046, 0.0042)",
         .derivative =
             "-2000000.0 * b / (wavelength * 1000000.0) ^ 3; 1; 1 / (wavelength * 1000000.0) ^ 2",
         .max_ulp = 0.51,
         .cost = 7,
         .bounds = {vm::BoundsForm::Parts, bounds::cauchy}}),
    vm::builtin<Fresnel>(
        {.signature = "real fresnel(real cos_theta, ior)",
         .module = "physics",
         .doc =
             "Reflectance of a dielectric for unpolarised light; `ior` is the far side over the "
             "near side, the cosine of incidence counts without its sign. 1 in total reflection.",
         .example = "fresnel(0.5, 1.5)",
         .derivative = "= fresnel_formula(cos_theta, ior)",
         .max_ulp = 0.51,
         .cost = 40,
         .bounds = {vm::BoundsForm::Parts, bounds::fresnel, 0, 1}}),
    vm::builtin<FresnelConductor>(
        {.signature = "real fresnel_conductor(real cos_theta, n, k)",
         .module = "physics",
         .doc = "Reflectance of a conductor of complex index n + i k for unpolarised light; the "
                "cosine of incidence counts without its sign.",
         .example = "fresnel_conductor(0.5, 0.2, 3.4)",
         .derivative = "= fresnel_conductor_formula(cos_theta, n, k)",
         .max_ulp = 0.51,
         .cost = 95,
         .bounds = {vm::BoundsForm::Range, bounds::fresnel_conductor, 0, kInf<double>}}),
    vm::builtin<OpticalTable>(
        {.signature = "real optical_table(real wavelength, table)",
         .module = "physics",
         .doc = "A measured curve at a wavelength in metres, linear between its rows, ends held: "
                "what `illuminant_d65`, `gold_n`, `cie_y` and others read. Tables are numbered "
                "from 0.",
         .example = "optical_table(550nm, 3)",
         .derivative = "optical_table_slope(wavelength, table); 0",
         .max_ulp = 0.51,
         .cost = 50,
         .bounds = {vm::BoundsForm::Exact, bounds::optical_table}}),
    vm::builtin<OpticalTableSlope>(
        {.signature = "real optical_table_slope(real wavelength, table)",
         .module = "physics",
         .doc = "Change of `optical_table` for each metre of wavelength: constant between the rows "
                "of the table, 0 outside.",
         .example = "optical_table_slope(550nm, 3)",
         .derivative = "0; 0",
         .max_ulp = 0.51,
         .cost = 50,
         .bounds = {vm::BoundsForm::Range, bounds::optical_table_slope}}),
};

}  // namespace mms::stdlib::MMS_ISA
