// SPDX-License-Identifier: Apache-2.0
#include "renderer/light_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/warp.h"

namespace mms::renderer {
namespace {

constexpr double kHalfTurn = kPi<double>;

double angle(Vec3d a, Vec3d b) { return std::acos(std::clamp(dot(a, b), -1.0, 1.0)); }

}  // namespace

LightTree::LightTree(const std::vector<LightExtent>& lights) : leaf_of_(lights.size()) {
  std::vector<int> order(lights.size());
  std::iota(order.begin(), order.end(), 0);
  nodes_.reserve(2 * lights.size());
  build(lights, order.data(), order.data() + order.size());
}

/// Halves the lights at the median along the longest side of their centres' box.
int LightTree::build(const std::vector<LightExtent>& lights, int* first, int* last) {
  const int index = int(nodes_.size());
  nodes_.emplace_back();
  Node node;
  if (last - first == 1) {
    const LightExtent& l = lights[std::size_t(*first)];
    const bool flat = dot(l.facing, l.facing) > 0;
    node.box = l.box;
    node.power = l.power;
    node.cone = flat ? Cone{l.facing, 0} : Cone{{0, 1, 0}, kHalfTurn};
    node.right = *first;
    leaf_of_[std::size_t(*first)] = index;
  } else {
    Bounds centres;
    for (const int* i = first; i != last; ++i) centres.add(lights[std::size_t(*i)].box.centre());
    const Vec3d size = centres.high - centres.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    int* middle = first + (last - first) / 2;
    std::nth_element(first, middle, last, [&](int a, int b) {
      return std::pair(lights[std::size_t(a)].box.centre()[axis], a) <
             std::pair(lights[std::size_t(b)].box.centre()[axis], b);
    });
    node.left = build(lights, first, middle);
    node.right = build(lights, middle, last);
    Node& left = nodes_[std::size_t(node.left)];
    Node& right = nodes_[std::size_t(node.right)];
    left.parent = right.parent = index;
    node.box = left.box;
    node.box.add(right.box);
    node.power = left.power + right.power;
    node.cone = joined(left.cone, right.cone);
  }
  node.radius = node.box.radius();
  nodes_[std::size_t(index)] = node;
  return index;
}

/// A cone around both, its axis between theirs: the smallest where both are equally wide.
LightTree::Cone LightTree::joined(const Cone& a, const Cone& b) {
  const Vec3d sum = a.axis + b.axis;
  if (!(length(sum) > 1e-6)) return {a.axis, kHalfTurn};
  Cone c{normalize(sum), 0};
  c.spread = std::min(kHalfTurn,
                      std::max(angle(c.axis, a.axis) + a.spread, angle(c.axis, b.axis) + b.spread));
  return c;
}

/// Power over squared distance times the largest cosine that any of the lights may show `from`; 0
/// only where all face away. The distance of many is the geometric mean of the nearest there may
/// be and of the middle's: by the middle's alone, a few lights close by would drown among the many
/// of their box, and the chance to draw them come out a tenth of what it should be.
double LightTree::importance(const Node& n, Vec3d from) {
  const Vec3d to = from - n.box.centre();
  const double d2 = dot(to, to), r2 = n.radius * n.radius;
  const double middle = std::max({d2, r2, 1e-12});
  double nearest = middle;
  if (n.left >= 0) {
    const Vec3d low = n.box.low - from, high = from - n.box.high;
    const Vec3d gap{std::max({low.x, high.x, 0.0}), std::max({low.y, high.y, 0.0}),
                    std::max({low.z, high.z, 0.0})};
    nearest = std::max(dot(gap, gap), 1e-3 * middle);
  }
  const double power = n.power / std::sqrt(nearest * middle);
  if (d2 <= r2 || n.cone.spread >= kHalfTurn) return power;
  const double d = std::sqrt(d2);
  const double blur = std::asin(n.radius / d);  // half the angle that the node fills
  const double off = angle(n.cone.axis, to / d) - n.cone.spread - blur;
  return off <= 0 ? power : power * std::max(0.0, std::cos(off));
}

double LightTree::left_share(const Node& n, Vec3d from) const {
  const double left = importance(nodes_[std::size_t(n.left)], from);
  const double right = importance(nodes_[std::size_t(n.right)], from);
  return left + right > 0 ? left / (left + right) : 0.5;
}

LightTree::Drawn LightTree::sample(Vec3d from, double u) const {
  Drawn d{0, 1, u};
  const Node* n = &nodes_[0];
  while (n->left >= 0) {
    const double share = left_share(*n, from);
    const bool left = d.rest < share;
    const double p = left ? share : 1 - share;
    d.rest = std::clamp((left ? d.rest : d.rest - share) / p, 0.0, 1 - 0x1p-53);
    d.probability *= p;
    n = &nodes_[std::size_t(left ? n->left : n->right)];
  }
  d.light = n->right;
  return d;
}

double LightTree::probability(int light, Vec3d from) const {
  double p = 1;
  int child = leaf_of_[std::size_t(light)];
  for (int at = nodes_[std::size_t(child)].parent; at >= 0 && p > 0;
       child = at, at = nodes_[std::size_t(at)].parent) {
    const Node& n = nodes_[std::size_t(at)];
    const double share = left_share(n, from);
    p *= child == n.left ? share : 1 - share;
  }
  return p;
}

}  // namespace mms::renderer
