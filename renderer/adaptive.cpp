// SPDX-License-Identifier: Apache-2.0
#include "renderer/adaptive.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "renderer/samples.h"

namespace mms::renderer {
namespace {

/// Every tile has as many before the error is asked for: one difference is known then, and it is
/// taken as of independent samples, which errs upwards.
constexpr std::uint32_t kFirstAsked = 4;

/// A tile gets a part of an octave at a time, so what lacks less than half of one has enough.
constexpr double kEnough = 1 + 0.5 / kPartsOfOctave;

/// Where a tile is looked at again.
std::uint32_t asked_after(std::uint32_t samples) {
  return samples < kFirstAsked ? kFirstAsked : samples + std::bit_floor(samples) / kPartsOfOctave;
}

/// Root of the variance of a sample in each patch: half its own, half the mean of those around it.
std::vector<double> deviations(const ErrorEstimate& e) {
  const auto patches = e.patches();
  const int across = e.patches_across(), down = int(patches.size()) / across;
  const auto own = [&](int x, int y) {
    const auto& p = patches[std::size_t(y * across + x)];
    return p.variance * p.samples;
  };
  std::vector<double> all;
  for (int y = 0; y < down; ++y)
    for (int x = 0; x < across; ++x) {
      double sum = 0;
      int count = 0;
      for (int j = std::max(0, y - 1); j <= std::min(down - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(across - 1, x + 1); ++i, ++count)
          sum += own(i, j);
      all.push_back(std::sqrt((own(x, y) + sum / count) / 2));
    }
  return all;
}

}  // namespace

std::vector<double> samples_worth_having(const ErrorEstimate& estimate, double target) {
  const auto patches = estimate.patches();
  std::vector<double> worth = deviations(estimate);
  const auto missed = [&](double k) {  // what is left above the target, with n = k s
    double sum = 0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      const auto& p = patches[i];
      const double n = std::max(p.samples, k * worth[i]);
      sum += p.probes * (n > 0 ? p.variance * p.samples / n - target * target : 0);
    }
    return sum;
  };
  double high = 1;
  while (missed(high) > 0 && high < 1e30) high *= 2;
  double low = high / 2;
  while (missed(low) <= 0 && low > 1e-30) low /= 2;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (missed(middle) > 0 ? low : high) = middle;
  }
  for (double& s : worth) s *= high;
  return worth;
}

std::vector<std::uint32_t> next_samples(const PartialFilm& film, double target, std::uint32_t first,
                                        std::uint32_t most) {
  std::vector<std::uint32_t> there, next;
  for (const SampleSet& s : film.done) there.push_back(s.missing_from(first));
  const auto go_on = [&](const auto& chosen) {
    next = there;
    for (int t = 0; t < film.tiles(); ++t)
      if (chosen(t)) next[t] = std::min(most, asked_after(there[t]));
    return next != there;
  };
  if (*std::min_element(there.begin(), there.end()) < std::min(first + kFirstAsked, most)) {
    go_on([&](int t) { return there[t] < first + kFirstAsked; });
    return next;
  }
  const ErrorEstimate estimate(film);
  if (estimate.rmse() <= target) return {};
  const std::vector<double> worth = samples_worth_having(estimate, target);
  const auto lacks = [&](double enough) {
    return [&, enough](int t) {
      const Rect r = film.tile(t);
      const auto patch = std::size_t(r.y0 / estimate.patch_side() * estimate.patches_across() +
                                     r.x0 / estimate.patch_side());
      return worth[patch] > estimate.patches()[patch].samples * enough;
    };
  };
  if (go_on(lacks(kEnough)) || go_on(lacks(1))) return next;
  return go_on([](int) { return true; }) ? next : std::vector<std::uint32_t>();
}

}  // namespace mms::renderer
