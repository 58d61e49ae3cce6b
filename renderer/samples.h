// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Which sample numbers there are in a sum, so that none is added twice and none is left out.

#include <cstdint>
#include <utility>
#include <vector>

#include "renderer/film.h"

namespace mms::renderer {

/// A set of sample numbers, as ranges [first, second) in order that do not touch.
class SampleSet {
 public:
  using Range = std::pair<std::uint32_t, std::uint32_t>;

  void add(Range range);
  bool has(std::uint32_t number) const;
  /// Whether some number is in both.
  bool meets(const SampleSet& other) const;
  /// The first number that is not in it.
  std::uint32_t prefix() const;
  std::uint64_t count() const;
  const std::vector<Range>& ranges() const { return ranges_; }
  bool operator==(const SampleSet&) const = default;

 private:
  std::vector<Range> ranges_;
};

/// Edge of the squares that a picture is worked on in, in pixels.
inline constexpr int kTile = 16;

/// A picture under way, and what is in it: for each tile, row by row, the numbers of the samples.
struct PartialFilm {
  FilmSums sums;
  std::vector<SampleSet> done;

  PartialFilm(int width, int height, FilterShape filter);
  int tiles_across() const { return (sums.width() + kTile - 1) / kTile; }
  /// The pixels of tile `t`.
  Rect tile(int t) const;
  /// All samples with smaller numbers are there everywhere.
  std::uint32_t complete() const;
  /// Whether some sample is in both; then they must not be added up.
  bool meets(const PartialFilm& other) const;
  /// \pre same size and filter, and `!meets(other)`.
  void add(const PartialFilm& other);
  /// The picture, with variances that know of the sequence (renderer/error.h).
  Film develop() const;
};

/// Doublings of the samples are worked on, and looked at, in so many parts.
inline constexpr std::uint32_t kPartsOfOctave = 8;

/// The passes that a picture is made in, each over all tiles: [0, 1), [1, 2), [2, 4), [4, 8), then
/// parts of an octave up to 64, then eight samples each. The first shows something soon; none lies
/// in two blocks of the film.
SampleSet::Range pass_range(int pass);
/// The pass that sample `number` is in.
int pass_of(std::uint32_t number);

}  // namespace mms::renderer
