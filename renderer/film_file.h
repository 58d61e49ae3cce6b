// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A picture under way as a file: the exact sums, which samples are in them, and what they are
/// samples of. A render goes on from it, and files of different samples of one picture add up to
/// the very bytes that one render of all of them writes.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "renderer/layers.h"
#include "renderer/samples.h"

namespace mms::renderer {

/// All that samples depend on. Sums of different keys do not add up.
struct FilmKey {
  int width = 0, height = 0;
  FilterShape filter = FilterShape::Box;
  std::uint64_t seed = 0;
  int max_depth = 0;
  Estimator estimator = Estimator::Clustered;
  Generator generator = Generator::Niederreiter;
  std::uint64_t script = 0;  ///< hash of the linked program, with its settings
  std::uint64_t scene = 0;   ///< hash of the scene, its files, and what the test object wears
  bool operator==(const FilmKey&) const = default;
};

/// Options that `key` leaves open are not asked for.
FilmKey film_key(const Scene& scene, const RenderOptions& options, std::uint64_t script);

/// What differs, in words: `seed 3 and 4`. Empty for equal keys.
std::string difference(const FilmKey& a, const FilmKey& b);

struct StoredFilm {
  FilmKey key;
  PartialFilm film;
  std::shared_ptr<const Layers> layers = {};  ///< null where the file has none
};

/// What such files end with.
inline constexpr std::string_view kFilmExtension = ".film";

/// Writes atomically: the file is there in full or as it was before. `layers` may be null; they are
/// of the same picture, and are what `mms merge` writes beside it.
Result<Done> save_film(const std::string& path, const FilmKey& key, const PartialFilm& film,
                       const Layers* layers = nullptr);

/// Errors: no such file, no film, of another version, damaged.
Result<StoredFilm> load_film(const std::string& path);

}  // namespace mms::renderer
