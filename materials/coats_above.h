// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What lies above the nodes of a layout: which coat is right above a node, of what lobes it is,
/// and what it does to light along one direction. materials/combine.h says what follows from that.

#include <algorithm>
#include <array>
#include <bitset>
#include <new>
#include <optional>

#include "materials/coat.h"
#include "materials/coated.h"
#include "materials/conductor.h"
#include "materials/film.h"
#include "materials/frames.h"
#include "materials/fresnel.h"
#include "materials/glass_coat.h"
#include "materials/glossy.h"
#include "materials/layout.h"
#include "materials/lobe.h"
#include "materials/microfacet.h"
#include "materials/under_coats.h"

namespace mms::materials {

/// What is known of a coat's own lobes.
template <class R>
struct CoatKind {
  bool known = false;          ///< how each spreads light, and one is no mirror
  bool polished = false;       ///< all are mirrors
  Spectrum<R> held{}, even{};  ///< as in materials/coat.h; of what is not known, 0
  Spectrum<R> colour{R(1)};    ///< of all lobes together, at most 1; of what is not known, 1

  /// How broad the coat is; what is not known counts as broad.
  R broad(int j) const { return known || polished ? held[j] + even[j] : R(1); }
};

/// What lies above a node. A coat is known by the node right below it.
struct NodeAbove {
  int base = -1;        ///< the coat right above; -1: there is none
  int once_base = -1;   ///< the same where what changes sides passes it once (glass_coat.h)
  int part_of = -1;     ///< the coat of whose known lobes this node is one, or some
  bool tilted = false;  ///< its normal is not that of all these coats

  bool coated() const { return base >= 0; }
  /// Whether a coat lies above it, or it is a part of one.
  bool any() const { return coated() || part_of >= 0; }
  /// A node that sees the normal of these coats. \pre any()
  int upright() const { return part_of >= 0 ? part_of : base; }
};

/// What the numbers of a coat are made of.
template <class R>
struct CoatGiven {
  Spectrum<R> ior;
  Films<R> films;
  Spectrum<R> held, even, least;

  bool operator==(const CoatGiven&) const = default;
};

/// What of a coat is alike along all directions.
template <class R>
class SolvedCoat {
 public:
  void solve(const CoatGiven<R>& given) {
    given_ = given;
    numbers_ = {given.ior.v.data(), given.films, given.held, given.even, given.least};
    mean_through_.reset();
  }
  bool solves(const CoatGiven<R>& given) const { return given == given_; }

  const CoatNumbers<R>& numbers() const { return numbers_; }
  /// The mean over the hemisphere of what it lets through, where nothing is above it. \pre no film
  const Spectrum<R>& mean_through() {
    if (!mean_through_) {
      mean_through_.emplace();
      for (int j = 0; j < kWavelengths; ++j)
        (*mean_through_)[j] =
            numbers_.repeated(j) ? (*mean_through_)[j - 1] : 1 - numbers_.mean_reflected(j);
    }
    return *mean_through_;
  }

 private:
  CoatGiven<R> given_;
  CoatNumbers<R> numbers_;
  std::optional<Spectrum<R>> mean_through_;
};

/// A coat.
template <class R>
struct CoatAbove {
  CoatKind<R> kind{};
  int upper = -1;           ///< the coat right above this one, if there is one
  bool over_glass = false;  ///< what passes it once is all or a part of what lies right below
  Spectrum<R> glass{};      ///< their share, with those below further coats that count together
  /// Whether at wavelength j it counts together with those above.
  std::array<bool, kWavelengths> nested{};
  /// The mean over the hemisphere of `through_o`, where Lambert lobes lie right below.
  Spectrum<R> mean{};

  // Along a direction (see_coats).
  const R* layer = nullptr;  ///< the numbers of its `coat`, if it is one
  CoatAlong<R> o{};
  Spectrum<R> through_o{};  ///< what is left of light by all coats that count together
};

/// The same of what takes long to solve for: kept where the next time asks for no other.
template <class T>
struct SolvedPerNode {
  PerNode<T> solution;
  std::bitset<kMaxNodes> made;

  SolvedPerNode() {}  // or `solution` would be zeroed where a choice is, which takes long

  template <class... Asked>
  T& solve(int node, const Asked&... asked) {
    T& its = solution.of[node];
    if (!made[node]) ::new (&its) T;  // not zeroed
    if (!made[node] || !its.solves(asked...)) its.solve(asked...);
    made.set(node);
    return its;
  }
  const T& operator[](int node) const { return solution.of[node]; }
  T& operator[](int node) { return solution.of[node]; }
};

/// All coats of a layout.
template <class R>
struct CoatTree {
  PerNode<NodeAbove> above;
  PerNode<CoatAbove<R>> coats;
  SolvedPerNode<SolvedCoat<R>> solved;

  /// Whether a coat lies right above that node.
  bool starts_at(int node) const { return above.of[node].base == node; }
  const CoatAbove<R>& operator[](int base) const { return coats.of[base]; }
  CoatAbove<R>& operator[](int base) { return coats.of[base]; }
  const CoatNumbers<R>& numbers(int base) const { return solved[base].numbers(); }
  /// |Cosine| of light that meets a node, from that outside all coats.
  R cosine_inside(int node, int j, R z) const {
    const int base = above.of[node].base;
    return base >= 0 ? numbers(base).cosine_inside(j, z) : z;
  }
};

namespace detail {

/// What the layer of a `coat`, whose numbers are at `p`, lets through at wavelength j, where the
/// |cosine| inside is `inside`: exp(-depth / cosine).
template <class R>
inline R layer_transmittance(const R* p, int j, R inside) {
  const R depth = std::min(non_negative(p[0]) * non_negative(p[1 + j]), R(1e6));
  if (!(depth > 0)) return 1;
  return inside > 0 ? std::exp(-depth / inside) : R(0);
}

/// The films of a `film_mix`, whose numbers behind its indices are at `p`.
template <class R>
inline Films<R> films(const R* p) {
  Films<R> films;
  for (int j = 0; j < kWavelengths; ++j)
    films[j] = {std::max(R(1), p[j]), p[kWavelengths], p[kWavelengths + 1 + j]};
  return films;
}

/// The weights of the children of a `mix`, `scale`, `add` or `turn`, whose factors are numbers;
/// whether the node is one.
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
    case Lobe::Turn:
      w[a] = w[i];
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

/// Whether the lobe's colour is not its first numbers, but what its facets reflect.
inline bool is_metal(Lobe lobe) {
  return lobe == Lobe::Conductor || lobe == Lobe::ColouredMetal || lobe == Lobe::FilmConductor;
}

/// Of a node's lobe, if it is one whose spread is known.
template <class R>
inline std::optional<Broadness<R>> lobe_broadness(const Layout::Node& node, const R* p) {
  const auto of = [](const auto& model) {
    return model.specular() ? Broadness<R>{} : model.coated({0, 0, 1}).broad();
  };
  switch (node.lobe) {
    case Lobe::Mirror:
      return Broadness<R>{};
    case Lobe::Conductor:
      return of(Conductor<R>(p));
    case Lobe::ColouredMetal:
      return of(ColouredMetal<R>(p));
    case Lobe::FilmConductor:
      return of(FilmConductor<R>(p));
    case Lobe::Glossy:
      return of(Glossy<R>(p));
    case Lobe::GlossyProduct:
      return of(GlossyProduct<R>(p));
    case Lobe::GlossyBack:
      return of(GlossyBack<R>(p));
    case Lobe::Microfacet:
      return of(Microfacet<R>(p));
    case Lobe::Beckmann:
      return of(BeckmannMirror<R>(p));
    default:
      return {};
  }
}

/// Calls `visit(broadness, weight)` for what a coat, the child `node`, is a sum of, the colours of
/// all but metals being in the weights; whether all of it is known. `weights` holds that of `node`.
template <class R, class Visit>
inline bool for_each_coat_lobe(const Layout& layout, const R* params, int node,
                               PerNode<Spectrum<R>>& weights, Visit visit) {
  const Layout::Node& n = layout.nodes()[node];
  const R* p = params + n.first_param;
  if (n.lobe == Lobe::Tilt) weights.of[n.children[0]] = weights.of[node];
  if (n.lobe == Lobe::Tilt || weigh_by_numbers(n, p, node, weights.of.data())) {
    for (int c = 0; c < n.child_count; ++c)
      if (!for_each_coat_lobe(layout, params, n.children[c], weights, visit)) return false;
    return true;
  }
  const auto broad = lobe_broadness(n, p);
  if (broad)
    visit(*broad, Spectrum<R>::map(
                      [](R x) { return limited(x, R(0), R(1e18)); },
                      weights.of[node] * (is_metal(n.lobe) ? Spectrum<R>(R(1)) : weight_at(p))));
  return broad.has_value();
}

/// Of the coat that is the child `node`.
template <class R>
inline CoatKind<R> coat_kind(const Layout& layout, const R* params, int node) {
  CoatKind<R> kind;
  Spectrum<R> sum;
  PerNode<Spectrum<R>> weights;
  weights.of[node] = Spectrum<R>(R(1));
  bool rough = false;
  const bool known = for_each_coat_lobe(layout, params, node, weights,
                                        [&](const Broadness<R>& broad, const Spectrum<R>& weight) {
                                          rough |= !broad.mirror();
                                          kind.held += weight * broad.held;
                                          kind.even += weight * broad.even;
                                          sum += weight;
                                        });
  kind.known = known && rough;
  kind.polished = known && !rough;
  for (int j = 0; j < kWavelengths; ++j) {
    const bool any = kind.known && sum[j] > 0;
    if (known) kind.colour[j] = std::min(sum[j], R(1));
    kind.held[j] = any ? kind.held[j] / sum[j] : R(0);
    kind.even[j] = any ? kind.even[j] / sum[j] : R(0);
  }
  return kind;
}

}  // namespace detail

/// Calls `visit(base)` for a coat, or none, and those above that count together with it at
/// wavelength j, the nearest first.
template <class R, class Visit>
inline void for_each_together(const CoatTree<R>& coats, int base, int j, Visit visit) {
  while (base >= 0) {
    visit(base);
    base = coats[base].nested[j] ? coats[base].upper : -1;
  }
}

/// What they reflect and let through together, along a direction of |cosine| `z`.
template <class R>
inline FresnelSplit<R> split_together(const CoatTree<R>& coats, int base, int j, R z) {
  FresnelSplit<R> all{R(0), R(1)};
  for_each_together(coats, base, j, [&](int one) {
    const FresnelSplit<R> e = coats.numbers(one).split(j, z);
    all.reflected += all.transmitted * e.reflected;
    all.transmitted *= e.transmitted;
  });
  return all;
}

/// The base of a combiner that may be a coat, or -1.
inline int coat_base(const Layout::Node& node) {
  switch (node.lobe) {
    case Lobe::FresnelMix:
    case Lobe::FilmMix:
      return node.children[0];
    case Lobe::Coat:
      return node.children[1];
    default:
      return -1;
  }
}

/// Whether G of a lobe of a node with `above` is solved for: it is no table's.
template <class R>
inline bool is_solved_for(const CoatTree<R>& coats, const NodeAbove& above) {
  if (above.part_of >= 0) return above.coated() || coats.numbers(above.part_of).filmed();
  return above.coated() && (coats[above.base].upper >= 0 || coats.numbers(above.base).filmed());
}

/// The coats that G of a lobe depends on: those of its node, which has `above`, and what the lobe
/// itself, as broad as `broad`, is a part of.
template <class R>
inline Coats<R> coats_above(const CoatTree<R>& coats, const NodeAbove& above,
                            const Broadness<R>& broad = {}) {
  Coats<R> all;
  if (above.part_of >= 0) all.part = coats.numbers(above.part_of).as(broad);
  for (int at = above.base; at >= 0; at = coats[at].upper) all.add(coats.numbers(at));
  return all;
}

/// The coats of a material. What they were before, of any material, saves time where coats are the
/// same.
template <class R>
inline void find_coats(const Layout& layout, const R* params, CoatTree<R>& coats) {
  const auto nodes = layout.nodes();
  auto& above = coats.above.of;
  above[nodes.size() - 1] = {};
  for (int i = int(nodes.size()) - 1; i >= 0; --i) {
    const Layout::Node& node = nodes[i];
    const R* p = params + node.first_param;
    for (int c = 0; c < node.child_count; ++c) above[node.children[c]] = above[i];
    const int a = node.children[0], b = node.children[1];
    const auto coated = [&](int base, int lobes, const R* ior, const Films<R>& films) {
      if (std::all_of(ior, ior + kWavelengths, [](R n) { return n == 1; }) &&
          std::none_of(films.begin(), films.end(), [](const Film<R>& f) { return f.there(); }))
        return;
      // What coats send back to glass is not known where they are tilted against each other.
      const bool apart = above[i].tilted && layout.transmits();
      const int upper = apart ? -1 : above[i].base;
      above[base] = {.base = base, .tilted = above[i].tilted && !apart};
      CoatAbove<R>& coat =
          coats[base] = {.kind = detail::coat_kind(layout, params, lobes), .upper = upper};
      CoatGiven<R> given{{}, films, coat.kind.held, coat.kind.even, {}};
      std::copy_n(ior, kWavelengths, given.ior.v.begin());
      for (int j = 0; upper >= 0 && j < kWavelengths; ++j)
        if (const CoatNumbers<R>& over = coats.numbers(upper); over.eta[j] > 1)
          given.least[j] = over.least_below(j);
      const CoatNumbers<R>& numbers = coats.solved.solve(base, given).numbers();
      for (int j = 0; upper >= 0 && j < kWavelengths; ++j)
        coat.nested[j] = numbers.eta[j] > 1 && coats.numbers(upper).eta[j] > 1;
      if (coat.kind.known) above[lobes].part_of = base;
    };
    if (node.lobe == Lobe::FresnelMix)
      coated(a, b, p, {});
    else if (node.lobe == Lobe::FilmMix)
      coated(a, b, p, detail::films(p + kWavelengths));
    else if (node.lobe == Lobe::Coat)
      coated(b, a, p + 1 + kWavelengths, {});
    else if (node.lobe == Lobe::Layer && layout.below_scales(a).lobe == Lobe::Sheen)
      above[b] = {};
    else if (node.lobe == Lobe::Tilt)
      above[a].tilted = true;
  }
}

/// What they do to light along `wo`.
template <class R>
inline void see_coats(const Layout& layout, const R* params, const Frames<R>& frames, Vec3<R> wo,
                      CoatTree<R>& coats) {
  const auto nodes = layout.nodes();
  for (int i = int(nodes.size()) - 1; i >= 0; --i) {
    const int base = coat_base(nodes[i]);
    if (base < 0 || !coats.starts_at(base)) continue;
    CoatAbove<R>& coat = coats[base];
    coat.layer = nodes[i].lobe == Lobe::Coat ? params + nodes[i].first_param : nullptr;
    coat.o = {coats.numbers(base), std::abs(frames.seen(i, wo).z)};
    coat.through_o = coat.o.through;
    for (int j = 0; j < kWavelengths; ++j)
      if (coat.nested[j]) coat.through_o[j] *= coats[coat.upper].through_o[j];
  }
}

/// What is sent back along a direction by the coats over glass, besides their E: as a mirror does,
/// and by a lobe of its own.
template <class R>
struct Sent {
  Spectrum<R> mirrored{}, spread{};
  Spectrum<R> all() const { return mirrored + spread; }
};

/// The coats right above what is glass, all or a part of it.
template <class R>
struct OverGlass {
  std::array<CoatOnGlass<R>, kWavelengths> law;
  Spectrum<R> colour{};  ///< what the coats leave of it
  Sent<R> o{};           ///< along wo
  Spectrum<R> mean{};    ///< of `spread` over the hemisphere of wo

  /// How much of `o` the mirror has.
  R mirror_share(int j) const {
    const R all = o.mirrored[j] + o.spread[j];
    return all > 0 ? o.mirrored[j] / all : R(0);
  }
};

/// The same as models are asked for it.
template <class R>
struct CoatsOnGlass {
  const CoatTree<R>& coats;
  int base;
  const std::array<CoatOnGlass<R>, kWavelengths>& law;

  FresnelSplit<R> split(int j, R z) const { return split_together(coats, base, j, z); }
  /// What their layers let through along a direction of |cosine| `z` outside.
  R layers(int j, R z) const {
    R through = 1;
    for_each_together(coats, base, j, [&](int one) {
      if (const R* layer = coats[one].layer)
        through *= detail::layer_transmittance(layer, j, coats.numbers(one).cosine_inside(j, z));
    });
    return through;
  }
};

namespace detail {

/// What they are at each wavelength.
template <class R>
inline std::array<CoatOnGlass<R>, kWavelengths> coats_on_glass(const CoatTree<R>& coats, int base) {
  // E and T at the points, and along the normal, of all that count together.
  std::array<std::array<FresnelSplit<R>, kGlassPoints + 1>, kWavelengths> all;
  for (auto& of_points : all) of_points.fill({R(0), R(1)});
  std::bitset<kWavelengths> together, repeated;
  together.set();
  repeated.set().reset(0);
  for (int one = base; one >= 0 && together.any(); one = coats[one].upper) {
    const CoatNumbers<R>& numbers = coats.numbers(one);
    for (int i = 0; i <= kGlassPoints; ++i) {
      CoatDirection<R> along(i < kGlassPoints ? R(chebyshev_points<kGlassPoints>()[i]) : R(1));
      FresnelSplit<R> e{};
      for (int j = 0; j < kWavelengths; ++j) {
        if (!numbers.repeated(j)) e = numbers.split(j, along);
        if (!together[j]) continue;
        all[j][i].reflected += all[j][i].transmitted * e.reflected;
        all[j][i].transmitted *= e.transmitted;
      }
    }
    for (int j = 1; j < kWavelengths; ++j)
      repeated[j] =
          repeated[j] && together[j] == together[j - 1] && (!together[j] || numbers.repeated(j));
    for (int j = 0; j < kWavelengths; ++j) together[j] = together[j] && coats[one].nested[j];
  }
  std::array<CoatOnGlass<R>, kWavelengths> law;
  for (int j = 0; j < kWavelengths; ++j) {
    if (coats.numbers(base).eta[j] > 1) {
      typename CoatOnGlass<R>::Points reflected, through;
      for (int i = 0; i < kGlassPoints; ++i)
        reflected[i] = all[j][i].reflected, through[i] = all[j][i].transmitted;
      law[j] = {reflected, through, all[j][kGlassPoints].transmitted};
    }
    law[j].repeated = repeated[j];
  }
  return law;
}

}  // namespace detail

/// Calls `visit(node, weight)` for what lies right below a coat, the child `base` of its combiner,
/// and is no coat of index 1.
template <class R, class Visit>
inline void for_each_below(const Layout& layout, const R* params, const CoatTree<R>& coats,
                           int base, Visit visit) {
  PerNode<Spectrum<R>> weights;
  weights.of[base] = Spectrum<R>(R(1));
  const auto part = [&](const auto& self, int node, const Spectrum<R>& weight) -> void {
    const int below = coat_base(layout.nodes()[node]);
    if (below < 0 || coats.starts_at(below)) return visit(node, weight);
    weights.of[below] = weight;
    detail::for_each_part(layout, params, below, weights,
                          [&](int n, const Spectrum<R>& w) { self(self, n, w); });
  };
  detail::for_each_part(layout, params, base, weights,
                        [&](int n, const Spectrum<R>& w) { part(part, n, w); });
}

/// Which coats are over glass, and which lobes get the weight of glass: those of which
/// `knows(lobe)` is true.
template <class R, class Knows>
inline void find_glass(const Layout& layout, const R* params, CoatTree<R>& coats,
                       PerNode<OverGlass<R>>& glass, const Knows& knows) {
  for (int base = 0; base < int(layout.nodes().size()); ++base) {
    if (!coats.starts_at(base)) continue;
    CoatAbove<R>& coat = coats[base];
    for_each_below(layout, params, coats, base, [&](int node, const Spectrum<R>& weight) {
      const Layout::Node& n = layout.nodes()[node];
      const int below = coat_base(n);
      if (below >= 0) {
        for (int j = 0; j < kWavelengths; ++j)
          if (coats[below].nested[j]) coat.glass[j] += weight[j] * coats[below].glass[j];
        return;
      }
      if (!(traits(n.lobe) & Transmits) || !(traits(n.lobe) & Reflects) || !knows(node)) return;
      auto& law = glass.of[base].law;
      if (!coat.over_glass) law = detail::coats_on_glass(coats, base);
      coats.above.of[node].once_base = base;
      coat.over_glass = true;
      for (int j = 0; j < kWavelengths; ++j)
        if (law[j].counts) coat.glass[j] += weight[j];
    });
    for (R& share : coat.glass.v) share = std::min(share, R(1));
  }
}

}  // namespace mms::materials
