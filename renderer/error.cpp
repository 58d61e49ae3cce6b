// SPDX-License-Identifier: Apache-2.0
#include "renderer/error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "renderer/samples.h"

namespace mms::renderer {
namespace {

/// r is that of the patches that are at most as far away, in patches.
constexpr int kAround = 1;

/// Bounds of r. Chance and rare bright samples may take it anywhere; 2 is independent samples, 8
/// the fastest that scrambled nets converge (Owen 1997: variance n^-3).
constexpr double kSlowest = 1.75, kFastest = 8;

/// That of what nets have of a pixel with an edge: variance n^-1.5 (He and Owen 2016).
constexpr double kOfEdges = 2 * std::numbers::sqrt2;

/// v(2n) over v(n) - v(2n), of which the like was r times as much one block before. Where r is
/// below that of edges the variance is a sum of theirs and of one that falls as chance does, 1 / n:
/// with time the latter stays, so that r was more than it is. Below 2, where r is by chance alone,
/// that goes on as it is above, lest means be too high.
double left_of_difference(double r) {
  if (r >= kOfEdges) return 1 / (r - 1);
  const double edges = (r - 2) / ((kOfEdges - 1) * (kOfEdges - r));  // over the other
  return (1 + edges) / (1 + (kOfEdges - 1) * edges);
}

/// Sums over the probes of one patch.
struct Sums {
  double independent = 0;       ///< variances as if samples were independent
  double last = 0, before = 0;  ///< (A - B)^2 / 4 of the last two blocks
  double samples = 0;
  int probes = 0;
  std::uint32_t complete = ~0u;
  /// The last block that is whole.
  int block() const { return complete < 4 ? 0 : std::bit_width(complete) - 2; }
};

double mean(const BlockSums& s) { return double(s.y) / double(s.weight); }

/// (A - B)^2 / 4.
double quarter_difference(const BlockSums& a, const BlockSums& b) {
  if (a.weight == 0 || b.weight == 0) return 0;
  constexpr double kUnit = 0x1p40;  // of a value: sums are in 2^-64, weights in 2^-24
  const double d = (mean(a) - mean(b)) / kUnit;
  return d * d / 4;
}

/// Adds what is told by the last whole block and the one before it at one probe.
void add_differences(const PartialFilm& film, int x, int y, Sums& s) {
  const int last = s.block();
  if (last < 1) return;
  BlockSums so_far = film.block(0, x, y);
  for (int b = 1; b <= last; ++b) {
    const BlockSums sums = film.block(b, x, y);
    if (b >= last - 1) (b == last ? s.last : s.before) += quarter_difference(so_far, sums);
    so_far += sums;
  }
}

/// Patches of the edge `side`, row by row, `across` in a row.
std::vector<Sums> sums_of(const PartialFilm& film, int side, int across) {
  const int down = (film.height() + side - 1) / side, stride = side / kTile;
  std::vector<Sums> all(std::size_t(across) * std::size_t(down));
  const auto patch = [&](int x, int y) -> Sums& {
    return all[std::size_t(y / side * across + x / side)];
  };
  for (int t = 0; t < film.tiles(); ++t) {
    const Rect r = film.tile(t);
    Sums& s = patch(r.x0, r.y0);
    s.complete = std::min(s.complete, film.done[std::size_t(t)].missing_from(0));
  }
  for (int y = 0; y < film.height(); y += stride)
    for (int x = 0; x < film.width(); x += stride) {
      Sums& s = patch(x, y);
      const PixelSums p = film.pixel(x, y);
      s.independent += film.parts[0].variance(p);
      s.samples += p.samples;
      ++s.probes;
      add_differences(film, x, y, s);
    }
  return all;
}

/// r of the patch at column `x` and row `y`: of those around that have as many samples, about.
double ratio_around(const std::vector<Sums>& all, int across, int x, int y) {
  const int down = int(all.size()) / across, block = all[std::size_t(y * across + x)].block();
  double last = 0, before = 0;
  for (int j = std::max(0, y - kAround); j <= std::min(down - 1, y + kAround); ++j)
    for (int i = std::max(0, x - kAround); i <= std::min(across - 1, x + kAround); ++i) {
      const Sums& near = all[std::size_t(j * across + i)];
      if (near.block() != block) continue;
      last += near.last;
      before += near.before;
    }
  return block >= 2 && last > 0 ? std::clamp(before / last, kSlowest, kFastest) : 2;
}

}  // namespace

ErrorEstimate::ErrorEstimate(const PartialFilm& film)
    : side_(kTile * film.parts[0].probe_stride()), across_((film.width() + side_ - 1) / side_) {
  const std::vector<Sums> all = sums_of(film, side_, across_);
  double sum = 0, probes = 0;
  for (int i = 0; i < int(all.size()); ++i) {
    const Sums& s = all[std::size_t(i)];
    double variance = s.independent;
    if (s.block() >= 1) {
      // Samples past the last whole block count as if they were independent of it.
      const double whole = block_end(s.block()) * double(s.probes);
      variance = s.last * left_of_difference(ratio_around(all, across_, i % across_, i / across_)) *
                 std::min(1.0, whole / s.samples);
    }
    patches_.push_back({variance / s.probes, s.samples / s.probes, s.probes});
    factors_.push_back(s.independent > 0 ? variance / s.independent : 1);
    sum += variance;
    probes += s.probes;
  }
  rmse_ = std::sqrt(sum / probes);
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
