// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Phase functions: Henyey-Greenstein (isotropic for g = 0) and Draine's (2003), of which g = 0, a
/// = 1 is Rayleigh's. Each offers its density per steradian, which integrates to 1, and samples of
/// it.

#include "base/quadrature.h"
#include "base/vec.h"
#include "base/warp.h"
#include "materials/lobe.h"

namespace mms::materials {

/// |g| is limited to this: a peak about 1 - g wide must stay wider than what a float direction
/// resolves (1e-7 rad: a relative error near 1e-3).
inline constexpr double kMaxPhaseG = 0.9999;

/// The direction whose cosine of deflection is given by its distances from 1 and from -1.
template <class R>
inline Vec3<R> deflected(Vec3<R> wo, R one_minus_c, R one_plus_c, R u2) {
  const R c = one_minus_c < one_plus_c ? 1 - one_minus_c : one_plus_c - 1;
  const R s = std::sqrt(std::max(R(0), one_minus_c * one_plus_c)), phi = 2 * kPi<R> * u2;
  const Frame<R> frame = Frame<R>::around(-wo);
  return normalize(frame.to_world({s * std::cos(phi), s * std::sin(phi), c}));
}

/// Henyey-Greenstein. The cosine `c` is that of the angle of deflection; its distance from 1 and
/// from -1 is formed without subtraction.
template <class R>
struct HenyeyGreenstein {
  R g;

  explicit HenyeyGreenstein(R mean_cosine)
      : g(std::isnan(mean_cosine) ? R(0) : limited(mean_cosine, R(-kMaxPhaseG), R(kMaxPhaseG))) {}

  /// Density per steradian: (1 - g^2) / (4 pi (1 + g^2 - 2 g c)^(3/2)).
  R density(Vec3<R> wo, Vec3<R> wi) const {
    const Vec3<R> off = g > 0 ? wi + wo : wi - wo;  // its square is 2 (1 - |g|/g c)
    const R a = 1 - std::abs(g);
    const R d = a * a + std::abs(g) * dot(off, off);
    return a * (1 + std::abs(g)) / (4 * kPi<R> * d * std::sqrt(d));
  }

  Vec3<R> sample(Vec3<R> wo, R u1, R u2) const {
    // With t = 2 u1 - 1 (which is c for g = 0): 1 - c and 1 + c without division by g.
    const R below = 2 * u1, above = 2 * (1 - u1);                   // 1 + t, 1 - t
    const R q = g > 0 ? (1 - g) + g * below : (1 + g) - g * above;  // 1 + g t
    const R k = 1 / (2 * q * q);
    const R one_minus_c = (1 - g) * (1 - g) * above * (2 + g * below) * k;
    const R one_plus_c = (1 + g) * (1 + g) * below * (2 - g * above) * k;
    return deflected(wo, one_minus_c, one_plus_c, u2);
  }
};

/// Draine's function: Henyey-Greenstein's times (1 + a c^2) / (1 + a (1 + 2 g^2) / 3), a in [0, 1].
template <class R>
struct Draine {
  HenyeyGreenstein<R> base;
  R a;

  Draine(R mean_cosine, R weight) : base(mean_cosine), a(limited(weight, R(0), R(1))) {}

  R norm() const { return 1 + a * (1 + 2 * base.g * base.g) / 3; }

  R density(Vec3<R> wo, Vec3<R> wi) const {
    const R c = dot(wo, wi);
    return base.density(wo, wi) * (1 + a * c * c) / norm();
  }

  /// The share below the cosine is found for the number t in [0, 1] with which Henyey-Greenstein's
  /// inverse gives that cosine: int_0^t 1 + a c(v)^2 dv grows from 0 to norm(), with a slope in [1,
  /// 1
  /// + a], so that Newton's method cannot leave its bracket by much.
  Vec3<R> sample(Vec3<R> wo, R u1, R u2) const {
    const double target = double(u1) * total(1);
    double lo = 0, hi = 1, t = u1;
    for (int i = 0; i < 40; ++i) {
      const double error = total(t) - target;
      if (std::abs(error) < 1e-9) break;
      (error < 0 ? lo : hi) = t;
      const double c = cosine(t), next = t - error / (1 + a * c * c);
      t = next > lo && next < hi ? next : (lo + hi) / 2;
    }
    const double below = 2 * t, above = 2 * (1 - t), g = base.g, q = 1 + g * (below - 1);
    const double k = 1 / (2 * q * q);
    return deflected(wo, R((1 - g) * (1 - g) * above * (2 + g * below) * k),
                     R((1 + g) * (1 + g) * below * (2 - g * above) * k), u2);
  }

 private:
  /// The cosine at `t`.
  double cosine(double t) const {
    const double g = base.g, q = 1 + g * (2 * t - 1);
    return 1 - (1 - g) * (1 - g) * (1 - t) * (2 + 2 * g * t) / (q * q);
  }

  /// int_0^t 1 + a c(v)^2 dv, in closed form but where that divides by too small a g.
  double total(double t) const {
    const double g = base.g;
    if (std::abs(g) < 0.05)
      return t + double(a) * integrate<8>([&](double v) { return cosine(v) * cosine(v); }, 0, t);
    // c = (A - B^2 / q^2) / (2 g), q = 1 + g (2 v - 1)
    const double big = 1 + g * g, b2 = (1 - g) * (1 - g) * (1 + g) * (1 + g);
    const auto part = [&](double q) {
      return big * big * q + 2 * big * b2 / q - b2 * b2 / (3 * q * q * q);
    };
    return t + double(a) * (part(1 + g * (2 * t - 1)) - part(1 - g)) / (8 * g * g * g);
  }
};

}  // namespace mms::materials
