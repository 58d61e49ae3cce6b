// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the functions of a Bsdf do. materials/bsdf.cpp compiles them for float and double; who
/// wants another type of numbers includes this.

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "materials/baselines.h"
#include "materials/bsdf.h"
#include "materials/combine.h"
#include "materials/conductor.h"
#include "materials/film.h"
#include "materials/glossy_refraction.h"
#include "materials/matte.h"
#include "materials/oren_nayar.h"
#include "materials/phong_glass.h"
#include "materials/radial.h"
#include "materials/sheen.h"
#include "materials/slab.h"
#include "materials/specular.h"

namespace mms::materials {

static_assert(kMaxGloss == axes::kLargestGloss, "a coat's table ends where gloss does");

namespace detail {

/// True of models that can be a delta, and of those that can be something else.
template <class M>
concept CanBeSpecular = requires(const M& m) {
  m.terms({});
};
template <class M>
concept CanBeSmooth = requires(const M& m) {
  m.evaluate({}, {}, Mode{});
}
|| requires(const M& m) { m.seen({}, m.solved()); };

/// Whether a coat's factor for Lambert lobes (materials/combine.h) is the model's.
template <class R, class M>
inline constexpr bool kLambert = std::is_same_v<M, Matte<R>> || std::is_same_v<M, Translucent<R>>;

/// Whether the model is an interface of which it is known what coats send back.
template <class R, class M>
inline bool knows_coats(const M& model) {
  if constexpr (std::is_same_v<M, Refraction<R>>)
    return true;
  else if constexpr (requires { model.knows_coats(); })
    return model.knows_coats();
  else
    return false;
}

/// What the model's lobe is around, where light is seen along `w`.
template <class M, class R>
inline Vec3<R> middle(const M&, Vec3<R> w) {
  if constexpr (requires { M::unfolded(w); })
    return M::unfolded(mirrored(w));
  else
    return mirrored(w);
}

/// Remembers what the model of node `i` is, and along `wo`, in its frame, if it is more than its
/// numbers.
template <class R, class M>
inline void see(const M& model, const Layout& layout, const R* params, Vec3<R> wo, int i,
                typename Bsdf<R>::Choice& choice) {
  if constexpr (requires { model.solved(); }) {
    using Solved = decltype(model.solved());
    const SolvedModel<R>& its = choice.models.solve(i, layout.nodes()[i], params, model);
    choice.seen.of[i] = model.seen(wo, its.template get<Solved>());
  }
}
/// `visit(solved, seen)` of that.
template <class R, class M, class Visit>
inline auto with_seen(const M& model, int i, const typename Bsdf<R>::Choice& choice,
                      const Visit& visit) {
  return visit(choice.models[i].template get<decltype(model.solved())>(), choice.seen.of[i]);
}

/// What the model of node `i` gives and takes, as `choice` has seen it. \pre CanBeSmooth
template <class R, class M>
inline Lobes<R> evaluate(const M& model, Vec3<R> wo, Vec3<R> wi, Mode mode, int i,
                         const typename Bsdf<R>::Choice& choice) {
  const R share = choice.frames.share(i, wo, wi, mode);
  if (share == 0) return {};
  wo = choice.frames.seen(i, wo), wi = choice.frames.seen(i, wi);
  Lobes<R> l;
  if constexpr (requires { model.solved(); })
    l = with_seen<R>(model, i, choice,
                     [&](const auto&... known) { return model.evaluate(wo, wi, mode, known...); });
  else
    l = model.evaluate(wo, wi, mode);
  if (share != 1) l.f *= share;
  return l;
}
template <class R, class M>
inline bool sample(const M& model, Vec3<R> wo, R u_lobe, R u1, R u2, int i,
                   const typename Bsdf<R>::Choice& choice, Vec3<R>& wi) {
  wo = choice.frames.seen(i, wo);
  bool drawn;
  if constexpr (requires { model.solved(); })
    drawn = with_seen<R>(model, i, choice, [&](const auto&... known) {
      return model.sample(wo, u_lobe, u1, u2, known..., wi);
    });
  else
    drawn = model.sample(wo, u_lobe, u1, u2, wi);
  wi = choice.frames.unseen(i, wi);
  return drawn;
}

template <class M>
inline bool is_specular(const M& model) {
  if constexpr (!CanBeSmooth<M>)
    return true;
  else if constexpr (!CanBeSpecular<M>)
    return false;
  else
    return model.specular();
}

/// What coats over the model of node `i` send back of light along `w`, of its frame.
template <class R, class M>
inline SentBack<R> sent_back(const M& model, Vec3<R> w, int i, const CoatsOnGlass<R>& coats,
                             const typename Bsdf<R>::Choice& choice) {
  if constexpr (requires { model.sent_back(w, coats, model.solved()); }) {
    using Solved = decltype(model.solved());
    if (!is_specular(model))
      return model.sent_back(w, coats, choice.models[i].template get<Solved>());
  } else if constexpr (requires { model.sent_back(w, coats); }) {
    if (!is_specular(model)) return model.sent_back(w, coats);
  }
  return SentBack<R>::smooth(model.terms(w), w, coats);
}

}  // namespace detail

template <class R>
template <class Result, class Visit>
Result Bsdf<R>::with_model(int i, Result none, const Visit& visit) const {
  const Layout::Node& node = layout_->nodes()[i];
  const R* p = params_ + node.first_param;
  switch (node.lobe) {
    case Lobe::Matte:
      return visit(Matte<R>(p));
    case Lobe::Translucent:
      return visit(Translucent<R>(p));
    case Lobe::Glossy:
      return visit(Glossy<R>(p));
    case Lobe::GlossyProduct:
      return visit(GlossyProduct<R>(p));
    case Lobe::GlossyBack:
      return visit(GlossyBack<R>(p));
    case Lobe::GlossyThrough:
      return visit(GlossyThrough<R>(p));
    case Lobe::OrenNayar:
      return visit(OrenNayar<R>(p));
    case Lobe::RoughMatte:
      return visit(RoughMatte<R>(p));
    case Lobe::Phong:
      return visit(Phong<R>(p));
    case Lobe::MaxPhong:
      return visit(MaxPhong<R>(p));
    case Lobe::Spot:
      return visit(Spot<R>(p));
    case Lobe::Ward:
      return visit(Ward<R>(p));
    case Lobe::AshikhminShirley:
      return visit(AshikhminShirley<R>(p));
    case Lobe::Sheen:
      return visit(Sheen<R>(p));
    case Lobe::Microfacet:
      return visit(Microfacet<R>(p));
    case Lobe::Beckmann:
      return visit(BeckmannMirror<R>(p));
    case Lobe::Conductor:
      return visit(Conductor<R>(p));
    case Lobe::ColouredMetal:
      return visit(ColouredMetal<R>(p));
    case Lobe::Dielectric:
      return visit(Dielectric<R>(p));
    case Lobe::BeckmannDielectric:
      return visit(BeckmannDielectric<R>(p));
    case Lobe::PhongGlass:
      return visit(PhongGlass<R>(p));
    case Lobe::Slab:
      return visit(Slab<R>(p));
    case Lobe::FilmConductor:
      return visit(FilmConductor<R>(p));
    case Lobe::FilmDielectric:
      return visit(FilmDielectric<R>(p));
    case Lobe::Mirror:
      return visit(Mirror<R>(p));
    case Lobe::Refraction:
      return visit(Refraction<R>(p));
    case Lobe::GlossyRefraction:
      return visit(GlossyRefraction<R>(p));
    case Lobe::Isotropic:
    case Lobe::HenyeyGreenstein:
    case Lobe::RayleighPhase:
    case Lobe::Draine:
    case Lobe::Mix:
    case Lobe::FresnelMix:
    case Lobe::FilmMix:
    case Lobe::Coat:
    case Lobe::Scale:
    case Lobe::Add:
    case Lobe::Layer:
    case Lobe::Turn:
    case Lobe::Tilt:
      break;
  }
  return none;
}

template <class R>
bool Bsdf<R>::node_is_specular(int i) const {
  return with_model(i, false, [](const auto& model) { return detail::is_specular(model); });
}

template <class R>
bool Bsdf<R>::specular_only() const {
  for (int i = 0; i < node_count(); ++i)
    if (with_model(i, false, [](const auto& model) { return !detail::is_specular(model); }))
      return false;
  return true;
}

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
      return with_model(lobe, false,
                        [](const auto& model) { return detail::knows_coats<R>(model); });
    });
  for (auto& known : choice.spread_known) known.reset();
  choice.solved.reset();
  for (int i = 0; i < node_count(); ++i) {
    const NodeAbove& above = choice.coats.above.of[i];
    const auto solve = [&](const CoatedLobe<R>& lobe) {
      if (!above.any() || !is_solved_for(choice.coats, above)) return;
      choice.under.solve(i, lobe, coats_above(choice.coats, above, lobe.broad(), lobe.stretched()));
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
  // the same for each wavelength, whichever is the hero.
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
      const R t = R(gauss<kPoints>().x[k]), x = at + reach * t * t * t;
      const R z = std::sqrt(x), s = std::sqrt(1 - x);
      const R weight = R(gauss<kPoints>().w[k]) * 3 * t * t * std::abs(reach);
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

template <class R>
Lobes<R> Bsdf<R>::evaluate(Vec3<R> wo, Vec3<R> wi, Mode mode, const Choice& choice) const {
  if (node_count() == 0 || in_surface(wo) || in_surface(wi)) return {};
  if (node_count() > 1) return sum_of_lobes(wo, wi, mode, choice);
  return with_model(0, Lobes<R>(), [&](const auto& model) {
    Lobes<R> l;
    if constexpr (detail::CanBeSmooth<std::decay_t<decltype(model)>>) {
      if (!detail::is_specular(model)) l = detail::evaluate<R>(model, wo, wi, mode, 0, choice);
      l.pdf *= choice.probability.of[0];
    }
    return l;
  });
}

template <class R>
Lobes<R> Bsdf<R>::sum_of_lobes(Vec3<R> wo, Vec3<R> wi, Mode mode, const Choice& choice) const {
  Lobes<R> total;
  PerNode<NodeWeight<R>> weights;
  weigh(*layout_, params_, choice.frames, choice.coats, wo, wi, mode, weights);
  for (int i = 0; i < node_count(); ++i) {
    const OverGlass<R>* glass = over_glass(i, choice);
    const bool spreads = glass && same_side(wo, wi) && !(glass->mean == Spectrum<R>());
    const R share = spreads ? choice.frames.share(i, wo, wi, mode) : R(0);
    if (share > 0) {
      const int base = coat_base(layout_->nodes()[i]);
      const Spectrum<R> spread = sent_back(base, wi, choice).spread;
      const R density = std::abs(choice.frames.seen(i, wi).z) / kPi<R>;
      for (int j = 0; j < kWavelengths; ++j) {
        if (!(glass->mean[j] > 0)) continue;
        total.f[j] += weights.of[base].crossing[j] * glass->colour[j] * glass->o.spread[j] *
                      spread[j] * share / (kPi<R> * glass->mean[j]);
        total.pdf[j] += choice.probability.of[i][j] * (1 - glass->mirror_share(j)) * density;
      }
    }
    with_model(i, 0, [&](const auto& model) {
      using Model = std::decay_t<decltype(model)>;
      if constexpr (detail::CanBeSmooth<Model>) {
        if (detail::is_specular(model)) return 0;
        const Lobes<R> l = detail::evaluate<R>(model, wo, wi, mode, i, choice);
        total.pdf += l.pdf * choice.probability.of[i];
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
          total.f += l.f * (detail::kLambert<R, Model>      ? w.lambert
                            : detail::knows_coats<R>(model) ? whole_weight(w, choice.coats, above)
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
