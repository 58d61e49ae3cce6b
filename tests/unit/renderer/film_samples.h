// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Pictures that are made of samples by hand.

#include "renderer/samples.h"

namespace mms::renderer::test {

/// Adds a sample to the tile that it falls into.
inline void add_sample(PartialFilm& film, const FilmSample& sample) {
  const int tile = int(sample.y) / kTile * film.tiles_across() + int(sample.x) / kTile;
  film.parts[std::size_t(tile)].add(sample);
  film.done[std::size_t(tile)].add({sample.number, sample.number + 1});
}

}  // namespace mms::renderer::test
