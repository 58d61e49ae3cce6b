// SPDX-License-Identifier: Apache-2.0
#include "renderer/film.h"

#include <cmath>

namespace mms::renderer {
namespace {

constexpr double kLargest = 0x1p32;
constexpr double kValueUnit = 0x1p64, kSquareUnit = 0x1p48;

double to_double(Int128 sum, double unit) { return double(sum) / unit; }

}  // namespace

SampleFate add_sample(PixelSums& sums, const std::array<double, 3>& xyz) {
  ++sums.samples;
  for (double v : xyz) {
    if (std::isnan(v)) return SampleFate::NotANumber;
    if (std::isinf(v)) return SampleFate::Infinite;
    if (!(std::abs(v) < kLargest)) return SampleFate::Overflow;
  }
  PixelSums next = sums;
  bool overflow = false;
  for (int i = 0; i < 3; ++i)
    overflow |= __builtin_add_overflow(sums.xyz[i], Int128(xyz[i] * kValueUnit), &next.xyz[i]);
  overflow |= __builtin_add_overflow(sums.luminance_square, Int128(xyz[1] * xyz[1] * kSquareUnit),
                                     &next.luminance_square);
  if (overflow) return SampleFate::Overflow;
  sums = next;
  return SampleFate::Added;
}

Film FilmSums::develop() const {
  Film film{width_, height_, {}, {}};
  film.xyz.reserve(pixels_.size());
  film.variance.reserve(pixels_.size());
  for (const PixelSums& p : pixels_) {
    const double n = p.samples > 0 ? p.samples : 1;
    std::array<double, 3> mean{};
    for (int i = 0; i < 3; ++i) mean[i] = to_double(p.xyz[i], kValueUnit) / n;
    film.xyz.push_back(mean);
    // The two terms cancel, so the difference is taken in the fixed point of the sums' square:
    // sum((y - mean)^2) = sum(y^2) - n mean^2, exact to 2^-53 of sum(y^2).
    const double sum_square = to_double(p.luminance_square, kSquareUnit);
    const double spread = std::max(0.0, sum_square - n * mean[1] * mean[1]);
    film.variance.push_back(p.samples > 1 ? spread / (n - 1) / n : 0.0);
  }
  return film;
}

}  // namespace mms::renderer
