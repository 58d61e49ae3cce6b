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
    vm::builtin<IlluminantD65>(
        {.signature = "real illuminant_d65(real wavelength)",
         .module = "spectra",
         .doc = "Relative power of CIE standard illuminant D65, 1 at 560 nm (CIE 15, 5 nm steps "
                "from 300 to 830 nm, linear between, ends held); wavelength in metres.",
         .example = "illuminant_d65(550nm)",
         .derivative = "illuminant_d65_slope(wavelength)",
         .max_ulp = 0.51,
         .cost = 45,
         .bounds = {vm::BoundsForm::Exact, bounds::illuminant_d65}}),
    vm::builtin<IlluminantA>({.signature = "real illuminant_a(real wavelength)",
                              .module = "spectra",
                              .doc = "Relative power of CIE standard illuminant A (a tungsten lamp "
                                     "of 2856 K), 1 at 560 nm; tabulated as D65.",
                              .example = "illuminant_a(550nm)",
                              .derivative = "illuminant_a_slope(wavelength)",
                              .max_ulp = 0.51,
                              .cost = 45,
                              .bounds = {vm::BoundsForm::Exact, bounds::illuminant_a}}),
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
    vm::builtin<GoldN>(
        {.signature = "real gold_n(real wavelength)",
         .module = "physics",
         .doc = "Real part of the refractive index of gold at a wavelength in metres (handbook "
                "data, 299 to 886 nm, linear between rows, ends held).",
         .example = "gold_n(550nm)",
         .derivative = "gold_n_slope(wavelength)",
         .max_ulp = 0.51,
         .cost = 70,
         .bounds = {vm::BoundsForm::Exact, bounds::gold_n}}),
    vm::builtin<GoldK>(
        {.signature = "real gold_k(real wavelength)",
         .module = "physics",
         .doc = "Imaginary part of the refractive index of gold (extinction); as gold_n.",
         .example = "gold_k(550nm)",
         .derivative = "gold_k_slope(wavelength)",
         .max_ulp = 0.51,
         .cost = 70,
         .bounds = {vm::BoundsForm::Exact, bounds::gold_k}}),
    vm::builtin<SilverN>(
        {.signature = "real silver_n(real wavelength)",
         .module = "physics",
         .doc = "Real part of the refractive index of silver at a wavelength in metres (handbook "
                "data, 299 to 886 nm, linear between rows, ends held).",
         .example = "silver_n(550nm)",
         .derivative = "silver_n_slope(wavelength)",
         .max_ulp = 0.51,
         .cost = 70,
         .bounds = {vm::BoundsForm::Exact, bounds::silver_n}}),
    vm::builtin<SilverK>(
        {.signature = "real silver_k(real wavelength)",
         .module = "physics",
         .doc = "Imaginary part of the refractive index of silver (extinction); as silver_n.",
         .example = "silver_k(550nm)",
         .derivative = "silver_k_slope(wavelength)",
         .max_ulp = 0.51,
         .cost = 100,
         .bounds = {vm::BoundsForm::Exact, bounds::silver_k}}),
    vm::builtin<CopperN>(
        {.signature = "real copper_n(real wavelength)",
         .module = "physics",
         .doc = "Real part of the refractive index of copper at a wavelength in metres (handbook "
                "data, 299 to 886 nm, linear between rows, ends held).",
         .example = "copper_n(550nm)",
         .derivative = "copper_n_slope(wavelength)",
         .max_ulp = 0.51,
         .cost = 100,
         .bounds = {vm::BoundsForm::Exact, bounds::copper_n}}),
    vm::builtin<CopperK>(
        {.signature = "real copper_k(real wavelength)",
         .module = "physics",
         .doc = "Imaginary part of the refractive index of copper (extinction); as copper_n.",
         .example = "copper_k(550nm)",
         .derivative = "copper_k_slope(wavelength)",
         .max_ulp = 0.51,
         .cost = 100,
         .bounds = {vm::BoundsForm::Exact, bounds::copper_k}}),
    vm::builtin<AluminiumN>(
        {.signature = "real aluminium_n(real wavelength)",
         .module = "physics",
         .doc = "Real part of the refractive index of aluminium at a wavelength in metres "
                "(handbook data, 299 to 886 nm, linear between rows, ends held).",
         .example = "aluminium_n(550nm)",
         .derivative = "aluminium_n_slope(wavelength)",
         .max_ulp = 0.51,
         .cost = 70,
         .bounds = {vm::BoundsForm::Exact, bounds::aluminium_n}}),
    vm::builtin<AluminiumK>(
        {.signature = "real aluminium_k(real wavelength)",
         .module = "physics",
         .doc = "Imaginary part of the refractive index of aluminium (extinction); as aluminium_n.",
         .example = "aluminium_k(550nm)",
         .derivative = "aluminium_k_slope(wavelength)",
         .max_ulp = 0.51,
         .cost = 70,
         .bounds = {vm::BoundsForm::Exact, bounds::aluminium_k}}),
    vm::builtin<IlluminantD65Slope>(
        {.signature = "real illuminant_d65_slope(real wavelength)",
         .module = "spectra",
         .doc = "Change of `illuminant_d65` for each metre of wavelength: constant between the "
                "rows of its table, 0 outside.",
         .example = "illuminant_d65_slope(550nm)",
         .derivative = "0",
         .max_ulp = 0.51,
         .cost = 45,
         .bounds = {vm::BoundsForm::Range, bounds::illuminant_d65_slope}}),
    vm::builtin<IlluminantASlope>({.signature = "real illuminant_a_slope(real wavelength)",
                                   .module = "spectra",
                                   .doc = "Change of `illuminant_a` for each metre of wavelength: "
                                          "constant between the rows of its table, 0 outside.",
                                   .example = "illuminant_a_slope(550nm)",
                                   .derivative = "0",
                                   .max_ulp = 0.51,
                                   .cost = 45,
                                   .bounds = {vm::BoundsForm::Range, bounds::illuminant_a_slope}}),
    vm::builtin<GoldNSlope>({.signature = "real gold_n_slope(real wavelength)",
                             .module = "physics",
                             .doc = "Change of `gold_n` for each metre of wavelength: constant "
                                    "between the rows of its table, 0 outside.",
                             .example = "gold_n_slope(550nm)",
                             .derivative = "0",
                             .max_ulp = 0.51,
                             .cost = 50,
                             .bounds = {vm::BoundsForm::Range, bounds::gold_n_slope}}),
    vm::builtin<GoldKSlope>({.signature = "real gold_k_slope(real wavelength)",
                             .module = "physics",
                             .doc = "Change of `gold_k` for each metre of wavelength: constant "
                                    "between the rows of its table, 0 outside.",
                             .example = "gold_k_slope(550nm)",
                             .derivative = "0",
                             .max_ulp = 0.51,
                             .cost = 50,
                             .bounds = {vm::BoundsForm::Range, bounds::gold_k_slope}}),
    vm::builtin<SilverNSlope>({.signature = "real silver_n_slope(real wavelength)",
                               .module = "physics",
                               .doc = "Change of `silver_n` for each metre of wavelength: constant "
                                      "between the rows of its table, 0 outside.",
                               .example = "silver_n_slope(550nm)",
                               .derivative = "0",
                               .max_ulp = 0.51,
                               .cost = 50,
                               .bounds = {vm::BoundsForm::Range, bounds::silver_n_slope}}),
    vm::builtin<SilverKSlope>({.signature = "real silver_k_slope(real wavelength)",
                               .module = "physics",
                               .doc = "Change of `silver_k` for each metre of wavelength: constant "
                                      "between the rows of its table, 0 outside.",
                               .example = "silver_k_slope(550nm)",
                               .derivative = "0",
                               .max_ulp = 0.51,
                               .cost = 50,
                               .bounds = {vm::BoundsForm::Range, bounds::silver_k_slope}}),
    vm::builtin<CopperNSlope>({.signature = "real copper_n_slope(real wavelength)",
                               .module = "physics",
                               .doc = "Change of `copper_n` for each metre of wavelength: constant "
                                      "between the rows of its table, 0 outside.",
                               .example = "copper_n_slope(550nm)",
                               .derivative = "0",
                               .max_ulp = 0.51,
                               .cost = 50,
                               .bounds = {vm::BoundsForm::Range, bounds::copper_n_slope}}),
    vm::builtin<CopperKSlope>({.signature = "real copper_k_slope(real wavelength)",
                               .module = "physics",
                               .doc = "Change of `copper_k` for each metre of wavelength: constant "
                                      "between the rows of its table, 0 outside.",
                               .example = "copper_k_slope(550nm)",
                               .derivative = "0",
                               .max_ulp = 0.51,
                               .cost = 50,
                               .bounds = {vm::BoundsForm::Range, bounds::copper_k_slope}}),
    vm::builtin<AluminiumNSlope>({.signature = "real aluminium_n_slope(real wavelength)",
                                  .module = "physics",
                                  .doc = "Change of `aluminium_n` for each metre of wavelength: "
                                         "constant between the rows of its table, 0 outside.",
                                  .example = "aluminium_n_slope(550nm)",
                                  .derivative = "0",
                                  .max_ulp = 0.51,
                                  .cost = 50,
                                  .bounds = {vm::BoundsForm::Range, bounds::aluminium_n_slope}}),
    vm::builtin<AluminiumKSlope>({.signature = "real aluminium_k_slope(real wavelength)",
                                  .module = "physics",
                                  .doc = "Change of `aluminium_k` for each metre of wavelength: "
                                         "constant between the rows of its table, 0 outside.",
                                  .example = "aluminium_k_slope(550nm)",
                                  .derivative = "0",
                                  .max_ulp = 0.51,
                                  .cost = 50,
                                  .bounds = {vm::BoundsForm::Range, bounds::aluminium_k_slope}}),
};

}  // namespace mms::stdlib::MMS_ISA
