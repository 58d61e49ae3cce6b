// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Pearson's chi-square test of samples on the sphere against a density.
///
/// Cells are rectangles in (t, phi) around an axis, t = sin(angle / 2), where a solid angle is
/// 4 t dt dphi. The equator, where densities of surfaces jump, and other circles around the axis
/// where this one does are edges of cells; each band between two is split at the medians of a pilot
/// run, so narrow lobes are resolved as well as wide ones, and the pilot is not used again. It is
/// longer where few draws are no deltas: quadrature overlooks a lobe that no cell was cut for. What
/// is not drawn (no sample, or a delta) is one more cell. It expects 1 - the integral of the
/// density, give or take what quadrature errs by, to the advantage of what was seen.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/quadrature.h"
#include "base/vec.h"
#include "tests/sanitized.h"
#include "tests/setting.h"
#include "tests/stats/distributions.h"
#include "tests/stats/random.h"

namespace mms::stats {

/// `usual`, or as many as `./run nightly` draws: 10^6.
inline int sample_count(int usual) { return int(setting("MMS_STATS_SAMPLES", usual)); }

struct ChiSquareTest {
  /// A direction, or nothing.
  std::function<std::optional<Vec3d>(Random&)> sample;
  /// Per steradian.
  std::function<double(Vec3d)> pdf;
  Vec3d axis{0, 0, 1};  ///< the pole: the density may jump at its equator
  /// t of other circles where it does: within a cell, Gauss's rules may agree on a step that they
  /// misplace alike.
  std::vector<double> jumps = {};
  int count = sample_count(kSanitized ? 5'000 : 100'000);
  int pilot = kSanitized ? 2048 : 8192;  ///< draws; up to `count` until pilot / 4 have a density
  int cells = kSanitized ? 16 : 64;      ///< in each band; a power of two
  std::uint64_t seed = 1;
};

struct ChiSquareResult {
  double statistic = 0, p_value = 1, mass = 0;
  double error = 0;  ///< of the mass, as quadrature estimates it
  int freedom = 0, pooled = 0;
  int impossible = 0;  ///< samples where the density expects nothing
  int count = 0;       ///< of all samples
  /// Integral of the density not above 1, the p-value above `level`, and at most five impossible
  /// samples, or as many in 100 000: float directions next to an edge of the support may fall over
  /// it. Quadrature has settled in each cell (integrate_cell; of up to 400 of them).
  bool passed(double level) const {
    return mass <= 1 + 1e-3 && impossible <= std::max(5, count / 20'000) && p_value > level &&
           error <= 2 / std::sqrt(count);
  }
  std::string report() const {
    return "chi2 " + std::to_string(statistic) + " freedom " + std::to_string(freedom) + " p " +
           std::to_string(p_value) + " mass " + std::to_string(mass) + " +- " +
           std::to_string(error) + " impossible " + std::to_string(impossible);
  }
};

/// Observed against expected counts: cells that expect fewer than five are pooled, in order of
/// expectation. Samples in cells that expect (almost) nothing are `impossible`.
inline ChiSquareResult pearson(std::vector<std::pair<double, double>> expected_observed) {
  ChiSquareResult r;
  std::sort(expected_observed.begin(), expected_observed.end());
  double pool_e = 0, pool_o = 0;
  const auto add = [&](double e, double o) {
    r.statistic += (o - e) * (o - e) / e;
    ++r.freedom;
  };
  for (const auto& [e, o] : expected_observed) {
    if (e < 1e-6 && o > 0) r.impossible += int(o);
    if (e >= 5 && pool_e == 0) {
      add(e, o);
      continue;
    }
    pool_e += e;
    pool_o += o;
    ++r.pooled;
    if (pool_e >= 5) {
      add(pool_e, pool_o);
      pool_e = pool_o = 0;
    }
  }
  if (pool_e > 0) add(std::max(pool_e, 1e-3), pool_o);
  r.freedom -= 1;
  r.p_value = r.freedom > 0 ? chi_square_tail(r.statistic, r.freedom) : 1;
  return r;
}

namespace detail {

struct PolarPoint {
  double t, phi;
};

inline PolarPoint to_polar(const Frame<double>& frame, Vec3d w) {
  const Vec3d off = w - frame.n;
  const Vec3d l = frame.to_local(w);
  const double phi = std::atan2(l.y, l.x);
  return {std::min(1.0, length(off) / 2), phi < 0 ? phi + 2 * std::numbers::pi : phi};
}

inline Vec3d from_polar(const Frame<double>& frame, double t, double phi) {
  const double c = 1 - 2 * t * t, s = 2 * t * std::sqrt(std::max(0.0, 1 - t * t));
  return frame.to_world({s * std::cos(phi), s * std::sin(phi), c});
}

/// Splits `r` at medians of the pilot points, turn by turn along t and phi.
inline void split(const Rectangle& r, std::vector<PolarPoint>::iterator a,
                  std::vector<PolarPoint>::iterator b, int cells, bool by_t,
                  std::vector<Rectangle>& out) {
  if (cells <= 1 || b - a < 2) {
    out.push_back(r);
    return;
  }
  const auto mid = a + (b - a) / 2;
  std::nth_element(a, mid, b, [&](const PolarPoint& p, const PolarPoint& q) {
    return by_t ? p.t < q.t : p.phi < q.phi;
  });
  Rectangle low = r, high = r;
  (by_t ? low.x1 : low.y1) = (by_t ? high.x0 : high.y0) = by_t ? mid->t : mid->phi;
  split(low, a, mid, cells / 2, !by_t, out);
  split(high, mid, b, cells / 2, !by_t, out);
}

struct Integral {
  double value, error;  ///< how far the last two ways to cut it disagree
};

/// Integral of `f(t, phi)` over a cell. Cells of the tail hold a peak at one edge, so both
/// coordinates run through x = s^4 (35 - 84 s + 70 s^2 - 20 s^3), which crowds the edges. An
/// adaptive rule may stop too early where it sees a peak at no point, or a jump at too few, and so
/// it is begun with the cell cut into 2 by 2, 3 by 3, 5 by 5, ... (Fibonacci: points of one are not
/// those of another) until two in turn agree within `enough(value)`. `tolerance` is the adaptive
/// rule's.
template <class Enough, class F>
Integral integrate_peaked(const Rectangle& cell, double tolerance, const Enough& enough, F&& f) {
  const auto crowd = [](double s) { return s * s * s * s * (35 + s * (-84 + s * (70 - s * 20))); };
  const auto slope = [](double s) {
    const double a = s * (1 - s);
    return 140 * a * a * a;
  };
  const double w = cell.x1 - cell.x0, h = cell.y1 - cell.y0;
  const auto cut = [&](int n) {
    double sum = 0;
    for (int i = 0; i < n * n; ++i) {
      const double x = double(i / n) / n, y = double(i % n) / n;
      sum += integrate_adaptive(
          [&](double u, double v) {
            return w * h * slope(u) * slope(v) * f(cell.x0 + w * crowd(u), cell.y0 + h * crowd(v));
          },
          {x, x + 1.0 / n, y, y + 1.0 / n}, tolerance / n);
    }
    return sum;
  };
  constexpr int kMostCuts = 34;
  int before = 2, n = 3;
  Integral all{cut(before), std::numeric_limits<double>::infinity()};
  while (all.error > enough(all.value) && n <= kMostCuts) {
    const double now = cut(n);
    all = {now, std::abs(now - all.value)};
    before = std::exchange(n, n + before);
  }
  return all;
}

/// The same of a density, over a cell of which `count` samples are drawn: within a tenth of the
/// standard deviation of the cell's own count. At the worst each cell then adds 0.01 to a statistic
/// that expects 1 of it.
template <class F>
Integral integrate_cell(const Rectangle& cell, double tolerance, int count, F&& f) {
  return integrate_peaked(
      cell, tolerance, [count](double p) { return 0.1 * std::sqrt(p / count); }, f);
}

}  // namespace detail

inline ChiSquareResult chi_square(const ChiSquareTest& test) {
  const Frame<double> frame = Frame<double>::around(normalize(test.axis));
  Random pilot_random(test.seed ^ 0x9170), random(test.seed);
  std::vector<detail::PolarPoint> pilot;
  int drawn = 0;
  for (; drawn < test.pilot || (int(pilot.size()) < test.pilot / 4 && drawn < test.count); ++drawn)
    if (const auto w = test.sample(pilot_random)) pilot.push_back(detail::to_polar(frame, *w));
  const double share = std::max(double(pilot.size()), 1.0) / drawn;
  std::vector<Rectangle> cells;
  std::vector<double> edges = test.jumps;
  edges.insert(edges.end(), {0, std::numbers::sqrt2 / 2, 1});
  std::sort(edges.begin(), edges.end());
  auto first = pilot.begin();
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const auto last = std::partition(first, pilot.end(), [&](const detail::PolarPoint& p) {
      return p.t < edges[i + 1] || edges[i + 1] == 1;
    });
    detail::split({edges[i], edges[i + 1], 0, 2 * std::numbers::pi}, first, last, test.cells, true,
                  cells);
    first = last;
  }

  std::vector<double> observed(cells.size() + 1, 0.0);
  for (int i = 0; i < test.count; ++i) {
    const auto w = test.sample(random);
    std::size_t cell = cells.size();
    if (w) {
      const auto p = detail::to_polar(frame, *w);
      for (cell = 0; cell + 1 < cells.size(); ++cell) {
        const Rectangle& r = cells[cell];
        if (p.t >= r.x0 && p.t <= r.x1 && p.phi >= r.y0 && p.phi <= r.y1) break;
      }
    }
    observed[cell] += 1;
  }

  std::vector<std::pair<double, double>> pairs;
  double mass = 0, error = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    // Parts of the standard deviation of a cell that has its share of what is not a delta.
    const double tolerance = 0.3 * std::sqrt(share / (double(cells.size()) * test.count));
    const auto p = detail::integrate_cell(
        cells[i], tolerance, test.count,
        [&](double t, double phi) { return 4 * t * test.pdf(detail::from_polar(frame, t, phi)); });
    mass += p.value;
    error += p.error;
    pairs.emplace_back(p.value * test.count, observed[i]);
  }
  const double none = std::clamp(observed.back() / test.count, std::max(0.0, 1 - mass - error),
                                 std::max(0.0, 1 - mass + error));
  if (none > 1e-4 || observed.back() > 0) pairs.emplace_back(none * test.count, observed.back());
  ChiSquareResult r = pearson(std::move(pairs));
  r.error = error;
  r.mass = mass;
  r.count = test.count;
  return r;
}

}  // namespace mms::stats
