// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The model of each node of a Bsdf, and what of it the rest of a Bsdf asks for.

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
template <class M>
inline bool knows_coats(const M& model) {
  if constexpr (requires { model.knows_coats(); })
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

/// What the model of node `i` gives and takes, as `choice` has seen it; of `kDensities` f may lack
/// what takes long. \pre CanBeSmooth
template <bool kDensities, class R, class M>
inline Lobes<R> evaluate(const M& model, Vec3<R> wo, Vec3<R> wi, Mode mode, int i,
                         const typename Bsdf<R>::Choice& choice) {
  const R share = choice.frames.share(i, wo, wi, mode);
  if (share == 0) return {};
  wo = choice.frames.seen(i, wo), wi = choice.frames.seen(i, wi);
  Lobes<R> l;
  if constexpr (requires { model.solved(); })
    l = with_seen<R>(model, i, choice, [&](const auto&... known) {
      if constexpr (kDensities && requires { model.once(wo, wi, mode, known...); })
        return model.once(wo, wi, mode, known...);
      else
        return model.evaluate(wo, wi, mode, known...);
    });
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

}  // namespace mms::materials
