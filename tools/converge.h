// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What `mms converge` was asked for.

#include <string>
#include <vector>

#include "tools/script.h"

namespace mms::tools {

struct ConvergeRequest : ScriptOptions {
  std::string output;
  std::vector<std::string> vary;  ///< each a set of switches of `mms render`
  std::vector<std::string> with;  ///< switches for all renders
  std::string range = "1:64", reference;
  int first = 1, last = 64;   ///< from `range`
  int reference_samples = 0;  ///< from `reference`
  bool quiet = false;
};

/// Renders and measures. In a build without the renderer: says that it cannot.
/// \pre every number of `request` has been checked.
Exit measure_convergence(const ConvergeRequest& request);

}  // namespace mms::tools
