// SPDX-License-Identifier: Apache-2.0
// Enclosures: how much wider they are than what is found by sampling, and what they cost against a
// point of the float machine. Prints the tables of docs/bounds.md.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "api/inputs.h"
#include "api/library.h"
#include "api/outputs.h"
#include "lang/link.h"
#include "lang/parser.h"
#include "vm/bounds.h"
#include "vm/interpreter.h"

namespace mms::bench {
namespace {

constexpr double kSizes[] = {2, 0.5, 0.1, 0.01};
constexpr int kBoxes = 24, kSamples = 4096;

/// A box of that size somewhere in the unit sphere's, for positions and parameters.
vm::Box box_of(double size, std::mt19937& random) {
  vm::Box box = vm::Box::unit_sphere();
  for (const vm::Variable v :
       {vm::Variable::Position, vm::Variable::ObjectPosition, vm::Variable::Uv})
    for (int c = 0; c < vm::info(v).components(); ++c) {
      vm::Interval& i = box.at(v, c);
      const double width = std::min(size, i.width());
      const double lo =
          i.lo + (i.width() - width) * std::uniform_real_distribution<double>(0, 1)(random);
      i = vm::reals(lo, lo + width);
    }
  return box;
}

/// What an output is at points of a box.
vm::Interval sampled(const vm::Executable& executable, std::uint32_t function, std::uint32_t result,
                     vm::SlotType type, const vm::Box& box, std::mt19937& random) {
  vm::InputBatch<float> in(kSamples);
  vm::Interpreter<float> machine(kSamples);
  api::fill_defaults(in);
  for (const vm::Variable v :
       {vm::Variable::Position, vm::Variable::ObjectPosition, vm::Variable::Uv})
    for (int c = 0; c < vm::info(v).components(); ++c) {
      std::uniform_real_distribution<float> number(float(box.at(v, c).lo), float(box.at(v, c).hi));
      for (int i = 0; i < kSamples; ++i) in.lanes(v, c)[i] = number(random);
    }
  machine.run(executable, function, in, kSamples);
  vm::Interval r = vm::Interval::empty();
  for (int c = 0; c < vm::block_count(type); ++c)
    for (int i = 0; i < kSamples; ++i)
      r = join(r, vm::Interval::point(double(machine.result(int(result), c)[i])));
  return r;
}

void tightness(const std::string& name, const vm::Program& program) {
  const vm::Executable executable(program);
  vm::BoundsMachine machine(program);
  for (const vm::Descriptor& d : program.descriptors)
    for (int o = 0; o < int(vm::Output::Count); ++o) {
      const auto output = vm::Output(o);
      const auto sources = api::number_sources(d, output);
      if (!sources || d.output(output).constant || output == vm::Output::Gradient) continue;
      const vm::ValueSource& source = sources->sources[0];
      if (source.constant || !sources->entry->function) continue;
      std::string row = fmt::format("| {} | {} |", name, api::output_name(d.form, output));
      for (const double size : kSizes) {
        std::mt19937 random(5);
        std::vector<double> ratios;
        for (int k = 0; k < kBoxes; ++k) {
          const vm::Box box = box_of(size, random);
          const vm::Interval found = sampled(executable, *sources->entry->function, source.index,
                                             source.type, box, random);
          const vm::Interval sure =
              machine.run(*sources->entry->function, box).results[source.index];
          if (found.width() > 1e-6 * found.magnitude())
            ratios.push_back(sure.width() / found.width());
        }
        std::sort(ratios.begin(), ratios.end());
        row += ratios.empty() ? " - |" : fmt::format(" {:.3g} |", ratios[ratios.size() / 2]);
      }
      fmt::print("{}\n", row);
    }
}

/// The fastest of several runs, in ns for each of `count` things.
template <class F>
double nanoseconds(int count, F f) {
  using Clock = std::chrono::steady_clock;
  double best = 1e300;
  for (int round = 0; round < 15; ++round) {
    const auto begin = Clock::now();
    f();
    best = std::min(best, std::chrono::duration<double, std::nano>(Clock::now() - begin).count());
  }
  return best / count;
}

void speed(const std::string& name, const vm::Program& program, const vm::Entry& entry) {
  const vm::Executable executable(program);
  vm::BoundsMachine bounds(program);
  vm::InputBatch<float> in(executable.width());
  vm::Interpreter<float> machine(executable.width());
  std::mt19937 random(5);
  api::fill_defaults(in);
  const double point = nanoseconds(
      executable.width(), [&] { machine.run(executable, *entry.function, in, in.width()); });
  std::string row = fmt::format("| {} | {:.1f} |", name, point);
  for (const double size : kSizes) {
    constexpr int boxes = 64;
    std::vector<vm::Box> all;
    for (int k = 0; k < boxes; ++k) all.push_back(box_of(size, random));
    row += fmt::format(" {:.0f} |", nanoseconds(boxes, [&] {
                         for (const vm::Box& b : all) bounds.run(*entry.function, b);
                       }));
  }
  fmt::print("{}\n", row);
}

int run() {
  std::vector<std::pair<std::string, lang::Linked>> all;
  for (const char* name : {"murky_glass", "lava", "tiles", "wood", "hammered_gold", "patina", "wax",
                           "lace", "marble"}) {
    const auto source = api::read_source(fmt::format("{}/examples/{}.mms", MMS_SOURCE_DIR, name));
    if (!source) return 1;
    lang::Diagnostics diagnostics;
    std::vector<lang::Graph> graphs;
    graphs.push_back(lang::parse(*source, diagnostics));
    auto linked = lang::link(graphs, api::standard_library(), {}, diagnostics);
    if (!linked) return 1;
    all.emplace_back(name, std::move(*linked));
  }
  const char* head = " 2 | 0.5 | 0.1 | 0.01 |\n";
  fmt::print("Width of the enclosure over the range of {} samples, median of {} boxes\n\n",
             kSamples, kBoxes);
  fmt::print("| script | output |{}|---|---|---|---|---|---|\n", head);
  for (const auto& [name, linked] : all) tightness(name, linked.program);
  fmt::print("\nns for a point of a batch, and for a box of each size\n\n");
  fmt::print("| script | point |{}|---|---|---|---|---|---|\n", head);
  speed("marble, bsdf", all.back().second.program, all.back().second.program.descriptors[0].shade);
  const vm::Program& murky = all.front().second.program;
  speed("murky_glass, volume", murky, murky.find(vm::DescriptorForm::Volume, "murky_glass")->pass);
  return 0;
}

}  // namespace
}  // namespace mms::bench

int main() { return mms::bench::run(); }
