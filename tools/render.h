// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What `mms render` was asked for.

#include <cstdint>
#include <string>

#include "tools/picture.h"

namespace mms::tools {

struct RenderRequest : PictureOptions {
  std::string output;  ///< as given; empty, a file, or a folder
  std::string size = "512x512";
  int width = 512, height = 512;  ///< from `size`
  std::string samples, threads = "0", max_depth = "64", seed = "0", checkpoint;
  std::string time, error, filter = "blackman-harris", estimator = "clustered",
                           sampler = "niederreiter";
  int first_sample = 0, end_sample = 64, thread_count = 0, depth = 64;
  double seconds = 0, error_limit = 0;  ///< 0 is none
  std::uint64_t seed_number = 0;
  std::string scene = "sphere", environment, surface, volume, turntable;
  std::vector<std::string> sweeps;  ///< `param=a:b:n`: the first across, the second down
  int frames = 0;                   ///< from `turntable`; 0 is none
  double turn = 0;                  ///< of the test object, radians
  double checkpoint_seconds = 60;   ///< 0 is never
  bool resume = false, report = false, watch = false;
};

/// Renders each script to its picture. In a build without the renderer: says that it cannot.
/// \pre every number of `request` has been checked.
Exit render_pictures(const RenderRequest& request);

}  // namespace mms::tools
