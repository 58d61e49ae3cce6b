// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// How combiners weigh their children: from the root down, a factor for each node. Factors of
/// `mix`, `scale` and `add` are numbers; those of `fresnel_mix` depend on both directions.
///
/// `fresnel_mix(base, coat, ior)`, F = F(|wo.z|), F' = F(|wi.z|), both from outside the coat:
///   coat: min(F, F')            for a delta F itself, as both angles are the same
///   base: 1 - max(F, F')        or, for the Lambert lobes right below it,
///         (1 - F)(1 - F') / (1 - mean F)    (Kelemen and Szirmay-Kalos 2001), whose integral over
///                               wi is exactly 1 - F
/// `coat(top, base, thickness, absorption, ior)` weighs in the same way and dims what passes the
/// layer twice, along the refracted directions: exp(-absorption thickness (1 / c + 1 / c')) on
/// `base`, where c^2 = 1 - (1 - |wo.z|^2) / ior^2, c' alike for wi.
///
/// Where the index is above 1, facets, `glossy` and `rough_matte` right below the coat get
///   base: g(wo) g(wi)           (materials/coated.h), whose mean over the lobe is 1 - F
///
/// Where it is above 1 and the coat polished, that is of mirrors alone, interfaces right below get
/// what passes it once if light changes sides, twice if it stays outside, and never if it stays
/// inside, along the directions outside; the same of the layer of a `coat`. The mirrors reflect the
/// rest (materials/glass_coat.h), and seen from inside nothing else:
///   base: T(outside), T T' / max(T, T', T(1)), or 1
/// so that lossless glass is 1 from both sides: smooth 1e-5 (`dielectric`, `beckmann_dielectric`,
/// `film_dielectric`, `phong_glass`, `refraction`), round facets of roughness from 0.1 1e-3, below
/// it 3e-3, for indices of both between 1 and 4. Stretched facets never gain, and lose up to 0.04
/// at anisotropy 0.5, 0.1 at 0.9, where a coat sends most back. Under rough coats, and
/// `phong_glass` that is rough, interfaces get 1 - max(F, F') as if both directions were outside,
/// and lose more.
///
/// All are symmetric. A lossless base under a lossless polished coat then has albedo 1 within 1e-4
/// (stretched facets within 3e-4, beyond anisotropy 0.9 within 1e-3); under a coat of which no more
/// is known it never exceeds 1, as min(F, F') <= F and 1 - max(F, F') <= 1 - F. A specular coat
/// over a Lambert base is 1 exactly; but near grazing a broad coat loses much: min(F, F') is small
/// where F' is.
///
/// Where the coat is `glossy`, `microfacet` or `beckmann`, or what `mix`, `scale` and `add` make of
/// these and of mirrors, and the index above 1, what it reflects is known: with M(wo) the mean of
/// F' over what it scatters (materials/coat_lobe.h) its factor is
///   coat: (F + F') / 2          which reflects E(wo) = (F + M(wo)) / 2
///   base: 1 - max(E, E')        or, for the Lambert lobes right below it,
///         (1 - E)(1 - E') / (1 - mean F)   as the means of E and F are the same
/// so that a white matte under such a white coat is 1 in every direction, within 1e-4; under
/// stretched facets, within 3e-4.
///
/// Under a coat that is not stretched, facets that are round, `glossy` and `rough_matte` get
/// g(wo) g(wi) for T = 1 - E there (materials/under_coats.h), within 1e-4. Stretched facets, and
/// all of these under stretched ones, get 1 - max(E, E'), as under a mixture that is coloured.
///
/// Where a coat lies right under another, as plastic under varnish, its lobe gets what any does
/// below the upper one, and S of what that lets through is left (materials/two_coats.h). If neither
/// is stretched, and the lower one a single lobe or a mirror, what lies below both gets
///   base: g(wo) g(wi) for T S   or, for the Lambert lobes, T S T' S' / mean (T S)
/// and all is 1 within 1e-4. In other nests the Lambert lobes get, of the two coats nearest,
///   base: T T' (1 - E)(1 - E') / mean (1 - F_above)(1 - F_below)
/// which is never more than 1 and loses at most 1.3%, by a lower coat that is broad; `rough_matte`
/// a share 1 - roughness / 4 of it, the rest of the other factor: the largest that never gains (by
/// quadrature over index and roughness). A coat whose index is 1 at every wavelength is not there.
///
/// `layer(top, base, weight)` gives `base` what `top` leaves; with E = weight times the albedo of a
/// white `top`:
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
#include "materials/two_coats.h"
#include "materials/under_coats.h"

namespace mms::materials {

/// Factors of one node, for lobes that are not Lambert's and for those that are.
template <class R>
struct NodeWeight {
  Spectrum<R> other{R(1)}, lambert{R(1)};
  Spectrum<R> glass{R(1)};  ///< for interfaces right below a polished coat
  /// Where a coat is right above: what it lets through along wi, and the factor for lobes with a G
  /// of materials/coated.h, times G G'.
  Spectrum<R> through_i{}, coated{};

  /// The weight of a child that is a part of the node.
  NodeWeight operator*(const Spectrum<R>& part) const {
    return {other * part, lambert * part, glass * part, through_i, coated * part};
  }
};

namespace detail {

template <class R>
inline void weigh_fresnel_mix(const CoatAbove<R>& mix, const LowerCoat<R>& lower,
                              const CoatAlong<R>& i, Vec3<R> wo, Vec3<R> wi, const R* ior_above,
                              const NodeWeight<R>& w, NodeWeight<R>& base, NodeWeight<R>& coat) {
  const CoatAlong<R>& o = mix.o;
  const R cos_i = std::abs(wi.z);
  const bool solved = mix.lower >= 0;
  const Spectrum<R> left_i = solved ? lower.along(i, cos_i) : i.through;
  R kept = 1, last_above = 0;
  Spectrum<R> reflects;
  for_each_index(mix.ior, [&](int j, bool repeated) {
    const R eta = relative_eta(mix.ior[j], Vec3<R>{0, 0, 1});
    const R above = ior_above ? relative_eta(ior_above[j], Vec3<R>{0, 0, 1}) : R(0);
    const bool both = above > 1 && eta > 1;
    if (solved && both)
      kept = lower.mean(j);
    else if (!repeated || above != last_above)
      kept = mean_through(eta, above);
    last_above = above;
    const R left = mix.left_o[j] * left_i[j];
    reflects[j] = mix.kind.known() && eta > 1 ? (o.reflected[j] + i.reflected[j]) / 2
                                              : std::min(o.reflected[j], i.reflected[j]);
    base.other[j] = w.other[j] * std::min(o.through[j], i.through[j]);
    if (mix.over_glass && eta > 1) {
      reflects[j] = mix.mirrored[j];
      base.glass[j] =
          w.other[j] * glass_factor(wo.z > 0, wi.z > 0, o.through[j], i.through[j], eta);
    } else {
      base.glass[j] = base.other[j];
    }
    // Elsewhere the factor of a mix above stays in its bounded form: w.other, not w.lambert.
    base.lambert[j] = kept > 0 ? (both ? w.coated[j] : w.other[j]) * left / kept : R(0);
    base.coated[j] = (solved && both ? w.coated[j] : w.other[j]) * left;
    base.through_i[j] = (solved && both ? w.through_i[j] : R(1)) * left_i[j];
  });
  coat = w * reflects;
}

/// Roughly how a coat splits what comes along `cos_o`.
template <class R>
inline void choose_fresnel_mix(const R* ior, const CoatKind<R>& kind, R cos_o,
                               Spectrum<R>& reflected, Spectrum<R>& transmitted) {
  const InterfaceSplits<R> s(ior, Vec3<R>{0, 0, 1}, cos_o);
  reflected = s.reflected;
  transmitted = s.transmitted;
  if (!kind.known()) return;
  for (int j = 0; j < kWavelengths; ++j) {
    const R eta = relative_eta(ior[j], Vec3<R>{0, 0, 1});
    if (!(eta > 1)) continue;
    const R mean = fresnel_dielectric_diffuse(eta);
    reflected[j] = (reflected[j] + mean) / 2;
    transmitted[j] = (transmitted[j] + 1 - mean) / 2;
  }
}

/// What the `layer` of that node leaves to its base.
template <class R>
struct LayerLeaves {
  R weight;
  std::optional<SheenLayer<R>> fibres;  ///< none: all but the weight

  LayerLeaves(const Layout& layout, const R* params, const Layout::Node& node)
      : weight(limited(params[node.first_param], R(0), R(1))) {
    const Layout::Node& top = layout.nodes()[node.children[0]];
    if (top.lobe == Lobe::Sheen) fibres.emplace(params[top.first_param + kWavelengths]);
  }

  R along(R c) const { return 1 - weight * (fibres ? fibres->albedo(c) : R(1)); }
  /// Of fibres.
  R lambert(R cos_o, R cos_i) const {
    return along(cos_o) * along(cos_i) / (1 - weight * fibres->mean_albedo());
  }
};

}  // namespace detail

/// Factors for the pair of directions, for every node.
template <class R>
inline void weigh(const Layout& layout, const R* params, const PerNode<CoatAbove<R>>& coats,
                  const SolvedPerNode<LowerCoat<R>>& lower, Vec3<R> wo, Vec3<R> wi, Mode mode,
                  PerNode<NodeWeight<R>>& weights) {
  const auto nodes = layout.nodes();
  const R cos_o = std::abs(wo.z), cos_i = std::abs(wi.z);
  const auto under_coat = [&](int i, int base, const R* ior, NodeWeight<R>& of_base,
                              NodeWeight<R>& of_coat) {
    const CoatAbove<R>& coat = coats.of[base];
    if (coat.ior != ior) {  // there is none
      of_base = weights.of[i];
      of_coat = weights.of[i] * Spectrum<R>();
      return;
    }
    detail::weigh_fresnel_mix(coat, lower[base],
                              detail::coat_along(layout, params, coat.ior, coat.kind, wi), wo, wi,
                              coats.of[i].ior, weights.of[i], of_base, of_coat);
  };
  auto& w = weights.of;
  w[nodes.size() - 1] = NodeWeight<R>{};
  for (int i = int(nodes.size()) - 1; i >= 0; --i) {
    const Layout::Node& node = nodes[i];
    const R* p = params + node.first_param;
    const int a = node.children[0], b = node.children[1];
    if (detail::weigh_by_numbers(node, p, i, w.data())) continue;
    switch (node.lobe) {
      case Lobe::Layer: {
        const detail::LayerLeaves<R> left(layout, params, node);
        w[a] = w[i] * Spectrum<R>(left.weight);
        if (left.fibres)
          w[b] = {w[i].other * left.along(mode == Mode::Radiance ? cos_o : cos_i),
                  w[i].other * left.lambert(cos_o, cos_i)};
        else
          w[b] = w[i] * Spectrum<R>(1 - left.weight);
        break;
      }
      case Lobe::FresnelMix:
        under_coat(i, a, p, w[a], w[b]);
        break;
      case Lobe::Coat:
        under_coat(i, b, p + 1 + kWavelengths, w[b], w[a]);
        for (int j = 0; j < kWavelengths; ++j) {
          const R along_o = detail::layer_transmittance(p, j, cos_o),
                  along_i = detail::layer_transmittance(p, j, cos_i);
          w[b].other[j] *= along_o * along_i;
          w[b].lambert[j] *= along_o * along_i;
          w[b].coated[j] *= along_o * along_i;
          w[b].glass[j] *= (wo.z > 0 ? along_o : R(1)) * (wi.z > 0 ? along_i : R(1));
        }
        break;
      default:
        break;  // a lobe
    }
  }
}

/// Whether materials/under_coats.h is asked for a lobe under that coat.
template <class R>
inline bool solved_under(const CoatAbove<R>& coat, const CoatedLobe<R>& lobe) {
  return (coat.kind.round || coat.lower >= 0) && !lobe.stretched();
}

/// The factor for a lobe right below a coat, from those of its node; `o` and `i` are the lobe along
/// the two directions, `under` what is solved for it.
template <class R>
inline Spectrum<R> coated_weight(const NodeWeight<R>& w, const CoatAbove<R>& coat,
                                 const SolvedPerNode<LowerCoat<R>>& lower,
                                 const UnderCoats<R>& under, const CoatedLobe<R>& o,
                                 const CoatedLobe<R>& i, R cos_o, R cos_i) {
  const bool solved = solved_under(coat, o);
  if ((coat.kind.known() || coat.lower >= 0) && !solved) return w.other;  // no more is known
  cos_o = std::min(std::abs(cos_o), R(1));
  cos_i = std::min(std::abs(cos_i), R(1));
  typename UnderCoats<R>::Along along_o, along_i;
  if (solved) along_o = under.along(cos_o), along_i = under.along(cos_i);
  Spectrum<R> f;
  R scale = 0;
  for_each_index(coat.ior, [&](int j, bool repeated) {
    const R eta = relative_eta(coat.ior[j], Vec3<R>{0, 0, 1});
    const bool known = coat.lower >= 0 ? lower[coat.lower].known(j) : eta > 1;
    if (known && !(repeated && coat.lower < 0)) {
      const R of_o = solved ? under.mean_squared(j, along_o, coat.through_o[j])
                            : o.mean_squared(eta, cos_o, coat.through_o[j]);
      const R of_i = solved ? under.mean_squared(j, along_i, w.through_i[j])
                            : i.mean_squared(eta, cos_i, w.through_i[j]);
      const R both = std::sqrt(of_o) * std::sqrt(of_i);
      scale = both > std::numeric_limits<R>::min() ? 1 / both : R(0);
    }
    f[j] = known ? scale * w.coated[j] : w.other[j];
  });
  return f;
}

/// Factors for choosing a lobe before wi is known: `fresnel_mix` takes F and 1 - F at wo, over
/// glass what its mirror reflects and the rest. 0 only where `weigh` is 0 for every wi. `coats` are
/// null where there are none.
template <class R>
inline void weigh_for_choice(const Layout& layout, const R* params, Vec3<R> wo,
                             const std::type_identity_t<PerNode<CoatAbove<R>>>* coats,
                             PerNode<Spectrum<R>>& weights) {
  const R cos_o = std::abs(wo.z);
  const auto split = [&](const R* ior, int base, int coat, Spectrum<R>& reflected,
                         Spectrum<R>& transmitted) {
    const CoatAbove<R>* above = coats ? &coats->of[base] : nullptr;
    if (above && above->ior == ior && above->over_glass) {
      reflected = above->mirrored;
      transmitted = Spectrum<R>::map([](R r) { return std::max(1 - r, R(0)); }, reflected);
    } else {
      detail::choose_fresnel_mix(ior, detail::coat_kind(layout, params, coat), cos_o, reflected,
                                 transmitted);
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
    switch (node.lobe) {
      case Lobe::Layer: {
        const detail::LayerLeaves<R> left(layout, params, node);
        w[a] = w[i] * left.weight;
        w[b] = w[i] * left.along(cos_o);
        break;
      }
      case Lobe::FresnelMix: {
        Spectrum<R> reflected, transmitted;
        split(p, a, b, reflected, transmitted);
        w[a] = w[i] * transmitted;
        w[b] = w[i] * reflected;
        break;
      }
      case Lobe::Coat: {
        Spectrum<R> reflected, transmitted;
        split(p + 1 + kWavelengths, b, a, reflected, transmitted);
        w[a] = w[i] * reflected;
        w[b] = w[i] * transmitted;
        // Light inside that stays there never meets the layer.
        if (wo.z < 0 && coats && coats->of[b].over_glass) break;
        for (int j = 0; j < kWavelengths; ++j)
          w[b][j] *=
              detail::layer_transmittance(p, j, cos_o) * detail::layer_transmittance(p, j, R(1));
        break;
      }
      default:
        break;
    }
  }
}

}  // namespace mms::materials
