// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Choice of one light among thousands in a few steps, by what each is likely to send to a point: a
/// binary tree over boxes of lights (after Conty Estevez and Kulla 2018), each node knowing how
/// much light leaves it and into which cone.

#include <vector>

#include "renderer/shape.h"

namespace mms::renderer {

/// What a tree knows of a light.
struct LightExtent {
  Bounds box;
  double power = 0;  ///< radiance times the area seen from before it; above 0
  Vec3d facing;      ///< unit normal of a flat light, which shines before it only; else zero
};

class LightTree {
 public:
  LightTree() = default;
  /// Lights are numbered as in `lights`; there is at least one.
  explicit LightTree(const std::vector<LightExtent>& lights);

  struct Drawn {
    int light = 0;
    double probability = 0;
    double rest = 0;  ///< what is left of the random number, in [0, 1)
  };
  /// Draws a light by its importance at `from`, descending from the root.
  Drawn sample(Vec3d from, double u) const;
  /// Probability that `sample` draws `light` at `from`; may be 0.
  double probability(int light, Vec3d from) const;
  /// What all lights send to `from`, roughly: power over squared distance, times a cosine.
  double importance(Vec3d from) const { return importance(nodes_[0], from); }

 private:
  /// Directions within `spread` of `axis`; all of them where `spread` is pi.
  struct Cone {
    Vec3d axis;
    double spread = 0;  ///< radians
  };
  struct Node {
    Bounds box;
    double radius = 0, power = 0;  ///< of the box; of all lights in it
    Cone cone;
    int left = -1, right = -1;  ///< of a leaf: none, and its light
    int parent = -1;
  };
  static Cone joined(const Cone& a, const Cone& b);
  static double importance(const Node& n, Vec3d from);
  /// Probability of the left child.
  double left_share(const Node& n, Vec3d from) const;
  int build(const std::vector<LightExtent>& lights, int* first, int* last);

  std::vector<Node> nodes_;   ///< the root first
  std::vector<int> leaf_of_;  ///< light to node
};

}  // namespace mms::renderer
