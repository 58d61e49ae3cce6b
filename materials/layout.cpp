// SPDX-License-Identifier: Apache-2.0
#include "materials/layout.h"

#include <cassert>

namespace mms::materials {
namespace {

/// The node, its parameters starting at `first`; false when it breaks its row of the table.
bool resolve(const vm::LayoutNode& from, int index, int first, Layout::Node& node) {
  if (from.lobe < 0 || from.lobe >= kLobeCount) return false;
  node.lobe = static_cast<Lobe>(from.lobe);
  node.first_param = first;
  std::size_t params = 0, children = 0;
  const Formals& f = formals(node.lobe);
  for (int i = 0; i < f.count; ++i) {
    if (f.kinds[i] == 'm') {
      ++children;
    } else {
      ++params;
      node.param_count += f.kinds[i] == 's' ? kWavelengths : 1;
    }
  }
  if (from.params.size() != params || from.children.size() != children) return false;
  for (std::uint32_t child : from.children) {
    if (child >= static_cast<std::uint32_t>(index)) return false;
    node.children[node.child_count++] = static_cast<std::int32_t>(child);
  }
  return true;
}

}  // namespace

Layout::Layout(const vm::MaterialLayout& material) {
  bool good = material.nodes.size() <= kMaxNodes;
  for (std::size_t i = 0; good && i < material.nodes.size(); ++i) {
    Node node;
    good = resolve(material.nodes[i], static_cast<int>(i), param_count_, node);
    param_count_ += node.param_count;
    nodes_.push_back(node);
  }
  assert(good);
  if (!good) {
    nodes_.clear();
    param_count_ = 0;
  }
  for (const Node& node : nodes_) {
    const unsigned t = traits(node.lobe);
    has_specular_ |= (t & (Specular | Polished)) != 0;
    has_smooth_ |= (t & (Specular | Combiner)) == 0;
    transmits_ |= (t & Transmits) != 0;
    reflects_ |= (t & Reflects) != 0;
    phase_ |= (t & PhaseFunction) != 0;
  }
}

}  // namespace mms::materials
