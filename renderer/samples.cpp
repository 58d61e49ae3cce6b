// SPDX-License-Identifier: Apache-2.0
#include "renderer/samples.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "renderer/error.h"

namespace mms::renderer {
namespace {

/// Samples of the passes from kFirstFullPass on: with 16 x 16 pixels, 2048 paths in a chunk.
constexpr std::uint32_t kSamplesOfPass = 8;
constexpr std::uint32_t kFirstOfFull = kPartsOfOctave * kSamplesOfPass;
/// The first of the passes that are parts of an octave: those of the first such octave have one
/// sample each, and each octave doubles that.
constexpr int kFirstPart = std::bit_width(kPartsOfOctave);
constexpr int kFirstFullPass = kFirstPart + int(kPartsOfOctave) * std::countr_zero(kSamplesOfPass);

/// How far a sample reaches beyond its tile, in pixels.
int reach_of(FilterShape filter) { return int(std::ceil(filter_of(filter).radius() - 0.5)); }

/// What a pixel gets from the tiles around it, each divided by its number of samples.
class WeighedPixel {
 public:
  void add(const FilmSums& part, int x, int y, std::uint64_t samples) {
    const PixelSums& p = part.pixel(x, y);
    if (p.weight <= 0) return;
    even_ &= samples_ == 0 || samples == samples_;
    samples_ = samples;
    const double weight = double(p.weight) / double(samples), worth = part.samples_worth(p);
    weight_ += weight;
    squares_ += weight * weight / worth;
    worth_ += worth;
    for (int i = 0; i < 3; ++i) xyz_[i] += FilmSums::mean(p, i) * weight;
  }
  /// Whether all tiles have as many.
  bool even() const { return even_; }
  std::array<double, 3> mean() const {
    return {xyz_[0] / weight_, xyz_[1] / weight_, xyz_[2] / weight_};
  }
  /// Of the mean, over that of all samples alike.
  double variance() const { return squares_ / (weight_ * weight_) * worth_; }

 private:
  bool even_ = true;
  std::uint64_t samples_ = 0;
  double weight_ = 0, squares_ = 0, worth_ = 0;
  std::array<double, 3> xyz_{};
};

}  // namespace

void SampleSet::add(Range range) {
  if (range.first >= range.second) return;
  // Swallow every range that touches this one.
  const auto touches = [&](const Range& r) {
    return r.first <= range.second && range.first <= r.second;
  };
  for (const Range& r : ranges_)
    if (touches(r)) range = {std::min(range.first, r.first), std::max(range.second, r.second)};
  std::erase_if(ranges_, touches);
  ranges_.insert(std::upper_bound(ranges_.begin(), ranges_.end(), range), range);
}

bool SampleSet::has(std::uint32_t number) const {
  return std::any_of(ranges_.begin(), ranges_.end(),
                     [&](const Range& r) { return r.first <= number && number < r.second; });
}

bool SampleSet::meets(const SampleSet& other) const {
  for (const Range& a : ranges_)
    for (const Range& b : other.ranges_)
      if (a.first < b.second && b.first < a.second) return true;
  return false;
}

std::uint32_t SampleSet::missing_from(std::uint32_t first) const {
  for (const Range& r : ranges_)
    if (r.first <= first && first < r.second) return r.second;
  return first;
}

std::uint64_t SampleSet::count() const {
  std::uint64_t n = 0;
  for (const Range& r : ranges_) n += r.second - r.first;
  return n;
}

PartialFilm::PartialFilm(int width, int height, FilterShape filter) {
  const int across = (width + kTile - 1) / kTile, down = (height + kTile - 1) / kTile;
  const int reach = reach_of(filter);
  for (int t = 0; t < across * down; ++t) {
    const int x = t % across * kTile, y = t / across * kTile;
    parts.emplace_back(
        width, height, filter,
        Rect{std::max(0, x - reach), std::max(0, y - reach), std::min(width, x + kTile + reach),
             std::min(height, y + kTile + reach)});
  }
  done.resize(parts.size());
}

/// Calls `f` with each tile whose samples may reach the pixel.
template <class F>
void PartialFilm::for_each_part(int x, int y, const F& f) const {
  const int reach = reach_of(parts[0].filter()), across = tiles_across();
  const int last_x = std::min(x + reach, width() - 1) / kTile,
            last_y = std::min(y + reach, height() - 1) / kTile;
  for (int row = std::max(0, y - reach) / kTile; row <= last_y; ++row)
    for (int column = std::max(0, x - reach) / kTile; column <= last_x; ++column)
      f(std::size_t(row * across + column));
}

PixelSums PartialFilm::pixel(int x, int y) const {
  PixelSums sum;
  for_each_part(x, y, [&](std::size_t t) { sum += parts[t].pixel(x, y); });
  return sum;
}

BlockSums PartialFilm::block(int b, int x, int y) const {
  BlockSums sum;
  for_each_part(x, y, [&](std::size_t t) { sum += parts[t].block(b, x, y); });
  return sum;
}

Rect PartialFilm::tile(int t) const {
  const int x = t % tiles_across() * kTile, y = t / tiles_across() * kTile;
  return {x, y, std::min(x + kTile, width()), std::min(y + kTile, height())};
}

std::uint32_t PartialFilm::fewest_samples() const {
  std::uint32_t fewest = ~0u;
  for (int t = 0; t < tiles(); ++t) {
    const Rect r = tile(t);
    for (int y = r.y0; y < r.y1; ++y)
      for (int x = r.x0; x < r.x1; ++x)
        fewest = std::min(fewest, parts[std::size_t(t)].pixel(x, y).samples);
  }
  return fewest;
}

bool PartialFilm::meets(const PartialFilm& other) const {
  for (std::size_t t = 0; t < done.size(); ++t)
    if (done[t].meets(other.done[t])) return true;
  return false;
}

void PartialFilm::add(const PartialFilm& other) {
  assert(!meets(other));
  wanted.clear();
  for (std::size_t t = 0; t < done.size(); ++t) {
    parts[t].merge(other.parts[t]);
    for (const SampleSet::Range& r : other.done[t].ranges()) done[t].add(r);
  }
}

Film PartialFilm::develop() const { return develop(ErrorEstimate(*this)); }

Film PartialFilm::develop(const ErrorEstimate& error) const {
  Film film{width(), height(), {}, {}};
  for (int y = 0; y < height(); ++y)
    for (int x = 0; x < width(); ++x) parts[0].develop(pixel(x, y), film);
  error.correct(film);
  weigh_borders(film);
  return film;
}

/// Where tiles meet that have different numbers of samples, a sum of both would reach further into
/// the one that has more: each part counts by its samples here.
void PartialFilm::weigh_borders(Film& film) const {
  std::size_t i = 0;
  for (int y = 0; y < height(); ++y)
    for (int x = 0; x < width(); ++x, ++i) {
      WeighedPixel pixel;
      for_each_part(x, y, [&](std::size_t t) { pixel.add(parts[t], x, y, done[t].count()); });
      if (pixel.even()) continue;
      film.xyz[i] = pixel.mean();
      film.variance[i] *= pixel.variance();
    }
}

SampleSet::Range pass_range(int pass) {
  if (pass == 0) return {0, 1};
  if (pass < kFirstPart) return {1u << (pass - 1), 1u << pass};
  if (pass < kFirstFullPass) {
    const std::uint32_t part = std::uint32_t(pass - kFirstPart), size = 1u << part / kPartsOfOctave;
    const std::uint32_t first = size * (kPartsOfOctave + part % kPartsOfOctave);
    return {first, first + size};
  }
  const std::uint32_t first = kFirstOfFull + std::uint32_t(pass - kFirstFullPass) * kSamplesOfPass;
  return {first, first + kSamplesOfPass};
}

int pass_of(std::uint32_t number) {
  if (number >= kFirstOfFull) return kFirstFullPass + int((number - kFirstOfFull) / kSamplesOfPass);
  const int digits = std::bit_width(number);
  if (number < kPartsOfOctave) return digits;
  const int octave = digits - kFirstPart;
  return kFirstPart + int(kPartsOfOctave) * octave + int((number >> octave) - kPartsOfOctave);
}

}  // namespace mms::renderer
