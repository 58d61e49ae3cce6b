// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Where the samples of a picture that ends by its error do most for it.
///
/// A patch of variance s^2 a sample has the variance s^2 / n after n samples, so a mean of all
/// patches of E^2 is had for the fewest samples where n is proportional to s: n = K s, with K so
/// large that it gets there. What has more already keeps it. s is that of the patch and of those
/// around it: what is rare may not have come yet where the samples of the patch alone say little.

#include <cstdint>
#include <vector>

#include "renderer/error.h"

namespace mms::renderer {

/// How many samples of a pixel each patch of `estimate` is worth for a root mean square error of
/// `target` over the picture, as far as it is known by now; at least one that has not got there
/// gets more than it has. \pre estimate.rmse() > target > 0
std::vector<double> samples_worth_having(const ErrorEstimate& estimate, double target);

/// How many samples each tile of `film` is to have next for that error, at most `most`, beginning
/// with number `first`; empty where the error is met, or nothing is left to be done.
std::vector<std::uint32_t> next_samples(const PartialFilm& film, double target, std::uint32_t first,
                                        std::uint32_t most);

}  // namespace mms::renderer
