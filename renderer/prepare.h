// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What is found out before a render begins: whether scripts run within their budget, and how much
/// each emitter radiates.

#include <string>
#include <vector>

#include "base/result.h"
#include "renderer/glows.h"
#include "renderer/rate_grid.h"
#include "renderer/scripts.h"

namespace mms::renderer {

struct Findings {
  std::vector<double> radiance;  ///< mean luminance of each object's surface; 0 is no emitter
  /// Largest extinction of each object's volume where it varies from place to place, in parts: as
  /// found by enclosure, and nowhere above what is stated; empty for other objects.
  std::vector<RateGrid> majorants;
  std::vector<RateGrid> emission_rates;  ///< of such volumes that emit: renderer/enclosure.h
  std::vector<Glow> glows;               ///< volumes that emit
};

/// Runs the scripts at kProbePoints points. Errors: a script that exceeds its budget; a volume that
/// varies from place to place, states no usable `bound`, and has no finite enclosure.
Result<Findings> probe(const SceneData& scene, const Compiled& compiled);

/// `file:line` of a place in a script.
std::string place(const vm::Program& program, std::uint32_t source, std::uint32_t line);

/// What the machine gave a lane up for, in words.
std::string cause_text(vm::Fault::Cause cause);

}  // namespace mms::renderer
