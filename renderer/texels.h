// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A picture file with its numbers made linear as they are read, before anything filters them.
/// Internal to the textures.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "renderer/packed.h"

namespace mms::renderer {

/// What is known of a picture file.
struct TexelFile {
  std::string path;
  std::string space;  ///< `linear`, `sRGB` or one that OpenColorIO knows; never `auto`
  int width = 0, height = 0, channels = 0;
  std::vector<std::string> channel_names;
  bool bounded = false;  ///< numbers are in [0, 1] for certain
  int number_bytes = 0;  ///< of a number as it is kept
};

/// Looks into the file and reads the last of it, so that one that is cut off is found out. The
/// error's `what` goes on after the file's name.
Result<TexelFile> inspect_texels(const std::string& path, const std::string& space);

/// A number that the file states under `name`.
bool texel_fact(const std::string& path, std::string_view name, double& value);

/// A level of a file, made linear: row by row from the top, all channels.
struct TexelLevel {
  int width = 0, height = 0;
  std::vector<float> pixels;
};

/// Reads a level into `to`, the first one being 0; false where there is none.
bool read_texels(const TexelFile& file, int level, TexelLevel& to);

/// The least and the greatest number of all channels and levels, made linear.
void texel_range(const TexelFile& file, double& low, double& high);

/// The first level of the file, made linear and packed; the error is one of reading.
Result<std::shared_ptr<const Packed>> pack_texels(const TexelFile& file);

/// The same for a packed picture, which outlives what looks it up.
std::string add_packed(void* cache, const TexelFile& file, const Packed& packed);

/// The name of the file's numbers in an OIIO::ImageCache `cache`, to which it is added.
std::string add_texels(void* cache, const TexelFile& file);

}  // namespace mms::renderer
