// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// `dielectric` and `beckmann_dielectric`: an interface that reflects by Fresnel and refracts the
/// rest, ideal at roughness 0, else GGX or Beckmann facets (Walter et al. 2007). Each wavelength
/// has its own index, so a rough direction is looked up with a different half vector for each: that
/// is what the hypothetical pdfs hold. What facets send on to other facets is given back on both
/// sides (materials/energy.h).

#include <utility>

#include "materials/fresnel.h"
#include "materials/glass_coat.h"
#include "materials/microfacet.h"

namespace mms::materials {

/// What facets of an interface lose to further bounces, of what comes from where the index beyond
/// is `eta` times as high.
template <class Facets, class R>
inline InterfaceLoss<R> interface_loss(const Facets& facets, R eta) {
  return {facets.interface(), facets.ax, facets.ay, eta};
}

/// What is at each facet of a bare interface; another face has the same members.
template <class R>
struct BareFace {
  static constexpr bool kFilmed = false;
  static constexpr int kNumbers = 0;  ///< of its own, behind the index

  explicit BareFace(const R*) {}

  /// Whether it is as at the wavelength before, if the index is.
  bool repeated(int) const { return true; }
  /// Of light along a direction of cosine `c` that meets the index ratio `eta`, from outside or
  /// not.
  FresnelSplit<R> split(int, R c, R eta, bool) const { return fresnel_split(c, eta); }
  /// The same at a facet of a rough interface.
  FresnelSplit<R> facet(int, R c, R eta, bool) const { return fresnel_split(c, eta); }

  /// What facets lose along a direction and in the mean, for one index and all wavelengths of it.
  using Loss = R;
  template <class Facets>
  Loss loss(const Facets&, const InterfaceLoss<R>& bare, Vec3<R> w) const {
    return bare.at(w);
  }
  template <class Facets>
  Loss mean_loss(const Facets&, const InterfaceLoss<R>& bare) const {
    return bare.mean();
  }
  /// What that is at one of the wavelengths.
  struct Law {
    R of(Loss loss) const { return loss; }
  };
  struct Shared {};       ///< by laws of the same indices
  struct SentWeights {};  ///< of what coats send back, besides those of any interface
  Law law(int, R, Shared&) const { return {}; }
};

/// What of facets of an interface is alike along all directions, for each wavelength; [0] of
/// directions outside, [1] inside.
template <class R, class Face>
struct InterfaceSolved {
  std::array<typename Face::Law, kWavelengths> law;
  std::array<InterfaceLoss<R>, kWavelengths> bare[2];  ///< by the first bounce; of each index once
  BounceSampling<R> bounces = {};                      ///< how directions of further ones are drawn
  Spectrum<R> mean[2];                                 ///< over the hemisphere, what is lost
  Spectrum<R> transmit[2];                             ///< share of that which goes to the far side

  /// Where what is lost at wavelength j goes.
  FresnelSplit<R> further(bool inside, int j) const {
    return {1 - transmit[inside][j], transmit[inside][j]};
  }
};

template <class R, template <class> class Distribution, class Face = BareFace<R>>
struct RoughInterface {
  using Solved = InterfaceSolved<R, Face>;

  const R* ior;
  Face face;
  Distribution<R> facets;
  Spectrum<R> reflected, transmitted;

  explicit RoughInterface(const R* p) : RoughInterface(p, p + kWavelengths + Face::kNumbers) {}

  /// Also where refraction bends so little at every wavelength that the transmitted lobe, of width
  /// about alpha |ior - 1|, is narrower than a float direction resolves (see kMinAlpha).
  bool specular() const {
    if (facets.specular()) return true;
    R bend = 0;
    for (int j = 0; j < kWavelengths; ++j) {
      const R eta = relative_eta(ior[j], Vec3<R>{0, 0, 1});
      bend = std::max(bend, std::abs(eta - 1));
    }
    return !(narrow() * bend >= R(kMinAlpha));
  }

  Spectrum<R> estimate(Vec3<R> wo) const {
    return interface_estimate(ior, wo, reflected, transmitted, Face::kFilmed || !specular());
  }

  SpecularTerms<R> terms(Vec3<R> wo) const {
    const R c = std::min(std::abs(wo.z), R(1));
    FresnelSplit<R> s{};
    return interface_terms(ior, wo, reflected, transmitted, [&](int j, R eta) {
      if (!repeated(j)) s = face.split(j, c, eta, wo.z > 0);
      return s;
    });
  }

  /// Whether it is known what coats send back.
  bool knows_coats() const {
    bool known = true;
    for (int j = 0; j < kWavelengths; ++j) known &= in_glass_tables(rough_eta(j, Vec3<R>{0, 0, 1}));
    return known || specular();
  }
  /// That, of light along `w`; `coats` as in SentBack::smooth. \pre not specular
  template <class Coats>
  SentBack<R> sent_back(Vec3<R> w, const Coats& coats, const Solved& solved) const {
    Spectrum<R> eta;
    for (int j = 0; j < kWavelengths; ++j) eta[j] = rough_eta(j, w);
    const bool outside = w.z > 0;
    Further further;
    if constexpr (Face::kFilmed) further = further_outside(w, eta, solved);
    R last = 0;  // the index that the weights are of
    GlassWeights<R> weights;
    typename Face::SentWeights film_weights;
    const auto sent = [&](int j, const CoatOnGlass<R>& law) {
      if (std::exchange(last, eta[j]) != eta[j]) {
        weights = {glass_tables(facets), facets.ax, facets.ay, w, eta[j]};
        if constexpr (Face::kFilmed)
          film_weights = {StretchedFacets<R>::of(facets.ax, facets.ay,
                                                 {w.x, w.y, std::min(std::abs(w.z), R(1))}),
                          eta[j], !outside};
      }
      R all = weights.sent_back(law);
      if constexpr (Face::kFilmed)
        all +=
            film_weights.more_sent_back(law, solved.law[j].q, further.bare[j], further.filmed[j]);
      return all;
    };
    return SentBack<R>::rough(
        w, eta, outside ? reflected : transmitted,
        Broadness<R>::facets(std::sqrt(facets.ax * facets.ay)), coats,
        [this](int j) { return repeated(j); }, sent);
  }

  Solved solved() const {
    Solved s;
    s.bounces = BounceSampling<R>(facets.ax * facets.ay);
    typename Face::Loss outside, inside;
    typename Face::Shared shared;
    for (int j = 0; j < kWavelengths; ++j) {
      const R eta = rough_eta(j, Vec3<R>{0, 0, 1});
      if (!same_index(j)) {
        outside = face.mean_loss(facets, s.bare[0][j] = interface_loss(facets, eta));
        inside = face.mean_loss(facets, s.bare[1][j] = interface_loss(facets, 1 / eta));
      }
      s.law[j] = face.law(j, eta, shared);
      const R out = s.mean[0][j] = s.law[j].of(outside), in = s.mean[1][j] = s.law[j].of(inside);
      s.transmit[0][j] = transmitted_share(out, in, eta);
      s.transmit[1][j] = transmitted_share(in, out, 1 / eta);
    }
    return s;
  }

  FacetsSeen<R> seen(Vec3<R> wo, const Solved& solved) const {
    return {facets.shadow(wo), lost(wo, solved)};
  }

  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode mode, const Solved& solved,
                    const FacetsSeen<R>& seen) const {
    Lobes<R> out = once(wo, wi, mode, solved, seen);
    const bool reflects = same_side(wo, wi);
    const Spectrum<R>& mean = solved.mean[wi.z < 0];
    const Spectrum<R> spread = lost(wi, solved);  // by further bounces
    R eta = 1;
    for (int j = 0; j < kWavelengths; ++j) {
      if (!same_index(j)) eta = rough_eta(j, wo);
      const R shape = spread[j] / (kPi<R> * mean[j]);
      const FresnelSplit<R> further = solved.further(wo.z < 0, j);
      const R f =
          reflects ? further.reflected * reflected[j] : further.transmitted * transmitted[j];
      const R scale = reflects || mode == Mode::Importance ? R(1) : 1 / (eta * eta);
      out.f[j] += seen.lost[j] * f * shape * scale;
    }
    return out;
  }
  /// The same, but f of the first bounce alone: what goes on takes as long as all else.
  Lobes<R> once(Vec3<R> wo, Vec3<R> wi, Mode mode, const Solved& solved,
                const FacetsSeen<R>& seen) const {
    const bool reflects = same_side(wo, wi);
    Lobes<R> out = reflects ? evaluate_reflection(wo, wi, seen.shadow)
                            : evaluate_transmission(wo, wi, seen.shadow, mode);
    const R pdf = solved.bounces.pdf(std::abs(wi.z));
    for (int j = 0; j < kWavelengths; ++j) {
      const Choice c = choose(j, solved.further(wo.z < 0, j));
      out.pdf[j] = (1 - seen.lost[j]) * out.pdf[j] +
                   seen.lost[j] * (reflects ? c.reflect : c.transmit) * pdf;
    }
    return out;
  }

  bool sample(Vec3<R> wo, R u_lobe, R u1, R u2, const Solved& solved, const FacetsSeen<R>& seen,
              Vec3<R>& wi) const {
    const Vec3<R> up = to_upper(wo, wo);
    const R lost = seen.lost[0];
    if (u_lobe < lost) {
      const Choice c = choose(0, solved.further(wo.z < 0, 0));
      if (!(c.reflect + c.transmit > 0)) return false;
      wi = solved.bounces.sample(u1, u2);
      if (!(wi.z > 0)) return false;
      const bool down = u_lobe >= c.reflect * lost;
      wi.z = down == (wo.z > 0) ? -wi.z : wi.z;
      return true;
    }
    u_lobe = (u_lobe - lost) / (1 - lost);
    const Vec3<R> h = facets.sample_visible(up, u1, u2);
    const R c = dot(up, h);
    if (!(c > 0)) return false;
    const R eta = rough_eta(0, wo);
    const Choice choice = choose(0, face.facet(0, std::min(c, R(1)), eta, wo.z > 0));
    if (u_lobe < choice.reflect) {
      wi = normalize(h * (2 * c) - up);
      if (!(wi.z > 0)) return false;
    } else {
      const R g2 = refraction_g2(c, eta);
      if (!(g2 > 0) || !(choice.transmit > 0)) return false;
      // -wo / eta + (c - g) / eta h, with c - g = (1 - eta^2) / (c + g)
      const R shift = (1 - eta) * (1 + eta) / (c + std::sqrt(g2));
      wi = normalize(h * shift - up);
      if (!(wi.z < 0)) return false;
    }
    wi = to_upper(wi, wo);
    return true;
  }

 private:
  struct Choice {
    R reflect = 0, transmit = 0;
  };

  /// Numbers of the face stand between those at `p` and those at `rest`.
  RoughInterface(const R* p, const R* rest)
      : ior(p),
        face(p),
        facets{Alpha<R>::from(rest[0], rest[2 * kWavelengths + 1])},
        reflected(weight_at(rest + 1)),
        transmitted(weight_at(rest + kWavelengths + 1)) {}

  R narrow() const { return std::min(facets.ax, facets.ay); }

  /// Index ratio with the bend kept above what `specular()` resolves; wavelengths of one material
  /// differ little, so this matters only where a dispersion curve crosses 1.
  R rough_eta(int j, Vec3<R> wo) const {
    const R n = relative_eta(ior[j], Vec3<R>{0, 0, 1});
    const R least = R(kMinAlpha) / narrow();
    const R bent = std::abs(n - 1) >= least ? n : n < 1 ? 1 - std::min(least, R(0.5)) : 1 + least;
    return wo.z > 0 ? bent : 1 / bent;
  }

  /// By the first bounce of light along `w`.
  Spectrum<R> lost(Vec3<R> w, const Solved& solved) const {
    Spectrum<R> to;
    typename Face::Loss loss;
    for (int j = 0; j < kWavelengths; ++j) {
      if (!same_index(j)) loss = face.loss(facets, solved.bare[w.z < 0][j], w);
      to[j] = solved.law[j].of(loss);
    }
    return to;
  }

  /// What of light along `w` bounces on and then goes outside.
  struct Further {
    Spectrum<R> bare, filmed;
  };
  Further further_outside(Vec3<R> w, const Spectrum<R>& eta, const Solved& solved) const {
    Further to;
    typename Face::Loss loss;
    const bool inside = w.z < 0;
    R transmit = 0;
    for (int j = 0; j < kWavelengths; ++j) {
      if (!same_index(j)) {
        const InterfaceLoss<R>&here = solved.bare[inside][j], &there = solved.bare[!inside][j];
        loss = face.loss(facets, here, w);
        transmit = transmitted_share(here.mean(), there.mean(), eta[j]);
      }
      const R filmed = solved.transmit[inside][j];
      to.bare[j] = loss.bare * (inside ? transmit : 1 - transmit);
      to.filmed[j] = solved.law[j].of(loss) * (inside ? filmed : 1 - filmed);
    }
    return to;
  }

  bool same_index(int j) const { return j > 0 && ior[j] == ior[j - 1]; }
  /// All is as at the wavelength before.
  bool repeated(int j) const {
    return same_index(j) && face.repeated(j) && reflected[j] == reflected[j - 1] &&
           transmitted[j] == transmitted[j - 1];
  }

  /// Probabilities of the two directions at a facet.
  Choice choose(int j, FresnelSplit<R> s) const {
    const R r = s.reflected * reflected[j], t = s.transmitted * transmitted[j];
    const R sum = r + t;
    if (!(sum > 0)) return {};
    return {r / sum, t / sum};
  }

  /// By the first bounce; `shadow` is that of `wo`.
  Lobes<R> evaluate_reflection(Vec3<R> wo, Vec3<R> wi, R shadow) const {
    Lobes<R> out;
    const Vec3<R> o = to_upper(wo, wo), i = to_upper(wi, wo);
    const HalfVector<R> half(o, i);
    const Vec3<R> h = half.h;
    if (!(h.z > 0)) return out;
    const R f = facets.density(h) * materials::masking(facets, o, shadow, i),
            pdf = visible(facets, o, shadow, h) / 4;
    FresnelSplit<R> s;
    for (int j = 0; j < kWavelengths; ++j) {
      if (!repeated(j)) s = face.facet(j, half.cosine, rough_eta(j, wo), wo.z > 0);
      out.f[j] = s.reflected * reflected[j] * f;
      out.pdf[j] = choose(j, s).reflect * pdf;
    }
    return out;
  }

  Lobes<R> evaluate_transmission(Vec3<R> wo, Vec3<R> wi, R shadow, Mode mode) const {
    Lobes<R> out;
    const Vec3<R> o = to_upper(wo, wo), i = to_upper(wi, wo);
    const R masking = materials::masking(facets, o, shadow, i);
    for (int j = 0; j < kWavelengths; ++j) {
      const R eta = rough_eta(j, wo);
      if (repeated(j)) {
        out.f[j] = out.f[j - 1];
        out.pdf[j] = out.pdf[j - 1];
        continue;
      }
      // The facet that refracts wo to wi; its length is |wo.h + eta wi.h|.
      Vec3<R> h = o + i * eta;
      const R l2 = dot(h, h);
      if (!(l2 > 0)) continue;
      const R inv = 1 / std::sqrt(l2);
      h = h * (h.z < 0 ? -inv : inv);
      const R oh = dot(o, h), ih = dot(i, h);
      if (!(oh > 0) || !(ih < 0) || !(h.z > 0)) continue;
      const FresnelSplit<R> s = face.facet(j, std::min(oh, R(1)), eta, wo.z > 0);
      const R jacobian = -ih * inv * inv;
      const R scale = mode == Mode::Radiance ? R(1) : eta * eta;
      // masking already holds 1 / (4 |wo.z| |wi.z|).
      out.f[j] =
          s.transmitted * transmitted[j] * facets.density(h) * 4 * masking * oh * jacobian * scale;
      out.pdf[j] =
          choose(j, s).transmit * visible(facets, o, shadow, h) * oh * jacobian * eta * eta;
    }
    return out;
  }
};

template <class R>
using Dielectric = RoughInterface<R, Ggx>;
template <class R>
using BeckmannDielectric = RoughInterface<R, Beckmann>;

}  // namespace mms::materials
