// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Runs a program on the machine and on the reference, and compares them lane by lane.

#include <doctest/doctest.h>

#include <optional>

#include "assembler.h"
#include "reference.h"

namespace mms::vm::test {

/// One value for each machine input of one point.
template <class T>
using Point = std::vector<Cell<T>>;

template <class T>
Point<T> zero_point() {
  return Point<T>(input_count());
}

template <class T>
void put(InputBatch<T>& in, int lane, const Point<T>& point) {
  for (const VariableInfo& v : kVariables)
    for (int c = 0; c < v.components(); ++c) {
      const Cell<T>& cell = point[input_index(v.variable, c)];
      if (v.slot_type() == SlotType::Real)
        in.lanes(v.variable, c)[lane] = cell.r[0];
      else
        for (int k = 0; k < kWavelengths; ++k) in.lanes(v.variable, k)[lane] = cell.r[k];
    }
}

/// What one lane came to.
template <class T>
struct Outcome {
  std::vector<Cell<T>> results;
  std::optional<Fault> fault;  ///< its lane is not compared

  friend bool operator==(const Outcome& a, const Outcome& b) {
    if (a.results.size() != b.results.size() || a.fault.has_value() != b.fault.has_value())
      return false;
    if (a.fault && (a.fault->cause != b.fault->cause || a.fault->line != b.fault->line))
      return false;
    for (std::size_t k = 0; k < a.results.size(); ++k) {
      if (a.results[k].i != b.results[k].i) return false;
      for (int w = 0; w < kWavelengths; ++w)
        if (!same(a.results[k].r[w], b.results[k].r[w])) return false;
    }
    return true;
  }
};

template <class T>
Outcome<T> outcome(const Interpreter<T>& machine, const Function& f, int lane) {
  Outcome<T> o;
  for (std::size_t k = 0; k < f.results.size(); ++k) {
    Cell<T> c;
    const SlotType t = f.results[k];
    if (t == SlotType::Integer || t == SlotType::Logic)
      c.i = machine.integer_result(int(k))[lane];
    else
      for (int w = 0; w < block_count(t); ++w) c.r[w] = machine.result(int(k), w)[lane];
    o.results.push_back(c);
  }
  for (const Fault& fault : machine.faults())
    if (fault.lane == lane) o.fault = fault;
  return o;
}

/// Runs the points as one batch.
template <class T>
std::vector<Outcome<T>> run(Interpreter<T>& machine, const Executable& exe, const Program& p,
                            std::uint32_t function, const std::vector<Point<T>>& points) {
  InputBatch<T> in(int(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) put(in, int(k), points[k]);
  machine.run(exe, function, in, int(points.size()));
  std::vector<Outcome<T>> outcomes;
  for (std::size_t k = 0; k < points.size(); ++k)
    outcomes.push_back(outcome(machine, p.functions[function], int(k)));
  return outcomes;
}

template <class T>
Outcome<T> reference(const Program& p, std::uint32_t function, const Point<T>& point) {
  Outcome<T> o;
  try {
    o.results = Reference<T>(p, point).run(function);
    for (std::size_t k = 0; k < o.results.size(); ++k) {  // only what the type holds
      const SlotType t = p.functions[function].results[k];
      const bool whole = t == SlotType::Integer || t == SlotType::Logic;
      if (!whole) o.results[k].i = 0;
      for (int w = whole ? 0 : block_count(t); w < kWavelengths; ++w) o.results[k].r[w] = 0;
    }
  } catch (const typename Reference<T>::GivenUp& g) {
    o.results.resize(p.functions[function].results.size());
    o.fault = Fault{g.depth ? Fault::Cause::CallDepth : Fault::Cause::BackEdges, 0, g.line};
  }
  return o;
}

/// Checks a function against the reference at every point, for both builds of the machine.
template <class T>
void check_against_reference(const Program& p, std::uint32_t function,
                             const std::vector<Point<T>>& points) {
  REQUIRE(fault_text(p) == "");
  const Executable exe(p);
  std::vector<Outcome<T>> expected;
  for (const Point<T>& point : points) expected.push_back(reference(p, function, point));
  for (const Isa isa : {Isa::Best, Isa::Baseline}) {
    Interpreter<T> machine(int(points.size()), isa);
    const auto found = run(machine, exe, p, function, points);
    std::size_t wrong = 0, first = 0;
    for (std::size_t k = points.size(); k-- > 0;)
      if (!(found[k] == expected[k])) ++wrong, first = k;
    CAPTURE(first);
    CAPTURE(disassemble(p));
    CHECK(wrong == 0);
  }
}

}  // namespace mms::vm::test
