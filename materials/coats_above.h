// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What lies above the nodes of a layout: which coat is right above a node, of what lobes it is,
/// and what it does to light along one direction. materials/combine.h says what follows from that.

#include <algorithm>
#include <array>
#include <bitset>
#include <optional>

#include "materials/coated.h"
#include "materials/fresnel.h"
#include "materials/glass_coat.h"
#include "materials/layout.h"
#include "materials/lobe.h"
#include "materials/microfacet.h"
#include "materials/rough_coat.h"
#include "materials/two_coats.h"

namespace mms::materials {

/// What is known of a coat's own lobes. Of a mirror, and of what is not, all is as if polished.
template <class R>
struct CoatKind {
  CoatLobe<R> lobe{};  ///< where there is one
  int mixture = -1;    ///< where there are several, the node that they are the children of
  bool round = false;  ///< known, and not stretched; of several, also the same at each wavelength
  bool polished = false;  ///< nothing but mirrors

  bool known() const { return lobe.known() || mixture >= 0; }
};

/// The coat right above a node, where light is seen along one direction.
template <class R>
struct CoatAbove {
  const R* ior = nullptr;  ///< its indices; null: there is none
  CoatKind<R> kind{};
  bool nested = false;       ///< there is a second coat right above that one
  int lower = -1;            ///< then the node of which materials/two_coats.h knows it
  int base = -1;             ///< the node right below it
  const R* layer = nullptr;  ///< the numbers of its `coat`, if it is one
  bool passed_once = false;  ///< by what changes sides at this lobe (materials/glass_coat.h)
  bool over_glass = false;   ///< such lobes are all or a part of what lies below
  CoatAlong<R> o{};
  Spectrum<R> left_o{}, through_o{};  ///< what is left of light by this coat, and by all that count
  Spectrum<R> mirrored{};             ///< over glass: what the coat reflects

  /// Whether all that lies above is known to a lobe that is not stretched.
  bool solvable() const { return nested ? lower >= 0 : kind.round || !kind.known(); }
};

/// One entry for each node of a layout; entries beyond it are not initialised.
template <class T>
union PerNode {
  PerNode() {}
  std::array<T, kMaxNodes> of;
};

/// The same of what takes long to solve for: kept where the next time asks for no other.
template <class T>
struct SolvedPerNode {
  PerNode<T> solution;
  std::bitset<kMaxNodes> made;

  template <class... Asked>
  void solve(int node, const Asked&... asked) {
    if (made[node] && solution.of[node].solves(asked...)) return;
    solution.of[node].solve(asked...);
    made.set(node);
  }
  const T& operator[](int node) const { return solution.of[node]; }
};

namespace detail {

/// What a layer lets through along a direction of |cosine| `c` outside: exp(-depth / cosine
/// inside).
template <class R>
inline R layer_transmittance(R depth, R ior, R c) {
  if (!(depth > 0)) return 1;
  const R eta = relative_eta(ior, Vec3<R>{0, 0, 1});
  const R inside2 = refraction_g2(limited(c, R(0), R(1)), eta) / (eta * eta);
  return inside2 > 0 ? std::exp(-depth / std::sqrt(inside2)) : R(0);
}

/// The same for wavelength j of a coat whose numbers are at `p`.
template <class R>
inline R layer_transmittance(const R* p, int j, R c) {
  const R depth = std::min(non_negative(p[0]) * non_negative(p[1 + j]), R(1e6));
  return layer_transmittance(depth, p[1 + kWavelengths + j], c);
}

/// The weights of the children of a `mix`, `scale` or `add`, whose factors are numbers; whether the
/// node is one.
template <class R, class Weight>
inline bool weigh_by_numbers(const Layout::Node& node, const R* p, int i, Weight* w) {
  const int a = node.children[0], b = node.children[1];
  switch (node.lobe) {
    case Lobe::Mix: {
      Spectrum<R> second;
      for (int j = 0; j < kWavelengths; ++j) second[j] = limited(p[j], R(0), R(1));
      w[a] = w[i] * (Spectrum<R>(R(1)) - second);
      w[b] = w[i] * second;
      return true;
    }
    case Lobe::Scale:
      w[a] = w[i] * weight_at(p);
      return true;
    case Lobe::Add:
      w[a] = w[b] = w[i];
      return true;
    default:
      return false;
  }
}

/// Calls `visit(node, weight)` for what `node` is a sum of, its own weight being in `weights`.
template <class R, class Visit>
inline void for_each_part(const Layout& layout, const R* params, int node,
                          PerNode<Spectrum<R>>& weights, Visit visit) {
  const Layout::Node& n = layout.nodes()[node];
  if (!weigh_by_numbers(n, params + n.first_param, node, weights.of.data()))
    return visit(node, weights.of[node]);
  for (int c = 0; c < n.child_count; ++c)
    for_each_part(layout, params, n.children[c], weights, visit);
}

/// The lobe of a node if it is one whose spread is known; a mirror has no tables.
template <class R>
inline std::optional<CoatLobe<R>> coat_lobe(const Layout::Node& node, const R* p) {
  const auto facets = [](const auto& model) {
    return model.specular() ? CoatLobe<R>() : model.rough.coat();
  };
  switch (node.lobe) {
    case Lobe::Mirror:
      return CoatLobe<R>();
    case Lobe::Glossy: {
      const R gloss = non_negative(p[kWavelengths]);
      return gloss <= R(axes::kLargestGloss) ? CoatLobe<R>::glossy(gloss) : CoatLobe<R>();
    }
    case Lobe::Microfacet:
      return facets(Microfacet<R>(p));
    case Lobe::Beckmann:
      return facets(BeckmannMirror<R>(p));
    default:
      return {};
  }
}

/// Calls `visit(lobe, weight)` for what a coat, the child `node`, is a sum of, the colours being in
/// the weights; whether all of it is known. `weights` holds that of `node`.
template <class R, class Visit>
inline bool for_each_coat_lobe(const Layout& layout, const R* params, int node,
                               PerNode<Spectrum<R>>& weights, Visit visit) {
  const Layout::Node& n = layout.nodes()[node];
  const R* p = params + n.first_param;
  if (weigh_by_numbers(n, p, node, weights.of.data())) {
    for (int c = 0; c < n.child_count; ++c)
      if (!for_each_coat_lobe(layout, params, n.children[c], weights, visit)) return false;
    return true;
  }
  const auto lobe = coat_lobe(n, p);
  if (lobe)
    visit(*lobe, Spectrum<R>::map([](R x) { return limited(x, R(0), R(1e18)); },
                                  weights.of[node] * weight_at(p)));
  return lobe.has_value();
}

/// Of the coat that is the child `node`.
template <class R>
inline CoatKind<R> coat_kind(const Layout& layout, const R* params, int node) {
  CoatLobe<R> last;
  int count = 0;
  R sum = 0;
  bool rough = false, stretched = false, uneven = false;
  PerNode<Spectrum<R>> weights;
  weights.of[node] = Spectrum<R>(R(1));
  const bool known =
      for_each_coat_lobe(layout, params, node, weights, [&](const auto& lobe, const auto& weight) {
        last = lobe;
        ++count;
        rough |= lobe.known();
        stretched |= lobe.stretched();
        uneven |= std::count(weight.v.begin(), weight.v.end(), weight[0]) != kWavelengths;
        sum += weight[0];
      });
  if (!known || !rough) return {{}, -1, false, known};
  if (count == 1) return {last, -1, !stretched};
  return {{}, node, !stretched && !uneven && sum > 0 && count <= CoatParts<R>::kMost};
}

/// Whether materials/two_coats.h knows of a coat of that kind under another.
template <class R>
inline bool knows_lower(const CoatAbove<R>& above, const CoatKind<R>& kind) {
  return above.ior && !above.nested && above.solvable() &&
         (!kind.known() || (kind.round && kind.mixture < 0));
}

/// What a coat does along `w`: that of several lobes the mean of what they would, by their weights.
template <class R>
inline CoatAlong<R> coat_along(const Layout& layout, const R* params, const R* ior,
                               const CoatKind<R>& kind, Vec3<R> w) {
  if (kind.mixture < 0) return {ior, kind.lobe, w};
  CoatAlong<R> all;
  Spectrum<R> sum;
  PerNode<Spectrum<R>> weights;
  weights.of[kind.mixture] = Spectrum<R>(R(1));
  for_each_coat_lobe(layout, params, kind.mixture, weights,
                     [&](const CoatLobe<R>& lobe, const Spectrum<R>& weight) {
                       const CoatAlong<R> one(ior, lobe, w);
                       all.reflected = one.reflected;
                       all.through += weight * one.through;
                       sum += weight;
                     });
  for (int j = 0; j < kWavelengths; ++j)
    all.through[j] = sum[j] > 0 ? all.through[j] / sum[j] : 1 - all.reflected[j];
  return all;
}

}  // namespace detail

template <class R>
inline CoatParts<R> coat_parts(const Layout& layout, const R* params, const CoatKind<R>& kind) {
  CoatParts<R> all;
  if (kind.mixture < 0) {
    all.parts[all.count++] = {kind.lobe, 1};
    return all;
  }
  R sum = 0;
  PerNode<Spectrum<R>> weights;
  weights.of[kind.mixture] = Spectrum<R>(R(1));
  detail::for_each_coat_lobe(layout, params, kind.mixture, weights,
                             [&](const auto& lobe, const auto& weight) {
                               all.parts[all.count++] = {lobe, weight[0]};
                               sum += weight[0];
                             });
  for (int k = 0; k < all.count; ++k) all.parts[k].share /= sum;
  return all;
}

/// `coat`, or another of a single lobe under it.
template <class R>
inline Coats<R> coats_above(const Layout& layout, const R* params, const CoatAbove<R>& coat,
                            const CoatLobe<R>& lower = {}, const R* lower_ior = nullptr) {
  Coats<R> coats{coat_parts(layout, params, coat.kind)};
  std::copy_n(coat.ior, kWavelengths, coats.above_ior.begin());
  coats.lower = lower;
  if (lower_ior) std::copy_n(lower_ior, kWavelengths, coats.lower_ior.begin());
  return coats;
}

/// The coats right above every node, where light is seen along `wo`.
template <class R>
inline void find_coats(const Layout& layout, const R* params, Vec3<R> wo,
                       PerNode<CoatAbove<R>>& coats, SolvedPerNode<LowerCoat<R>>& lower) {
  const auto nodes = layout.nodes();
  auto& above = coats.of;
  above[nodes.size() - 1] = {};
  for (int i = int(nodes.size()) - 1; i >= 0; --i) {
    const Layout::Node& node = nodes[i];
    const R* p = params + node.first_param;
    for (int c = 0; c < node.child_count; ++c) above[node.children[c]] = above[i];
    const int a = node.children[0], b = node.children[1];
    const auto coated = [&](int base, int coat, const R* ior, const R* layer) {
      if (std::all_of(ior, ior + kWavelengths, [](R n) { return n == 1; })) return;
      const CoatKind<R> kind = detail::coat_kind(layout, params, coat);
      CoatAbove<R>& below = above[base];
      below = {.ior = ior,
               .kind = kind,
               .nested = above[i].ior != nullptr,
               .base = base,
               .layer = layer,
               .o = detail::coat_along(layout, params, ior, kind, wo)};
      below.left_o = below.through_o = below.o.through;
      if (!detail::knows_lower(above[i], kind)) return;
      below.lower = base;
      lower.solve(base, coats_above(layout, params, above[i], kind.lobe, ior));
      const LowerCoat<R>& two = lower[base];
      below.left_o = two.along(below.o, std::abs(wo.z));
      for (int j = 0; j < kWavelengths; ++j)
        below.through_o[j] = below.left_o[j] * (two.known(j) ? above[i].o.through[j] : R(1));
    };
    if (node.lobe == Lobe::FresnelMix)
      coated(a, b, p, nullptr);
    else if (node.lobe == Lobe::Coat)
      coated(b, a, p + 1 + kWavelengths, p);
    else if (node.lobe == Lobe::Layer && nodes[a].lobe == Lobe::Sheen)
      above[b] = {};
  }
}

/// What the mirrors of a polished coat reflect along `wo`, and which lobes of what lies right below
/// get the weight of interfaces. `sent_back(lobe, ior)` is what materials/glass_coat.h says of a
/// lobe; none where it is no interface, or nothing is known of it. What is sent back has passed the
/// layer of the coat twice.
template <class R, class Ask>
inline void find_glass(const Layout& layout, const R* params, Vec3<R> wo, int base,
                       PerNode<CoatAbove<R>>& coats, const Ask& sent_back) {
  CoatAbove<R>& coat = coats.of[base];
  Spectrum<R> share, sent;
  PerNode<Spectrum<R>> weights;
  weights.of[base] = Spectrum<R>(R(1));
  detail::for_each_part(layout, params, base, weights, [&](int lobe, const Spectrum<R>& weight) {
    std::optional<SentBack<R>> back = sent_back(lobe, coat.ior);
    if (!back) return;
    coats.of[lobe].passed_once = coat.over_glass = true;
    for (int j = 0; coat.layer && j < kWavelengths; ++j) {
      const R through = detail::layer_transmittance(coat.layer, j, back->cosine[j]);
      back->share[j] *= through * through;
    }
    share += weight;
    sent += weight * back->share;
  });
  if (!coat.over_glass) return;
  coat.mirrored = coat.o.reflected;
  for (int j = 0; j < kWavelengths; ++j) {
    if (!(relative_eta(coat.ior[j], Vec3<R>{0, 0, 1}) > 1)) continue;
    if (wo.z < 0) coat.mirrored[j] *= std::max(1 - share[j], R(0));
    coat.mirrored[j] += sent[j];
  }
}

}  // namespace mms::materials
