// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The rows that look pictures up. `image`, `image_rgb` and `image_value` of stdlib/images.mms make
/// their handles.

#include "vm/images.h"

namespace mms::stdlib {

inline constexpr vm::Builtin kImageRows[] = {
    vm::image_builtin<vm::ImageAsk::Number>(
        {.signature = "real image_number(integer image, real[2] at, across_x, across_y, blur)",
         .module = "images",
         .doc = "What `image_value` looks up: the image is one of `intrinsic::image`, `across_x` "
                "and `across_y` say how `at` changes across the pixel. An image that is not there "
                "is 1, a place that is not finite 0.",
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
};

}  // namespace mms::stdlib
