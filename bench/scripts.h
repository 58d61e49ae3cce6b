// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Large scripts, made by rule: what the compiler is timed with. Each is as an author (or a
/// program that writes scripts) might lay it out, and has `lines` lines within a few.

#include <span>
#include <string>
#include <string_view>

namespace mms::bench {

struct LargeScript {
  std::string_view name, doc;
  std::string (*text)(int lines);
};

/// All of them; the first is the one whose stages are reported.
std::span<const LargeScript> large_scripts();

/// One descriptor on each line but a few, all sharing a handful of functions.
std::string descriptors_script(int count);

}  // namespace mms::bench
