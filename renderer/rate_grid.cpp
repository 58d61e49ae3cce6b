// SPDX-License-Identifier: Apache-2.0
#include "renderer/rate_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mms::renderer {

Bounds cell_of(const Bounds& box, int cells, int i) {
  const Vec3d cell = (box.high - box.low) / double(cells);
  Bounds part;
  part.low = box.low +
             cell * Vec3d{double(i % cells), double(i / cells % cells), double(i / cells / cells)};
  part.high = part.low + cell;
  return part;
}

RateGrid::RateGrid(const Bounds& box, int cells, std::vector<float> values)
    : box_(box),
      cell_((box.high - box.low) / double(cells)),
      cells_(cells),
      values_(std::move(values)) {}

float RateGrid::largest() const {
  return values_.empty() ? 0 : *std::max_element(values_.begin(), values_.end());
}

Bounds RateGrid::support(float least) const {
  Bounds all;
  for (int i = 0; i < int(values_.size()); ++i) {
    if (values_[i] < least) continue;
    const Bounds cell = renderer::cell_of(box_, cells_, i);
    all.add(cell.low);
    all.add(cell.high);
  }
  return all;
}

std::array<int, 3> RateGrid::cell_of(Vec3d p) const {
  std::array<int, 3> cell{};
  for (int k = 0; k < 3; ++k) {
    const double x = cell_[k] > 0 ? (p[k] - box_.low[k]) / cell_[k] : 0;
    cell[k] = int(std::clamp(x, 0.0, double(cells_ - 1)));
  }
  return cell;
}

float RateGrid::at(Vec3d p) const { return value(cell_of(p)); }

/// Amanatides and Woo 1987: from plane to plane, the nearest of three next.
RateGrid::Event RateGrid::next(Vec3d o, Vec3d d, double from, double to, double depth) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<int, 3> cell = cell_of(o + d * from);
  const auto plane = [&](int k) {  // where the ray leaves its cell along one axis
    if (d[k] == 0 || cell[k] < 0 || cell[k] >= cells_) return kInfinity;
    return (box_.low[k] + cell_[k] * (cell[k] + (d[k] > 0 ? 1 : 0)) - o[k]) / d[k];
  };
  double planes[3] = {plane(0), plane(1), plane(2)};
  for (double t = from;;) {
    const int axis = int(std::min_element(planes, planes + 3) - planes);
    const double end = std::clamp(planes[axis], t, to);  // rounding may put the plane behind
    const float rate = value(cell);
    const double over = double(rate) * (end - t);
    if (over > depth) return {std::min(t + depth / rate, end), rate};
    if (!(end < to)) return {kInfinity, 0};
    depth -= over;
    t = end;
    const int step = d[axis] > 0 ? 1 : -1;
    if (cell[axis] + step < 0 || cell[axis] + step >= cells_) {
      planes[axis] = kInfinity;  // beyond the box as in its last cell
    } else {
      cell[axis] += step;
      planes[axis] = plane(axis);
    }
  }
}

}  // namespace mms::renderer
