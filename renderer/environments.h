// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Environments that have a name: what `SceneSource::environment` may ask for besides a picture.

#include <string_view>

namespace mms::renderer {

struct NamedEnvironment {
  std::string_view name;
  std::string_view text;  ///< `environment` of a scene file that says the same
};

inline constexpr NamedEnvironment kEnvironments[] = {
    {"white", R"({"constant": 1})"},
    {"black", R"({"constant": 0})"},
    {"overcast", R"({"sky": "overcast"})"},
    {"clear", R"({"sky": "clear"})"},
};

}  // namespace mms::renderer
