// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the execution loop works on, as plain data, and its two builds. Internal to vm.

#include <cstddef>
#include <cstdint>

#include "vm/interpreter.h"
#include "vm/limits.h"
#include "vm/lower.h"

namespace mms::vm {

/// Scratch of one run of an Interpreter. Pointers are borrowed from it; blocks are `lanes` wide
/// but for those with a stride of their own.
struct Machine {
  const LoweredInstruction* code;
  const SourceLine* lines;
  const LoweredFunction* functions;
  const CallSite* sites;
  const Operand* operands;

  bool uniform;  ///< the inputs of the frame are the same in all lanes
  const Image* const* images;
  int image_count;
  std::byte* constants;
  std::byte* inputs;
  std::size_t constant_stride, input_stride;  ///< bytes between blocks
  int lanes;                                  ///< a multiple of kLaneMultiple

  std::int32_t* spent;  ///< back edges and recursive calls of each lane
  std::int32_t* alive;  ///< 0 where a lane was given up
  Fault* faults;        ///< room for one each lane
  int fault_count;
  int back_edges;  ///< that a lane may take

  const void** in;  ///< room for the blocks of one builtin call
  void** out;

  /// Called before each instruction, if there is one.
  void (*watch)(void* watcher, std::uint32_t instruction);
  void* watcher;

  std::size_t open_blocks;  ///< of all open frames
  void* frames;
  /// A frame of that many bytes, aligned to a cache line; frames are given back last first.
  std::byte* (*push_frame)(void* frames, std::size_t bytes);
  void (*pop_frame)(void* frames, std::size_t bytes);
};

/// Bytes of a frame.
template <class R>
constexpr std::size_t frame_bytes(const LoweredFunction& f, int lanes) {
  return std::size_t(lanes) * (f.masks * sizeof(std::int32_t) + f.blocks * sizeof(R));
}

/// Runs a function on a frame whose mask 0 and parameters are set, to its end. `depth`: open calls.
namespace baseline {
void execute(float, Machine& m, std::uint32_t function, std::byte* frame, int depth);
void execute(double, Machine& m, std::uint32_t function, std::byte* frame, int depth);
}  // namespace baseline
#if defined(__x86_64__)
namespace avx2 {
void execute(float, Machine& m, std::uint32_t function, std::byte* frame, int depth);
void execute(double, Machine& m, std::uint32_t function, std::byte* frame, int depth);
}  // namespace avx2
#endif

}  // namespace mms::vm
