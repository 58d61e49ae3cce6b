// SPDX-License-Identifier: Apache-2.0
// The benchmarks of the compiler: prints its tables and writes its part of docs/performance.md.
// Every run is in a process of its own that this one forks before it compiles anything.
//
//   bench_compile [--quick] [--only NAME] [--no-document]
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string_view>

#include "api/library.h"
#include "bench/document.h"
#include "bench/measure.h"
#include "bench/scripts.h"
#include "lang/lexer.h"
#include "lang/parser.h"
#include "vm/interpreter.h"

namespace mms::bench {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  bool quick = false, write = true;
  std::string only;
};

/// Times in ms by stage, in order, and the peak of memory in MB.
struct Run {
  std::vector<std::pair<std::string, double>> stages;
  double total = 0, wall = 0, peak = 0;
};

/// Of this thread: what other programs on the same core take does not count.
double processor_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
}

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024;
}

/// Text to lowered program. Ends the process if it does not link. With `by_stage` each stage is
/// timed, which takes time itself.
Run compile(const std::string& text, bool by_stage) {
  Run run;
  const Clock::time_point start = Clock::now();
  const double first = processor_ms();
  double last = first;
  const auto done = [&](std::string_view stage) {
    if (!by_stage) return;
    auto known = std::ranges::find(run.stages, stage, [](const auto& s) { return s.first; });
    if (known == run.stages.end()) known = run.stages.insert(known, {std::string(stage), 0.0});
    known->second += processor_ms() - last;
    last = processor_ms();
  };
  lang::Diagnostics diagnostics;
  const lang::Graph graph = lang::parse(lang::make_source("script", text), diagnostics);
  done("parse");
  lang::LinkOptions options;
  if (by_stage) options.stage_done = done;
  const auto linked = lang::link({&graph, 1}, api::standard_library(), options, diagnostics);
  if (!linked) {
    for (const lang::Diagnostic& d : diagnostics.all())
      fmt::print(stderr, "{}", lang::render(d, false));
    std::_Exit(1);
  }
  const vm::Executable executable(linked->program);
  done("lower");
  run.total = processor_ms() - first;
  run.wall = milliseconds_since(start);
  run.peak = peak_megabytes();
  return run;
}

/// Only the lexer, which `parse` calls as it goes.
double lex(const std::string& text) {
  lang::Diagnostics diagnostics;
  const lang::SourcePtr source = lang::make_source("script", text);
  const double start = processor_ms();
  lang::Lexer lexer(*source, diagnostics);
  while (lexer.next().tok != lang::Tok::Eof) {
  }
  return processor_ms() - start;
}

/// What `work` says in a process of its own; nothing if that failed.
std::string in_child(const std::function<std::string()>& work) {
  int ends[2];
  if (pipe(ends) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    const std::string said = work();
    std::_Exit(write(ends[1], said.data(), said.size()) == ssize_t(said.size()) ? 0 : 1);
  }
  close(ends[1]);
  std::string said;
  char buffer[4096];
  for (ssize_t n; child > 0 && (n = read(ends[0], buffer, sizeof buffer)) > 0;)
    said.append(buffer, std::size_t(n));
  close(ends[0]);
  int status = 1;
  if (child > 0) waitpid(child, &status, 0);
  return status == 0 ? said : std::string();
}

Run run_in_child(const std::function<std::string()>& text, bool by_stage) {
  std::istringstream said(in_child([&] {
    const std::string script = text();
    const Run run = compile(script, by_stage);
    std::string s = fmt::format("{} {} {}", run.total, run.wall, run.peak);
    for (const auto& [name, ms] : run.stages) s += fmt::format(" {} {}", name, ms);
    return s;
  }));
  Run run;
  if (!(said >> run.total >> run.wall >> run.peak)) {
    fmt::print(stderr, "error: a script of the benchmark does not compile\n");
    std::exit(1);
  }
  std::string name;
  for (double ms; said >> name >> ms;) run.stages.emplace_back(name, ms);
  return run;
}

/// Several runs of one script.
struct Case {
  std::string name;
  int lines = 0;
  Series total, wall;
  double peak = 0;
  std::vector<std::pair<std::string, Series>> stages;

  double us_per_line() const { return least(total) * 1e3 / lines; }
};

/// Scripts of one rule, the shortest first, in turn: what disturbs one disturbs the others of its
/// round.
std::vector<Case> measure(const std::string& name,
                          const std::vector<std::function<std::string()>>& texts, int runs) {
  std::vector<Case> cases(texts.size());
  for (std::size_t i = 0; i < texts.size(); ++i) {
    cases[i].name = name;
    cases[i].lines = std::atoi(in_child([&] {
                                 const std::string script = texts[i]();
                                 const auto n = std::count(script.begin(), script.end(), '\n');
                                 return std::to_string(n);
                               }).c_str());
  }
  std::vector<Series> lexed(texts.size());
  for (int k = 0; k < runs; ++k)
    for (std::size_t i = 0; i < texts.size(); ++i) {
      Case& c = cases[i];
      const Run run = run_in_child(texts[i], false), parts = run_in_child(texts[i], true);
      c.total.push_back(run.total);
      c.wall.push_back(run.wall);
      c.peak = std::max(c.peak, run.peak);
      for (std::size_t s = 0; s < parts.stages.size(); ++s) {
        if (k == 0) c.stages.push_back({parts.stages[s].first, {}});
        c.stages[s].second.push_back(parts.stages[s].second);
      }
      lexed[i].push_back(
          std::atof(in_child([&] { return fmt::format("{}", lex(texts[i]())); }).c_str()));
    }
  for (std::size_t i = 0; i < texts.size(); ++i)
    cases[i].stages.insert(cases[i].stages.begin(), {"lex", lexed[i]});
  return cases;
}

/// Milliseconds of a whole process that runs `arguments`, its output thrown away.
Series processes(const std::vector<std::string>& arguments, int runs) {
  Series all;
  std::vector<char*> argv;
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  for (int k = 0; k < runs; ++k) {
    const Clock::time_point start = Clock::now();
    const pid_t child = fork();
    if (child == 0) {
      const int null = open("/dev/null", O_WRONLY);
      dup2(null, STDOUT_FILENO);
      execv(argv[0], argv.data());
      _exit(127);
    }
    int status = 1;
    if (child > 0) waitpid(child, &status, 0);
    if (status != 0) return {};
    all.push_back(milliseconds_since(start));
  }
  return all;
}

std::string spread(const Series& s) {
  const auto number = [](double x) {
    return x < 1     ? fmt::format("{:.3f}", x)
           : x < 100 ? fmt::format("{:.2f}", x)
                     : fmt::format("{:.0f}", x);
  };
  return fmt::format("{} | {} [{}, {}]", number(least(s)), number(median(s)),
                     number(quantile(s, 0.25)), number(quantile(s, 0.75)));
}

/// Time a line over that of the shortest script of the same rule, round by round.
std::string growth(const std::vector<Case>& cases, const Case& c) {
  for (const Case& other : cases) {
    if (other.name != c.name || other.lines >= c.lines) continue;
    Series ratios;
    for (std::size_t k = 0; k < c.total.size(); ++k)
      ratios.push_back(c.total[k] / c.lines / (other.total[k] / other.lines));
    return fmt::format("{:.2f} [{:.2f}, {:.2f}]", median(ratios), quantile(ratios, 0.25),
                       quantile(ratios, 0.75));
  }
  return "";
}

std::string case_table(const std::vector<Case>& cases) {
  std::string t =
      "| script | lines | ms, least | median [quartiles] | wall, least | µs a line | to the "
      "shortest "
      "| peak MB |\n|---|---|---|---|---|---|---|---|\n";
  for (const Case& c : cases)
    t += fmt::format("| {} | {} | {} | {:.4g} | {:.2f} | {} | {:.0f} |\n", c.name, c.lines,
                     spread(c.total), least(c.wall), c.us_per_line(), growth(cases, c), c.peak);
  return t;
}

std::string stage_table(const std::vector<const Case*>& cases) {
  std::string t = "| stage |", rule = "\n|---|";
  for (const Case* c : cases) {
    t += fmt::format(" {}, {} lines: ms | lines a second |", c->name, c->lines);
    rule += "---|---|";
  }
  t += rule + "\n";
  for (std::size_t s = 0; s < cases[0]->stages.size(); ++s) {
    const std::string& name = cases[0]->stages[s].first;
    t += fmt::format("| {} |", name == "parse" ? "parse, lexing included" : name);
    for (const Case* c : cases) {
      const double ms = least(c->stages[s].second);
      t += fmt::format(" {:.3f} | {:.3g} |", ms, double(c->lines) / ms * 1e3);
    }
    t += "\n";
  }
  return t;
}

std::string marble() {
  const auto source = api::read_source(MMS_SOURCE_DIR "/examples/marble.mms");
  return source ? std::string((*source)->text) : std::string();
}

Options options_of(int count, char** arguments) {
  Options o;
  for (int k = 1; k < count; ++k) {
    const std::string_view a = arguments[k];
    if (a == "--no-document")
      o.write = false;
    else if (a == "--quick")
      o.quick = true, o.write = false;
    else if (a == "--only" && k + 1 < count)
      o.only = arguments[++k], o.write = false;
    else {
      fmt::print(stderr, "usage: bench_compile [--quick] [--only NAME] [--no-document]\n");
      std::exit(2);
    }
  }
  return o;
}

constexpr const char* kMethod =
    R"(From source text to a verified, lowered program, the standard library included. Every run is the
first of its process, so nothing is cached; only the executable's pages are in memory. Times are
processor time of the one thread (other programs on the machine do not count), the least and the
median of several runs; next to them the least by the clock on the wall. "To the shortest" is the
time a line over that of the shortest script of the same kind, 1 where time is linear: scripts of a
kind run in turn, and these are the median and quartiles over the rounds. Peaks are of the whole
process, the source text and 4 MB of this program included.

)";

std::string process_table(int runs) {
  const std::string script = MMS_SOURCE_DIR "/examples/marble.mms";
  const std::string picture = std::filesystem::temp_directory_path() / "mms_bench.png";
  std::string t = "| whole process | ms, least | median [quartiles] |\n|---|---|---|\n";
  const std::pair<const char*, std::vector<std::string>> rows[] = {
      {"`mms check marble.mms`", {MMS_COMMAND, "check", script}},
      {"`mms --version`", {MMS_COMMAND, "--version"}},
      {"`/bin/true`", {"/bin/true"}},
      {"`mms render marble.mms` of 16x16 pixels, one sample",
       {MMS_COMMAND, "render", script, "--size", "16x16", "--samples", "1", "-o", picture}},
  };
  for (const auto& [name, arguments] : rows)
    if (const Series s = processes(arguments, runs); !s.empty())
      t += fmt::format("| {} | {} |\n", name, spread(s));
  std::filesystem::remove(picture);
  return t;
}

int run(const Options& options) {
  const int few = options.quick ? 3 : 9, many = options.quick ? 7 : 31;
  std::vector<Case> cases;
  const auto wanted = [&](std::string_view name) {
    return options.only.empty() || options.only == name;
  };
  using Texts = std::vector<std::function<std::string()>>;
  const auto add = [&](std::string_view name, const Texts& texts, int runs) {
    if (!wanted(name)) return;
    for (Case& c : measure(std::string(name), texts, runs)) cases.push_back(std::move(c));
  };
  add("marble", {marble}, many);
  for (const LargeScript& s : large_scripts()) {
    Texts texts;
    for (const int lines : {1000, 10000, 100000})
      texts.push_back([&s, lines] { return s.text(lines); });
    add(s.name, texts, few);
  }
  add("descriptors",
      {[] { return descriptors_script(1000); }, [] { return descriptors_script(10000); }}, few);
  std::string text = case_table(cases);
  std::vector<const Case*> staged;
  for (const Case& c : cases)
    if (!options.only.empty() || (c.name == "marble" || c.name == "mixed")) staged.push_back(&c);
  if (!staged.empty())
    text +=
        "\nStage by stage, the least times, of runs of their own (the clock takes a part of "
        "them):\n\n" +
        stage_table(staged);
  text += "\n" + process_table(many);
  fmt::print("{}", text);
  std::string kinds = "The scripts are made by rule:";
  for (const LargeScript& s : large_scripts()) kinds += fmt::format(" {}: {};", s.name, s.doc);
  kinds += " descriptors: one on each line.\n\n";
  if (options.write && !write_part("compile", "## The compiler\n\n" + (kMethod + kinds) + text))
    return 1;
  return 0;
}

}  // namespace
}  // namespace mms::bench

int main(int count, char** arguments) {
  return mms::bench::run(mms::bench::options_of(count, arguments));
}
