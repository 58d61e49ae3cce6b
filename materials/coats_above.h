// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What lies above the nodes of a layout: which coat is right above a node, of what lobes it is,
/// and what it does to light along one direction. materials/combine.h says what follows from that.

#include <algorithm>
#include <array>
#include <bitset>
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

/// The coat right above a node, where light is seen along one direction.
template <class R>
struct CoatAbove {
  const R* ior = nullptr;  ///< its indices; null: there is none
  CoatKind<R> kind{};
  CoatNumbers<R> numbers{};
  int base = -1;        ///< the node right below it
  int matte_base = -1;  ///< the same of what is tilted below it: Lambert lobes get its factor there
  int upper = -1;       ///< that of a coat right above this one, if there is one
  int part_of = -1;     ///< that of the coat of whose known lobes this node is one, or some
  const R* layer = nullptr;  ///< the numbers of its `coat`, if it is one
  bool passed_once = false;  ///< by what changes sides at this lobe (materials/glass_coat.h)
  bool over_glass = false;   ///< such lobes are all or a part of what lies right below
  CoatAlong<R> o{};
  Spectrum<R> through_o{};  ///< what is left of light by all coats that count together
  Spectrum<R> mean{};       ///< of that over the hemisphere, where Lambert lobes lie right below
  Spectrum<R> glass{};      ///< their share, with those below further coats that count together

  /// Whether at wavelength j it counts together with those above.
  std::array<bool, kWavelengths> nested{};

  bool filmed(int j) const { return numbers.films[j].there(); }
  /// |Cosine| of light in it, from that outside all coats.
  R cosine_inside(int j, R z) const { return ior ? numbers.cosine_inside(j, z) : z; }
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
  if (weigh_by_numbers(n, p, node, weights.of.data())) {
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

/// Calls `visit(coat)` for the coats above a node that count together at wavelength j, the nearest
/// first.
template <class R, class Visit>
inline void for_each_together(const PerNode<CoatAbove<R>>& coats, const CoatAbove<R>& above, int j,
                              Visit visit) {
  for (int at = above.base; at >= 0;) {
    const CoatAbove<R>& one = coats.of[at];
    visit(one);
    at = one.nested[j] ? one.upper : -1;
  }
}

/// What they reflect and let through together, along a direction of |cosine| `z`.
template <class R>
inline FresnelSplit<R> split_together(const PerNode<CoatAbove<R>>& coats, const CoatAbove<R>& above,
                                      int j, R z) {
  FresnelSplit<R> all{R(0), R(1)};
  for_each_together(coats, above, j, [&](const CoatAbove<R>& one) {
    const FresnelSplit<R> e = one.numbers.split(j, z);
    all.reflected += all.transmitted * e.reflected;
    all.transmitted *= e.transmitted;
  });
  return all;
}

/// Whether one of them has a film, whose E is no sum that glass knows the parts of.
template <class R>
inline bool filmed_together(const PerNode<CoatAbove<R>>& coats, const CoatAbove<R>& above, int j) {
  bool filmed = false;
  for_each_together(coats, above, j, [&](const CoatAbove<R>& one) { filmed |= one.filmed(j); });
  return filmed;
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
inline bool is_solved_for(const PerNode<CoatAbove<R>>& coats, const CoatAbove<R>& above) {
  if (above.part_of >= 0) return above.ior || coats.of[above.part_of].numbers.filmed();
  return above.ior && (above.upper >= 0 || above.numbers.filmed());
}

/// The coats that G of a lobe depends on: those of its node, which is `above`, and what the lobe
/// itself, as broad as `broad`, is a part of.
template <class R>
inline Coats<R> coats_above(const PerNode<CoatAbove<R>>& coats, const CoatAbove<R>& above,
                            const Broadness<R>& broad = {}) {
  Coats<R> all;
  if (above.part_of >= 0) all.part = coats.of[above.part_of].numbers.as(broad);
  for (int at = above.base; at >= 0; at = coats.of[at].upper) all.add(coats.of[at].numbers);
  return all;
}

/// The coats right above every node, where light is seen along `wo`.
template <class R>
inline void find_coats(const Layout& layout, const R* params, const Frames<R>& frames, Vec3<R> wo,
                       PerNode<CoatAbove<R>>& coats) {
  const auto nodes = layout.nodes();
  auto& above = coats.of;
  above[nodes.size() - 1] = {};
  for (int i = int(nodes.size()) - 1; i >= 0; --i) {
    const Layout::Node& node = nodes[i];
    const R* p = params + node.first_param;
    for (int c = 0; c < node.child_count; ++c) above[node.children[c]] = above[i];
    const int a = node.children[0], b = node.children[1];
    const auto coated = [&](int base, int coat, const R* ior, const Films<R>& films,
                            const R* layer) {
      if (std::all_of(ior, ior + kWavelengths, [](R n) { return n == 1; }) &&
          std::none_of(films.begin(), films.end(), [](const Film<R>& f) { return f.there(); }))
        return;
      CoatAbove<R>& below = above[base];
      below = {.ior = ior, .kind = detail::coat_kind(layout, params, coat)};
      below.base = below.matte_base = base;
      below.layer = layer;
      const CoatAbove<R>* upper = above[i].ior ? &above[above[i].base] : nullptr;
      Spectrum<R> least;
      if (upper) {
        below.upper = upper->base;
        for (int j = 0; j < kWavelengths; ++j)
          if (upper->numbers.eta[j] > 1) least[j] = upper->numbers.least_below(j);
      }
      below.numbers = {ior, films, below.kind.held, below.kind.even, least};
      if (upper)
        for (int j = 0; j < kWavelengths; ++j)
          below.nested[j] = below.numbers.eta[j] > 1 && upper->numbers.eta[j] > 1;
      below.o = {below.numbers, std::abs(frames.seen(i, wo).z)};
      below.through_o = below.o.through;
      for (int j = 0; j < kWavelengths; ++j)
        if (below.nested[j]) below.through_o[j] *= upper->through_o[j];
      if (below.kind.known) above[coat].part_of = base;
    };
    if (node.lobe == Lobe::FresnelMix)
      coated(a, b, p, {}, nullptr);
    else if (node.lobe == Lobe::FilmMix)
      coated(a, b, p, detail::films(p + kWavelengths), nullptr);
    else if (node.lobe == Lobe::Coat)
      coated(b, a, p + 1 + kWavelengths, {}, p);
    else if (node.lobe == Lobe::Layer && layout.unturned(a).lobe == Lobe::Sheen)
      above[b] = {};
    else if (node.lobe == Lobe::Tilt)
      above[a] = {.matte_base = above[i].matte_base};
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
  const PerNode<CoatAbove<R>>& coats;
  const CoatAbove<R>& above;
  const std::array<CoatOnGlass<R>, kWavelengths>& law;

  FresnelSplit<R> split(int j, R z) const { return split_together(coats, above, j, z); }
  bool filmed(int j) const { return filmed_together(coats, above, j); }
  /// What their layers let through along a direction of |cosine| `z` outside.
  R layers(int j, R z) const {
    R through = 1;
    for_each_together(coats, above, j, [&](const CoatAbove<R>& one) {
      if (one.layer)
        through *= detail::layer_transmittance(one.layer, j, one.numbers.cosine_inside(j, z));
    });
    return through;
  }
};

namespace detail {

/// At wavelength j.
template <class R>
inline CoatOnGlass<R> coat_on_glass(const PerNode<CoatAbove<R>>& coats, const CoatAbove<R>& above,
                                    int j) {
  CoatOnGlass<R> on;
  if (!(above.numbers.eta[j] > 1)) return on;
  // F is that of the uppermost; of others little is left below it (materials/coat.h).
  const CoatAbove<R>* top = &above;
  R through = 1, before = 1;  // along the surface, with and without the uppermost
  for_each_together(coats, above, j, [&](const CoatAbove<R>& one) {
    top = &one;
    before = through;
    through *= one.numbers.split(j, R(0)).transmitted;
  });
  on.eta = top->numbers.eta[j];
  on.steep = top->numbers.shape[j].steep * before;
  on.normal = split_together(coats, above, j, R(1)).transmitted;
  if ((top == &above && above.kind.polished) || filmed_together(coats, above, j)) return on;
  for (int m = 0; m < kRest; ++m) {
    const R z = R(kRestCosine[m]);
    on.rest[m] =
        split_together(coats, above, j, z).reflected - on.steep * fresnel_dielectric(z, on.eta);
  }
  return on;
}

}  // namespace detail

/// Calls `visit(node, weight)` for what lies right below a coat, the child `base` of its combiner,
/// and is no coat of index 1.
template <class R, class Visit>
inline void for_each_below(const Layout& layout, const R* params,
                           const PerNode<CoatAbove<R>>& coats, int base, Visit visit) {
  PerNode<Spectrum<R>> weights;
  weights.of[base] = Spectrum<R>(R(1));
  const auto part = [&](const auto& self, int node, const Spectrum<R>& weight) -> void {
    const int below = coat_base(layout.nodes()[node]);
    if (below < 0 || coats.of[below].base == below) return visit(node, weight);
    weights.of[below] = weight;
    detail::for_each_part(layout, params, below, weights,
                          [&](int n, const Spectrum<R>& w) { self(self, n, w); });
  };
  detail::for_each_part(layout, params, base, weights,
                        [&](int n, const Spectrum<R>& w) { part(part, n, w); });
}

/// Which coats are over glass, and which lobes get the weight of glass: those of which
/// `knows(lobe, coats)` is true.
template <class R, class Knows>
inline void find_glass(const Layout& layout, const R* params, PerNode<CoatAbove<R>>& coats,
                       PerNode<OverGlass<R>>& glass, const Knows& knows) {
  for (int base = 0; base < int(layout.nodes().size()); ++base) {
    CoatAbove<R>& coat = coats.of[base];
    if (coat.base != base) continue;
    bool asked = false;
    for_each_below(layout, params, coats, base, [&](int node, const Spectrum<R>& weight) {
      const Layout::Node& n = layout.nodes()[node];
      const int below = coat_base(n);
      if (below >= 0) {
        for (int j = 0; j < kWavelengths; ++j)
          if (coats.of[below].nested[j]) coat.glass[j] += weight[j] * coats.of[below].glass[j];
        return;
      }
      if (!(traits(n.lobe) & Transmits) || !(traits(n.lobe) & Reflects)) return;
      auto& law = glass.of[base].law;
      for (int j = 0; !asked && j < kWavelengths; ++j)
        law[j] = coat.numbers.repeated(j) && j > 0 && coat.upper < 0
                     ? law[j - 1]
                     : detail::coat_on_glass(coats, coat, j);
      asked = true;
      if (!knows(node, CoatsOnGlass<R>{coats, coat, law})) return;
      coats.of[node].passed_once = coat.over_glass = true;
      for (int j = 0; j < kWavelengths; ++j)
        if (law[j].counts()) coat.glass[j] += weight[j];
    });
    for (R& share : coat.glass.v) share = std::min(share, R(1));
  }
}

}  // namespace mms::materials
