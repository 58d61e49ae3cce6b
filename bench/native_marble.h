// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A material in C++ in the place of its script: the linker sends the renderer's calls of the
/// machine through here (`--wrap`, bench/CMakeLists.txt), so that nothing in the renderer knows of
/// it.

namespace mms::bench {

/// What runs: the script, or where this is set the twin of the suite's marble.
inline bool native_marble = false;

/// Its only number that varies is `t`, the one result of a run.
inline constexpr const char* kMarble =
    "surface s\n"
    "  t = 0.5 + 0.5 * sin(3 * $position.x + 4 * fbm(2 * $position, 6));\n"
    "  bsdf = fresnel_mix(matte(t), glossy(colour = 1, gloss = 900.0), ior = 1.5);\n"
    "end\n";

}  // namespace mms::bench
