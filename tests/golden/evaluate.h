// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Links scripts and runs them at random points, for tests: every value as a double, lane by lane.

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "api/inputs.h"
#include "api/library.h"
#include "lang/link.h"
#include "lang/parser.h"
#include "vm/interpreter.h"
#include "vm/verify.h"

namespace mms::golden {

/// What became of a script. The source outlives the diagnostics that point into it.
struct Compiled {
  lang::SourcePtr source;
  lang::Diagnostics diagnostics;
  std::vector<lang::Graph> graphs;
  std::optional<lang::Linked> linked;
  std::string text_of_errors() const { return lang::render(diagnostics); }
};

inline Compiled compile(lang::SourcePtr source, const lang::LinkOptions& options = {}) {
  Compiled c;
  c.source = std::move(source);
  c.graphs.push_back(lang::parse(c.source, c.diagnostics));
  c.linked = lang::link(c.graphs, api::standard_library(), options, c.diagnostics);
  return c;
}

inline Compiled compile(std::string text, lang::Level level = lang::Level::O2) {
  lang::LinkOptions options;
  options.level = level;
  return compile(lang::make_source("test.mms", std::move(text)), options);
}

/// Components of a variable that have lanes of their own.
inline int components(vm::Variable v) { return api::value_count(v); }

/// `width` shading points. Lane 0 is the point of api::fill_defaults; the others are random, with
/// the same numbers for either machine (they are floats).
template <class R>
vm::InputBatch<R> points(int width, std::uint32_t seed = 1) {
  vm::InputBatch<R> in(width);
  api::fill_defaults(in);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> number(-2.0f, 2.0f);
  for (const vm::VariableInfo& v : vm::kVariables) {
    if (v.slot_type() == vm::SlotType::Spectrum) continue;
    for (int c = 0; c < components(v.variable); ++c)
      for (int i = 1; i < width; ++i) in.lanes(v.variable, c)[i] = R(number(random));
  }
  return in;
}

/// Lane `lane` of `from` as the only one.
template <class R>
vm::InputBatch<R> alone(vm::InputBatch<R>& from, int lane) {
  vm::InputBatch<R> in(vm::kLaneMultiple);
  for (const vm::VariableInfo& v : vm::kVariables)
    for (int c = 0; c < components(v.variable); ++c)
      in.lanes(v.variable, c)[0] = from.lanes(v.variable, c)[lane];
  return in;
}

/// Results of a run: `values[slot][lane]`, a spectrum being kWavelengths slots.
struct Run {
  std::vector<std::vector<double>> values;
  std::vector<vm::Fault> faults;
};

template <class R>
Run run(vm::Interpreter<R>& machine, const vm::Program& program, const vm::Executable& executable,
        std::uint32_t function, vm::InputBatch<R>& in, int lanes) {
  machine.run(executable, function, in, lanes);
  Run out;
  const std::vector<vm::SlotType>& types = program.functions[function].results;
  for (std::size_t k = 0; k < types.size(); ++k) {
    const int slot = static_cast<int>(k);
    if (types[k] == vm::SlotType::Integer || types[k] == vm::SlotType::Logic) {
      const std::int32_t* block = machine.integer_result(slot);
      out.values.emplace_back(block, block + lanes);
      continue;
    }
    for (int c = 0; c < vm::block_count(types[k]); ++c) {
      const R* block = machine.result(slot, c);
      out.values.emplace_back(block, block + lanes);
    }
  }
  const auto faults = machine.faults();
  out.faults.assign(faults.begin(), faults.end());
  return out;
}

template <class R>
Run run(const vm::Program& program, const vm::Executable& executable, std::uint32_t function,
        vm::InputBatch<R>& in, int lanes, vm::Isa isa = vm::Isa::Best) {
  vm::Interpreter<R> machine(in.width(), isa);
  return run(machine, program, executable, function, in, lanes);
}

/// Equal as bits; any NaN equals any other.
inline bool same_bits(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) ||
         std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Something a program computes: an export, or an entry of a descriptor, and where its values are.
struct Point {
  std::string name;
  std::optional<std::uint32_t> function;
  std::vector<vm::ValueSource> sources;
};

inline void add_materials(const vm::MaterialLayout& m, std::vector<vm::ValueSource>& sources) {
  for (const vm::LayoutNode& n : m.nodes)
    sources.insert(sources.end(), n.params.begin(), n.params.end());
}

/// Everything the program computes.
inline std::vector<Point> points_of(const vm::Program& p) {
  std::vector<Point> all;
  for (const vm::Export& e : p.exports) {
    all.push_back({e.name, e.function, {}});
    const std::vector<vm::SlotType>& types = p.functions[e.function].results;
    for (std::size_t k = 0; k < types.size(); ++k)
      all.back().sources.push_back({types[k], false, static_cast<std::uint32_t>(k)});
  }
  for (const vm::Descriptor& d : p.descriptors) {
    const vm::Entry &s = d.shade, &e = d.emit;
    all.push_back({d.name + ".shade",
                   s.function,
                   {s.scattering, s.absorption, s.emission, s.gradient[0], s.gradient[1]}});
    add_materials(s.material, all.back().sources);
    add_materials(s.emission_material, all.back().sources);
    all.push_back({d.name + ".pass", d.pass.function, {d.pass.scattering, d.pass.absorption}});
    all.push_back({d.name + ".emit", e.function, {e.emission}});
    add_materials(e.emission_material, all.back().sources);
    all.push_back(
        {d.name + ".displace", d.displace.function, {d.displace.height, d.displace.bound}});
  }
  return all;
}

/// The slots of one source in every lane: a spectrum is kWavelengths of them.
template <class R>
std::vector<std::vector<double>> values_of(const vm::Program& p, const vm::ValueSource& s,
                                           const std::optional<std::uint32_t>& function,
                                           const Run& r, int lanes) {
  const auto width = static_cast<std::size_t>(vm::block_count(s.type));
  if (s.constant) {
    const vm::Constant& c = p.constants[s.index];
    const double v = c.type != vm::SlotType::Real ? c.integer
                     : std::is_same_v<R, float>   ? static_cast<double>(c.f32)
                                                  : c.f64;
    return std::vector(width, std::vector<double>(static_cast<std::size_t>(lanes), v));
  }
  std::size_t first = 0;
  const std::vector<vm::SlotType>& types = p.functions[*function].results;
  for (std::uint32_t k = 0; k < s.index; ++k)
    first += static_cast<std::size_t>(vm::block_count(types[k]));
  const auto begin = r.values.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(width)};
}

/// Runs a point and gives all its slots, in order.
template <class R>
Run evaluate(vm::Interpreter<R>& machine, const vm::Program& p, const vm::Executable& executable,
             const Point& point, vm::InputBatch<R>& in, int lanes) {
  Run raw, out;
  if (point.function) raw = run(machine, p, executable, *point.function, in, lanes);
  for (const vm::ValueSource& s : point.sources)
    for (auto& slot : values_of<R>(p, s, point.function, raw, lanes))
      out.values.push_back(std::move(slot));
  out.faults = raw.faults;
  return out;
}

template <class R>
Run evaluate(const vm::Program& p, const vm::Executable& executable, const Point& point,
             vm::InputBatch<R>& in, int lanes, vm::Isa isa = vm::Isa::Best) {
  vm::Interpreter<R> machine(in.width(), isa);
  return evaluate(machine, p, executable, point, in, lanes);
}

}  // namespace mms::golden
