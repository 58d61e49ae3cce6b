// SPDX-License-Identifier: Apache-2.0
#include "harness.h"

namespace mms::vm::test {

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

namespace {

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

}  // namespace

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

template void put(InputBatch<float>&, int, const Point<float>&);
template std::vector<Outcome<float>> run(Interpreter<float>&, const Executable&, const Program&,
                                         std::uint32_t, const std::vector<Point<float>>&);
template Outcome<float> reference(const Program&, std::uint32_t, const Point<float>&);
template void check_against_reference(const Program&, std::uint32_t,
                                      const std::vector<Point<float>>&);
template void put(InputBatch<double>&, int, const Point<double>&);
template std::vector<Outcome<double>> run(Interpreter<double>&, const Executable&, const Program&,
                                          std::uint32_t, const std::vector<Point<double>>&);
template Outcome<double> reference(const Program&, std::uint32_t, const Point<double>&);
template void check_against_reference(const Program&, std::uint32_t,
                                      const std::vector<Point<double>>&);

}  // namespace mms::vm::test
