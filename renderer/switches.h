// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Ways to do the same work, for comparison: what a path counts for which wavelengths, and where
/// its numbers come from. Every combination has the same mean; the first of each has the least
/// error.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace mms::renderer {

/// How light that a path finds for its hero counts for the cluster's wavelengths (thesis 4.3.3).
enum class Estimator : std::uint8_t { Clustered, Unweighted, SingleSample, Four };

/// Wavelengths of a cluster that differ. Four lie evenly in eight lanes, each in two of them, so
/// that every sum over lanes is twice that over wavelengths, and so are the densities that it is
/// over.
constexpr int wavelengths_of(Estimator e) { return e == Estimator::Four ? 4 : 8; }

/// Where the first four coordinates of a sample come from (thesis 6.1.1).
enum class Generator : std::uint8_t { Niederreiter, Sobol, Random, Unscrambled };

struct SwitchInfo {
  std::string_view name, doc;
};

/// In the order of the enumerators.
std::span<const SwitchInfo> estimators();
std::span<const SwitchInfo> generators();
std::optional<Estimator> estimator_named(std::string_view name);
std::optional<Generator> generator_named(std::string_view name);

}  // namespace mms::renderer
