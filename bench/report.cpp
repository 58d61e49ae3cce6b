// SPDX-License-Identifier: Apache-2.0
#include "bench/report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "bench/document.h"

namespace mms::bench {
namespace {

std::string number(double x) {
  return x == 0 ? "" : x < 10 ? fmt::format("{:.2f}", x) : fmt::format("{:.1f}", x);
}
std::string pair(const Series& s) {
  return s.empty() ? "" : fmt::format("{} ({})", number(least(s)), number(median(s)));
}
/// Median and quartiles of `a` over `b`.
std::string ratio(const Series& a, const Series& b) {
  if (a.empty()) return "";
  const Series r = ratios(a, b);
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", median(r), quantile(r, 0.25), quantile(r, 0.75));
}

std::string speed_table(const Results& results) {
  std::string t =
      "| shader | ours | g++ scalar | clang++ scalar | AVX2 by hand | scalar / ours | ours / by "
      "hand "
      "|\n|---|---|---|---|---|---|---|\n";
  double log_sum = 0;
  int count = 0;
  for (const Measured& m : results.shaders) {
    t += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", m.row->title, pair(m.ours),
                     pair(m.gcc), pair(m.clang), pair(m.vector), ratio(m.scalar(), m.ours),
                     m.vector.empty() ? "" : ratio(m.ours, m.vector));
    if (std::string_view(m.row->name) == "constant") continue;
    log_sum += std::log(median(ratios(m.scalar(), m.ours)));
    ++count;
  }
  if (count)
    t += fmt::format("\nGeometric mean of scalar / ours, without the constant: **{:.2f}**.\n",
                     std::exp(log_sum / count));
  return t;
}

std::string peer_table(const Results& results) {
  std::string t =
      "| shader | ours, median | peer, one point at a time | peer, batched AVX2 |\n"
      "|---|---|---|---|\n";
  for (const Measured& m : results.shaders)
    if (m.row->peer_scalar > 0)
      t += fmt::format("| {} | {} | {:.0f} | {:.0f} |\n", m.row->title, number(median(m.ours)),
                       m.row->peer_scalar, m.row->peer_batched);
  return t;
}

std::string error_table(const Results& results) {
  std::string t =
      "| shader | bound | ours | scalar twins | by hand | points beyond: ours, scalar, by hand | "
      "lanes of a batch | blocks of a frame |\n|---|---|---|---|---|---|---|---|\n";
  for (const Measured& m : results.shaders)
    t += fmt::format("| {} | {:.0e} | {:.1e} | {:.1e} | {:.1e} | {}, {}, {} | {} | {} |\n",
                     m.row->title, m.row->bound, m.check.ours.largest, m.check.scalar.largest,
                     m.check.vector.largest, m.check.ours.beyond, m.check.scalar.beyond,
                     m.check.vector.beyond, m.width, m.blocks);
  return t;
}

std::string per_call_table(const Results& results) {
  std::string t = "| shader |";
  for (const int n : kPerCall) t += fmt::format(" {} |", n);
  t += "\n|---|---|---|---|---|---|---|\n";
  for (const PerCall& p : results.per_call) {
    t += fmt::format("| {} |", p.row->title);
    for (const double ns : p.ns) t += fmt::format(" {} |", number(ns));
    t += "\n";
  }
  return t;
}

std::string thread_table(const Results& results) {
  std::string t = "| shader | 2 threads over 1, median [quartiles] | best |\n|---|---|---|\n";
  for (const Threads& p : results.threads)
    t += fmt::format("| {} | {:.2f} [{:.2f}, {:.2f}] | {:.2f} |\n", p.row->title, median(p.speedup),
                     quantile(p.speedup, 0.25), quantile(p.speedup, 0.75), quantile(p.speedup, 1));
  return t;
}

std::string cold_table(const Results& results) {
  std::string t =
      "| marble, ms | parse | link, standard library included | verify and lower | first batch of "
      "256 "
      "| total |\n|---|---|---|---|---|---|\n";
  for (const auto& [name, c] : {std::pair{"first time in a process, least of 15", results.first},
                                {"median", results.usual}})
    t += fmt::format("| {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | **{:.2f}** |\n", name, c.parse_ms,
                     c.link_ms, c.lower_ms, c.run_ms, c.total());
  return t;
}

std::string compilers() {
  std::string c = MMS_COMPILER;
#ifdef MMS_CLANG
  c += ", " MMS_CLANG;
#endif
  return c;
}

constexpr const char* kMethod = R"(## Method

- Every output is compared with the same shader in double, at the same float inputs, before it is
  timed; the bounds are in the table of errors. A shader that fails ends the program.
- {points} random points (fixed seed). Ours are in batches as wide as the machine asks for; a scalar
  twin is called once a point through a pointer, as a renderer calls a native shader; a twin
  vectorised by hand gets all points in one call.
- Ours and the twins run in turn, {rounds} rounds in one process; a turn lasts about 150
  microseconds. Times are ns a point, the least and (the median). A ratio is taken within a round;
  its median and quartiles are shown, so slow spells of the machine cancel.
- The scalar twin that counts is the faster of `g++` and `clang++`, both `-O3 -march=native` with
  contraction. They compute the same functions, with the same hashes, written for speed.
- The twins by hand use AVX2 and FMA, eight points in registers; sine and exponential come from
  the C library's vector functions.
- Reproduce: `./run bench`.
)";

constexpr const char* kShared =
    "Where other programs hold the cores (the load average above tells), the figures of this table "
    "say\nnothing.\n\n";

constexpr const char* kPeer = R"(
Open Shading Language with its LLVM compiler, measured earlier by its own test host on an older
processor (AMD Zen 3, AVX2), not re-run here: part of any difference is the processor's. What else
differs: its shaders are similar, not the same (its noise is its own); its times hold per-point set-up
of that host, 41 of the 111 ns of bump and 19 of the 40 in the batched mode. From source to the first
point it takes about 300 ms of offline compiling, 11 to 40 ms of just-in-time compiling, and start-up.
)";

constexpr const char* kNotClaimed = R"(## Not claimed

- The two-thread figures hold only where the load average says that both cores were free.
- Nothing about renderers: a point here is a shader's evaluation, its inputs already in memory.
- Nothing about other processors; in particular none without AVX2 and none with AVX-512.
- The points are random: a scalar twin with a branch pays for mispredictions that neighbouring
  pixels would spare it; a divergent shader of ours pays for lanes that wait.
- Scalar twins are not what a compiler could make of a loop over points that it can see whole and
  vectorise; the twins by hand stand for that.
- The peer's figures are indications, for the reasons given above its table.
)";

}  // namespace

const Series& Measured::scalar() const {
  if (clang.empty()) return gcc;
  return median(clang) < median(gcc) ? clang : gcc;
}

std::string tables(const Results& r) {
  std::string t = "## Speed, ns a point\n\n" + speed_table(r);
  t += "\n## Errors against double\n\n" + error_table(r);
  if (!r.per_call.empty()) t += "\n## Points a call, ns a point\n\n" + per_call_table(r);
  if (!r.threads.empty())
    t += "\n## Two threads, one program\n\n" + std::string(kShared) + thread_table(r);
  t += "\n## From text to the first batch\n\n" + cold_table(r);
  return t + "\n## The peer\n" + kPeer + "\n" + peer_table(r);
}

std::string document(const Results& r) {
  std::string d = "## Machine\n\n";
  d += fmt::format("{}, {} hardware threads; {}. Load average when the run ended: {}.\n\n",
                   processor(), std::thread::hardware_concurrency(), compilers(), load());
  std::string method = kMethod;
  for (const auto& [key, value] : {std::pair{"{points}", r.points}, {"{rounds}", r.rounds}})
    method.replace(method.find(key), std::string_view(key).size(), std::to_string(value));
  return d + method + "\n" + tables(r) + "\n" + kNotClaimed;
}

}  // namespace mms::bench
