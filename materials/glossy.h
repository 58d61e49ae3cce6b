// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// `glossy`: the energy-preserving glossy reflection of Radziszewski's thesis (section 6.3), in
/// forms that do not cancel. With x = cos^2 theta_i, y = cos^2 theta_r, m = 2 ln cosh n, T = tanh^2
/// n:
///
///   f = 2 f_theta f_phi
///   f_theta = m T e^(-m (x + y)) / (T - (1 - e^(-m x)) (1 - e^(-m y)))^2
///   f_phi   = C / (1 + u)^6,  u = n_phi s_i s_r (1 - cos dphi)
///
/// The factor 2 is missing from (6.18) as printed, which also prints P5(n_phi) for
/// P5(n_phi s_i s_r). f_theta is the density of a Frank copula: its marginals are uniform and it is
/// symmetric, hence albedo 1 for colour 1 and reciprocity (bitwise: only symmetric expressions of
/// the two directions enter). `glossy_back` and `glossy_through` turn the lobe around the direction
/// that light came from and the one in which it went on; `glossy_refraction` is the latter, bent
/// (materials/glossy_refraction.h). Near grazing the lobe moves away from the
/// horizon: that is the model.

#include "materials/coated.h"
#include "materials/specular.h"

namespace mms::materials {

/// Above this gloss the lobe is a mirror: m = 1e5, where rounding a direction in float already
/// costs 4e-3 of f (4e-4 at m = 1e4, 4e-5 at 1e3).
inline constexpr double kMaxGloss = 5e4;
/// n_phi is limited to this: a lobe 4e-4 rad wide.
inline constexpr double kMaxLongitude = 1e7;

/// The latitudal factor over x and y.
template <class R>
struct Latitude {
  R m, t;

  explicit Latitude(R n) {
    if (n < 1) {
      const R sh = std::sinh(n / 2);
      m = 2 * std::log1p(2 * sh * sh);
    } else {
      m = 2 * (n - std::numbers::ln2_v<R> + std::log1p(std::exp(-2 * n)));
    }
    t = -std::expm1(-m);
  }

  /// f_theta from s = (x + y) / 2, 1 - s and d = x - y.
  R density(R s, R one_minus_s, R d) const {
    if (m < R(1e-30)) return 1;
    const R half = m * std::abs(d) / 2;
    const R e = -std::expm1(-half);
    const R h = e > R(0.5) ? std::exp(-half) : 1 - e;
    const R a = -std::expm1(-m * s) - std::expm1(-m * one_minus_s);
    const R g = h / (h * a + e * e);
    return (m * g) * (t * g);
  }

  /// x with CDF(x | y) = xi; call with 1 - xi and 1 - y for 1 - x.
  R inverse(R xi, R one_minus_xi, R y, R one_minus_y) const {
    if (m < R(1e-30)) return xi;
    const R my = m * y;
    const R far = one_minus_xi + xi * std::exp(-m * one_minus_y);
    if (my < 30) {
      const R ratio = xi * t * std::exp(my) / far;
      if (ratio < R(1e6)) return std::log1p(ratio) / m;
    }
    const R near = xi + one_minus_xi * std::exp(-my);
    const R log_near = near > R(0.5) ? std::log1p(one_minus_xi * std::expm1(-my)) : std::log(near);
    const R log_far = far > R(0.5) ? std::log1p(xi * std::expm1(-m * one_minus_y)) : std::log(far);
    return limited(y + (log_near - log_far) / m, R(0), R(1));
  }
};

/// The longitudal factor for `n` = n_phi s_i s_r.
template <class R>
struct Longitude {
  R n;

  /// C / (1 + u)^6.
  R density(R u) const {
    const R a = 1 / (2 * n + 1);
    const R q = (63 + a * (35 + a * (30 + a * (30 + a * (35 + a * 63))))) / 256;
    const R c = std::sqrt(2 * n + 1) / (2 * kPi<R> * q);
    const R v = 1 / (1 + u), v2 = v * v;
    return c * (v2 * v2 * v2);
  }

  /// dphi in [-pi, pi] drawn by `xi` in [0, 1).
  R sample(R xi) const {
    const R v = 2 * xi - 1;
    const R psi = inverse(std::abs(v));
    const R half = std::atan2(std::sin(psi / 2), std::sqrt(2 * n + 1) * std::cos(psi / 2));
    return v < 0 ? -2 * half : 2 * half;
  }

 private:
  /// tan(psi/2) = sqrt(2n+1) tan(dphi/2) makes the density proportional to (1 + b cos psi)^5,
  /// b = n/(n+1): a trigonometric polynomial. Newton on its CDF over [0, pi], kept in a bracket.
  R inverse(R v) const {
    const R b = n / (n + 1), b2 = b * b;
    const R a0 = 1 + b2 * (5 + b2 * R(1.875));
    const R a1 = b * (5 + b2 * (R(7.5) + b2 * R(0.625)));
    const R a2 = b2 * (5 + b2 * R(2.5)) / 2, a3 = b * b2 * (R(2.5) + b2 * R(0.3125)) / 3;
    const R a4 = b2 * b2 * R(0.15625), a5 = b * b2 * b2 * R(0.0125);
    const R target = v * a0 * kPi<R>;
    const R noise = 2 * std::numeric_limits<R>::epsilon() * target;
    R lo = 0, hi = kPi<R>;
    R psi = std::min(hi, target / (a0 + a1 + 2 * a2 + 3 * a3 + 4 * a4 + 5 * a5));
    for (int i = 0; i < 32; ++i) {
      const R c = std::cos(psi), s = std::sin(psi);
      // sin(k psi) = s U_(k-1)(c)
      const R u1 = 2 * c, u2 = 2 * c * u1 - 1, u3 = 2 * c * u2 - u1, u4 = 2 * c * u3 - u2;
      const R value = a0 * psi + s * (a1 + a2 * u1 + a3 * u2 + a4 * u3 + a5 * u4) - target;
      if (std::abs(value) <= noise) break;  // no better can be known
      (value < 0 ? lo : hi) = psi;
      const R w = 1 + b * c, slope = w * w * w * w * w;
      R next = psi - value / slope;
      if (!(next > lo && next < hi)) next = (lo + hi) / 2;
      if (std::abs(next - psi) <= 2 * std::numeric_limits<R>::epsilon() * psi) return next;
      psi = next;
    }
    return psi;
  }
};

/// Around which direction the lobe is: the thesis' three choices of the reflected angle.
enum class GlossyAngle { Reflection, Backward, Through };

/// `kProduct`: n_theta and n_phi are two numbers; else one gives both as in the thesis' images.
template <class R, GlossyAngle kAngle, bool kProduct>
struct GlossyLobe {
  Spectrum<R> colour;
  R gloss, longitude;  ///< n_theta, n_phi

  explicit GlossyLobe(const R* p) : colour(weight_at(p)), gloss(non_negative(p[kWavelengths])) {
    longitude = kProduct ? non_negative(p[kWavelengths + 1]) : R(0);
    if constexpr (kProduct) {
      if (specular()) return;
      gloss = std::min(gloss, R(kMaxGloss));
      longitude = std::min(longitude, R(kMaxLongitude));
    }
  }

  bool specular() const {
    if constexpr (kAngle == GlossyAngle::Backward) return false;
    return gloss > R(kMaxGloss) && (!kProduct || longitude > R(kMaxLongitude));
  }
  /// How a coat sees it: the longitude is of no matter to that.
  CoatedLobe<R> coated(Vec3<R> w) const { return CoatedLobe<R>::glossy(gloss, w); }
  Spectrum<R> estimate(Vec3<R>) const { return colour; }
  SpecularTerms<R> terms(Vec3<R>) const {
    SpecularTerms<R> t = mirror_terms(colour);
    if constexpr (kAngle == GlossyAngle::Through) {
      std::swap(t.reflect_weight, t.transmit_weight);
      std::swap(t.reflect_probability, t.transmit_probability);
    }
    return t;
  }

  /// The direction whose mirror image is around the lobe's axis, for one around it; its own
  /// inverse.
  static Vec3<R> unfolded(Vec3<R> w) {
    if constexpr (kAngle == GlossyAngle::Backward) return {-w.x, -w.y, w.z};
    if constexpr (kAngle == GlossyAngle::Through) return {w.x, w.y, -w.z};
    return w;
  }

  /// f for colour 1.
  R value(Vec3<R> wo, Vec3<R> wi) const {
    wi = unfolded(wi);
    if (!same_side(wo, wi)) return 0;
    wi = to_upper(wi, wo);
    wo = to_upper(wo, wo);
    // Tangents of the mirror direction (a) and of wi (b).
    const R ax = -wo.x, ay = -wo.y, bx = wi.x, by = wi.y;
    const R a2 = ax * ax + ay * ay, b2 = bx * bx + by * by;
    const R x = wi.z * wi.z, y = wo.z * wo.z;
    const R d = x + y > 1 ? difference_of_products(ax - bx, ax + bx, by - ay, by + ay)
                          : (wi.z - wo.z) * (wi.z + wo.z);
    return 2 * Latitude<R>(gloss).density((x + y) / 2, (a2 + b2) / 2, d) *
           around_normal(ax, ay, bx, by);
  }

  /// f_phi of the tangents of the mirror direction (a) and of wi (b).
  R around_normal(R ax, R ay, R bx, R by) const {
    const R ss = std::sqrt(ax * ax + ay * ay) * std::sqrt(bx * bx + by * by);
    const R n = effective(ss);
    const R along = ax * bx + ay * by;
    // The larger product first, so that exchanging wo and wi gives the same bits.
    const R across = std::abs(ax * by) < std::abs(ay * bx) ? difference_of_products(ay, bx, ax, by)
                                                           : difference_of_products(ax, by, ay, bx);
    // u = n (1 - cos dphi) = n / ss (ss - along)
    const R u = !(ss > 0)   ? R(0)
                : along > 0 ? n / ss * (across * across / (ss + along))
                            : n / ss * (ss - along);
    return Longitude<R>{n}.density(u);
  }

  Lobes<R> evaluate(Vec3<R> wo, Vec3<R> wi, Mode) const {
    const R f = value(wo, wi);
    return {colour * f, Spectrum<R>(f * std::abs(wi.z))};
  }

  bool sample(Vec3<R> wo, R, R u1, R u2, Vec3<R>& wi) const {
    const R y = wo.z * wo.z, s2 = wo.x * wo.x + wo.y * wo.y;
    const auto [x, r2] = draw_latitude(u1, y, s2);
    wi = turned(wo, x, r2, u2);
    if (!(wi.z > 0)) return false;
    wi = unfolded(to_upper(wi, wo));
    return true;
  }

  /// x and 1 - x for `y` and 1 - y.
  std::pair<R, R> draw_latitude(R u1, R y, R one_minus_y) const {
    const R xi = std::min(u1, 1 - std::numeric_limits<R>::epsilon() / 2);
    const Latitude<R> latitude(gloss);
    return {latitude.inverse(xi, 1 - xi, y, one_minus_y),
            latitude.inverse(1 - xi, xi, one_minus_y, y)};
  }
  /// The direction of that squared cosine and sine whose azimuth `u2` draws, z > 0.
  Vec3<R> turned(Vec3<R> wo, R x, R r2, R u2) const {
    const R r = std::sqrt(r2), s = std::sqrt(wo.x * wo.x + wo.y * wo.y);
    const R dphi = Longitude<R>{effective(r * s)}.sample(u2);
    // Turn the mirror direction's tangent by dphi; any tangent will do at normal incidence.
    const R tx = s > 0 ? -wo.x / s : R(1), ty = s > 0 ? -wo.y / s : R(0);
    const R c = std::cos(dphi), sn = std::sin(dphi);
    return normalize(Vec3<R>{r * (tx * c - ty * sn), r * (ty * c + tx * sn), std::sqrt(x)});
  }

 private:
  /// n_phi s_i s_r; the thesis' images take n_phi = 0.75 n sqrt(n s_i s_r).
  R effective(R ss) const {
    return kProduct ? longitude * ss : R(0.75) * gloss * ss * std::sqrt(gloss * ss);
  }
};

template <class R>
using Glossy = GlossyLobe<R, GlossyAngle::Reflection, false>;
template <class R>
using GlossyProduct = GlossyLobe<R, GlossyAngle::Reflection, true>;
template <class R>
using GlossyBack = GlossyLobe<R, GlossyAngle::Backward, true>;
template <class R>
using GlossyThrough = GlossyLobe<R, GlossyAngle::Through, true>;

}  // namespace mms::materials
