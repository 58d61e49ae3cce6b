// SPDX-License-Identifier: Apache-2.0
#include "api/accuracy.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "api/inputs.h"
#include "api/outputs.h"
#include "vm/trace.h"

namespace mms::api {

namespace {

/// One output while its errors are collected.
struct Collected {
  OutputAccuracy report;
  std::vector<vm::ValueSource> sources;  ///< that are not constant
  std::vector<float> ulps, absolutes;
};

/// The outputs that an entry computes.
std::vector<Collected> outputs_of(const vm::Descriptor& d, const vm::Entry& entry) {
  std::vector<Collected> all;
  for (int o = 0; o < static_cast<int>(vm::Output::Count); ++o) {
    const auto output = static_cast<vm::Output>(o);
    Collected c;
    const auto add = [&](const vm::ValueSource& s) {
      const bool real = s.type == vm::SlotType::Real || s.type == vm::SlotType::Spectrum;
      if (!s.constant && real) c.sources.push_back(s);
    };
    if (const auto numbers = number_sources(d, output); numbers && numbers->entry == &entry)
      std::for_each(numbers->sources.begin(), numbers->sources.end(), add);
    if (const auto m = material_source(d, output); m && m->entry == &entry)
      for (const vm::LayoutNode& node : m->layout->nodes)
        std::for_each(node.params.begin(), node.params.end(), add);
    if (c.sources.empty()) continue;
    c.report.descriptor =
        fmt::format("{} {}", d.form == vm::DescriptorForm::Surface ? "surface" : "volume", d.name);
    c.report.output = output_name(d.form, output);
    all.push_back(std::move(c));
  }
  return all;
}

/// One machine, and the time it has run.
template <class R>
struct Timed {
  explicit Timed(int width) : in(width), machine(width) { fill_defaults(in); }
  void run(const vm::Executable& exe, std::uint32_t function, int lanes) {
    const auto start = std::chrono::steady_clock::now();
    machine.run(exe, function, in, lanes);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  vm::InputBatch<R> in;
  vm::Interpreter<R> machine;
  double seconds = 0;
};

double ulp_at(double x) {
  int exponent;
  std::frexp(x, &exponent);
  return std::ldexp(1.0, std::max(exponent, -125) - 24);
}

double median(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class Comparison {
 public:
  Comparison(const vm::Program& program, const Samples& samples)
      : program_(program),
        samples_(samples),
        exe_(program),
        float_(exe_.width()),
        double_(exe_.width()) {}

  Accuracy run() {
    for (const vm::Descriptor& d : program_.descriptors)
      for (const NamedEntry& e : kEntries) entry(d, d.*e.entry, e.name);
    return std::move(result_);
  }

 private:
  void entry(const vm::Descriptor& d, const vm::Entry& e, const char* name) {
    std::vector<Collected> outputs = outputs_of(d, e);
    if (!e.function || outputs.empty()) return;
    float_.run(exe_, *e.function, 1);  // what is made once is not timed
    double_.run(exe_, *e.function, 1);
    float_.seconds = double_.seconds = 0;
    for (int first = 0; first < samples_.count; first += exe_.width()) {
      const int lanes = std::min(exe_.width(), samples_.count - first);
      fill_samples(float_.in, samples_, first, lanes);
      fill_samples(double_.in, samples_, first, lanes);
      float_.run(exe_, *e.function, lanes);
      double_.run(exe_, *e.function, lanes);
      std::vector<bool> skip(static_cast<std::size_t>(lanes));
      for (const vm::Fault& f : float_.machine.faults())
        skip[static_cast<std::size_t>(f.lane)] = true;
      for (const vm::Fault& f : double_.machine.faults())
        skip[static_cast<std::size_t>(f.lane)] = true;
      result_.given_up += static_cast<std::uint64_t>(std::count(skip.begin(), skip.end(), true));
      for (Collected& c : outputs)
        for (int i = 0; i < lanes; ++i)
          if (!skip[static_cast<std::size_t>(i)]) compare(*e.function, c, i);
    }
    for (Collected& c : outputs) {
      c.report.median_ulp = median(c.ulps);
      c.report.median_absolute = median(c.absolutes);
      result_.outputs.push_back(std::move(c.report));
    }
    result_.speeds.push_back({result_.outputs.back().descriptor, name,
                              samples_.count / float_.seconds, samples_.count / double_.seconds});
  }

  void compare(std::uint32_t function, Collected& c, int lane) {
    for (const vm::ValueSource& s : c.sources)
      for (int k = 0; k < vm::block_count(s.type); ++k) {
        const int index = static_cast<int>(s.index);
        const double x = float_.machine.result(index, k)[lane];
        const double exact = double_.machine.result(index, k)[lane];
        if (std::isfinite(x) && std::isfinite(exact))
          add(c, x, exact, lane);
        else
          not_finite(function, s.index, c.report, lane, std::isfinite(exact));
      }
  }

  void add(Collected& c, double x, double exact, int lane) {
    OutputAccuracy& r = c.report;
    const double absolute = std::fabs(x - exact), ulp = absolute / ulp_at(exact);
    ++r.compared;
    c.ulps.push_back(static_cast<float>(ulp));
    c.absolutes.push_back(static_cast<float>(absolute));
    r.worst_absolute = std::max(r.worst_absolute, absolute);
    if (ulp <= r.worst_ulp && r.compared > 1) return;
    r.worst_ulp = ulp;
    r.float_value = x;
    r.double_value = exact;
    for (int axis = 0; axis < 3; ++axis)
      r.point[static_cast<std::size_t>(axis)] =
          float_.in.lanes(vm::Variable::ObjectPosition, axis)[lane];
  }

  void not_finite(std::uint32_t function, std::uint32_t index, OutputAccuracy& r, int lane,
                  bool lost) {
    r.lost += lost;
    if (r.not_finite++ > 0) return;
    const vm::Trace t = vm::trace(program_, function, float_.in, lane);
    const int origin = index < t.results.size() ? t.results[index].origin : -1;
    r.made_at =
        origin < 0 ? "an input" : place(program_, t.origins[static_cast<std::size_t>(origin)].line);
  }

  const vm::Program& program_;
  const Samples& samples_;
  vm::Executable exe_;
  Timed<float> float_;
  Timed<double> double_;
  Accuracy result_;
};

}  // namespace

std::string place(const vm::Program& program, vm::SourceLine line) {
  const std::string file =
      line.source < program.sources.size() ? program.sources[line.source] : "?";
  if (line.column == 0) return fmt::format("{}:{}", file, line.line);
  return fmt::format("{}:{}:{}", file, line.line, line.column);
}

Accuracy accuracy(const vm::Program& program, const Samples& samples) {
  return Comparison(program, samples).run();
}

}  // namespace mms::api
