// SPDX-License-Identifier: Apache-2.0
#include "renderer/samples.h"

#include <algorithm>
#include <bit>
#include <cassert>

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

std::uint32_t SampleSet::prefix() const {
  return ranges_.empty() || ranges_[0].first > 0 ? 0 : ranges_[0].second;
}

std::uint64_t SampleSet::count() const {
  std::uint64_t n = 0;
  for (const Range& r : ranges_) n += r.second - r.first;
  return n;
}

PartialFilm::PartialFilm(int width, int height, FilterShape filter) : sums(width, height, filter) {
  const int down = (height + kTile - 1) / kTile;
  done.resize(std::size_t(tiles_across()) * std::size_t(down));
}

Rect PartialFilm::tile(int t) const {
  const int x = t % tiles_across() * kTile, y = t / tiles_across() * kTile;
  return {x, y, std::min(x + kTile, sums.width()), std::min(y + kTile, sums.height())};
}

std::uint32_t PartialFilm::complete() const {
  std::uint32_t least = ~0u;
  for (const SampleSet& s : done) least = std::min(least, s.prefix());
  return least;
}

bool PartialFilm::meets(const PartialFilm& other) const {
  for (std::size_t t = 0; t < done.size(); ++t)
    if (done[t].meets(other.done[t])) return true;
  return false;
}

void PartialFilm::add(const PartialFilm& other) {
  assert(!meets(other));
  sums.merge(other.sums);
  for (std::size_t t = 0; t < done.size(); ++t)
    for (const SampleSet::Range& r : other.done[t].ranges()) done[t].add(r);
}

Film PartialFilm::develop() const {
  Film film = sums.develop();
  ErrorEstimate(sums, complete()).correct(film);
  return film;
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
