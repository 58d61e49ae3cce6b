// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Timing contenders against each other: in turn, many times, in one process.

#include <functional>
#include <vector>

namespace mms::bench {

/// The times of one contender, ns per point, in the order of the rounds.
using Series = std::vector<double>;

/// The value below which a share `q` of the series lies.
double quantile(Series series, double q);
inline double least(const Series& s) { return quantile(s, 0); }
inline double median(const Series& s) { return quantile(s, 0.5); }

/// a[r] / b[r] for each round: noise that lasts longer than a round cancels.
Series ratios(const Series& a, const Series& b);

/// Runs every contender once a round, in turn. One run is repeated until it takes `slice_us`
/// microseconds, and counts `points` points.
std::vector<Series> interleave(const std::vector<std::function<void()>>& contenders, int points,
                               int rounds, double slice_us = 150);

}  // namespace mms::bench
