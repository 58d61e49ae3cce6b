// SPDX-License-Identifier: Apache-2.0
// Functions that facets are sampled and looked up with, against those of the C library in long
// double.
#include "materials/facets.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace mms::test {
namespace {

using namespace materials;

TEST_CASE("the angle by which tables are laid out is that of atan2 within 2e-8") {
  double worst = 0;
  for (int i = 0; i <= 1000; ++i)
    for (double scale : {1e-12, 1.0, 1e8}) {
      const double turn = i / 1000.0, phi = turn * kPi<double> / 2;
      worst = std::max(worst,
                       std::abs(axes::angle(scale * std::sin(phi), scale * std::cos(phi)) - turn));
    }
  CHECK(worst < 2e-8);
  CHECK(axes::angle(0.0, 1.0) == 0);
  CHECK(axes::angle(1.0, 0.0) == 1);
  CHECK(axes::angle(0.0f, 0.0f) == 0);
}

/// How far erf(`x`) is from `y`, over what R rounds there: of its distance from 1 where that is
/// less.
template <class R>
double inverse_error(R y, R x) {
  const long double target = y, z = x, all = std::abs(target);
  const long double error = all < 0.5L ? std::erf(z) - target
                            : y > 0    ? (1 - target) - std::erfc(z)
                                       : std::erfc(-z) - (1 + target);
  return double(std::abs(error) / std::min(all, 1 - all)) /
         double(std::numeric_limits<R>::epsilon());
}

TEST_CASE_TEMPLATE("the inverse of erf", R, float, double) {
  double worst = 0;
  for (double part = 1; part > std::numeric_limits<R>::epsilon(); part *= 0.83)
    for (double y : {part / 2, 1 - part / 2})
      for (double sign : {1.0, -1.0})
        worst = std::max(worst, inverse_error(R(sign * y), erf_inverse(R(sign * y))));
  // Of its distance from 1 erf changes by 2 x^2 of what x does of itself: in float by 29, of the
  // half epsilon that it is rounded by and of 3e-7; in double by 67, of the former.
  MESSAGE("epsilons: ", worst);
  CHECK(worst < 100);
  CHECK(erf_inverse(R(0)) == 0);
  CHECK(std::isfinite(erf_inverse(R(1))));
  CHECK(std::isfinite(erf_inverse(R(-1))));
}

/// c (1 + erf x) / 2 + s e^(-x^2) / (2 sqrt pi).
long double visible_below(long double x, long double c, long double s) {
  return (c * std::erfc(-x) + s * std::exp(-x * x) / std::sqrt(kPi<long double>)) / 2;
}

/// The largest distance of a number from the share of visible slopes below the one it draws.
template <class R>
double quantile_error() {
  double worst = 0;
  for (double degrees : {0.0, 1.0, 30.0, 60.0, 80.0, 89.0, 89.99}) {
    const R angle = R(degrees) * kPi<R> / 180, alpha = R(0.4);
    const Beckmann<R> facets{{alpha, alpha}};
    const Vec3<R> wo{std::sin(angle), 0, std::cos(angle)};
    // Along wo stretched by alpha.
    const long double x = alpha * (long double)wo.x, z = wo.z, length = std::sqrt(x * x + z * z);
    const long double c = z / length, s = x / length;
    const long double end = s > 0 ? std::min(c / s, 40.0L) : 40.0L;
    for (int i = 0; i < 256; ++i) {
      const R u = (R(i) + R(0.5)) / 256;
      const Vec3<R> h = facets.sample_visible(wo, u, R(0.5));
      const long double slope = -(long double)h.x / h.z / alpha;
      worst = std::max(
          worst,
          double(std::abs(visible_below(slope, c, s) / visible_below(end, c, s) - (long double)u)));
    }
  }
  return worst;
}

TEST_CASE("Beckmann's visible slopes are drawn by their integral's inverse") {
  const double narrow = quantile_error<float>(), wide = quantile_error<double>();
  MESSAGE(narrow, " in float, ", wide, " in double");
  CHECK(narrow < 1e-6);
  CHECK(wide < 1e-14);
}

}  // namespace
}  // namespace mms::test
