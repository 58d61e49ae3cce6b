// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The static shape of one material: its tree of lobes and combiners, where each one's numbers
/// are in the flat array the renderer gathers for a lane, and what holds for the whole tree.
/// Made once for each descriptor; immutable after that and shared by every thread.
///
/// The flat array: for each node in the order of the tree (children first), for each
/// argument that is not a material in the order of the signature, one number for a `real` and
/// kWavelengths numbers for a `spectrum` (a constant is repeated).

#include <cstdint>
#include <span>
#include <vector>

#include "materials/nodes.h"
#include "materials/table.h"
#include "vm/program.h"

namespace mms::materials {

/// The numbers of a node, at most: `film_dielectric` has 43. Tests hold every row against it.
inline constexpr int kMostNumbers = 6 * kWavelengths;

class Layout {
 public:
  struct Node {
    Lobe lobe{};
    std::int32_t first_param = 0;  ///< index into the flat array
    std::int32_t param_count = 0;  ///< numbers, not arguments
    std::int32_t child_count = 0;
    std::int32_t children[2] = {0, 0};  ///< nodes, each before this one

    bool operator==(const Node&) const = default;
  };

  /// The empty layout: scatters nothing.
  Layout() = default;

  /// \pre `material` belongs to a verified program. A tree that breaks the order of children, the
  /// number of arguments of a row or kMaxNodes gives the empty layout (and an assertion).
  explicit Layout(const vm::MaterialLayout& material);

  std::span<const Node> nodes() const { return nodes_; }
  bool empty() const { return nodes_.empty(); }
  /// What is below the turns and scales of node `i`; of a lobe that is alike all around the normal
  /// turns change nothing.
  const Node& below_scales(int i) const {
    while (nodes_[i].lobe == Lobe::Turn || nodes_[i].lobe == Lobe::Scale) i = nodes_[i].children[0];
    return nodes_[i];
  }
  /// Numbers in the flat array.
  int param_count() const { return param_count_; }

  // What the lobes can do, whatever their numbers. An upper bound: a rough glass has_specular()
  // because its roughness may be 0 at a point.
  bool has_specular() const { return has_specular_; }  ///< may hold a delta
  bool has_smooth() const { return has_smooth_; }      ///< may hold something that is not a delta
  bool transmits() const { return transmits_; }
  bool reflects() const { return reflects_; }
  bool phase() const { return phase_; }  ///< holds a phase function: for `Phase`, not `Bsdf`

 private:
  std::vector<Node> nodes_;
  int param_count_ = 0;
  bool has_specular_ = false, has_smooth_ = false;
  bool transmits_ = false, reflects_ = false, phase_ = false;
};

}  // namespace mms::materials
