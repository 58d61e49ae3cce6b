// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// The rows of the elementary functions of reals and integers.

#include "stdlib/bounds.h"
#include "stdlib/elementary.h"
#include "vm/builtin.h"

namespace mms::stdlib::MMS_ISA {

// The figure behind a max_ulp is the worst that was met among all floats, or every 17th, and where
// (tests/unit/stdlib/sweep_test.cpp).
inline constexpr vm::Builtin kElementaryRows[] = {
    vm::builtin<Sin>({.signature = "real sin(real x)",
                      .module = "math",
                      .doc = "Sine of an angle in radians, for every finite x; NaN for infinite x.",
                      .example = "sin(0.5)",
                      .derivative = "cos(x)",
                      .max_ulp = 1.6,  // 1.581470 at 0x1.f0a58ap+91, of all floats

                      .cost = 20,
                      .bounds = {vm::BoundsForm::Exact, bounds::sin, -1, 1}}),
    vm::builtin<Cos>({.signature = "real cos(real x)",
                      .module = "math",
                      .doc = "Cosine of an angle in radians; the range is that of sin.",
                      .example = "cos(0.5)",
                      .derivative = "-sin(x)",
                      .max_ulp = 1.6,  // 1.585331 at 0x1.ebb01cp+105, of all floats

                      .cost = 15,
                      .bounds = {vm::BoundsForm::Exact, bounds::cos, -1, 1}}),
    vm::builtin<Tan>({.signature = "real tan(real x)",
                      .module = "math",
                      .doc = "Tangent of an angle in radians; the range is that of sin.",
                      .example = "tan(0.5)",
                      .derivative = "1 + tan(x) ^ 2",
                      .max_ulp = 0.501,  // 0.500000 at 0x1.ccfeb2p+2

                      .cost = 35,
                      .bounds = {vm::BoundsForm::Exact, bounds::tan}}),
    vm::builtin<Asin>({.signature = "real asin(real x)",
                       .module = "math",
                       .doc = "Angle in [-pi/2, pi/2] whose sine is x; NaN outside [-1, 1].",
                       .example = "asin(0.5)",
                       .derivative = "1 / sqrt(1 - x * x)",
                       .max_ulp = 0.501,  // 0.500000 at 0x1.d12edp-12

                       .cost = 70,
                       .bounds = {vm::BoundsForm::Exact, bounds::asin}}),
    vm::builtin<Acos>({.signature = "real acos(real x)",
                       .module = "math",
                       .doc = "Angle in [0, pi] whose cosine is x; NaN outside [-1, 1].",
                       .example = "acos(0.5)",
                       .derivative = "-1 / sqrt(1 - x * x)",
                       .max_ulp = 0.501,  // 0.500000 at 0x1.16e4aap-3

                       .cost = 70,
                       .bounds = {vm::BoundsForm::Exact, bounds::acos}}),
    vm::builtin<Atan>({.signature = "real atan(real x)",
                       .module = "math",
                       .doc = "Angle in [-pi/2, pi/2] whose tangent is x.",
                       .example = "atan(2.0)",
                       .derivative = "1 / (1 + x * x)",
                       .max_ulp = 0.501,  // 0.500000 at 0x1.d7dee6p+5

                       .cost = 50,
                       .bounds = {vm::BoundsForm::Exact, bounds::atan}}),
    vm::builtin<Atan2>({.signature = "real atan2(real y, x)",
                        .module = "math",
                        .doc = "Angle of the point (x, y) in [-pi, pi], measured from the x axis; "
                               "signed zeros and infinities as C99.",
                        .example = "atan2(1.0, -1.0)",
                        .derivative = "x / (x * x + y * y); -y / (x * x + y * y)",
                        .max_ulp = 0.51,
                        .cost = 50,
                        .bounds = {vm::BoundsForm::Exact, bounds::atan2}}),
    vm::builtin<Sinh>({.signature = "real sinh(real x)",
                       .module = "math",
                       .doc = "Hyperbolic sine.",
                       .example = "sinh(0.5)",
                       .derivative = "cosh(x)",
                       .max_ulp = 0.501,  // 0.500000 at -0x1.6d543ep-9

                       .cost = 35,
                       .bounds = {vm::BoundsForm::Exact, bounds::sinh}}),
    vm::builtin<Cosh>({.signature = "real cosh(real x)",
                       .module = "math",
                       .doc = "Hyperbolic cosine.",
                       .example = "cosh(0.5)",
                       .derivative = "sinh(x)",
                       .max_ulp = 0.501,  // 0.500000 at -0x1.cd401p-5

                       .cost = 30,
                       .bounds = {vm::BoundsForm::Exact, bounds::cosh}}),
    vm::builtin<Tanh>({.signature = "real tanh(real x)",
                       .module = "math",
                       .doc = "Hyperbolic tangent.",
                       .example = "tanh(0.5)",
                       .derivative = "1 - tanh(x) ^ 2",
                       .max_ulp = 0.501,  // 0.500000 at -0x1.679054p+0

                       .cost = 35,
                       .bounds = {vm::BoundsForm::Exact, bounds::tanh, -1, 1}}),
    vm::builtin<Asinh>({.signature = "real asinh(real x)",
                        .module = "math",
                        .doc = "Number whose hyperbolic sine is x.",
                        .example = "asinh(0.5)",
                        .derivative = "1 / hypot(x, 1)",
                        .max_ulp = 0.501,  // 0.500000 at 0x1.b121a6p+75

                        .cost = 50,
                        .bounds = {vm::BoundsForm::Exact, bounds::asinh}}),
    vm::builtin<Acosh>({.signature = "real acosh(real x)",
                        .module = "math",
                        .doc = "Number, 0 or above, whose hyperbolic cosine is x; NaN below 1.",
                        .example = "acosh(1.5)",
                        .derivative = "1 / (sqrt(x - 1) * sqrt(x + 1))",
                        .max_ulp = 0.501,  // 0.500000 at 0x1.b121a6p+75

                        .cost = 50,
                        .bounds = {vm::BoundsForm::Exact, bounds::acosh}}),
    vm::builtin<Atanh>({.signature = "real atanh(real x)",
                        .module = "math",
                        .doc = "Number whose hyperbolic tangent is x; infinite at -1 and 1, NaN "
                               "beyond.",
                        .example = "atanh(0.5)",
                        .derivative = "1 / ((1 - x) * (1 + x))",
                        .max_ulp = 0.501,  // 0.500000 at 0x1.d5fa86p-10

                        .cost = 50,
                        .bounds = {vm::BoundsForm::Exact, bounds::atanh}}),
    vm::builtin<Exp>({.signature = "real exp(real x)",
                      .module = "math",
                      .doc = "e to the power x; 0 below -104, infinite above 88.8.",
                      .example = "exp(0.5)",
                      .derivative = "exp(x)",
                      .max_ulp = 1.1,  // 1.095441 at 0x1.4cba34p+2, of all floats

                      .cost = 10,
                      .bounds = {vm::BoundsForm::Exact, bounds::exp, 0, kInf<double>}}),
    vm::builtin<Exp2>({.signature = "real exp2(real x)",
                       .module = "math",
                       .doc = "2 to the power x.",
                       .example = "exp2(0.5)",
                       .derivative = "exp2(x) * 0.6931471805599453",
                       .max_ulp = 1.1,  // 1.077681 at -0x1.fce5d6p-2, of all floats

                       .cost = 10,
                       .bounds = {vm::BoundsForm::Exact, bounds::exp2, 0, kInf<double>}}),
    vm::builtin<Expm1>({.signature = "real expm1(real x)",
                        .module = "math",
                        .doc = "exp(x) - 1 without the cancellation near 0.",
                        .example = "expm1(0.001)",
                        .derivative = "exp(x)",
                        .max_ulp = 0.501,  // 0.500000 at 0x1.62b666p+1

                        .cost = 35,
                        .bounds = {vm::BoundsForm::Exact, bounds::expm1}}),
    vm::builtin<Log>({.signature = "real log(real x)",
                      .module = "math",
                      .doc = "Natural logarithm; -infinity at 0, NaN below.",
                      .example = "log(2.0)",
                      .derivative = "1 / x",
                      .max_ulp = 0.87,  // 0.862279 at 0x1.65eaa2p-1, of all floats

                      .cost = 15,
                      .bounds = {vm::BoundsForm::Exact, bounds::log}}),
    vm::builtin<Log2>({.signature = "real log2(real x)",
                       .module = "math",
                       .doc = "Logarithm to base 2; -infinity at 0, NaN below.",
                       .example = "log2(3.0)",
                       .derivative = "1.4426950408889634 / x",
                       .max_ulp = 1.1,  // 1.046773 at 0x1.6972a4p+0, of all floats

                       .cost = 15,
                       .bounds = {vm::BoundsForm::Exact, bounds::log2}}),
    vm::builtin<Log10>({.signature = "real log10(real x)",
                        .module = "math",
                        .doc = "Logarithm to base 10; -infinity at 0, NaN below.",
                        .example = "log10(2.0)",
                        .derivative = "0.4342944819032518 / x",
                        .max_ulp = 0.501,  // 0.500000 at 0x1.fe9bb8p+28

                        .cost = 35,
                        .bounds = {vm::BoundsForm::Exact, bounds::log10}}),
    vm::builtin<Log1p>(
        {.signature = "real log1p(real x)",
         .module = "math",
         .doc = "log(1 + x) without the cancellation near 0; -infinity at -1, NaN below.",
         .example = "log1p(0.001)",
         .derivative = "1 / (1 + x)",
         .max_ulp = 0.501,  // 0.500000 at 0x1.577ac6p+78

         .cost = 40,
         .bounds = {vm::BoundsForm::Exact, bounds::log1p}}),
    vm::builtin<Pow>({.signature = "real pow(real x, y)",
                      .module = "math",
                      .doc = "x to the power y; what `x ^ y` means for reals. pow(0, 0) is 1, as "
                             "are pow(x, 0) and pow(1, y) for every x and y; NaN for negative x "
                             "and fractional y; other edge cases as C99.",
                      .example = "pow(2.0, 0.5)",
                      .derivative = "y * pow(x, y - 1); pow(x, y) * log(x)",
                      .max_ulp = 0.51,
                      .cost = 120,
                      .bounds = {vm::BoundsForm::Exact, bounds::pow}}),
    vm::builtin<PowI>({.signature = "real powi(real x, integer n)",
                       .module = "math",
                       .doc = "x multiplied by itself n times; what `x ^ n` means for an integer "
                              "n. 1 for n = 0; 1 / powi(x, -n) for negative n.",
                       .example = "powi(1.5, 3)",
                       .derivative = "n * powi(x, n - 1); 0",
                       .max_ulp = 0.51,
                       .cost = 180,
                       .bounds = {vm::BoundsForm::Exact, bounds::powi}}),
    vm::builtin<Sqrt>({.signature = "real sqrt(real x)",
                       .module = "math",
                       .doc = "Square root; NaN below 0, -0 at -0.",
                       .example = "sqrt(2.0)",
                       .derivative = "0.5 / sqrt(x)",
                       .max_ulp = 0.5,
                       .cost = 4,
                       .bounds = {vm::BoundsForm::Exact, bounds::sqrt},
                       .instruction = vm::LoweredOp::SqrtR}),
    vm::builtin<Cbrt>({.signature = "real cbrt(real x)",
                       .module = "math",
                       .doc = "Cube root, of negative numbers too.",
                       .example = "cbrt(-8.0)",
                       .derivative = "1 / (3 * cbrt(x) ^ 2)",
                       .max_ulp = 0.501,  // 0.500000 at 0x1.4371cep-122

                       .cost = 60,
                       .bounds = {vm::BoundsForm::Exact, bounds::cbrt}}),
    vm::builtin<Hypot>({.signature = "real hypot(real x, y)",
                        .module = "math",
                        .doc = "sqrt(x^2 + y^2) without overflow; infinite where either is "
                               "infinite, even if the other is NaN.",
                        .example = "hypot(3.0, 4.0)",
                        .derivative = "x / hypot(x, y); y / hypot(x, y)",
                        .max_ulp = 0.51,
                        .cost = 10,
                        .bounds = {vm::BoundsForm::Exact, bounds::hypot}}),
    vm::builtin<Fmod>({.signature = "real fmod(real a, b)",
                       .module = "math",
                       .doc = "a - b trunc(a / b) without rounding: has the sign of a. NaN where "
                              "b is 0 or a is infinite; a where b is infinite.",
                       .example = "fmod(-5.5, 2.0)",
                       .derivative = "1; -trunc(a / b)",
                       .cost = 15,
                       .bounds = {vm::BoundsForm::Parts, bounds::fmod}}),
    vm::builtin<Floor>({.signature = "real floor(real x)",
                        .module = "math",
                        .doc = "Largest whole number not above x.",
                        .example = "floor(-1.5)",
                        .derivative = "0",
                        .cost = 1,
                        .bounds = {vm::BoundsForm::Exact, bounds::floor},
                        .instruction = vm::LoweredOp::FloorR}),
    vm::builtin<Ceil>({.signature = "real ceil(real x)",
                       .module = "math",
                       .doc = "Smallest whole number not below x.",
                       .example = "ceil(-1.5)",
                       .derivative = "0",
                       .cost = 1,
                       .bounds = {vm::BoundsForm::Exact, bounds::ceil}}),
    vm::builtin<Trunc>({.signature = "real trunc(real x)",
                        .module = "math",
                        .doc = "x without its fraction.",
                        .example = "trunc(-1.5)",
                        .derivative = "0",
                        .cost = 1,
                        .bounds = {vm::BoundsForm::Exact, bounds::trunc}}),
    vm::builtin<Round>({.signature = "real round(real x)",
                        .module = "math",
                        .doc = "Nearest whole number; halves go away from 0.",
                        .example = "round(2.5)",
                        .derivative = "0",
                        .cost = 2,
                        .bounds = {vm::BoundsForm::Exact, bounds::round}}),
    vm::builtin<Fract>({.signature = "real fract(real x)",
                        .module = "math",
                        .doc = "x - floor(x), in [0, 1): what would round up to 1 is the number "
                               "below 1. NaN for infinite x.",
                        .example = "fract(-0.25)",
                        .derivative = "1",
                        .max_ulp = 1,
                        .cost = 1,
                        .bounds = {vm::BoundsForm::Exact, bounds::fract, 0, 1}}),
    vm::builtin<Abs>({.signature = "real abs(real x)",
                      .module = "math",
                      .doc = "x without its sign; of NaN, NaN.",
                      .example = "abs(-2.0)",
                      .derivative = "sign(x)",
                      .cost = 1,
                      .bounds = {vm::BoundsForm::Exact, bounds::abs},
                      .instruction = vm::LoweredOp::AbsR}),
    vm::builtin<Sign>(
        {.signature = "real sign(real x)",
         .module = "math",
         .doc =
             "-1, 0 or 1 as x is negative, zero or positive; -0 and NaN are returned as they are.",
         .example = "sign(-2.0)",
         .derivative = "0",
         .cost = 2,
         .bounds = {vm::BoundsForm::Exact, bounds::sign}}),
    vm::builtin<Min>({.signature = "real min(real a, b)",
                      .module = "math",
                      .doc = "The smaller; NaN where either is NaN.",
                      .example = "min(1.0, 2.0)",
                      .derivative = "step(a, b); 1 - step(a, b)",
                      .cost = 2,
                      .bounds = {vm::BoundsForm::Exact, bounds::min}}),
    vm::builtin<Max>({.signature = "real max(real a, b)",
                      .module = "math",
                      .doc = "The larger; NaN where either is NaN.",
                      .example = "max(1.0, 2.0)",
                      .derivative = "step(b, a); 1 - step(b, a)",
                      .cost = 1,
                      .bounds = {vm::BoundsForm::Exact, bounds::max}}),
    vm::builtin<Clamp>(
        {.signature = "real clamp(real x, low, high)",
         .module = "math",
         .doc = "x limited to [low, high]; `high` where low > high; NaN where x is NaN; a bound "
                "that is NaN does not act.",
         .example = "clamp(1.5, 0.0, 1.0)",
         .derivative = "step(low, x) * step(x, high); (1 - step(low, x)) * step(low, high); "
                       "1 - step(max(x, low), high)",
         .cost = 2,
         .bounds = {vm::BoundsForm::Exact, bounds::clamp}}),
    vm::builtin<AbsI>(
        {.signature = "integer abs(integer x)",
         .module = "math",
         .doc = "x without its sign; the smallest integer stays, as it has no counterpart.",
         .example = "abs(-2)",
         .derivative = "",
         .cost = 1,
         .bounds = {vm::BoundsForm::Exact, bounds::abs_integer}}),
    vm::builtin<SignI>({.signature = "integer sign(integer x)",
                        .module = "math",
                        .doc = "-1, 0 or 1 as x is negative, zero or positive.",
                        .example = "sign(-2)",
                        .derivative = "",
                        .cost = 1,
                        .bounds = {vm::BoundsForm::Exact, bounds::sign_integer}}),
    vm::builtin<MinI>({.signature = "integer min(integer a, b)",
                       .module = "math",
                       .doc = "The smaller.",
                       .example = "min(1, 2)",
                       .derivative = "",
                       .cost = 1,
                       .bounds = {vm::BoundsForm::Exact, bounds::min_integer}}),
    vm::builtin<MaxI>({.signature = "integer max(integer a, b)",
                       .module = "math",
                       .doc = "The larger.",
                       .example = "max(1, 2)",
                       .derivative = "",
                       .cost = 1,
                       .bounds = {vm::BoundsForm::Exact, bounds::max_integer}}),
    vm::builtin<ClampI>({.signature = "integer clamp(integer x, low, high)",
                         .module = "math",
                         .doc = "x limited to [low, high]; `high` where low > high.",
                         .example = "clamp(5, 0, 3)",
                         .derivative = "",
                         .cost = 2,
                         .bounds = {vm::BoundsForm::Exact, bounds::clamp_integer}}),
};

}  // namespace mms::stdlib::MMS_ISA
