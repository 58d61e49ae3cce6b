// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the functions of a Bsdf do: here how it is evaluated and sampled, given a choice.
/// materials/bsdf.cpp compiles all of them for float and double; who wants another type of numbers
/// includes this.

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "materials/bsdf_choice.h"
#include "materials/bsdf_models.h"

namespace mms::materials {

template <class R>
Lobes<R> Bsdf<R>::evaluate(Vec3<R> wo, Vec3<R> wi, Mode mode, const Choice& choice) const {
  return lobes<false>(wo, wi, mode, choice);
}

template <class R>
Spectrum<R> Bsdf<R>::pdf(Vec3<R> wo, Vec3<R> wi, Mode mode, const Choice& choice) const {
  return lobes<true>(wo, wi, mode, choice).pdf;
}

template <class R>
template <bool kDensities>
Lobes<R> Bsdf<R>::lobes(Vec3<R> wo, Vec3<R> wi, Mode mode, const Choice& choice) const {
  if (node_count() == 0 || in_surface(wo) || in_surface(wi)) return {};
  if (node_count() > 1) return sum_of_lobes<kDensities>(wo, wi, mode, choice);
  return with_model(0, Lobes<R>(), [&](const auto& model) {
    Lobes<R> l;
    if constexpr (detail::CanBeSmooth<std::decay_t<decltype(model)>>) {
      if (!detail::is_specular(model))
        l = detail::evaluate<kDensities, R>(model, wo, wi, mode, 0, choice);
      l.pdf *= choice.probability.of[0];
    }
    return l;
  });
}

template <class R>
template <bool kDensities>
Lobes<R> Bsdf<R>::sum_of_lobes(Vec3<R> wo, Vec3<R> wi, Mode mode, const Choice& choice) const {
  Lobes<R> total;
  PerNode<NodeWeight<R>> weights;
  if (!kDensities) weigh(*layout_, params_, choice.frames, choice.coats, wo, wi, mode, weights);
  for (int i = 0; i < node_count(); ++i) {
    const OverGlass<R>* glass = over_glass(i, choice);
    const bool spreads = glass && same_side(wo, wi) && !(glass->mean == Spectrum<R>());
    const R share = spreads ? choice.frames.share(i, wo, wi, mode) : R(0);
    if (share > 0) {
      const int base = coat_base(layout_->nodes()[i]);
      const Spectrum<R> spread = kDensities ? Spectrum<R>() : sent_back(base, wi, choice).spread;
      const R density = std::abs(choice.frames.seen(i, wi).z) / kPi<R>;
      for (int j = 0; j < kWavelengths; ++j) {
        if (!(glass->mean[j] > 0)) continue;
        if (!kDensities)
          total.f[j] += weights.of[base].crossing[j] * glass->colour[j] * glass->o.spread[j] *
                        spread[j] * share / (kPi<R> * glass->mean[j]);
        total.pdf[j] += choice.probability.of[i][j] * (1 - glass->mirror_share(j)) * density;
      }
    }
    with_model(i, 0, [&](const auto& model) {
      using Model = std::decay_t<decltype(model)>;
      if constexpr (detail::CanBeSmooth<Model>) {
        if (detail::is_specular(model)) return 0;
        const Lobes<R> l = detail::evaluate<kDensities, R>(model, wo, wi, mode, i, choice);
        total.pdf += l.pdf * choice.probability.of[i];
        if constexpr (kDensities) return 0;
        const NodeWeight<R>& w = weights.of[i];
        const NodeAbove& above = choice.coats.above.of[i];
        const auto coated = [&](const Spectrum<R>& counted, const Spectrum<R>& g_i) {
          return coated_weight(choice.coats, above, counted, w.other, choice.scaling.of[i], g_i);
        };
        if constexpr (requires { model.coated(wi); }) {
          if (above.any()) {
            const CoatedLobe<R> lobe = model.coated(choice.frames.seen(i, wi));
            const R z = std::abs(choice.frames.seen(above.upright(), wi).z);
            total.f +=
                l.f * coated(w.bare, coated_scaling(choice.coats, above, choice.solution(i), lobe,
                                                    {w.through_i, z},
                                                    above.tilted ? &choice.tilted.of[i] : nullptr));
            return 0;
          }
        } else if constexpr (requires { model.coated(wi, 0); }) {
          if (above.once_base >= 0 && !same_side(wo, wi)) {
            total.f +=
                l.f * coated(w.crossing, bent_scaling(choice.coats, above, choice.solution(i),
                                                      model, choice.frames.seen(i, wi)));
            return 0;
          }
        }
        if (above.once_base >= 0)
          total.f += l.f * glass_weight(w, choice.coats[above.once_base],
                                        choice.glass.of[above.once_base], wo, wi);
        else
          total.f += l.f * (detail::kLambert<R, Model>   ? w.lambert
                            : detail::knows_coats(model) ? whole_weight(w, choice.coats, above)
                                                         : w.other);
      }
      return 0;
    });
  }
  return total;
}

template <class R>
std::optional<BsdfSample<R>> Bsdf<R>::sample(Vec3<R> wo, R u_lobe, R u1, R u2, Mode mode,
                                             const Choice& choice) const {
  if (in_surface(wo) || !choice.any) return {};
  // Choose a lobe by the hero's probabilities, and stretch what is left of the number.
  int chosen = -1;
  R u = 0;
  for (int i = 0; i < node_count(); ++i) {
    const R p = choice.probability.of[i][0];
    if (!(p > 0)) continue;
    chosen = i;
    u = u_lobe / p;
    if (u_lobe < p) break;
    u_lobe -= p;
  }
  if (chosen < 0) return {};
  u = std::min(u, 1 - std::numeric_limits<R>::epsilon() / 2);
  const OverGlass<R>* glass = node_count() > 1 ? over_glass(chosen, choice) : nullptr;
  return (glass ? u < glass->mirror_share(0) : node_is_specular(chosen))
             ? sample_specular(chosen, wo, u, mode, choice)
             : sample_smooth(chosen, wo, u, u1, u2, mode, choice);
}

template <class R>
std::optional<BsdfSample<R>> Bsdf<R>::sample_smooth(int lobe, Vec3<R> wo, R u, R u1, R u2,
                                                    Mode mode, const Choice& choice) const {
  BsdfSample<R> s;
  const bool glass = node_count() > 1 && over_glass(lobe, choice);
  if (glass) {
    s.wi = square_to_cosine_hemisphere(u1, u2);
    if (wo.z < 0) s.wi.z = -s.wi.z;
    s.wi = choice.frames.unseen(lobe, s.wi);
  }
  const bool drawn = glass || with_model(lobe, false, [&](const auto& model) {
                       if constexpr (detail::CanBeSmooth<std::decay_t<decltype(model)>>)
                         return detail::sample<R>(model, wo, u, u1, u2, lobe, choice, s.wi);
                       else
                         return false;
                     });
  if (!drawn || in_surface(s.wi) || choice.frames.share(lobe, wo, s.wi, mode) == 0) return {};
  const Lobes<R> l = evaluate(wo, s.wi, mode, choice);
  s.f = l.f;
  s.pdf = l.pdf;
  s.transmitted = !same_side(wo, s.wi);
  if (!(s.pdf[0] > 0) || !std::isfinite(s.pdf[0])) return {};
  return s;
}

template <class R>
std::optional<BsdfSample<R>> Bsdf<R>::sample_specular(int lobe, Vec3<R> wo, R u, Mode mode,
                                                      const Choice& choice) const {
  const auto terms_of = [&](int i) {
    if (const OverGlass<R>* glass = node_count() > 1 ? over_glass(i, choice) : nullptr) {
      SpecularTerms<R> terms = mirror_terms(glass->o.mirrored);
      for (int j = 0; j < kWavelengths; ++j) terms.reflect_probability[j] = glass->mirror_share(j);
      return terms;
    }
    return with_model(i, SpecularTerms<R>{}, [&](const auto& model) {
      if constexpr (detail::CanBeSpecular<std::decay_t<decltype(model)>>)
        if (detail::is_specular(model)) return model.terms(choice.frames.seen(i, wo));
      return SpecularTerms<R>{};
    });
  };
  // Choose between reflection and refraction by the hero's probabilities.
  const SpecularTerms<R> mine = terms_of(lobe);
  const bool reflect = u < mine.reflect_probability[0];
  if (!reflect && !(mine.transmit_probability[0] > 0)) return {};
  BsdfSample<R> s;
  s.specular = true;
  s.transmitted = !reflect;
  const R eta = mine.eta[0];
  const Vec3<R> seen = choice.frames.seen(lobe, wo);
  s.wi = choice.frames.unseen(lobe, reflect ? mirrored(seen) : refracted(seen, eta));
  const R share = choice.frames.share(lobe, wo, s.wi, mode);
  if (in_surface(s.wi) || share == 0) return {};
  // Sum the deltas of all lobes that fall on this very direction.
  PerNode<NodeWeight<R>> weights;
  if (node_count() == 1)
    weights.of[0] = {};
  else
    weigh(*layout_, params_, choice.frames, choice.coats, wo, s.wi, mode, weights);
  for (int i = 0; i < node_count(); ++i) {
    if (choice.frames.tilt(i) != choice.frames.tilt(lobe)) continue;
    const R cos_i = std::abs(choice.frames.seen(i, s.wi).z);
    const SpecularTerms<R> t = i == lobe ? mine : terms_of(i);
    Spectrum<R> weight = weights.of[i].other;
    if (node_count() > 1) {
      const NodeAbove& above = choice.coats.above.of[i];
      const int upright = above.any() ? above.upright() : i;
      if (const OverGlass<R>* glass = over_glass(i, choice))
        weight = weights.of[coat_base(layout_->nodes()[i])].crossing * glass->colour;
      else if (above.once_base >= 0)
        weight = glass_weight(weights.of[i], choice.coats[above.once_base],
                              choice.glass.of[above.once_base], wo, s.wi);
      else
        weight = delta_weight(weights.of[i], choice.coats, above,
                              std::abs(choice.frames.seen(upright, wo).z));
    }
    for (int j = 0; j < kWavelengths; ++j) {
      if (!reflect && t.eta[j] != eta) continue;
      const R scale = reflect || mode == Mode::Importance ? share : share / (eta * eta);
      s.f[j] += weight[j] * (reflect ? t.reflect_weight : t.transmit_weight)[j] * scale / cos_i;
      s.pdf[j] += choice.probability.of[i][j] *
                  (reflect ? t.reflect_probability : t.transmit_probability)[j];
    }
  }
  if (!(s.pdf[0] > 0)) return {};
  return s;
}

}  // namespace mms::materials
