// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The interval column of the rows: what each function returns over a box of its arguments (see
/// vm::RowBounds for the contract). Compiled once, for any processor; the rows of every instruction
/// set point to the same functions.

#include "vm/builtin.h"

namespace mms::stdlib::bounds {

using Function = void(const vm::Interval* in, vm::Interval* out);

Function sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh;
Function asinh, acosh, atanh;
Function exp, exp2, expm1, log, log2, log10, log1p, pow, powi, sqrt, cbrt, hypot;
Function fmod, floor, ceil, trunc, round, fract, abs, sign, min, max, clamp;
Function abs_integer, sign_integer, min_integer, max_integer, clamp_integer;

Function complex_exp, complex_log, complex_sqrt, complex_sin, complex_cos, complex_tan;
Function complex_sinh, complex_cosh, complex_tanh, complex_pow, complex_powi;
Function complex_asin, complex_acos, complex_atan, complex_asinh, complex_acosh, complex_atanh;

Function perlin1, perlin2, perlin3, perlin4;
Function perlin_gradient1, perlin_gradient2, perlin_gradient3, perlin_gradient4;
Function perlin_of1, perlin_of2, perlin_of3, perlin_of4;
Function perlin_gradient_of1, perlin_gradient_of2, perlin_gradient_of3, perlin_gradient_of4;
Function valuenoise1, valuenoise2, valuenoise3, valuenoise4;
Function valuenoise_of1, valuenoise_of2, valuenoise_of3, valuenoise_of4;
Function valuenoise_gradient_of1, valuenoise_gradient_of2, valuenoise_gradient_of3,
    valuenoise_gradient_of4;
Function simplex1, simplex2, simplex3, simplex4;
Function simplex_of1, simplex_of2, simplex_of3, simplex_of4;
Function simplex_gradient_of1, simplex_gradient_of2, simplex_gradient_of3, simplex_gradient_of4;
Function perlin_derivative1, perlin_derivative2, perlin_derivative3, perlin_derivative4;
Function hash1, hash2, hash3, hash4, cells1, cells2, cells3, cells4;
Function hash_of1, hash_of2, hash_of3, hash_of4;
Function cells_of1, cells_of2, cells_of3, cells_of4;
Function worley_ways1, worley_ways2, worley_ways3, worley_ways4;
Function worley_border1, worley_border2, worley_border3, worley_border4;
Function worley_nearest1, worley_nearest2, worley_nearest3, worley_nearest4;
Function worley_squares1, worley_squares2, worley_squares3, worley_squares4;
Function worley_edge1, worley_edge2, worley_edge3, worley_edge4;
Function worley2, worley3, worley_pair2, worley_pair3;

Function planck, sellmeier, cauchy, fresnel, fresnel_conductor;
Function optical_table, optical_table_slope;

}  // namespace mms::stdlib::bounds
