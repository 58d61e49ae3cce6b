// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// `phong_glass`: an interface that scatters after Phong around ideal reflection and refraction:
/// the test model of thesis 4.3.3, with an index of its own for each wavelength, made reciprocal
/// and never gaining energy.
///
/// A direction of tangent t on the side of index n (1 on the rarer side) has the momentum p = n t,
/// which a smooth interface keeps. This one adds a random one: with P = n_o o + n_i i the sum of
/// both, F Fresnel's reflectance at each of the two directions,
///
///   f = n_i^2 K(P^2) (F(wo) + F(wi)) / 2          to the same side
///   f = n_i^2 K(P^2) (T(wo) + T(wi)) / 2          to the other side, T = 1 - F, Importance mode
///   K = (n + 2) / (2 pi) (1 - P^2)^(n/2)          0 where P > 1
///
/// At normal incidence the reflected lobe is Phong's cos^n, and nothing is lost. Sampling draws P,
/// then the side: only what falls where neither side has a direction is lost, that is K beyond the
/// unit disc, by half, or beyond both. F is taken for 1 beyond the critical angle, which makes it
/// one function of momentum; so albedo <= 1 from either side.

#include "materials/coat.h"
#include "materials/fresnel.h"
#include "materials/glass_coat.h"
#include "materials/phong_coat.h"
#include "materials/radial.h"

namespace mms::materials {

template <class R>
struct PhongGlass {
  const R* ior;
  R n;
  Spectrum<R> reflected, transmitted;

  explicit PhongGlass(const R* p)
      : ior(p),
        n(non_negative(p[kWavelengths])),
        reflected(weight_at(p + kWavelengths + 1)),
        transmitted(weight_at(p + 2 * kWavelengths + 1)) {}

  bool specular() const { return n > R(kMaxExponent); }
  /// Whether it is known what coats send back.
  bool knows_coats() const {
    return specular() || std::all_of(ior, ior + kWavelengths, [](R its) {
             const R eta = relative_eta(its, Vec3<R>{0, 0, 1});
             return eta >= 1 || in_glass_tables(eta);
           });
  }
  /// That, of light along `w` (materials/phong_coat.h); `coats` as in SentBack::smooth.
  /// \pre not specular
  template <class Coats>
  SentBack<R> sent_back(Vec3<R> w, const Coats& coats) const {
    Spectrum<R> eta;
    for (int j = 0; j < kWavelengths; ++j) eta[j] = relative_eta(ior[j], w);
    return SentBack<R>::rough(
        w, eta, w.z > 0 ? reflected : transmitted,
        Broadness<R>::facets(std::sqrt(axes::phong_area(n))), coats,
        [this](int j) { return repeated(j); },
        [&](int j, const CoatOnGlass<R>& law) { return sent_back(w, eta[j], law); });
  }

  Spectrum<R> estimate(Vec3<R> wo) const {
    return interface_estimate(ior, wo, reflected, transmitted, !specular());
  }

  SpecularTerms<R> terms(Vec3<R> wo) const {
    const R c = limited(std::abs(wo.z), R(0), R(1));
    return interface_terms(ior, wo, reflected, transmitted,
                           [c](int, R eta) { return fresnel_split(c, eta); });
  }

  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode mode) const {
    Lobes<R> out;
    const bool reflects = same_side(wo, wi);
    for (int j = 0; j < kWavelengths; ++j) {
      if (repeated(j)) {
        out.f[j] = out.f[j - 1];
        out.pdf[j] = out.pdf[j - 1];
        continue;
      }
      const R eta = relative_eta(ior[j], wo), no = eta < 1 ? 1 / eta : R(1);
      const R ni = reflects ? no : no * eta;
      const R x = no * wo.x + ni * wi.x, y = no * wo.y + ni * wi.y;
      const R k = ni * ni * kernel(x * x + y * y);
      const FresnelSplit<R> o = fresnel_split(limited(std::abs(wo.z), R(0), R(1)), eta);
      const Sides s =
          sides(o, limited(std::abs(wi.z), R(0), R(1)), reflects ? eta : 1 / eta, reflects, j);
      const R scale = reflects || mode == Mode::Importance ? R(1) : 1 / (eta * eta);
      out.f[j] = k * (reflects ? s.reflect : s.transmit) * scale;
      const R both = s.reflect + s.transmit;
      out.pdf[j] =
          both > 0 ? k * std::abs(wi.z) * ((reflects ? s.reflect : s.transmit) / both) : R(0);
    }
    return out;
  }

  bool sample(Vec3<R> wo, R u_lobe, R u1, R u2, Vec3<R>& wi) const {
    const R eta = relative_eta(ior[0], wo), no = eta < 1 ? 1 / eta : R(1), ni = no * eta;
    // 1 - P^2 = (1 - u1)^(2 / (n + 2))
    const R r = std::sqrt(-std::expm1(std::log1p(-u1) * 2 / (n + 2))), phi = 2 * kPi<R> * u2;
    const R x = r * std::cos(phi) - no * wo.x, y = r * std::sin(phi) - no * wo.y;
    const R here2 = 1 - (x * x + y * y) / (no * no), there2 = 1 - (x * x + y * y) / (ni * ni);
    if (!(here2 > 0) && !(there2 > 0)) return false;
    const FresnelSplit<R> o = fresnel_split(limited(std::abs(wo.z), R(0), R(1)), eta);
    const bool from_here = here2 > 0;
    const Sides s = sides(o, std::sqrt(std::min(R(1), from_here ? here2 : there2)),
                          from_here ? eta : 1 / eta, from_here, 0);
    const bool reflect = u_lobe * (s.reflect + s.transmit) < s.reflect;
    const R c2 = reflect ? here2 : there2, inv = 1 / (reflect ? no : ni);
    if (!((reflect ? s.reflect : s.transmit) > 0) || !(c2 > 0)) return false;
    const R c = std::sqrt(c2);
    wi = normalize(Vec3<R>{x * inv, y * inv, reflect == (wo.z > 0) ? c : -c});
    return true;
  }

 private:
  /// All is as at the wavelength before.
  bool repeated(int j) const {
    return j > 0 && ior[j] == ior[j - 1] && reflected[j] == reflected[j - 1] &&
           transmitted[j] == transmitted[j - 1];
  }

  /// The share of light that coats send back, from outside over T(o); `eta` as in SpecularTerms.
  R sent_back(Vec3<R> w, R eta, const CoatOnGlass<R>& law) const {
    const bool outside = w.z > 0;
    const R c = std::min(std::abs(w.z), R(1)), s = std::sqrt(w.x * w.x + w.y * w.y);
    const FresnelSplit<R> o = fresnel_split(c, eta);
    const R here = outside ? o.reflected : o.transmitted;
    const PhongWeights<R> weights(n, s, eta, !outside);
    R sent = 0;
    for (int i = 0; i < kGlassPoints; ++i)
      sent += law.sent[!outside][i] * (here * weights.of[i] + weights.of[kGlassPoints + i]);
    return sent / 2;
  }

  R kernel(R p2) const {
    if (!(p2 < 1)) return 0;
    return (n + 2) / (2 * kPi<R>)*std::exp(n / 2 * std::log1p(-p2));
  }

  /// What becomes of light that leaves with one momentum, by side.
  struct Sides {
    R reflect, transmit;
  };

  /// `o`: Fresnel's split at wo. The momentum is that of a direction of cosine `c` on the side of
  /// wo (`here`) or the other one; `eta` is the index beyond that side over its own.
  Sides sides(FresnelSplit<R> o, R c, R eta, bool here, int j) const {
    const bool both = refraction_g2(c, eta) > 0;  // the momentum fits the other side too
    const FresnelSplit<R> i = both ? fresnel_split(c, eta) : FresnelSplit<R>{R(1), R(0)};
    return {here || both ? (o.reflected + i.reflected) / 2 * reflected[j] : R(0),
            !here || both ? (o.transmitted + i.transmitted) / 2 * transmitted[j] : R(0)};
  }
};

}  // namespace mms::materials
