// SPDX-License-Identifier: Apache-2.0
#include "lang/conservation.h"

#include <algorithm>
#include <optional>

namespace mms::lang {

std::optional<double> known_number(const Module& module, Ref r) {
  const std::deque<IrFunction>& functions = module.functions;
  const Node* n = &functions[r.function].nodes[r.node];
  if (n->op == vm::Op::Splat) n = &functions[n->args[0].function].nodes[n->args[0].node];
  if (n->known < 0) return std::nullopt;
  const vm::Constant& c = module.constants[static_cast<std::size_t>(n->known)];
  return c.type == vm::SlotType::Real ? c.f64 : c.integer;
}

namespace {

/// `material NAME`.
std::string_view head(const MaterialTree& m) {
  return m.row->signature.substr(0, m.row->signature.find('('));
}

/// The least of the colours of a model that is no combiner, unknown ones being 0; 0 without any.
double least_colour(const Module& module, const MaterialTree& m) {
  std::optional<double> least;
  std::string_view rest = m.row->signature.substr(head(m).size());
  for (std::size_t k = 0; !rest.empty(); ++k) {
    const std::string_view item = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), item.size() + 1));
    if (!vm::is_colour(item)) continue;
    const double colour = std::max(known_number(module, m.params[k]).value_or(0), 0.0);
    least = std::min(least.value_or(colour), colour);
  }
  return least.value_or(0);
}

}  // namespace

double stated_weight(const Module& module, const MaterialTree& m) {
  const std::string_view row = head(m);
  const double first = m.params.empty() ? -1 : known_number(module, m.params[0]).value_or(-1);
  const double weight = std::clamp(first, 0.0, 1.0);  // of a factor; unknown: 0
  const auto part = [&](std::size_t k) { return stated_weight(module, *m.children[k]); };
  if (row == "material add") return part(0) + part(1);
  if (row == "material turn" || row == "material tilt") return part(0);
  if (row == "material scale") return weight * part(0);
  if (row == "material mix" && first >= 0) return (1 - weight) * part(0) + weight * part(1);
  if (m.children.size() == 2) return std::min(part(0), part(1));
  return least_colour(module, m);
}

std::optional<double> inverted_coat_index(const Module& module, const MaterialTree& m) {
  const std::string_view row = head(m);
  const bool coat = row == "material coat";
  const bool mix = row == "material fresnel_mix" || row == "material film_mix";
  const std::size_t base = coat ? 1 : mix ? 0 : m.children.size();
  if (coat || mix)
    if (const auto index = known_number(module, m.params[coat ? 2 : 0]); index && *index < 1)
      return index;
  for (std::size_t k = 0; k < m.children.size(); ++k)
    if (k != base)
      if (const auto index = inverted_coat_index(module, *m.children[k])) return index;
  return std::nullopt;
}

MaterialPtr sole_part(const Module& module, const MaterialTree& m) {
  const auto is = [&](std::size_t k, double x) {
    return known_number(module, m.params[k]).value_or(-1) == x;
  };
  const std::string_view row = head(m);
  if (row == "material mix") return is(0, 0) ? m.children[0] : is(0, 1) ? m.children[1] : nullptr;
  if (row == "material scale") return is(0, 1) ? m.children[0] : nullptr;
  if (row == "material turn") return is(0, 0) ? m.children[0] : nullptr;
  if (row == "material tilt") return is(0, 0) && is(1, 0) ? m.children[0] : nullptr;
  if (row == "material fresnel_mix") return is(0, 1) ? m.children[0] : nullptr;
  if (row == "material layer") return is(0, 0) ? m.children[1] : nullptr;
  if (row == "material coat") return is(2, 1) && (is(0, 0) || is(1, 0)) ? m.children[1] : nullptr;
  return nullptr;
}

}  // namespace mms::lang
