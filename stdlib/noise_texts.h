// SPDX-License-Identifier: Apache-2.0
// Included once for each instruction set; see core.h.
#pragma once

/// \file
/// What the texts of a row of noise say of its number of dimensions, for macros that put rows
/// together: an example's arguments are `(0.3`, `(0.3, 7, 6`, formals `real x`, and so on.

// clang-format off: what is alike stands in columns.

#define MMS_D(name, order) name "_derivative(p, seed, period, " order ")"

#define MMS_VECTOR1 "real"
#define MMS_ARGUMENT1 "x"
#define MMS_AT1 "real x"
#define MMS_OF1 MMS_AT1 ", integer seed, real period"
#define MMS_ZEROS1 "0"
#define MMS_NO_SLOPES1 "0"
#define MMS_EXAMPLE1 "(0.3"
#define MMS_EXAMPLE_OF1 MMS_EXAMPLE1 ", 7, 6"
#define MMS_ORDERS1 ", integer n"
#define MMS_ORDERS_TEXT1 "Derivative of order n"
#define MMS_SECOND1 ", 2"
#define MMS_CURVATURE1(name) name "_derivative(x, seed, period, 2)"
#define MMS_HIGHER1(name) name "_derivative(x, seed, period, max(n, 0) + 1); 0; 0; 0"

#define MMS_VECTOR2 "real[2]"
#define MMS_ARGUMENT2 "p"
#define MMS_AT2 "real[2] p"
#define MMS_OF2 MMS_AT2 ", integer seed, real[2] period"
#define MMS_ZEROS2 "[0, 0]"
#define MMS_NO_SLOPES2 "[[0, 0], [0, 0]]"
#define MMS_EXAMPLE2 "([0.3, 0.7]"
#define MMS_EXAMPLE_OF2 MMS_EXAMPLE2 ", 7, [6, 3]"
#define MMS_ORDERS2 ", integer i, j"
#define MMS_ORDERS_TEXT2 "Mixed derivative, i and j times along the axes in turn,"
#define MMS_SECOND2 ", 2, 0"
#define MMS_CURVATURE2(name) \
  "[" "[" MMS_D(name, "2, 0") ", " MMS_D(name, "1, 1") "]" ", " \
  "[" MMS_D(name, "1, 1") ", " MMS_D(name, "0, 2") "]" "]"
#define MMS_HIGHER2(name) \
  "[" MMS_D(name, "max(i, 0) + 1, j") ", " MMS_D(name, "i, max(j, 0) + 1") "]; 0; [0, 0]; 0; 0"

#define MMS_VECTOR3 "real[3]"
#define MMS_ARGUMENT3 "p"
#define MMS_AT3 "real[3] p"
#define MMS_OF3 MMS_AT3 ", integer seed, real[3] period"
#define MMS_ZEROS3 "[0, 0, 0]"
#define MMS_NO_SLOPES3 "[[0, 0, 0], [0, 0, 0], [0, 0, 0]]"
#define MMS_EXAMPLE3 "([0.3, 0.7, 1.9]"
#define MMS_EXAMPLE_OF3 MMS_EXAMPLE3 ", 7, [6, 3, 0]"
#define MMS_ORDERS3 ", integer i, j, k"
#define MMS_ORDERS_TEXT3 "Mixed derivative, i, j and k times along the axes in turn,"
#define MMS_SECOND3 ", 2, 0, 0"
#define MMS_CURVATURE3(name) \
  "[" "[" MMS_D(name, "2, 0, 0") ", " MMS_D(name, "1, 1, 0") ", " MMS_D(name, "1, 0, 1") "]" ", " \
  "[" MMS_D(name, "1, 1, 0") ", " MMS_D(name, "0, 2, 0") ", " MMS_D(name, "0, 1, 1") "]" ", " \
  "[" MMS_D(name, "1, 0, 1") ", " MMS_D(name, "0, 1, 1") ", " MMS_D(name, "0, 0, 2") "]" "]"
#define MMS_HIGHER3(name)                                                                    \
  "[" MMS_D(name, "max(i, 0) + 1, j, k") ", " MMS_D(name, "i, max(j, 0) + 1, k") ", " MMS_D( \
      name, "i, j, max(k, 0) + 1") "]; 0; [0, 0, 0]; 0; 0; 0"

#define MMS_VECTOR4 "real[4]"
#define MMS_ARGUMENT4 "p"
#define MMS_AT4 "real[4] p"
#define MMS_OF4 MMS_AT4 ", integer seed, real[4] period"
#define MMS_ZEROS4 "[0, 0, 0, 0]"
#define MMS_NO_SLOPES4 "[[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 0, 0]]"
#define MMS_EXAMPLE4 "([0.3, 0.7, 1.9, 2.2]"
#define MMS_EXAMPLE_OF4 MMS_EXAMPLE4 ", 7, [6, 3, 0, 9]"
#define MMS_ORDERS4 ", integer i, j, k, l"
#define MMS_ORDERS_TEXT4 "Mixed derivative, i, j, k and l times along the axes in turn,"
#define MMS_SECOND4 ", 2, 0, 0, 0"
#define MMS_CURVATURE4(name) \
  "[" "[" MMS_D(name, "2, 0, 0, 0") ", " MMS_D(name, "1, 1, 0, 0") ", " MMS_D(name, "1, 0, 1, 0") ", " MMS_D(name, "1, 0, 0, 1") "]" ", " \
  "[" MMS_D(name, "1, 1, 0, 0") ", " MMS_D(name, "0, 2, 0, 0") ", " MMS_D(name, "0, 1, 1, 0") ", " MMS_D(name, "0, 1, 0, 1") "]" ", " \
  "[" MMS_D(name, "1, 0, 1, 0") ", " MMS_D(name, "0, 1, 1, 0") ", " MMS_D(name, "0, 0, 2, 0") ", " MMS_D(name, "0, 0, 1, 1") "]" ", " \
  "[" MMS_D(name, "1, 0, 0, 1") ", " MMS_D(name, "0, 1, 0, 1") ", " MMS_D(name, "0, 0, 1, 1") ", " MMS_D(name, "0, 0, 0, 2") "]" "]"
#define MMS_HIGHER4(name) \
  "[" MMS_D(name, "max(i, 0) + 1, j, k, l") ", " MMS_D(name, "i, max(j, 0) + 1, k, l") ", " MMS_D( \
      name,                                                                                        \
      "i, j, max(k, 0) + 1, l") ", " MMS_D(name,                                                   \
                                           "i, j, k, max(l, 0) + 1") "]; 0; [0, 0, 0, 0]; 0; 0; "  \
                                                                     "0; 0"

// clang-format on
