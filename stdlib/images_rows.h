// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The rows that look pictures and tables of files up. `image`, `image_rgb` and `image_value` of
/// stdlib/images.mms make their handles, and `measured` of stdlib/spectra.mms.

#include "vm/images.h"

namespace mms::stdlib {

inline constexpr vm::Builtin kImageRows[] = {
    vm::image_builtin<vm::ImageAsk::Number>(
        {.signature = "real image_number(integer image, real[2] at, across_x, across_y, blur)",
         .module = "images",
         .doc = "What `image_value` looks up: the image is one of `intrinsic::image`, `across_x` "
                "and `across_y` say how `at` changes across the pixel. An image that is not there "
                "is 1, a place that is not finite 0. In float it is off by at most 2^-19 of the "
                "largest texel at a point, and by 2^-13 where the pixel covers more.",
         .example = "image_number(-1, [0.5, 0.5], [0, 0], [0, 0], [0, 0])",
         .derivative = "0; image_number_slope(image, at, across_x, across_y, blur); 0; 0; 0",
         .cost = 300,
         .bounds = {.form = vm::BoundsForm::Range}}),
    vm::image_builtin<vm::ImageAsk::NumberSlope>(
        {.signature =
             "real[2] image_number_slope(integer image, real[2] at, across_x, across_y, blur)",
         .module = "images",
         .doc = "How `image_number` changes with `at`; differentiation takes it for constant.",
         .example = "image_number_slope(-1, [0.5, 0.5], [0, 0], [0, 0], [0, 0])",
         .derivative = "0; 0; 0; 0; 0",
         .cost = 350,
         .bounds = {.form = vm::BoundsForm::Range}}),
    vm::image_builtin<vm::ImageAsk::Colour>(
        {.signature = "real[3] image_colour(integer image, real[2] at, across_x, across_y, blur)",
         .module = "images",
         .doc = "What `image_rgb` looks up: as image_number, but [red, green, blue], linear. An "
                "image that is not there is magenta.",
         .example = "image_colour(-1, [0.5, 0.5], [0, 0], [0, 0], [0, 0])",
         .derivative = "0; image_colour_slope(image, at, across_x, across_y, blur); 0; 0; 0",
         .cost = 350,
         .bounds = {.form = vm::BoundsForm::Range}}),
    vm::image_builtin<vm::ImageAsk::ColourSlope>(
        {.signature =
             "real[6] image_colour_slope(integer image, real[2] at, across_x, across_y, blur)",
         .module = "images",
         .doc = "How `image_colour` changes with `at`: red by u, red by v, green by u, and so on; "
                "differentiation takes it for constant.",
         .example = "image_colour_slope(-1, [0.5, 0.5], [0, 0], [0, 0], [0, 0])",
         .derivative = "0; 0; 0; 0; 0",
         .cost = 400,
         .bounds = {.form = vm::BoundsForm::Range}}),
    vm::image_builtin<vm::ImageAsk::Curve>(
        {.signature = "real curve_value(integer curve, real wavelength)",
         .module = "spectra",
         .doc = "What `measured` looks up: the curve is one of `intrinsic::curve`, the wavelength "
                "in metres. Linear between rows, level outside; a curve that is not there is 1.",
         .example = "curve_value(-1, 550nm)",
         .derivative = "0; curve_slope(curve, wavelength)",
         .max_ulp = 0.51,
         .cost = 50,
         .bounds = {.form = vm::BoundsForm::Range}}),
    vm::image_builtin<vm::ImageAsk::CurveSlope>(
        {.signature = "real curve_slope(integer curve, real wavelength)",
         .module = "spectra",
         .doc = "Change of `curve_value` for each metre of wavelength: constant between the rows "
                "of the table, 0 outside.",
         .example = "curve_slope(-1, 550nm)",
         .derivative = "0; 0",
         .max_ulp = 0.51,
         .cost = 50,
         .bounds = {.form = vm::BoundsForm::Range}}),
};

}  // namespace mms::stdlib
