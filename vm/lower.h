// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The form that runs: three-operand code over slots. It is made at load by running the operand
/// stack symbolically, so pushes cost nothing: an operation takes its operands straight from
/// constants, inputs and the slots where earlier operations left them.
///
/// Plain data: the loops that read it are compiled once for each instruction set and must not
/// share inline functions with the rest of the program.

#include <cstdint>
#include <memory>
#include <vector>

#include "vm/lowered_op.h"
#include "vm/program.h"

namespace mms::vm {

/// A block of lanes, or the first of a spectrum's.
struct Operand {
  enum Base : std::uint32_t { Constant, Input, Slot, Mask };
  std::uint32_t bits = 0;

  static Operand make(Base base, std::uint32_t index) { return {index << 3 | base}; }
  Operand splatted() const { return {bits | 4}; }
  /// Component `k` of a spectrum.
  Operand component(int k) const {
    return splat() ? *this : Operand{bits + (std::uint32_t(k) << 3)};
  }
  /// The real block that stands for a spectrum, as itself.
  Operand unsplatted() const { return {bits & ~4u}; }

  [[gnu::always_inline]] std::uint32_t base() const { return bits & 3; }
  /// A real block that stands for a spectrum.
  [[gnu::always_inline]] bool splat() const { return bits & 4; }
  [[gnu::always_inline]] std::uint32_t index() const { return bits >> 3; }
  friend bool operator==(Operand, Operand) = default;
};

struct LoweredInstruction {
  LoweredOp op;
  bool read_once =
      false;  ///< `dst` is a slot that one instruction reads before it is written again
  Operand dst{}, a{}, b{}, c{};
  std::uint32_t target = 0;
  Operand d{}, e{};  ///< of pairs
};

/// A call of a function or of a builtin, whose operands are single blocks in
/// `LoweredCode::operands`. A builtin runs `repeats` times over successive runs of them.
struct CallSite {
  std::uint32_t function = 0;
  Kernel f32 = nullptr, f64 = nullptr;
  ImageKernel image32 = nullptr, image64 = nullptr;
  std::uint32_t first_arg = 0, args = 0;
  std::uint32_t first_result = 0, results = 0;
  std::uint32_t repeats = 1;
  bool uniform = false;  ///< gives the same in all lanes where the inputs of the frame do
};

/// A frame is `masks` blocks of masks (0: lanes that run; 1, where it loops: lanes that start
/// again) followed by `blocks` slots: results, parameters, then temporaries.
struct LoweredFunction {
  std::uint32_t begin = 0, end = 0;  ///< in LoweredCode::instructions
  std::uint32_t masks = 0, blocks = 0;
  std::uint32_t result_blocks = 0, param_blocks = 0;
  /// Inputs that it or a function it calls reads, as operands in LoweredCode::operands; the last
  /// is below `input_end`.
  std::uint32_t first_input = 0, inputs = 0, input_end = 0;
  bool masked = false;     ///< reads a mask
  bool calls = false;      ///< has a TailCall or a Call, so lanes may be given up
  bool loops = false;      ///< has a TailCall
  bool recursive = false;  ///< can reach itself: its calls are counted
};

struct LoweredResult {
  SlotType type;
  std::uint32_t slot;
};

struct LoweredCode {
  std::vector<LoweredInstruction> instructions;
  std::vector<SourceLine> lines;  ///< one for each instruction
  std::vector<LoweredFunction> functions;
  std::vector<CallSite> sites;
  std::vector<Operand> operands;
  std::vector<Constant> constants;
  /// For each function, where its results are.
  std::vector<std::vector<LoweredResult>> results;
  bool uniform_sites = false;        ///< has a CallSite that is uniform
  std::uint32_t builtin_blocks = 0;  ///< most arguments or results of one builtin call
  std::uint32_t frame_blocks = 0;    ///< masks and slots of the largest frame
  std::vector<std::shared_ptr<const Image>> images;  ///< of the program, by number
  std::vector<const Image*> image_table;             ///< the same
  /// Nobody else's: what an interpreter recognises the code by.
  std::shared_ptr<const char> identity;
};

/// \pre `verify(program)` found no fault.
LoweredCode lower(const Program& program);

}  // namespace mms::vm
