// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Runs a verified program over boxes instead of points: what a function returns for any point of
/// a box lies in the interval that comes back, in the float and in the double machine.
///
/// Always ends, and is always sound: loops are followed step by step as long as a budget lasts,
/// then widened until nothing changes; recursion deeper than a cap returns anything. A comparison
/// that can come out both ways takes both arms, each with what the comparison says of its operands,
/// and joins them. docs/bounds.md says what that means for an author.
///
/// Owns scratch only; the Program is borrowed. Does not throw or print.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "vm/interval.h"
#include "vm/program.h"

namespace mms::vm {

/// Steps of one loop that an enclosure follows one by one before it is widened.
inline constexpr int kBoundsSteps = 1024;

/// Recursive calls that are open at a time in an enclosure before one returns anything.
inline constexpr int kBoundsDepth = 48;

/// Cost of an enclosure, in instructions, from which on every loop is widened at once; at ten times
/// as much every call returns anything.
inline constexpr int kBoundsInstructions = 1 << 20;

/// Rounds of widening before what still grows in a loop is taken for anything.
inline constexpr int kBoundsRounds = 24;

/// What is known of the point that is shaded: an interval for each machine input (vm/variables.h).
/// That of a spectrum holds for all its wavelengths. The two curves of `rgb` come from one
/// wavelength: neither is negative, and together they are at most 1.
struct Box {
  std::array<Interval, input_count()> inputs;

  /// The points of the unit sphere and of the box around it: positions, normals and directions in
  /// [-1, 1], `$uv` in [0, 1], time 0, every wavelength that is rendered (360 to 830 nm), and any
  /// footprint and distance.
  static Box unit_sphere();

  Interval& at(Variable v, int component = 0);
  const Interval& at(Variable v, int component = 0) const {
    return const_cast<Box*>(this)->at(v, component);
  }
};

/// The enclosures of a run.
struct Enclosure {
  std::vector<Interval> results;  ///< one for each result of the function
  bool widened = false;           ///< a loop or a recursion was cut short: wider than need be
};

/// Scratch for enclosures of one program.
class BoundsMachine {
 public:
  /// \pre `verify(program)` found no fault; it outlives this.
  explicit BoundsMachine(const Program& program);
  ~BoundsMachine();
  BoundsMachine(BoundsMachine&&) noexcept;

  /// Encloses the results of `function`, which has no parameters, over `box`. A lane that the
  /// machine gives up (vm/limits.h) holds zeros; where that may happen, zero is enclosed too.
  Enclosure run(std::uint32_t function, const Box& box);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What the kernels of `row` return over a box of its flattened arguments.
void enclose_row(const Builtin& row, std::span<const SlotType> results,
                 std::span<const Interval> in, std::span<Interval> out);

/// One value of an entry, over a box: a constant, or what its function returns.
Interval enclose(BoundsMachine& machine, const Program& program, const Entry& entry,
                 const ValueSource& value, const Box& box);

/// Calls `f(Box)` for each of `n`^k equal parts of `box`, which is split along the `k` inputs in
/// `axes`; stops when `f` returns false.
template <class F>
void each_part(const Box& box, std::span<const int> axes, int n, F f) {
  std::vector<int> at(axes.size(), 0);
  for (;;) {
    Box part = box;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const Interval& whole = box.inputs[static_cast<std::size_t>(axes[k])];
      const auto end = [&](int i) {
        return i == 0 ? whole.lo : i == n ? whole.hi : whole.lo + (whole.hi - whole.lo) * i / n;
      };
      part.inputs[static_cast<std::size_t>(axes[k])] = reals(end(at[k]), end(at[k] + 1), whole.nan);
    }
    if (!f(part)) return;
    std::size_t k = 0;
    while (k < at.size() && ++at[k] == n) at[k++] = 0;
    if (k == at.size()) return;
  }
}

}  // namespace mms::vm
