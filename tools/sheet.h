// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// `mms render` of several pictures to one: scripts beside each other, a parameter swept.

#include <string>

#include "tools/render.h"

namespace mms::tools {

/// Whether `request` asks for one picture of several: a sweep, or many scripts and a .png file.
bool wants_sheet(const RenderRequest& request);

/// Renders them and puts them on one sheet at `request.output`, or where that is empty at
/// `NAME.png`. A script that does not render leaves its place empty; a sweep of a param
/// that a script does not have renders nothing.
Exit render_sheet(const RenderRequest& request);

}  // namespace mms::tools
