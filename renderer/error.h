// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// How far a picture is from the truth, found from its own samples.
///
/// The scatter of quasi-Monte Carlo samples says nothing of the error of their mean: it would be
/// that of independent samples, which is larger. But the samples with numbers in [0, n) and in
/// [n, 2n) are two nets of one sequence, so at each pixel they give two means A and B whose mean is
/// what 2n samples give. Let v(n) be the variance of a mean of n samples. Then
///     E (A - B)^2 / 4 = v(n) - v(2n),
/// whatever the correlation of A and B. Of v(n) = r v(2n) the factor r is found from the same
/// difference one block earlier: it is 2 for independent samples and up to 8 for nets and smooth
/// functions. Both sums are over the pixels of a region, since one pixel knows too little.

#include <cstdint>
#include <vector>

#include "renderer/film.h"

namespace mms::renderer {

class ErrorEstimate {
 public:
  /// Every sample with a number below `complete` has been added everywhere. Where that is below 8
  /// the samples are taken to be independent, which errs upwards.
  ErrorEstimate(const FilmSums& film, std::uint32_t complete);

  /// Root of the mean variance of a pixel's linear luminance over the picture; 0 below 2 samples.
  double rmse() const { return rmse_; }
  /// What the variance of pixel (x, y) by independent samples is to be multiplied by.
  double factor(int x, int y) const;
  /// Applies `factor` to the variances of a developed picture.
  void correct(Film& film) const;

 private:
  int side_ = 1, across_ = 1;  ///< of a region in pixels; regions in a row
  std::vector<double> factors_;
  double rmse_ = 0;
};

}  // namespace mms::renderer
