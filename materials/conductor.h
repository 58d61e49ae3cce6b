// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// `conductor`: GGX facets of metal with the exact Fresnel reflectance; polished at low roughness.
/// `coloured_metal`: the same of a reflectance that is stated by its colours. Light of several
/// bounces has been reflected as often: it is more saturated.

#include "base/quadrature.h"
#include "materials/fresnel.h"
#include "materials/microfacet.h"

namespace mms::materials {

/// Reflectance of a facet of bare metal.
template <class R>
struct ConductorFresnel {
  static constexpr int kNumbers = 2 * kWavelengths;  ///< n, k
  const R* p;

  /// At the cosine of incidence `c`.
  Spectrum<R> operator()(R c) const {
    bool grey = true;
    for (int j = 1; j < kWavelengths; ++j)
      grey &= int(p[j] == p[0]) & int(p[kWavelengths + j] == p[kWavelengths]);
    if (grey)
      return Spectrum<R>(fresnel_conductor(c, non_negative(p[0]), non_negative(p[kWavelengths])));
    return side_by_side(c, weight_at(p), weight_at(p + kWavelengths));
  }

 private:
  /// In loops without branches, but for the last.
  static Spectrum<R> side_by_side(R c, const Spectrum<R>& n, const Spectrum<R>& k) {
    Spectrum<R> absorptance, direct, f;
    for (int j = 0; j < kWavelengths; ++j)
      absorptance[j] = fresnel_conductor_absorptance(c, n[j], k[j]);
    bool little = false;
    for (int j = 0; j < kWavelengths; ++j) {
      f[j] = 1 - absorptance[j];
      little |= reflects_little(absorptance[j], n[j], k[j]);
    }
    if (!little) return f;
    for (int j = 0; j < kWavelengths; ++j) direct[j] = fresnel_conductor_direct(c, n[j], k[j]);
    for (int j = 0; j < kWavelengths; ++j)
      if (reflects_little(absorptance[j], n[j], k[j])) f[j] = direct[j];
    return f;
  }
};

/// Schlick's curve from `facing` at the normal to 1 in the surface, dimmed around 82 degrees
/// (cosine 1/7) by a multiple of c (1 - c)^6, so that it is `edge` times the curve there (Kutz,
/// Hasan and Edmondson 2021, as OpenPBR has it). Where a black metal is dimmed below 0 it is 0.
template <class R>
struct ColouredFresnel {
  static constexpr int kNumbers = 2 * kWavelengths;  ///< facing, edge
  const R* p;

  /// At the cosine of incidence `c`.
  Spectrum<R> operator()(R c) const {
    constexpr R kBend = R(1) / 7, u = 1 - kBend, u5 = u * u * u * u * u;
    const R v = 1 - c, v5 = v * v * v * v * v;
    Spectrum<R> f;
    for (int j = 0; j < kWavelengths; ++j) {
      const R facing = limited(p[j], R(0), R(1)), edge = limited(p[kWavelengths + j], R(0), R(1));
      const R dip = (facing + (1 - facing) * u5) * (1 - edge) / (kBend * u5 * u);
      f[j] = std::max(R(0), facing + (1 - facing) * v5 - dip * c * v5 * v);
    }
    return f;
  }
};

/// Facets of a metal; `Fresnel` holds the first numbers, roughness and anisotropy follow.
template <class R, template <class> class Fresnel>
struct RoughMetal {
  Fresnel<R> reflectance;
  RoughReflection<R, Ggx> rough;

  explicit RoughMetal(const R* p) : reflectance{p}, rough(p + Fresnel<R>::kNumbers) {}

  bool specular() const { return rough.specular(); }
  CoatedLobe<R> coated(Vec3<R> w) const { return rough.coated(w); }

  Spectrum<R> estimate(Vec3<R> wo) const {
    return reflectance(limited(std::abs(wo.z), R(0), R(1)));
  }
  SpecularTerms<R> terms(Vec3<R> wo) const { return mirror_terms(estimate(wo)); }

  /// 2 int_0^1 F(c) c dc. Of bare metals by the Gauss rule of four points for that weight: within
  /// 5e-4 of real ones', exact for coloured ones that are nowhere cut off at 0, and 1 for the
  /// lossless. Under films by rules of four that see their fringes: of 400 nm within 5e-4, of 800
  /// nm 1.5e-3, of 3 um 5e-3 and of 10 um 1.1e-2.
  Spectrum<R> mean_reflectance() const {
    if constexpr (requires { reflectance.parts(); }) {
      const int parts = reflectance.parts();
      Spectrum<R> mean;
      for (int k = 0; k < 4 * parts; ++k) {
        const R c = (R(k / 4) + R(gauss<4>().x[k % 4])) / R(parts);
        mean += reflectance(c) * (2 * c * R(gauss<4>().w[k % 4]) / R(parts));
      }
      return mean;
    }
    return reflectance(R(0.139759864344)) * R(0.062361941900) +
           reflectance(R(0.416409567631)) * R(0.259695095216) +
           reflectance(R(0.723156986362)) * R(0.406929136021) +
           reflectance(R(0.942895803885)) * R(0.271013826863);
  }

  FacetsSolved<R> solved() const {
    return rough.solved([this](R loss) {
      return Spectrum<R>::map([loss](R f) { return multiple_fresnel(std::min(f, R(1)), loss); },
                              mean_reflectance());
    });
  }
  FacetsSeen<R> seen(Vec3<R> wo, const FacetsSolved<R>&) const { return rough.seen(wo); }

  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode, const FacetsSolved<R>& solved,
                    const FacetsSeen<R>& seen) const {
    const auto v = rough.evaluate(wo, wi, solved, seen);
    if (!(v.pdf > 0)) return {};
    return {reflectance(v.cos_h) * v.single + solved.further * v.multiple, Spectrum<R>(v.pdf)};
  }

  bool sample(Vec3<R> wo, R u_lobe, R u1, R u2, const FacetsSolved<R>& solved,
              const FacetsSeen<R>& seen, Vec3<R>& wi) const {
    return rough.sample(wo, u_lobe, u1, u2, solved, seen, wi);
  }
};

template <class R>
using Conductor = RoughMetal<R, ConductorFresnel>;
template <class R>
using ColouredMetal = RoughMetal<R, ColouredFresnel>;

}  // namespace mms::materials
