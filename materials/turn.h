// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// How `turn(material a, real angle)` turns the tangents of what is below it: lobes see directions
/// in frames of their own. Cosines are as before, so nothing else knows of it.

#include <bitset>
#include <cmath>

#include "base/vec.h"
#include "materials/coats_above.h"
#include "materials/layout.h"

namespace mms::materials {

/// The frame of each node of a layout. An angle that is not finite turns nothing.
template <class R>
class Turns {
 public:
  void reset() { turned_.reset(); }

  void find(const Layout& layout, const R* params) {
    reset();
    const auto nodes = layout.nodes();
    for (int i = int(nodes.size()) - 1; i >= 0; --i) {
      const Layout::Node& node = nodes[i];
      const R angle = node.lobe == Lobe::Turn ? params[node.first_param] : R(0);
      const bool turns = angle != 0 && std::isfinite(angle);
      if (!turned_[i] && !turns) continue;
      Frame frame = turned_[i] ? frames_.of[i] : Frame{};
      if (turns) frame = frame.turned({std::cos(angle), std::sin(angle)});
      for (int c = 0; c < node.child_count; ++c) {
        turned_.set(node.children[c]);
        frames_.of[node.children[c]] = frame;
      }
    }
  }

  bool any() const { return turned_.any(); }
  /// `w` as node i sees it, and the other way round.
  Vec3<R> seen(int i, Vec3<R> w) const {
    if (!turned_[i]) return w;
    const auto [c, s] = frames_.of[i];
    return {c * w.x + s * w.y, c * w.y - s * w.x, w.z};
  }
  Vec3<R> unseen(int i, Vec3<R> w) const {
    if (!turned_[i]) return w;
    const auto [c, s] = frames_.of[i];
    return {c * w.x - s * w.y, c * w.y + s * w.x, w.z};
  }

 private:
  /// Cosine and sine of how much it is turned.
  struct Frame {
    R c = 1, s = 0;
    Frame turned(const Frame& more) const {
      return {c * more.c - s * more.s, s * more.c + c * more.s};
    }
  };

  std::bitset<kMaxNodes> turned_;
  PerNode<Frame> frames_;
};

}  // namespace mms::materials
