// SPDX-License-Identifier: Apache-2.0
// Polynomials over the shapes of stretched facets, against powers and cosines term by term.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/warp.h"
#include "materials/energy.h"
#include "tests/stats/random.h"

using namespace mms;
using materials::Shape, materials::ShapeBasis, materials::ShapeOrder;

namespace {

/// r^m cos(m angle) T_k(2 r^2 - 1) of all terms, less where it is at the centre, in their order.
std::vector<double> terms(double radius, double angle, ShapeOrder order) {
  const auto chebyshev = [radius](int k) {
    return std::cos(k * std::acos(2 * radius * radius - 1));
  };
  std::vector<double> all;
  for (int k = 1; k <= order.outwards(); ++k)
    all.push_back(chebyshev(k) - std::cos(k * kPi<double>));
  constexpr int together = ShapeBasis<double>::kTogether;
  for (int first = 1; first <= order.around; first += together)
    for (int k = 0; k <= order.outwards(); ++k)
      for (int m = first; m < first + together && m + order.step * k <= order.around; ++m)
        all.push_back(std::pow(radius, m) * std::cos(m * angle) * chebyshev(k));
  return all;
}

}  // namespace

TEST_CASE("polynomials over shapes are what their terms add up to") {
  stats::Random random(1);
  double worst = 0, worst_float = 0;
  for (const ShapeOrder order : {ShapeOrder{24}, {20}, {18}, {24, 4}, {20, 4}, {16}})
    for (int n = 0; n < 200; ++n) {
      const double radius = std::sqrt(random.next()), angle = kPi<double> * random.next();
      const Shape<double> shape{radius * std::cos(angle), radius * std::sin(angle)};
      const std::vector<double> values = terms(radius, angle, order);
      REQUIRE(int(values.size()) == ShapeBasis<double>::terms(order));
      std::vector<double> coefficients;
      std::vector<float> rounded;
      double sum = 0, size = 0;
      for (const double value : values) {
        rounded.push_back(float(random.between(-0.1, 0.1)));
        coefficients.push_back(rounded.back());
        sum += value * coefficients.back();
        size += std::abs(value * coefficients.back());
      }
      const ShapeBasis<double> basis(shape, order);
      CHECK(basis.count <= int(values.size()));
      worst = std::max(worst, std::abs(basis.sum(coefficients.data()) - sum));
      const ShapeBasis<float> in_float({float(shape.u), float(shape.v)}, order);
      worst_float =
          std::max(worst_float, std::abs(double(in_float.sum(rounded.data())) - sum) / size);
    }
  CHECK(worst < 2e-6);  // what is left out where facets are nearly round
  CHECK(worst_float < 1e-5);
  MESSAGE("off by up to ", worst, "; in float by ", worst_float, " of the terms' sum");
}

TEST_CASE("terms of many angles are left out where facets are nearly round, and nowhere else") {
  constexpr ShapeOrder order{24};
  using Basis = ShapeBasis<float>;
  CHECK(Basis({0, 0}, order).count == Basis::terms(order, 1));
  CHECK(Basis({0.2f, 0}, order).count == Basis::terms(order, 1));
  CHECK(Basis({0, 0.45f}, order).count == Basis::terms(order, 2));
  CHECK(Basis({0.9f, 0}, order).count == Basis::terms(order));
}
