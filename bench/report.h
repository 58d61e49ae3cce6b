// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The measurements as text: tables for the terminal, and docs/performance.md.

#include <optional>
#include <string>
#include <vector>

#include "bench/measure.h"
#include "bench/suite.h"

namespace mms::bench {

/// Everything about one shader of the suite.
struct Measured {
  const Row* row;
  Check check;
  int width, blocks;
  Series ours, gcc, clang, vector;  ///< empty where there is none
  const Series& scalar() const;     ///< the faster by its median
};

struct PerCall {
  const Row* row;
  std::vector<double> ns;  ///< median ns per point, by kPerCall
};
inline constexpr int kPerCall[] = {1, 4, 16, 64, 256, 1024};

struct Threads {
  const Row* row;
  Series speedup;  ///< points per second of two threads over those of one
};

struct ColdStart {
  double parse_ms, link_ms, lower_ms, run_ms;
  double total() const { return parse_ms + link_ms + lower_ms + run_ms; }
};

struct Results {
  int rounds, points;
  std::vector<Measured> shaders;
  std::vector<PerCall> per_call;
  std::vector<Threads> threads;
  ColdStart first, usual;  ///< the least and the median of several processes' first times
};

/// Markdown. `plain`: only the tables, as the terminal shows them.
std::string tables(const Results& results);
std::string document(const Results& results);

}  // namespace mms::bench
