// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Frames of parts of a material. `turn(a, angle)` turns the tangents that `a` sees: cosines are as
/// before. `tilt(a, u, v)` gives `a` a normal of its own, that of a height which rises by u along
/// the tangent and by v along the bitangent. As where a whole surface has bumps, light on different
/// sides of the two normals is lost, and the normal is held back where its own back would be seen;
/// so Lambert's lobe tilted by t keeps (1 + cos t) / 2. f is per cosine of the surface's normal:
/// that in the frame, times the cosine there over the one here. Hence it is not reciprocal.

#include <algorithm>
#include <bitset>
#include <cmath>

#include "base/vec.h"
#include "materials/layout.h"
#include "materials/lobe.h"

namespace mms::materials {

/// The unit normal `n` of bumps on a surface of normal `ng`, held back towards `ng` where it would
/// turn away from `view` or mirror it into the surface (Keller et al. 2017): m = n + s (ng - n)
/// with the least s in [0, 1] for which the mirrored view is high enough, near the horizon nearly
/// as high as the view itself, else about half a degree. That is where a quadratic in s is 0,
///   2 (m . view) (m . ng) - (m . m) (ng . view + least)
template <class R>
inline Vec3<R> held_back(Vec3<R> n, Vec3<R> ng, Vec3<R> view) {
  if (dot(ng, view) < 0) view = -view;
  const R height = dot(ng, view), most = height + std::min(R(0.9) * height, R(0.01));
  const R along = dot(n, view), up = dot(n, ng), c = 2 * along * up - most;
  if (along > 0 && c >= 0) return n;
  const Vec3<R> d = ng - n;
  const R d_along = dot(d, view), d_up = dot(d, ng);
  const R a = 2 * d_along * d_up - dot(d, d) * most;
  const R b = 2 * (along * d_up + d_along * up - dot(n, d) * most);
  const R root = std::sqrt(std::max(b * b - 4 * a * c, R(0)));
  const R s = b > 0 ? -2 * c / (b + root) : (root - b) / (2 * a);
  return normalize(n + d * (s >= 0 && s < 1 ? s : R(1)));
}

/// The frame of each node of a layout, where light is seen along one direction. Numbers that are
/// not finite turn and tilt nothing.
template <class R>
class Frames {
 public:
  void reset() { own_.reset(); }

  void find(const Layout& layout, const R* params, Vec3<R> wo) {
    reset();
    const auto nodes = layout.nodes();
    for (int i = int(nodes.size()) - 1; i >= 0; --i) {
      const Layout::Node& node = nodes[i];
      const R* p = params + node.first_param;
      const bool tilts = node.lobe == Lobe::Tilt;
      const bool turns = node.lobe == Lobe::Turn && p[0] != 0 && std::isfinite(p[0]);
      if (!own_[i] && !turns && !tilts) continue;
      NodeFrame frame = own_[i] ? frames_.of[i] : NodeFrame{};
      if (turns) frame.axes = within(frame.axes, turned(p[0]));
      if (tilts) frame = {within(frame.axes, tilted(p[0], p[1], frame.axes.to_local(wo))), i};
      for (int c = 0; c < node.child_count; ++c) {
        own_.set(node.children[c]);
        frames_.of[node.children[c]] = frame;
      }
    }
  }

  /// Whether a part has a frame of its own.
  bool any() const { return own_.any(); }
  /// `w` as node i sees it, and the other way round.
  Vec3<R> seen(int i, Vec3<R> w) const { return own_[i] ? frames_.of[i].axes.to_local(w) : w; }
  Vec3<R> unseen(int i, Vec3<R> w) const { return own_[i] ? frames_.of[i].axes.to_world(w) : w; }
  /// The `tilt` whose normal node i has, or -1.
  int tilt(int i) const { return own_[i] ? frames_.of[i].tilt : -1; }

  /// What f of node i is times the same in its frame; 0 where light would leak.
  R share(int i, Vec3<R> wo, Vec3<R> wi, Mode mode) const {
    if (tilt(i) < 0) return 1;
    if (!passes(i, wo) || !passes(i, wi)) return 0;  // wo: within rounding of the surface
    const Vec3<R> w = mode == Mode::Radiance ? wi : wo;
    return std::abs(seen(i, w).z / w.z);
  }

 private:
  struct NodeFrame {
    Frame<R> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    int tilt = -1;
  };

  /// What is seen in `frame` as `axes`.
  static Frame<R> within(const Frame<R>& frame, const Frame<R>& axes) {
    return {frame.to_world(axes.s), frame.to_world(axes.t), frame.to_world(axes.n)};
  }
  static Frame<R> turned(R angle) {
    const R c = std::cos(angle), s = std::sin(angle);
    return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
  }
  static Frame<R> tilted(R u, R v, Vec3<R> view) {
    const R l2 = u * u + v * v + 1;
    const Vec3<R> up{0, 0, 1};
    const Vec3<R> n =
        held_back(std::isfinite(l2) ? Vec3<R>{-u, -v, 1} / std::sqrt(l2) : up, up, view);
    // Frame::with_tangent of (1, 0, 0) without its difference, of which little is left where the
    // normal is nearly along it.
    const R across2 = n.y * n.y + n.z * n.z;
    if (!(across2 > R(1e-30))) return Frame<R>::around(n);
    const Vec3<R> s = Vec3<R>{across2, -n.x * n.y, -n.x * n.z} / std::sqrt(across2);
    return {s, cross(n, s), n};
  }

  /// Whether `w` is on one side of all normals from that of node i to the surface's.
  bool passes(int i, Vec3<R> w) const {
    for (; tilt(i) >= 0; i = tilt(i))
      if (const Vec3<R> in = seen(i, w); in_surface(in) || !same_side(in, w)) return false;
    return true;
  }

  std::bitset<kMaxNodes> own_;
  PerNode<NodeFrame> frames_;
};

}  // namespace mms::materials
