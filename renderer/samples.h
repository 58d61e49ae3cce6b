// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Which sample numbers there are in a sum, so that none is added twice and none is left out.

#include <cstdint>
#include <utility>
#include <vector>

#include "renderer/film.h"

namespace mms::renderer {

class ErrorEstimate;  // renderer/error.h

/// A set of sample numbers, as ranges [first, second) in order that do not touch.
class SampleSet {
 public:
  using Range = std::pair<std::uint32_t, std::uint32_t>;

  void add(Range range);
  bool has(std::uint32_t number) const;
  /// Whether some number is in both.
  bool meets(const SampleSet& other) const;
  /// The first number from `first` on that is not in it.
  std::uint32_t missing_from(std::uint32_t first) const;
  std::uint64_t count() const;
  const std::vector<Range>& ranges() const { return ranges_; }
  bool operator==(const SampleSet&) const = default;

 private:
  std::vector<Range> ranges_;
};

/// A picture under way. Each tile, row by row, has sums of its own over all pixels that its samples
/// reach: so tiles may have different numbers of samples, and where they meet a pixel weighs what
/// it gets from each by the samples that there are, as the filter asks for.
struct PartialFilm {
  std::vector<FilmSums> parts;
  std::vector<SampleSet> done;  ///< the numbers of each tile's samples
  /// How many samples each tile is to have before the error is asked for again; else empty. Where
  /// a render goes on, it first comes to the same point (renderer/adaptive.h).
  std::vector<std::uint32_t> wanted = {};

  PartialFilm(int width, int height, FilterShape filter);
  int width() const { return parts[0].width(); }
  int height() const { return parts[0].height(); }
  int tiles() const { return int(parts.size()); }
  int tiles_across() const { return (width() + kTile - 1) / kTile; }
  /// The pixels of tile `t`.
  Rect tile(int t) const;
  /// Of the samples that fell into a pixel, the smallest number.
  std::uint32_t fewest_samples() const;
  /// What all parts have gathered there.
  PixelSums pixel(int x, int y) const;
  /// The same of a block, at a probe.
  BlockSums block(int b, int x, int y) const;
  /// Whether some sample is in both; then they must not be added up.
  bool meets(const PartialFilm& other) const;
  /// \pre same size and filter, and `!meets(other)`.
  void add(const PartialFilm& other);
  /// The picture, with variances that know of the sequence (renderer/error.h).
  Film develop() const;
  /// The same; `error` is of this film.
  Film develop(const ErrorEstimate& error) const;

 private:
  template <class F>
  void for_each_part(int x, int y, const F& f) const;
  void weigh_borders(Film& film) const;
};

/// Doublings of the samples are worked on, and looked at, in so many parts.
inline constexpr std::uint32_t kPartsOfOctave = 4;

/// The passes that a tile is made in: [0, 1), [1, 2), [2, 4), then parts of an octave up to 32,
/// then eight samples each. The first shows something soon; none lies in two blocks of the film.
SampleSet::Range pass_range(int pass);
/// The pass that sample `number` is in.
int pass_of(std::uint32_t number);

}  // namespace mms::renderer
