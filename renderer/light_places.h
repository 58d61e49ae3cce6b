// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Where on a lamp light is drawn: densities that follow what a matte receiver gets from each
/// place, in closed form and with closed inverses. They are continuous maps of the unit square, so
/// what is stratified there stays so. A density is relative to the even one: its mean is 1.

#include <algorithm>
#include <array>
#include <cmath>

#include "base/warp.h"

namespace mms::renderer {

/// Least share of the largest value that a density has anywhere: what it follows is known at some
/// places only.
inline constexpr double kLeastShare = 1.0 / 16;

struct Place {
  double x, y;
};

namespace detail {

/// Inverse of the distribution over [0, 1] whose density is linear, `a` at 0 and `b` at 1.
inline double inverse_linear(double a, double b, double u) {
  return u * (a + b) / (a + std::sqrt(a * a + u * (b * b - a * a)));
}

/// The same of one that is linear between three values, at 0, 1/2 and 1.
inline double inverse_linear(const std::array<double, 3>& at, double u) {
  const double first = at[0] + at[1], second = at[1] + at[2], x = u * (first + second);
  const double place = x < first ? inverse_linear(at[0], at[1], x / first) / 2
                                 : (1 + inverse_linear(at[1], at[2], (x - first) / second)) / 2;
  return std::min(place, 1.0);
}

inline double linear(const std::array<double, 3>& at, double x) {
  return x < 0.5 ? at[0] + (at[1] - at[0]) * 2 * x : at[1] + (at[2] - at[1]) * (2 * x - 1);
}

}  // namespace detail

/// Over the unit square, bilinear between nine values at the corners of its quarters.
class SquareDensity {
 public:
  /// `value(x, y)`, not negative, for x and y in {0, 1/2, 1}.
  template <class Value>
  explicit SquareDensity(const Value& value) {
    double largest = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) largest = std::max(largest, at_[i][j] = value(0.5 * i, 0.5 * j));
    const double least = largest > 0 ? largest * kLeastShare : 1;
    for (int i = 0; i < 3; ++i) {
      for (double& v : at_[i]) v = std::max(v, least);
      columns_[i] = (at_[i][0] + 2 * at_[i][1] + at_[i][2]) / 4;
    }
    mean_ = (columns_[0] + 2 * columns_[1] + columns_[2]) / 4;
  }

  Place sample(double u, double v) const {
    const double x = detail::inverse_linear(columns_, u);
    return {x, detail::inverse_linear(along(x), v)};
  }
  double at(double x, double y) const { return detail::linear(along(x), y) / mean_; }

 private:
  std::array<double, 3> along(double x) const {
    std::array<double, 3> column;
    for (int j = 0; j < 3; ++j) column[j] = detail::linear({at_[0][j], at_[1][j], at_[2][j]}, x);
    return column;
  }

  std::array<std::array<double, 3>, 3> at_;
  std::array<double, 3> columns_;
  double mean_;
};

/// Over the unit disc: linear in r^2, and on each circle Poisson's kernel, whose distribution a
/// Moebius map of the circle inverts,
///
///   p(r, phi) = q(r^2) (1 - k^2) / (1 + k^2 - 2 k cos phi),   k = tilt r
class DiscDensity {
 public:
  /// Values not negative: `centre` and `rim` are those at r = 0 and the mean at r = 1, and
  /// (slope_x, slope_y) is how the density changes across the disc.
  DiscDensity(double centre, double rim, double slope_x, double slope_y) {
    const double least = std::max(centre, rim) * kLeastShare;
    centre = std::max(centre, least);
    rim = std::max(rim, least);
    const double mean = (centre + rim) / 2;
    if (!(mean > 0)) return;
    centre_ = centre / mean;
    rim_ = rim / mean;
    const double slope = std::sqrt(slope_x * slope_x + slope_y * slope_y);
    if (!(slope > 0)) return;
    tilt_ = std::min(slope / (2 * mean), kLargestTilt);
    cos_ = slope_x / slope;
    sin_ = slope_y / slope;
  }

  Place sample(double u, double v) const {
    const Vec3d even = square_to_disc(u, v);
    const double even2 = even.x * even.x + even.y * even.y;
    if (!(even2 > 0)) return {0, 0};
    const double r = std::sqrt(detail::inverse_linear(centre_, rim_, std::min(even2, 1.0)));
    const double k = tilt_ * r, unit = 1 / std::sqrt(even2);
    const double c = (even.x * cos_ + even.y * sin_) * unit;
    const double s = (even.y * cos_ - even.x * sin_) * unit;
    // (e^i phi + k) / (1 + k e^i phi), of length 1
    const double scale = r / (1 + k * k + 2 * k * c);
    const double a = scale * (2 * k + c * (1 + k * k)), b = scale * s * (1 - k) * (1 + k);
    return {a * cos_ - b * sin_, a * sin_ + b * cos_};
  }
  double at(double x, double y) const {
    const double r2 = x * x + y * y, k2 = tilt_ * tilt_ * r2;
    return (centre_ + (rim_ - centre_) * r2) * (1 - k2) /
           (1 + k2 - 2 * tilt_ * (x * cos_ + y * sin_));
  }

 private:
  static constexpr double kLargestTilt = 0.6;

  double centre_ = 1, rim_ = 1, tilt_ = 0, cos_ = 1, sin_ = 0;
};

}  // namespace mms::renderer
