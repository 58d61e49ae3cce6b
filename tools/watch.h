// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// `mms render --watch`: a picture that follows its files.

#include <string>

#include "tools/render.h"

namespace mms::tools {

/// Renders `file` to `path`, and again whenever the script, an import, the scene or a file of it
/// changes, comes or goes, until Ctrl-C. A coarse picture comes first; the picture at `path`
/// refines and is whole at every moment. Mistakes in the script are said, and their correction is
/// waited for.
Exit watch(RenderRequest request, const std::string& file, const std::string& path);

}  // namespace mms::tools
