// SPDX-License-Identifier: Apache-2.0
#include "renderer/error.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mms::renderer {
namespace {

/// Probes along the edge of a region: 1024 differences know r to about one part in ten.
constexpr int kRegion = 32;

/// Bounds of r. Chance and rare bright samples may take it anywhere; 2 is independent samples, 8
/// the fastest that scrambled nets converge (Owen 1997: variance n^-3).
constexpr double kSlowest = 1.75, kFastest = 8;

/// Sums over the probes of one region.
struct Region {
  double independent = 0;       ///< variances as if samples were independent
  double last = 0, before = 0;  ///< (A - B)^2 / 4 of the last two blocks
  double samples = 0;
  int probes = 0;
};

double mean(const BlockSums& s) { return double(s.y) / double(s.weight); }

/// (A - B)^2 / 4 at one probe, of block `b` and all before it.
double quarter_difference(const FilmSums& film, int b, std::size_t probe) {
  BlockSums before;
  for (int i = 0; i < b; ++i) {
    before.y += film.block(i)[probe].y;
    before.weight += film.block(i)[probe].weight;
  }
  const BlockSums& last = film.block(b)[probe];
  if (before.weight == 0 || last.weight == 0) return 0;
  constexpr double kUnit = 0x1p40;  // of a value: sums are in 2^-64, weights in 2^-24
  const double d = (mean(before) - mean(last)) / kUnit;
  return d * d / 4;
}

/// Variance of a mean of `complete` samples, summed over the region; nothing if it cannot be known.
double net_variance(const Region& r, int block) {
  const double ratio =
      block >= 2 && r.last > 0 ? std::clamp(r.before / r.last, kSlowest, kFastest) : 2;
  return r.last / (ratio - 1);
}

}  // namespace

ErrorEstimate::ErrorEstimate(const FilmSums& film, std::uint32_t complete) {
  const int stride = film.probe_stride();
  side_ = kRegion * stride;
  across_ = (film.width() + side_ - 1) / side_;
  const int down = (film.height() + side_ - 1) / side_;
  const int block = complete < 8 ? 0 : std::bit_width(complete) - 3;  // the last one that is whole
  std::vector<Region> regions(std::size_t(across_) * std::size_t(down));
  const Filter filter(film.filter());
  std::size_t probe = 0;
  for (int y = 0; y < film.height(); y += stride)
    for (int x = 0; x < film.width(); x += stride, ++probe) {
      Region& r = regions[std::size_t(y / side_ * across_ + x / side_)];
      r.independent += film.variance(film.pixel(x, y));
      r.samples += film.samples_seen(film.pixel(x, y));
      ++r.probes;
      if (block < 1) continue;
      r.last += quarter_difference(film, block, probe);
      if (block >= 2) r.before += quarter_difference(film, block - 1, probe);
    }
  double sum = 0;
  for (const Region& r : regions) {
    double variance = r.independent;
    if (block >= 1) {
      // Samples past the last whole block count as if they were independent of it.
      const double whole = block_end(block) * double(r.probes);
      variance = net_variance(r, block) * std::min(1.0, whole / r.samples);
    }
    factors_.push_back(r.independent > 0 ? variance / r.independent : 1);
    sum += variance;
  }
  rmse_ = std::sqrt(sum / double(std::max<std::size_t>(1, probe)));
}

double ErrorEstimate::factor(int x, int y) const {
  return factors_[std::size_t(y / side_ * across_ + x / side_)];
}

void ErrorEstimate::correct(Film& film) const {
  std::size_t i = 0;
  for (int y = 0; y < film.height; ++y)
    for (int x = 0; x < film.width; ++x, ++i) film.variance[i] *= factor(x, y);
}

}  // namespace mms::renderer
