// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What a Bsdf knows before `wi`: of its material, and of light along `wo` (Bsdf::Choice).

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "materials/bsdf_models.h"

namespace mms::materials {

template <class R>
void Bsdf<R>::choose(Vec3<R> wo, Choice& choice) const {
  choice.any = false;
  choice.frames.reset();
  if (node_count() == 0 || in_surface(wo)) return;
  auto& probability = choice.probability.of;
  // Of a node's model; what that has seen along `wo` is remembered.
  const auto estimate = [&](int i) {
    const Vec3<R> w = choice.frames.seen(i, wo);
    return with_model(i, Spectrum<R>(), [&](const auto& model) {
      if (!detail::is_specular(model)) detail::see<R>(model, *layout_, params_, w, i, choice);
      return model.estimate(w);
    });
  };
  // Below this the inverse would overflow: black.
  constexpr R least = std::numeric_limits<R>::min() / std::numeric_limits<R>::epsilon();
  if (node_count() == 1) {
    probability[0] = Spectrum<R>::map([](R x) { return R(x > least); }, estimate(0));
    choice.any = probability[0][0] > 0;
    return;
  }
  Spectrum<R> sum;
  choice.frames.find(*layout_, params_, wo);
  PerNode<Spectrum<R>> estimates;
  for (int i = 0; i < node_count(); ++i) estimates.of[i] = estimate(i);
  if (!choice.material.is(*layout_, params_)) know_material(choice);
  see_coats(*layout_, params_, choice.frames, wo, choice.coats);
  if (layout_->transmits()) see_coated_glass(wo, choice);
  weigh_for_choice(*layout_, params_, choice.frames, wo, &choice.coats, choice.probability);
  for (int i = 0; i < node_count(); ++i) {
    const OverGlass<R>* glass = over_glass(i, choice);
    probability[i] *= glass ? glass->o.all() * glass->colour : estimates.of[i];
    sum += probability[i];
  }
  for (int j = 0; j < kWavelengths; ++j) sum[j] = sum[j] > least ? 1 / sum[j] : R(0);
  for (int i = 0; i < node_count(); ++i) probability[i] *= sum;
  choice.any = sum[0] > 0;
  for (int i = 0; i < node_count(); ++i) {
    const NodeAbove& above = choice.coats.above.of[i];
    if (!above.any()) continue;
    const Vec3<R> w = choice.frames.seen(i, wo);
    with_model(i, 0, [&](const auto& model) {
      if constexpr (requires { model.coated(w); }) {
        if (detail::is_specular(model)) return 0;
        const CoatedLobe<R> lobe = model.coated(w);
        choice.scaling.of[i] =
            coated_scaling(choice.coats, above, choice.solution(i), lobe,
                           {above.coated() ? choice.coats[above.base].through_o : Spectrum<R>(R(1)),
                            std::abs(choice.frames.seen(above.upright(), wo).z)});
        if (!above.tilted) return 0;
        const Vec3<R> middle = choice.frames.unseen(i, detail::middle(model, w));
        choice.tilted.of[i] =
            tilted_share(choice.coats, above, lobe, {choice.coats, choice.frames, above, middle});
        for (int j = 0; j < kWavelengths; ++j) choice.scaling.of[i][j] /= choice.tilted.of[i][j];
      } else if constexpr (requires { model.coated(w, 0); }) {
        if (!detail::is_specular(model) && above.once_base >= 0)
          choice.scaling.of[i] = bent_scaling(choice.coats, above, choice.solution(i), model, w);
      }
      return 0;
    });
  }
}

template <class R>
void Bsdf<R>::know_material(Choice& choice) const {
  choice.material.keep(*layout_, params_);
  find_coats(*layout_, params_, choice.coats);
  if (layout_->transmits())
    find_glass(*layout_, params_, choice.coats, choice.glass, [&](int lobe) {
      return with_model(lobe, false, [](const auto& model) { return detail::knows_coats(model); });
    });
  for (auto& known : choice.spread_known) known.reset();
  choice.solved.reset();
  for (int i = 0; i < node_count(); ++i) {
    const NodeAbove& above = choice.coats.above.of[i];
    const auto solve = [&](const CoatedLobe<R>& lobe) {
      if (!above.any() || !is_solved_for(choice.coats, above)) return;
      if (lobe.stretched() && !choice.stretched)
        choice.stretched = std::make_unique<StretchedSolutions<R>>();
      choice.under.solve(i, lobe, coats_above(choice.coats, above, lobe.broad()), choice.stretched,
                         i);
      choice.solved.set(i);
    };
    with_model(i, 0, [&](const auto& model) {
      const Vec3<R> up{0, 0, 1};  // lobes are as wide along any direction
      if constexpr (detail::kLambert<R, std::decay_t<decltype(model)>>) {
        if (const int base = above.base; base >= 0)
          choice.coats[base].mean = mean_through_coats(i, base, choice);
      } else if constexpr (requires { model.coated(up); }) {
        if (!detail::is_specular(model)) solve(model.coated(up));
      } else if constexpr (requires { model.coated(up, 0); }) {
        if (!detail::is_specular(model) && above.once_base >= 0) solve(model.coated(up, 0));
      }
      return 0;
    });
  }
}

template <class R>
Spectrum<R> Bsdf<R>::mean_through_coats(int lobe, int base, Choice& choice) const {
  SolvedCoat<R>& alone = choice.coats.solved[base];
  if (choice.coats[base].upper < 0 && !alone.numbers().filmed()) return alone.mean_through();
  return choice.means.solve(lobe, coats_above(choice.coats, choice.coats.above.of[base])).mean();
}

template <class R>
void Bsdf<R>::see_coated_glass(Vec3<R> wo, Choice& choice) const {
  for (int i = 0; i < node_count(); ++i) {
    if (!choice.coats.starts_at(i) || !choice.coats[i].over_glass) continue;
    OverGlass<R>& glass = choice.glass.of[i];
    glass.colour = choice.coats[i].kind.colour;
    glass.o = sent_back(i, wo, choice);
    const bool inside = wo.z < 0;
    glass.mean = {};
    if (glass.o.spread == Spectrum<R>()) continue;
    auto& known = choice.spread_known[inside];
    if (!known[i]) choice.mean_spread[inside].of[i] = mean_spread(i, inside, choice);
    known.set(i);
    glass.mean = choice.mean_spread[inside].of[i];
  }
}

template <class R>
Sent<R> Bsdf<R>::sent_back(int base, Vec3<R> w, const Choice& choice) const {
  const CoatsOnGlass<R> coats{choice.coats, base, choice.glass.of[base].law};
  Sent<R> sent;
  const auto add = [&](const SentBack<R>& back, const Spectrum<R>& weight) {
    for (int j = 0; j < kWavelengths; ++j) {
      // Of light outside, directions say what passes the layers (materials/combine.h).
      const R layers = choice.frames.seen(base, w).z > 0 ? R(1) : coats.layers(j, back.cosine[j]);
      const R share = weight[j] * back.share[j] * layers * layers;
      const R spread = back.broad * choice.coats[base].kind.broad(j);
      sent.mirrored[j] += share * (1 - spread);
      sent.spread[j] += share * spread;
    }
  };
  for_each_below(*layout_, params_, choice.coats, base, [&](int i, const Spectrum<R>& weight) {
    if (choice.coats.above.of[i].once_base < 0) return;
    const Vec3<R> seen = choice.frames.seen(i, w);
    with_model(i, 0, [&](const auto& model) {
      if constexpr (detail::CanBeSpecular<std::decay_t<decltype(model)>>)
        add(detail::sent_back<R>(model, seen, i, coats, choice), weight);
      return 0;
    });
  });
  return sent;
}

template <class R>
Spectrum<R> Bsdf<R>::mean_spread(int base, bool inside, const Choice& choice) const {
  // Over x = z^2 and, by steps of pi / 8, azimuths: one where all are alike, a quarter of the turn
  // of stretched facets, and half of it where axes are turned. Points crowd about a critical angle,
  // the same for each wavelength, whichever is the hero, and outside towards grazing too.
  R at = 0;
  bool stretched = false;
  for_each_below(*layout_, params_, choice.coats, base, [&](int i, const Spectrum<R>&) {
    if (choice.coats.above.of[i].once_base < 0) return;
    with_model(i, 0, [&](const auto& model) {
      if constexpr (requires { model.ior; })
        for (int j = 0; j < kWavelengths; ++j) {
          const R eta = relative_eta(model.ior[j], Vec3<R>{0, 0, R(inside ? -1 : 1)});
          at = std::max(at, (1 - eta) * (1 + eta));
        }
      if constexpr (requires { model.facets; }) stretched |= model.facets.ax != model.facets.ay;
      return 0;
    });
  });
  Spectrum<R> mean;
  constexpr int kPoints = 8;
  for (const R reach : {-at, 1 - at}) {
    if (reach == 0) continue;
    for (int k = 0; k < kPoints; ++k) {
      const bool both_ends = !inside && reach < 0;
      const R t = R(gauss<kPoints>().x[k]),
              x = at + reach * (both_ends ? t * t * (3 - 2 * t) : t * t * t);
      const R z = std::sqrt(x), s = std::sqrt(1 - x);
      const R slope = both_ends ? 6 * t * (1 - t) : 3 * t * t;
      const R weight = R(gauss<kPoints>().w[k]) * slope * std::abs(reach);
      const int azimuths = !stretched ? 1 : choice.frames.any() ? 8 : 4;
      for (int a = 0; a < azimuths; ++a) {
        const R phi = (R(a) + R(0.5)) * (kPi<R> / 8);
        const Vec3<R> w{s * std::cos(phi), s * std::sin(phi), inside ? -z : z};
        mean +=
            sent_back(base, choice.frames.unseen(base, w), choice).spread * (weight / R(azimuths));
      }
    }
  }
  return mean;
}

template <class R>
const OverGlass<R>* Bsdf<R>::over_glass(int i, const Choice& choice) const {
  const int base = coat_base(layout_->nodes()[i]);
  if (base < 0 || !choice.coats.starts_at(base) || !choice.coats[base].over_glass) return nullptr;
  return &choice.glass.of[base];
}

}  // namespace mms::materials
