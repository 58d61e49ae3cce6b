// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Where the time of a program goes: seconds of every lowered instruction, and of source lines.

#include <chrono>
#include <cstdint>
#include <vector>

#include "vm/interpreter.h"

namespace mms::vm {

class Profile {
 public:
  struct Cost {
    std::uint64_t runs = 0;  ///< batches in which it ran
    double seconds = 0;
  };
  struct LineCost {
    SourceLine line;  ///< column 0
    double seconds = 0;
    double share = 0;  ///< of all lines
    int instructions = 0;
  };

  /// The executable is borrowed.
  explicit Profile(const Executable& exe);

  /// As Interpreter::run, with a clock read before each instruction. What reading it takes is
  /// measured once and taken off; instructions of a few nanoseconds are still uncertain.
  template <class R>
  void run(Interpreter<R>& machine, std::uint32_t function, const InputBatch<R>& in, int lanes);

  /// One for each of code().instructions. A Call's is without what it calls.
  const std::vector<Cost>& costs() const { return costs_; }

  /// Lines that instructions came from, dearest first.
  std::vector<LineCost> by_line() const;

 private:
  using Clock = std::chrono::steady_clock;
  static void watch(void* self, std::uint32_t instruction);
  void see(std::uint32_t instruction);

  const Executable& exe_;
  std::vector<Cost> costs_;
  double clock_seconds_ = 0;
  Clock::time_point last_;
  std::uint32_t running_ = 0;
  bool any_ = false;
};

extern template void Profile::run(Interpreter<float>&, std::uint32_t, const InputBatch<float>&,
                                  int);
extern template void Profile::run(Interpreter<double>&, std::uint32_t, const InputBatch<double>&,
                                  int);

}  // namespace mms::vm
