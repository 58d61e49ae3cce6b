// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Runs a lowered program over a batch of shading points.
///
/// `Executable` is immutable and shared by all threads; an `Interpreter` is one thread's scratch:
/// cheap to keep, costly to make. `run` does not throw or print, and allocates only when it meets
/// an executable for the first time or recurses deeper than it ever has.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "vm/limits.h"
#include "vm/program.h"

namespace mms::vm {

struct LoweredCode;  // slot-addressed three-operand code; vm/lower.h

/// A verified program, lowered for this host. Borrows the Program's builtin rows, not the Program.
class Executable {
 public:
  /// \pre `verify(program)` found no fault.
  explicit Executable(const Program& program);
  ~Executable();
  Executable(Executable&&) noexcept;
  Executable& operator=(Executable&&) noexcept;

  const LoweredCode& code() const { return *code_; }
  /// Lanes of a batch: as many as keep the working set in the L2 cache, in [32, 512]. (Measured:
  /// wide batches out of L2 beat narrow ones out of L1, which pay more for each instruction.)
  int width() const;

 private:
  std::unique_ptr<const LoweredCode> code_;
};

/// Allocates at cache lines.
template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{64};
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kAlignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, kAlignment); }
  friend bool operator==(CacheLineAllocator, CacheLineAllocator) { return true; }
};

/// The shading points of one batch: for each machine input (vm/variables.h) `width` lanes.
/// Spectrum inputs are kWavelengths blocks one after another.
template <class R>
class InputBatch {
 public:
  explicit InputBatch(int width);
  int width() const { return width_; }
  /// Lanes of component `c` of `v`; for a spectrum, `c` is the wavelength. Starts as zeros.
  R* lanes(Variable v, int c = 0);
  const R* data() const { return data_.data(); }

 private:
  int width_;
  std::vector<R, CacheLineAllocator<R>> data_;
};

/// Why a lane was given up.
struct Fault {
  enum class Cause : std::uint8_t { BackEdges, CallDepth };
  Cause cause;
  int lane;
  SourceLine line;
};

/// Which build of the machine runs: the best for this host, or the one that runs anywhere. Both
/// give the same bits (but for which NaN it is).
enum class Isa : std::uint8_t { Best, Baseline };

struct RunOptions {
  /// Back edges and recursive calls of one lane before it is given up; at most limits::kBackEdges.
  int back_edges = limits::kBackEdges;
};

template <class R>
class Interpreter {
 public:
  /// Scratch for batches of at most `width` lanes (rounded up to kLaneMultiple) of any program.
  explicit Interpreter(int width, Isa isa = Isa::Best);
  ~Interpreter();
  Interpreter(Interpreter&&) noexcept;
  Interpreter& operator=(Interpreter&&) noexcept;

  /// Runs function `function`, which has no parameters, for the first `lanes` lanes of `in`.
  /// \pre  1 <= lanes <= in.width() <= width of this interpreter.
  /// \post `result(k, c)` holds the results until the next run. Lanes of a fault hold zero.
  void run(const Executable& exe, std::uint32_t function, const InputBatch<R>& in, int lanes,
           const RunOptions& options = {});

  /// From now on calls `watch(watcher, k)` before each instruction k of the lowered code; null: no
  /// more. Costs nothing where nobody watches.
  void observe(void (*watch)(void* watcher, std::uint32_t instruction), void* watcher);

  /// Block of result `k` (component `c` of a spectrum). Real results only.
  const R* result(int k, int c = 0) const;
  /// Block of an Integer or Logic result.
  const std::int32_t* integer_result(int k) const;

  /// Lanes that the last run gave up, each once.
  std::span<const Fault> faults() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

extern template class InputBatch<float>;
extern template class InputBatch<double>;
extern template class Interpreter<float>;
extern template class Interpreter<double>;

}  // namespace mms::vm
