// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// How combiners weigh their children: from the root down, a factor for each node. Factors of
/// `mix`, `scale` and `add` are numbers, and `turn` and `tilt` have none (materials/frames.h);
/// those of `fresnel_mix` depend on both directions, along the coat's own normal.
///
/// `fresnel_mix(base, coat, ior)` and `coat(top, base, thickness, absorption, ior)`: of light along
/// wo the coat reflects E and lets T = 1 - E through (materials/coat.h), both from outside the
/// coat; E' and T' along wi. A `coat` dims what passes its layer twice, along the refracted
/// directions: exp(-absorption thickness (1 / c + 1 / c')) on `base`, where c^2 = 1 - (1 -
/// |wo.z|^2) / n^2, c' alike for wi; n is `ior` times that of all coats right above.
///
/// Where the coat is made of `glossy`, `glossy_product`, `glossy_back`, `microfacet`, `beckmann`,
/// metals and mirrors, one of them or what `mix`, `scale`, `add` and `turn` make of several, each
/// of its lobes gets
///   coat: h(wo) h(wi)           (materials/coated.h), for its own E; for a delta E itself
/// so that a white coat reflects E exactly. Of other lobes it is
///   coat: min(F, F')            and s is 0: E = F
///
/// Facets, all glossy lobes and `rough_matte` right below the coat get
///   base: g(wo) g(wi)           (materials/coated.h), whose mean over the lobe is T
/// and Lambert's lobes
///   base: T T' / mean T         whose integral over wi is exactly T (Kelemen and Szirmay-Kalos
///                               2001, where the coat is polished)
/// so that a lossless base under a lossless coat is 1 in every direction: round facets, `glossy`
/// and both mattes under any such coat within 1e-4 for indices from 1.005 to 4 and roughness from
/// 0.05, beyond these 4e-4, and towards index 1 or 8 1e-3; stretched facets in it or under it 2e-4
/// up to anisotropy 0.9 for indices from 1.02 to 4 and roughness from 0.2, 3e-4 at anisotropy 1, in
/// a coat of index 1.005 or 8 2e-4, of 1.001 1e-3, and above 8 1e-2.
/// All other lobes get
///   base: min(T, T')
/// which never gains, as it is below T. All of these are symmetric. A specular coat over a Lambert
/// base is 1 exactly; but near grazing a broad coat of which no more is known loses much: min(F,
/// F') is small where F' is.
///
/// Known lobes in a `tilt` get g and h as if the coats were tilted with them, times
///   r(wo) min(r(wi), m) / m     r is T, E or T E about the coats' normal over the same about the
///                               lobe's own, m = min(1, r) of what wo's lobe is around
/// so that they reflect as much of T, E or T E as they reflect of all light without coats, or
/// little less, and never more, and are lit and seen through the coats that there are. Mirrors get
/// T, E or T E along wo, and glass T. So do those below or in a coat in a `tilt`. Other lobes get
/// min(T, T') there too, but for Lambert's: their factor never gains, as about any other normal
/// more of the lobe is where less is let through. As without coats none of that is reciprocal.
///
/// Where a coat lies right under another, as plastic under varnish, and so on, T is the product of
/// all coats above, and a lobe of a coat below others gets E of its coat times their T: g and h are
/// then solved for (materials/under_coats.h), however many there are, within 1e-4. An index below
/// 1, as of water under varnish, counts as its inverse (materials/coat.h), and a coat whose index
/// is 1 at every wavelength is not there.
///
/// Under a film, of `film_mix(base, coat, ior, film_ior, thickness, wavelength)`, E is what film
/// and interface reflect (materials/coat.h), and g and h are solved for too. Mattes, round facets
/// and `glossy` in it and under it keep their energy within 1e-4 however thick it is. So do
/// stretched facets of roughness from 0.2 in and under films of up to 2 waves; of roughness from
/// 0.05 they do within 1e-3.
///
/// Interfaces right below the coat, or below several, get what passes it once if light changes
/// sides, twice if it stays outside, and never if it stays inside, along the directions outside;
/// the same of the layer of a `coat`. The coat sends back the rest
/// (materials/glass_coat.h), and seen from inside nothing else:
///   base: T(outside), T T' / M, or 1      M the most that T is: mostly along the normal
/// so that lossless glass is 1 from both sides: smooth 1e-5 (`dielectric`, `beckmann_dielectric`,
/// `film_dielectric`, `phong_glass`, `refraction`), round facets of roughness from 0.02 1e-3 for
/// indices between 1.01 and 4 and their inverses under coats of indices from 1.005, stretched ones
/// from 0.15 for indices from 1.02 under coats from 1.02; seen from the denser side one random
/// setting of anisotropy 1 in 3000 is off by up to 2.7e-3, and of Beckmann facets one in 500 by up
/// to 5e-3. What changes sides in `glossy_refraction` gets g(wo) g(wi) of the directions outside,
/// and where its index is below 1 T of the one outside; the rest of T is sent back as by a mirror:
/// 1e-4. Rough `phong_glass` of an index from 1/4 loses what it does without a coat, within 1e-3
/// (materials/phong_coat.h). Rough `film_dielectric` is within 1e-3 up to anisotropy 0.9 where its
/// film is up to 600 nm thick (materials/film_coat.h). All that is so under a film too. Rough glass
/// of an index above 4 or below 1/4 gets min(T, T') as if both directions were outside, and loses
/// up to a tenth about the critical angle.
///
/// `layer(top, base, weight)` gives `base` what `top` leaves; with E = weight times the albedo of a
/// white `top`, or of a scaled one so many times less:
///   top: weight
///   base: 1 - E(wo)             in radiance; of importance 1 - E(wi). For the Lambert lobes right
///                               below it (1 - E)(1 - E') / (1 - mean E)
/// so that a white base under a white top is 1 in every direction, whatever it is: of radiance
/// always, so that nothing is seen brighter than what lights it; of importance only under the
/// second factor, as the first is not symmetric. E is known of `sheen` (materials/sheen.h); of all
/// else it is taken for the weight: a mixture.

#include <algorithm>
#include <limits>
#include <optional>

#include "materials/coated.h"
#include "materials/coats_above.h"
#include "materials/fresnel.h"
#include "materials/glass_coat.h"
#include "materials/layout.h"
#include "materials/lobe.h"
#include "materials/sheen.h"
#include "materials/under_coats.h"

namespace mms::materials {

/// Factors of one node, for lobes that are not Lambert's and for those that are.
template <class R>
struct NodeWeight {
  Spectrum<R> other{R(1)}, lambert{R(1)};
  /// Without the coats that count together right above, and what these let through along wi.
  Spectrum<R> bare{R(1)}, through_i{R(1)};
  /// `bare`, but light passes the layers of these coats along directions outside alone.
  Spectrum<R> crossing{R(1)};

  /// The weight of a child that is a part of the node.
  NodeWeight operator*(const Spectrum<R>& part) const {
    return {other * part, lambert * part, bare * part, through_i, crossing * part};
  }
};

namespace detail {

template <class R>
inline void weigh_fresnel_mix(const CoatAbove<R>& mix, const CoatNumbers<R>& numbers, Vec3<R> wo,
                              Vec3<R> wi, const NodeWeight<R>& w, NodeWeight<R>& base,
                              NodeWeight<R>& coat) {
  const CoatAlong<R>&o = mix.o, i(numbers, std::abs(wi.z));
  Spectrum<R> reflects;
  for (int j = 0; j < kWavelengths; ++j) {
    const R eta = numbers.eta[j];
    base.bare[j] = mix.nested[j] ? w.bare[j] : w.other[j];
    base.through_i[j] = mix.nested[j] ? w.through_i[j] * i.through[j] : i.through[j];
    base.other[j] = w.other[j] * std::min(o.through[j], i.through[j]);
    const R both = mix.through_o[j] * base.through_i[j];
    base.lambert[j] = mix.mean[j] > 0 ? base.bare[j] * both / mix.mean[j] : R(0);
    base.crossing[j] = mix.nested[j] ? w.crossing[j] : w.other[j];
    // Lobes that are known get their factor themselves; mirrors, that of where light is seen.
    reflects[j] = mix.kind.polished           ? o.reflected[j]
                  : mix.kind.known && eta > 1 ? R(1)
                                              : std::min(o.reflected[j], i.reflected[j]);
    if (wo.z < 0 && eta > 1) reflects[j] *= 1 - mix.glass[j];
  }
  coat = w * reflects;
}

/// What the `layer` of that node leaves to its base.
template <class R>
struct LayerLeaves {
  R weight;
  std::optional<SheenLayer<R>> fibres;  ///< none: all but the weight
  Spectrum<R> share;                    ///< of white fibres, with the scales above them

  LayerLeaves(const Layout& layout, const R* params, const Layout::Node& node)
      : weight(limited(params[node.first_param], R(0), R(1))), share(weight) {
    const Layout::Node& top = layout.below_scales(node.children[0]);
    if (top.lobe != Lobe::Sheen) return;
    fibres.emplace(params[top.first_param + kWavelengths]);
    const Layout::Node* above = &layout.nodes()[node.children[0]];
    for (; above != &top; above = &layout.nodes()[above->children[0]])
      if (above->lobe == Lobe::Scale)
        share *= Spectrum<R>::map([](R x) { return limited(x, R(0), R(1)); },
                                  weight_at(params + above->first_param));
  }

  Spectrum<R> along(R c) const {
    return Spectrum<R>(R(1)) - share * (fibres ? fibres->albedo(c) : R(1));
  }
  /// Of fibres.
  Spectrum<R> lambert(R cos_o, R cos_i) const {
    return along(cos_o) * along(cos_i) / (Spectrum<R>(R(1)) - share * fibres->mean_albedo());
  }
};

}  // namespace detail

/// Factors for the pair of directions, for every node.
template <class R>
inline void weigh(const Layout& layout, const R* params, const Frames<R>& frames,
                  const CoatTree<R>& coats, Vec3<R> wo, Vec3<R> wi, Mode mode,
                  PerNode<NodeWeight<R>>& weights) {
  const auto nodes = layout.nodes();
  const auto under_coat = [&](int i, int base, NodeWeight<R>& of_base, NodeWeight<R>& of_coat) {
    if (!coats.starts_at(base)) {  // its index is 1
      of_base = weights.of[i];
      of_coat = weights.of[i] * Spectrum<R>();
      return;
    }
    detail::weigh_fresnel_mix(coats[base], coats.numbers(base), frames.seen(i, wo),
                              frames.seen(i, wi), weights.of[i], of_base, of_coat);
  };
  auto& w = weights.of;
  w[nodes.size() - 1] = NodeWeight<R>{};
  for (int i = int(nodes.size()) - 1; i >= 0; --i) {
    const Layout::Node& node = nodes[i];
    const R* p = params + node.first_param;
    const int a = node.children[0], b = node.children[1];
    if (detail::weigh_by_numbers(node, p, i, w.data())) continue;
    const R cos_o = std::abs(frames.seen(i, wo).z), cos_i = std::abs(frames.seen(i, wi).z);
    switch (node.lobe) {
      case Lobe::Tilt:
        w[a] = w[i];
        break;
      case Lobe::Layer: {
        const detail::LayerLeaves<R> left(layout, params, node);
        w[a] = w[i] * Spectrum<R>(left.weight);
        w[b] = w[i] * Spectrum<R>(1 - left.weight);
        if (left.fibres) {
          w[b].other = w[i].other * left.along(mode == Mode::Radiance ? cos_o : cos_i);
          w[b].lambert = w[i].other * left.lambert(cos_o, cos_i);
        }
        break;
      }
      case Lobe::FresnelMix:
      case Lobe::FilmMix:
        under_coat(i, a, w[a], w[b]);
        break;
      case Lobe::Coat:
        under_coat(i, b, w[b], w[a]);
        for (int j = 0; j < kWavelengths; ++j) {
          const R along_o = detail::layer_transmittance(p, j, coats.cosine_inside(b, j, cos_o)),
                  along_i = detail::layer_transmittance(p, j, coats.cosine_inside(b, j, cos_i));
          w[b].other[j] *= along_o * along_i;
          w[b].lambert[j] *= along_o * along_i;
          w[b].bare[j] *= along_o * along_i;
          w[b].crossing[j] *= (wo.z > 0 ? along_o : R(1)) * (wi.z > 0 ? along_i : R(1));
        }
        break;
      default:
        break;  // a lobe
    }
  }
}

/// The factor for interfaces that coats are passed by once, from those of their node.
template <class R>
inline Spectrum<R> glass_weight(const NodeWeight<R>& w, const CoatAbove<R>& coat,
                                const OverGlass<R>& over, Vec3<R> wo, Vec3<R> wi) {
  Spectrum<R> f = w.other;
  for (int j = 0; j < kWavelengths; ++j)
    if (over.law[j].counts)
      f[j] = w.crossing[j] *
             glass_factor(wo.z > 0, wi.z > 0, coat.through_o[j], w.through_i[j], over.law[j].most);
  return f;
}

/// Whether at wavelength j the coats above a known lobe count together, with what it is a part of.
template <class R>
inline bool counts_together(const CoatTree<R>& coats, const NodeAbove& above, int j) {
  return above.coated() && coats.numbers(above.base).eta[j] > 1 &&
         (above.part_of < 0 || coats.numbers(above.part_of).eta[j] > 1);
}

/// The factor for what reflects or lets through all that T lets it: for mirrors and glass in a
/// `tilt` T along wo.
template <class R>
inline Spectrum<R> whole_weight(const NodeWeight<R>& w, const CoatTree<R>& coats,
                                const NodeAbove& above) {
  Spectrum<R> f = w.other;
  if (above.tilted)
    for (int j = 0; j < kWavelengths; ++j)
      if (counts_together(coats, above, j)) f[j] = w.bare[j] * coats[above.base].through_o[j];
  return f;
}

/// The factor for deltas, from those of their node, for a direction whose |cosine| about the normal
/// of the coats is `cos_o`. Of a coat's own, where all is one frame, it is the same along wi.
template <class R>
inline Spectrum<R> delta_weight(const NodeWeight<R>& w, const CoatTree<R>& coats,
                                const NodeAbove& above, R cos_o) {
  Spectrum<R> f = whole_weight(w, coats, above);
  if (above.part_of < 0) return f;
  const CoatNumbers<R>& coat = coats.numbers(above.part_of);
  CoatDirection<R> along(std::min(cos_o, R(1)));
  for (int j = 0; j < kWavelengths; ++j)
    if (coat.eta[j] > 1) f[j] *= coat.of(j, {}).split(along, coat.face(j)).reflected;
  return f;
}

/// What the coats of a lobe are to it along one direction.
template <class R>
struct CoatsSeen {
  Spectrum<R> through{R(1)};  ///< what those above that count together let through
  R z{1};                     ///< |cosine| about the normal of what it is a part of

  CoatsSeen(const Spectrum<R>& all, R cosine) : through(all), z(cosine) {}
  CoatsSeen(const CoatTree<R>& coats, const Frames<R>& frames, const NodeAbove& above, Vec3<R> w)
      : z(std::abs(frames.seen(above.upright(), w).z)) {
    std::bitset<kWavelengths> together;
    together.set();
    for (int one = above.base; one >= 0 && together.any(); one = coats[one].upper) {
      const CoatAlong<R> along(coats.numbers(one), std::abs(frames.seen(one, w).z));
      for (int j = 0; j < kWavelengths; ++j) {
        if (together[j]) through[j] *= along.through[j];
        together[j] = together[j] && coats[one].nested[j];
      }
    }
  }
};

/// What a known lobe is to reflect at one wavelength.
template <class R>
struct CoatedShare {
  R reflected, through;  ///< E and T, about its own normal
  R share;               ///< T E; of what is tilted, that about the normals of the coats
};

/// That of a lobe of a coat or below one, at each wavelength in turn.
template <class R>
class CoatedShares {
 public:
  CoatedShares(const CoatTree<R>& coats, const NodeAbove& above, const CoatedLobe<R>& lobe,
               const CoatsSeen<R>& seen)
      : coats_(coats),
        above_(above),
        lobe_(lobe),
        seen_(seen),
        broad_(above.part_of >= 0 ? lobe.broad() : Broadness<R>{}),
        along_(lobe.z) {}

  bool part() const { return above_.part_of >= 0; }
  const CoatNumbers<R>& coat() const {
    return coats_.numbers(part() ? above_.part_of : above_.base);
  }
  CoatShape<R> shape(int j) const { return part() ? coat().of(j, broad_) : coat().shape[j]; }
  /// Whether there is one.
  bool known(int j) const {
    return part() ? coat().eta[j] > 1 : counts_together(coats_, above_, j);
  }
  CoatedShare<R> at(int j, const CoatShape<R>& shape) {
    const bool together = counts_together(coats_, above_, j);
    const R e = part() ? shape.split(along_, coat().face(j)).reflected : R(1);
    const R t = together ? seen_.through[j] : R(1);
    if (!above_.tilted) return {e, t, e * t};
    const R share = part() ? t * shape.split(std::min(seen_.z, R(1)), coat().face(j)).reflected : t;
    return {e, together ? split_together(coats_, above_.base, j, lobe_.z).transmitted : R(1),
            share};
  }

 private:
  const CoatTree<R>& coats_;
  const NodeAbove& above_;
  const CoatedLobe<R>& lobe_;
  const CoatsSeen<R>& seen_;
  Broadness<R> broad_;
  CoatDirection<R> along_;
};

/// r of what is tilted along a direction, at most 1.
template <class R>
inline Spectrum<R> tilted_share(const CoatTree<R>& coats, const NodeAbove& above,
                                const CoatedLobe<R>& lobe, const CoatsSeen<R>& seen) {
  CoatedShares<R> shares(coats, above, lobe, seen);
  Spectrum<R> r{R(1)};
  for (int j = 0; j < kWavelengths; ++j) {
    if (!shares.known(j)) continue;
    const CoatedShare<R> s = shares.at(j, shares.shape(j));
    if (s.share < s.reflected * s.through)
      r[j] = std::max(s.share / (s.reflected * s.through), R(1e-6));
  }
  return r;
}

/// g of materials/coated.h along one direction, of a lobe that is known below a coat or as a part
/// of one; 1 where no more is known. `under` is what is solved for the lobe (is_solved_for); `most`
/// what r is at most, if it is.
template <class R>
inline Spectrum<R> coated_scaling(const CoatTree<R>& coats, const NodeAbove& above,
                                  const UnderCoats<R>* under, const CoatedLobe<R>& lobe,
                                  const CoatsSeen<R>& seen, const Spectrum<R>* most = nullptr) {
  CoatedShares<R> shares(coats, above, lobe, seen);
  const CoatNumbers<R>& coat = shares.coat();
  typename UnderCoats<R>::Along along;
  if (under) along = under->along(lobe);
  Spectrum<R> g{R(1)};
  bool known = false, solved = false;
  for (int j = 0; j < kWavelengths; ++j) {
    const bool was_known = known, was_solved = solved;
    known = shares.known(j);
    solved = coat.films[j].there() ||
             (shares.part() ? counts_together(coats, above, j) : coats[above.base].nested[j]);
    if (!known) continue;
    if (was_known && solved == was_solved && coat.repeated(j) && (!solved || under->repeated(j))) {
      g[j] = g[j - 1];
      continue;
    }
    const R eta = coat.eta[j];
    const CoatShape<R> shape = shares.shape(j);
    CoatedShare<R> s = shares.at(j, shape);
    if (most) s.share = std::min(s.share, (*most)[j] * s.reflected * s.through);
    const R squared = solved          ? under->squared(j, along, s.through, s.reflected)
                      : shares.part() ? lobe.as_coat(eta, s.reflected)
                                      : lobe.below(eta, shape, s.through);
    g[j] = squared > 0 ? s.share / std::sqrt(squared) : R(0);
  }
  return g;
}

/// The same of what passes `glossy_refraction`, whose lobe is outside in a direction for each
/// index; where the index is the lower one, the factor of glass (materials/glass_coat.h).
template <class R, class Model>
inline Spectrum<R> bent_scaling(const CoatTree<R>& coats, const NodeAbove& above,
                                const UnderCoats<R>* under, const Model& model, Vec3<R> w) {
  Spectrum<R> g, of_index;
  const auto through = [&](R z) {
    Spectrum<R> t;
    for (int k = 0; k < kWavelengths; ++k)
      t[k] = split_together(coats, above.base, k, z).transmitted;
    return t;
  };
  for_each_index(model.numbers, [&](int j, bool repeated) {
    if (!repeated) {
      if (model.falls(j)) {
        of_index = w.z > 0 ? through(std::min(w.z, R(1))) : Spectrum<R>(R(1));
      } else {
        const CoatedLobe<R> lobe = model.coated(w, j);
        of_index = coated_scaling(coats, above, under, lobe, {through(lobe.z), lobe.z});
      }
    }
    g[j] = of_index[j];
  });
  return g;
}

/// The factor for such a lobe from `g` along both directions and those of its node: `counted` where
/// the coats above count together, and `other`.
template <class R>
inline Spectrum<R> coated_weight(const CoatTree<R>& coats, const NodeAbove& above,
                                 const Spectrum<R>& counted, const Spectrum<R>& other,
                                 const Spectrum<R>& g_o, const Spectrum<R>& g_i) {
  Spectrum<R> f;
  for (int j = 0; j < kWavelengths; ++j)
    f[j] = (counts_together(coats, above, j) ? counted[j] : other[j]) * (g_o[j] * g_i[j]);
  return f;
}

/// Factors for choosing a lobe before wi is known: `fresnel_mix` takes F and 1 - F at wo. 0 only
/// where `weigh` is 0 for every wi. `coats` are null where there are none.
template <class R>
inline void weigh_for_choice(const Layout& layout, const R* params, const Frames<R>& frames,
                             Vec3<R> wo, const std::type_identity_t<CoatTree<R>>* coats,
                             PerNode<Spectrum<R>>& weights) {
  const auto split = [&](const R* ior, int base, R cos_o, Spectrum<R>& reflected,
                         Spectrum<R>& transmitted) {
    if (!coats || !coats->starts_at(base)) {
      const InterfaceSplits<R> s(ior, Vec3<R>{0, 0, 1}, cos_o);
      reflected = s.reflected;
      transmitted = s.transmitted;
      return;
    }
    const CoatAbove<R>& coat = (*coats)[base];
    reflected = coat.o.reflected;
    transmitted = coat.o.through;
    // Of light inside, glass gets all.
    if (wo.z > 0) return;
    for (int j = 0; j < kWavelengths; ++j) {
      const R glass = coats->numbers(base).eta[j] > 1 ? coat.glass[j] : R(0);
      reflected[j] *= 1 - glass;
      transmitted[j] += glass * (1 - transmitted[j]);
    }
  };
  const auto nodes = layout.nodes();
  auto& w = weights.of;
  w[nodes.size() - 1] = Spectrum<R>(R(1));
  for (int i = int(nodes.size()) - 1; i >= 0; --i) {
    const Layout::Node& node = nodes[i];
    const R* p = params + node.first_param;
    const int a = node.children[0], b = node.children[1];
    if (detail::weigh_by_numbers(node, p, i, w.data())) continue;
    const R cos_o = std::abs(frames.seen(i, wo).z);
    switch (node.lobe) {
      case Lobe::Tilt:
        w[a] = w[i];
        break;
      case Lobe::Layer: {
        const detail::LayerLeaves<R> left(layout, params, node);
        w[a] = w[i] * left.weight;
        w[b] = w[i] * left.along(cos_o);
        break;
      }
      case Lobe::FresnelMix:
      case Lobe::FilmMix: {
        Spectrum<R> reflected, transmitted;
        split(p, a, cos_o, reflected, transmitted);
        w[a] = w[i] * transmitted;
        w[b] = w[i] * reflected;
        break;
      }
      case Lobe::Coat: {
        Spectrum<R> reflected, transmitted;
        split(p + 1 + kWavelengths, b, cos_o, reflected, transmitted);
        w[a] = w[i] * reflected;
        w[b] = w[i] * transmitted;
        // Light inside that stays there never meets the layer.
        if (wo.z < 0 && coats && coats->starts_at(b) && (*coats)[b].over_glass) break;
        for (int j = 0; j < kWavelengths; ++j) {
          const R inside = coats ? coats->cosine_inside(b, j, cos_o) : cos_o;
          w[b][j] *=
              detail::layer_transmittance(p, j, inside) * detail::layer_transmittance(p, j, R(1));
        }
        break;
      }
      default:
        break;
    }
  }
}

}  // namespace mms::materials
