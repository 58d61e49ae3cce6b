// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What `mms merge` was asked for.

#include "tools/picture.h"

namespace mms::tools {

struct MergeRequest : PictureOptions {
  std::vector<std::string> films;
  std::string output;
};

/// Adds films up to one picture or film. In a build without the renderer: says that it cannot.
Exit merge_films(const MergeRequest& request);

}  // namespace mms::tools
