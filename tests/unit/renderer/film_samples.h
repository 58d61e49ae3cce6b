// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Pictures that are made of samples by hand, and how far a picture is from another.

#include "renderer/samples.h"

namespace mms::renderer::test {

/// Adds a sample to the tile that it falls into.
inline void add_sample(PartialFilm& film, const FilmSample& sample) {
  const int tile = int(sample.y) / kTile * film.tiles_across() + int(sample.x) / kTile;
  film.parts[std::size_t(tile)].add(sample);
  film.done[std::size_t(tile)].add({sample.number, sample.number + 1});
}

/// Mean over the pixels of the squared difference in luminance.
inline double mean_square(const Film& film, const Film& reference) {
  double sum = 0;
  for (std::size_t i = 0; i < film.xyz.size(); ++i) {
    const double d = film.xyz[i][1] - reference.xyz[i][1];
    sum += d * d;
  }
  return sum / double(film.xyz.size());
}

}  // namespace mms::renderer::test
