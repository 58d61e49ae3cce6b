// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// How often something is to happen along a ray, cell by cell over a box: where a volume is thin or
/// dark, a ray crosses it in few steps.

#include <vector>

#include "renderer/shape.h"

namespace mms::renderer {

/// The `i`-th of cells^3 parts of a box, x fastest.
Bounds cell_of(const Bounds& box, int cells, int i);

class RateGrid {
 public:
  RateGrid() = default;
  /// `values`: cells^3 of them, 1/m, not negative, as `cell_of` counts.
  RateGrid(const Bounds& box, int cells, std::vector<float> values);

  bool empty() const { return values_.empty(); }
  float largest() const;              ///< 0 of a grid without cells
  Bounds support(float least) const;  ///< around the cells of at least that
  /// In the cell of `p`, or in the nearest one.
  float at(Vec3d p) const;

  struct Event {
    double t;    ///< distance along the ray; infinite where it gets to `to` before
    float rate;  ///< 1/m, there
  };
  /// Where the integral of the rate along `o + t d` (`d` of unit length) from `from` on reaches
  /// `depth`, cell after cell.
  Event next(Vec3d o, Vec3d d, double from, double to, double depth) const;

 private:
  std::array<int, 3> cell_of(Vec3d p) const;
  float value(const std::array<int, 3>& cell) const {
    return values_[std::size_t((cell[2] * cells_ + cell[1]) * cells_ + cell[0])];
  }

  Bounds box_;
  Vec3d cell_;  ///< its size
  int cells_ = 0;
  std::vector<float> values_;
};

}  // namespace mms::renderer
