// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What verbs that write pictures share: how a linear picture becomes a file.

#include <optional>
#include <string>

#include "tools/script.h"

namespace mms::tools {

struct PictureOptions : ScriptOptions {
  std::string exposure = "0", contrast = "1", view = "thesis", ocio;
  double stops = 0;  ///< from `exposure`
  double power = 1;  ///< from `contrast`
  bool quiet = false;
};

void add_picture_options(Verb& verb, PictureOptions& options);

/// Reads the numbers; what is wrong with them.
std::optional<Error> read_picture_options(PictureOptions& options);

/// The whole of `text` as a number.
template <class T>
std::optional<T> number(const std::string& text);

}  // namespace mms::tools
