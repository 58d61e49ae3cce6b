// SPDX-License-Identifier: Apache-2.0
// The benchmarks of the machine: prints its tables and writes its part of docs/performance.md.
//
//   bench_shaders [--rounds N] [--only NAME] [--no-document]
#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <thread>

#include "api/library.h"
#include "bench/document.h"
#include "bench/report.h"
#include "lang/parser.h"
#include "vm/lower.h"
#include "vm/verify.h"

namespace mms::bench {
namespace {

constexpr int kPoints = 1024;

struct Options {
  int rounds = 101;
  std::string only;
  bool write = true;
};

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

/// The marble from its text to its first batch.
ColdStart cold_start(const std::string& text, const vm::InputBatch<float>& batch) {
  using Clock = std::chrono::steady_clock;
  ColdStart cold{};
  auto start = Clock::now();
  lang::Diagnostics diagnostics;
  const lang::Graph graph = lang::parse(lang::make_source("marble", text), diagnostics);
  cold.parse_ms = milliseconds_since(start);
  start = Clock::now();
  auto linked = lang::link({&graph, 1}, api::standard_library(), {}, diagnostics);
  cold.link_ms = milliseconds_since(start);
  if (!linked) std::exit(1);
  start = Clock::now();
  if (vm::verify(linked->program)) std::exit(1);
  const vm::Executable executable(linked->program);
  vm::Interpreter<float> machine(batch.width());
  cold.lower_ms = milliseconds_since(start);
  start = Clock::now();
  machine.run(executable, linked->program.exports[0].function, batch, batch.width());
  cold.run_ms = milliseconds_since(start);
  return cold;
}

/// Several first times, each in a process of its own that this one forks before it links anything.
std::vector<ColdStart> cold_starts(int count, const std::string& text,
                                   const vm::InputBatch<float>& batch) {
  std::vector<ColdStart> all;
  for (int k = 0; k < count; ++k) {
    int ends[2];
    if (pipe(ends) != 0) break;
    const pid_t child = fork();
    if (child == 0) {
      const ColdStart cold = cold_start(text, batch);
      _exit(write(ends[1], &cold, sizeof cold) == sizeof cold ? 0 : 1);
    }
    ColdStart cold;
    if (child > 0 && read(ends[0], &cold, sizeof cold) == sizeof cold) all.push_back(cold);
    if (child > 0) waitpid(child, nullptr, 0);
    close(ends[0]);
    close(ends[1]);
  }
  std::sort(all.begin(), all.end(),
            [](const ColdStart& a, const ColdStart& b) { return a.total() < b.total(); });
  return all;
}

std::function<void()> scalar(Twin<float> twin, const Points& points, std::vector<float>& out) {
  return [twin, &points, &out] {
    for (int i = 0; i < points.count(); ++i) twin(points.singles[i], &out[std::size_t(i) * 8]);
  };
}

Measured measure(const Shader& s, const Points& points, int rounds) {
  const int width = s.executable->width();
  Measured m{s.row, check(s, points), width, int(s.executable->code().frame_blocks), {}, {}, {},
             {}};
  if (!m.check.good) {
    fmt::print(stderr, "error: {}: beyond the bound of {}: ours {}, scalar {}, vector {} of {}\n",
               s.row->name, s.row->bound, m.check.ours.beyond, m.check.scalar.beyond,
               m.check.vector.beyond, points.count());
    std::exit(1);
  }
  const auto batches = points.batches(width);
  vm::Interpreter<float> machine(width);
  std::vector<float> out(std::size_t(points.count()) * 8);
  float* columns[8];
  for (int k = 0; k < 8; ++k) columns[k] = out.data() + std::size_t(k) * points.count();
  const Lanes lanes = points.lanes();
  std::vector<std::function<void()>> runs{[&] { run_all(s, machine, batches, width); }};
  std::vector<Series*> into{&m.ours};
  const auto add = [&](std::function<void()> run, Series& series) {
    runs.push_back(std::move(run));
    into.push_back(&series);
  };
  if (s.gcc) add(scalar(s.gcc, points, out), m.gcc);
  if (s.clang) add(scalar(s.clang, points, out), m.clang);
  if (s.vector) add([&] { s.vector(lanes, columns, points.count()); }, m.vector);
  const auto series = interleave(runs, points.count(), rounds);
  for (std::size_t k = 0; k < series.size(); ++k) *into[k] = series[k];
  // A batch is as wide as the shader likes; where that does not divide the points, the last is
  // padded and its padding is work.
  const double worked = double(batches.size()) * width / points.count();
  for (double& t : m.ours) t /= worked;
  return m;
}

PerCall measure_per_call(const Shader& s, const Points& points, int rounds) {
  PerCall result{s.row, {}};
  for (const int n : kPerCall) {
    const int width = std::min(n, s.executable->width());
    const auto batches = points.batches(width);
    vm::Interpreter<float> machine(width);
    const auto series = interleave({[&] { run_all(s, machine, batches, width); }},
                                   int(batches.size()) * width, rounds);
    result.ns.push_back(median(series[0]));
  }
  return result;
}

double seconds_of(int threads, const Shader& s, const Points& points, int passes) {
  const int width = s.executable->width();
  const auto batches = points.batches(width);
  std::vector<std::thread> running;
  const auto work = [&] {
    vm::Interpreter<float> machine(width);
    for (int k = 0; k < passes; ++k) run_all(s, machine, batches, width);
  };
  const auto start = std::chrono::steady_clock::now();
  for (int t = 1; t < threads; ++t) running.emplace_back(work);
  work();
  for (std::thread& t : running) t.join();
  return milliseconds_since(start) * 1e-3;
}

Threads measure_threads(const Shader& s, const Points& points, double ns_per_point, int rounds) {
  Threads result{s.row, {}};
  const int passes = std::max(1, int(20e6 / (ns_per_point * points.count())));  // 20 ms
  for (int r = 0; r < rounds; ++r) {
    const double one = seconds_of(1, s, points, passes), two = seconds_of(2, s, points, passes);
    result.speedup.push_back(2 * one / two);
  }
  return result;
}

Options options_of(int count, char** arguments) {
  Options o;
  for (int k = 1; k < count; ++k) {
    const std::string_view a = arguments[k];
    if (a == "--no-document")
      o.write = false;
    else if (a == "--rounds" && k + 1 < count)
      o.rounds = std::max(5, std::atoi(arguments[++k]));
    else if (a == "--only" && k + 1 < count)
      o.only = arguments[++k], o.write = false;
    else {
      fmt::print(stderr, "usage: bench_shaders [--rounds N] [--only NAME] [--no-document]\n");
      std::exit(2);
    }
  }
  return o;
}

int run(const Options& options) {
  const Points points(kPoints);
  Results results{options.rounds, kPoints, {}, {}, {}, {}, {}};
  {
    const std::string text = text_of("marble");
    const auto batch = std::move(points.batches(256)[0]);
    const auto first = cold_starts(15, text, batch);
    if (first.empty()) return fmt::print(stderr, "error: cannot fork\n"), 1;
    results.first = first.front();
    results.usual = first[first.size() / 2];
  }
  for (const Row& row : rows()) {
    if (!options.only.empty() && options.only != row.name) continue;
    const Shader shader = load(row);
    results.shaders.push_back(measure(shader, points, options.rounds));
    const std::string_view name = row.name;
    if (name == "gradient" || name == "marble" || name == "mandelbrot" || name == "layered") {
      results.per_call.push_back(measure_per_call(shader, points, options.rounds / 4 + 1));
      results.threads.push_back(measure_threads(shader, points, median(results.shaders.back().ours),
                                                options.rounds / 8 + 1));
    }
  }
  fmt::print("{}", tables(results));
  if (!options.write) return 0;
  return write_part("shaders", document(results)) ? 0 : 1;
}

}  // namespace
}  // namespace mms::bench

int main(int count, char** arguments) {
  return mms::bench::run(mms::bench::options_of(count, arguments));
}
