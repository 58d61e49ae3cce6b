// SPDX-License-Identifier: Apache-2.0
#include "bench/measure.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace mms::bench {
namespace {

using Clock = std::chrono::steady_clock;

double nanoseconds(const std::function<void()>& run, int times) {
  const auto start = Clock::now();
  for (int k = 0; k < times; ++k) run();
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

}  // namespace

double quantile(Series s, double q) {
  std::sort(s.begin(), s.end());
  return s[std::min(s.size() - 1, std::size_t(q * double(s.size())))];
}

Series ratios(const Series& a, const Series& b) {
  Series r(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) r[k] = a[k] / b[k];
  return r;
}

std::vector<Series> interleave(const std::vector<std::function<void()>>& contenders, int points,
                               int rounds, double slice_us) {
  std::vector<int> times;
  for (const auto& run : contenders) {
    run();  // warm
    const double once = std::min({nanoseconds(run, 1), nanoseconds(run, 1), nanoseconds(run, 1)});
    times.push_back(std::max(1, int(std::lround(slice_us * 1e3 / once))));
  }
  std::vector<Series> all(contenders.size());
  for (int r = 0; r < rounds; ++r)
    for (std::size_t k = 0; k < contenders.size(); ++k)
      all[k].push_back(nanoseconds(contenders[k], times[k]) / (double(times[k]) * points));
  return all;
}

}  // namespace mms::bench
