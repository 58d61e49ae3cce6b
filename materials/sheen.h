// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// `sheen`: a thin layer of white fibres that stand up on a surface, such as velvet's or dust.
/// Light may scatter in it many times; what comes out above is tabulated as a linearly transformed
/// cosine of two numbers a, b and the share R that it is (Zeltner, Burley and Chiang 2022; the
/// table is our own, materials/tables/sheen.cpp), all of which depend on where the layer is seen
/// from:
///
///   f |wi.z| = colour R(wo) D(wi),  D = a^2 wi.z / (pi l^4),  l^2 = |a wi + b wi.z wo|^2 + wi.z^2
///
/// the first square over the parts along the surface only. D integrates to 1 and is drawn exactly,
/// so that the albedo is colour R(wo). What passes the layer is what `layer` (materials/combine.h)
/// gives to its base.
///
/// Such fits are not reciprocal, though the layer is: f(a, b) and f(b, a) differ. Importance is the
/// adjoint of radiance, with the directions exchanged, so that paths from lights and from the
/// camera agree.

#include "materials/lobe.h"
#include "materials/spline.h"

namespace mms::materials {

/// R, a and b: [3][roughness][direction], splines (materials/spline.h); and of R the mean over the
/// hemisphere: [roughness].
extern const float kSheenTable[], kSheenMean[];

namespace axes {

inline constexpr int kSheenRoughness = 16, kSheenDirection = 32;
inline constexpr double kLeastSheen = 0.1;  ///< lower roughnesses are taken for this one

/// Of a |cosine|: finer towards grazing.
template <class R>
inline R sheen_direction(R z) {
  return std::sqrt(z);
}

template <class R>
inline R sheen_roughness(R roughness) {
  return (limited(roughness, R(kLeastSheen), R(1)) - R(kLeastSheen)) / R(1 - kLeastSheen);
}

}  // namespace axes

/// The layer as it is seen from anywhere.
template <class R>
struct SheenLayer {
  Stencil<R> roughness;

  explicit SheenLayer(R r)
      : roughness(Stencil<R>::at(axes::sheen_roughness(r), axes::kSheenRoughness)) {}

  /// R in [0, 1], from a direction of |cosine| `z`.
  R albedo(R z) const { return std::min(std::max(number(0, direction(z)), R(0)), R(1)); }

  /// 2 int_0^1 R(z) z dz.
  R mean_albedo() const { return interpolate(kSheenMean, roughness); }

  /// What a direction of |cosine| `z` sees.
  struct View {
    R albedo, a, b;
  };
  View seen_from(R z) const {
    const Stencil<R> d = direction(z);
    return {albedo(z), std::max(number(1, d), R(1e-3)), number(2, d)};
  }

 private:
  static Stencil<R> direction(R z) {
    return Stencil<R>::at(axes::sheen_direction(std::min(z, R(1))), axes::kSheenDirection);
  }
  R number(int which, const Stencil<R>& d) const {
    constexpr int n1 = coefficients(axes::kSheenDirection),
                  n0 = n1 * coefficients(axes::kSheenRoughness);
    return interpolate(kSheenTable + which * n0, roughness, n1, d);
  }
};

template <class R>
struct Sheen {
  Spectrum<R> colour;
  SheenLayer<R> fibres;

  explicit Sheen(const R* p) : colour(weight_at(p)), fibres(p[kWavelengths]) {}

  static constexpr bool specular() { return false; }
  Spectrum<R> estimate(Vec3<R> wo) const { return colour * fibres.albedo(std::abs(wo.z)); }

  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode mode) const {
    if (!same_side(wo, wi)) return {};
    wi = to_upper(wi, wo);
    wo = to_upper(wo, wo);
    const auto view = fibres.seen_from(wo.z);
    const R density = shape(view, wo, wi);
    Lobes<R> out{Spectrum<R>(), Spectrum<R>(density * wi.z)};
    if (mode == Mode::Radiance) {
      out.f = colour * (view.albedo * density);
    } else {
      const auto back = fibres.seen_from(wi.z);
      out.f = colour * (back.albedo * shape(back, wi, wo));
    }
    return out;
  }

  bool sample(Vec3<R> wo, R, R u1, R u2, Vec3<R>& wi) const {
    const Vec3<R> up = to_upper(wo, wo);
    const auto view = fibres.seen_from(up.z);
    const Vec3<R> q = square_to_cosine_hemisphere(u1, u2);
    wi = normalize(Vec3<R>{q.x - view.b * q.z * up.x, q.y - view.b * q.z * up.y, view.a * q.z});
    wi = to_upper(wi, wo);
    return wi.z != 0;
  }

 private:
  /// D / wi.z, of directions above.
  static R shape(const typename SheenLayer<R>::View& view, Vec3<R> wo, Vec3<R> wi) {
    const R x = view.a * wi.x + view.b * wi.z * wo.x, y = view.a * wi.y + view.b * wi.z * wo.y;
    const R l2 = x * x + y * y + wi.z * wi.z;
    return view.a * view.a / (kPi<R> * l2 * l2);
  }
};

}  // namespace mms::materials
