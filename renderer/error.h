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
/// difference one block earlier: it is 2 for independent samples, up to 8 for nets and smooth
/// functions, and between 2 and 2.83 a sum of chance and of edges that pixels have, of which v(2n)
/// has more of the former than r says (`left_of_difference`). The differences are summed over the
/// pixels of a patch, whose tiles have much the same samples, and r is that of the patches around,
/// since one pixel knows too little.

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/film.h"

namespace mms::renderer {

struct PartialFilm;  // renderer/samples.h

class ErrorEstimate {
 public:
  /// A square of `patch_side` pixels, or what of it lies in the picture.
  struct Patch {
    double variance = 0;  ///< of a pixel's mean luminance, on average; 0 below 2 samples
    double samples = 0;   ///< of a pixel
    int probes = 0;       ///< pixels that were looked at
  };

  /// Where a tile lacks one of its first 4 samples they are taken to be independent, which errs
  /// upwards.
  explicit ErrorEstimate(const PartialFilm& film);

  /// Root of the mean variance of a pixel's linear luminance over the picture; 0 below 2 samples.
  double rmse() const { return rmse_; }
  /// Row by row.
  std::span<const Patch> patches() const { return patches_; }
  int patches_across() const { return across_; }
  /// A multiple of kTile.
  int patch_side() const { return side_; }
  /// What the variance of pixel (x, y) by independent samples is to be multiplied by.
  double factor(int x, int y) const;
  /// Applies `factor` to the variances of a developed picture.
  void correct(Film& film) const;

 private:
  int side_, across_;
  std::vector<Patch> patches_;
  std::vector<double> factors_;
  double rmse_ = 0;
};

}  // namespace mms::renderer
