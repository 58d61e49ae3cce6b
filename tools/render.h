// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What `mms render` was asked for.

#include <cstdint>
#include <string>

#include "tools/script.h"

namespace mms::tools {

struct RenderRequest : ScriptOptions {
  std::string output;  ///< as given; empty, a file, or a folder
  std::string size = "512x512";
  int width = 512, height = 512;  ///< from `size`
  std::string samples = "64", threads = "0", max_depth = "64", seed = "0", exposure = "0";
  int sample_count = 64, thread_count = 0, depth = 64;
  std::uint64_t seed_number = 0;
  double stops = 0;
  std::string scene = "sphere", surface, volume;
  bool quiet = false, report = false;
};

/// Renders each script to its picture. In a build without the renderer: says that it cannot.
/// \pre every number of `request` has been checked.
Exit render_pictures(const RenderRequest& request);

}  // namespace mms::tools
