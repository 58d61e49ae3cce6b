// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the verbs that write pictures say of them, and how they show them.

#include <cstdint>

#include "renderer/film_file.h"
#include "renderer/picture.h"
#include "tools/picture.h"

namespace mms::tools {

/// \pre `read_picture_options` found nothing wrong.
renderer::View view_of(const PictureOptions& options);

/// Whether pictures can be written to `paths` and shown as asked, before any work is done.
Result<renderer::Done> check_output(const std::vector<std::string>& paths,
                                    const PictureOptions& options);

/// A word as a shell reads it back.
std::string quoted(const std::string& word);

/// Whether a picture with so many samples of each pixel tells its error: one says nothing of it.
constexpr bool tells_error(std::uint32_t samples) { return samples >= 2; }

/// `0.01`, or `unknown`.
std::string error_text(std::uint32_t samples, double error);

/// What the picture at `path` says of itself. Equal sums say the same, however they were made: all
/// but the command line, which only .exr pictures hold.
renderer::Metadata metadata(const std::string& path, const renderer::FilmKey& key,
                            const renderer::PartialFilm& film);

}  // namespace mms::tools
