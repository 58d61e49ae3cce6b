// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What `mms compare` was asked for.

#include "tools/picture.h"

namespace mms::tools {

struct CompareRequest : PictureOptions {
  std::string picture, reference, output, layer, crop, measure = "rmse", threshold;
  double limit = -1;  ///< from `threshold`; below 0 is none
};

/// Tells how two pictures differ. In a build without the renderer: says that it cannot.
/// \pre every number of `request` has been checked.
Exit compare_pictures(const CompareRequest& request);

}  // namespace mms::tools
