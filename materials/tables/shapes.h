// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// How tables over the shapes of stretched facets are made: values at some shapes become
/// polynomials. Nothing here is used when rendering.

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/warp.h"
#include "materials/energy.h"
#include "materials/tables/grid.h"

namespace mms::materials::tables {

/// Shapes that stretched facets are computed at, on rings of the disc, and what makes polynomials
/// of the values there: least squares.
class ShapeFit {
 public:
  explicit ShapeFit(ShapeOrder order) : terms_(ShapeBasis<double>::terms(order)) {
    const int rings = order.outwards() + 1;
    for (int ring = 1; ring <= rings; ++ring) {
      const int n = 5 + order.around * ring / rings;
      const double radius = std::sin(kPi<double> / 2 * ring / rings);
      for (int i = 0; i < n; ++i) {
        const double angle = kPi<double> * i / (n - 1);
        shapes_.push_back({radius * std::cos(angle), radius * std::sin(angle)});
      }
    }
    // The normal equations, with a column for each shape. A little is added to their diagonal:
    // there are polynomials that all but vanish over the disc, of which any multiple would do.
    const int columns = terms_ + count();
    std::vector<std::vector<double>> a(terms_, std::vector<double>(columns));
    for (int s = 0; s < count(); ++s) {
      const std::vector<double> value = values(ShapeBasis<double>(shapes_[s], order));
      for (int i = 0; i < terms_; ++i) {
        a[i][terms_ + s] = value[i];
        for (int j = 0; j < terms_; ++j) a[i][j] += value[i] * value[j];
      }
    }
    for (int i = 0; i < terms_; ++i) a[i][i] += 1e-5;
    solve(a);
    for (auto& row : a) inverse_.emplace_back(row.begin() + terms_, row.end());
  }

  int count() const { return int(shapes_.size()); }
  int terms() const { return terms_; }

  /// Facets that look so along the tangent (x, y), with z = 0, whose widths have the product 1.
  StretchedFacets<double> facets(int i, double widening = axes::kWidening) const {
    const auto [u, v] = shapes_[i];
    const double radius = std::hypot(u, v) * 9 / 11, aspect = (1 + radius) / (1 - radius);
    const double turn = std::atan2(v, u) / 2;  // from the narrower axis, widened
    const double wide = std::sqrt(aspect),
                 widened = Shape<double>::widened(std::hypot(u, v), widening);
    const Vec3d w = normalize(Vec3d{std::sin(turn) / widened, std::cos(turn), 0});
    return {wide, 1 / wide, w.x, w.y, 0};
  }

  /// The same, but along the tangent as wide as round ones of the width `like`.
  StretchedFacets<double> facets_like(int i, double like, double widening) const {
    StretchedFacets<double> seen = facets(i, widening);
    const double along = std::hypot(seen.wide * seen.x, seen.narrow * seen.y);
    const double root = like / (along + like * (1 - along));  // the inverse of like()
    seen.wide *= root, seen.narrow *= root;
    return seen;
  }

  /// The coefficient of a term, of values at all shapes.
  double term(int i, const double* values) const {
    double sum = 0;
    for (int s = 0; s < count(); ++s) sum += inverse_[i][s] * values[s];
    return sum;
  }

  /// Those of all terms; of terms that do not count, 0.
  std::vector<double> values(const ShapeBasis<double>& basis) const {
    std::vector<double> all, one(terms_);
    for (double& coefficient : one) {
      coefficient = 1;
      all.push_back(basis.sum(one.data()));
      coefficient = 0;
    }
    return all;
  }

 private:
  int terms_;
  std::vector<Shape<double>> shapes_;
  std::vector<std::vector<double>> inverse_;  // [term][shape]
};

}  // namespace mms::materials::tables
