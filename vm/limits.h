// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Every limit of the machine and of the compiler: one number, one sentence. A diagnostic that
/// reports one quotes it from here.

namespace mms::vm::limits {

/// Back edges (tail calls) and recursive calls of one lane in one run: a script that needs more is
/// taken to recurse for ever.
inline constexpr int kBackEdges = 1 << 20;

/// Calls of one lane that are open at a time (calls in tail position do not count).
inline constexpr int kCallDepth = 256;

/// Scattering models and combiners in one material.
inline constexpr int kLobes = 64;

/// Nesting of expressions, types and descriptors in a script.
inline constexpr int kNesting = 256;

/// Elements of an array or structure, all levels counted.
inline constexpr int kAggregate = 4096;

/// Instances of generic functions in one program.
inline constexpr int kInstances = 4096;

/// Nodes of the linked program: every expression after functions have been inlined.
inline constexpr int kNodes = 1 << 20;

/// Calls inlined inside one another while linking.
inline constexpr int kInlineDepth = 200;

/// Expressions inside one another while linking, through the functions that are inlined.
inline constexpr int kExpressionDepth = 1500;

/// Derivatives of derivatives of a function that is not inlined: each order has twice the
/// parameters and several times the operations of the one before.
inline constexpr int kDerivativeOrder = 6;

/// Values on the stack and locals of one function.
inline constexpr int kSlots = 1 << 16;

/// Nesting of If in one function of a program.
inline constexpr int kIfDepth = 4096;

/// Values that the instructions of one program move, each counted where it stands: calls and arms
/// can move far more than a file that holds them has bytes.
inline constexpr int kMoves = 1 << 24;

/// Blocks of the frames of all open calls of one run, masks counted.
inline constexpr int kStackBlocks = 1 << 18;

/// Bytes of one source file.
inline constexpr int kSourceBytes = 1 << 26;

}  // namespace mms::vm::limits
