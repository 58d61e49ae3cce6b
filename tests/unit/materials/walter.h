// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What rough glass scatters in all: its first bounce as Walter et al. (2007) write it, with the
/// textbook's Fresnel, and of the model's value the rest.

#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "base/quadrature.h"
#include "tests/sanitized.h"
#include "tests/unit/materials/make.h"

namespace mms::test {

/// GGX facets, as wide as `ax` and `ay`; `seen` draws those that a direction sees.
struct GgxFacets {
  double ax, ay;

  double normals(Vec3d h) const {
    const double x = h.x / ax, y = h.y / ay, t = x * x + y * y + h.z * h.z;
    return 1 / (kPi<double> * ax * ay * t * t);
  }
  double lambda(Vec3d w) const {
    const double x = ax * w.x / w.z, y = ay * w.y / w.z;
    return (std::sqrt(1 + x * x + y * y) - 1) / 2;
  }
  /// The tail of steep facets is as long as 1 / alpha^2: `left` of u2 grows as a fourth power.
  Vec3d seen(Vec3d o, double u, double v, double& weight) const {
    weight = 4 * v * v * v;
    return materials::Ggx<double>{{ax, ay}}.sample_visible(o, u, 1 - v * v * v * v);
  }
};

struct BeckmannFacets {
  double ax, ay;

  double normals(Vec3d h) const {
    const double x = h.x / h.z / ax, y = h.y / h.z / ay;
    return std::exp(-x * x - y * y) / (kPi<double> * ax * ay * std::pow(h.z, 4));
  }
  double lambda(Vec3d w) const {
    const double a = std::abs(w.z) / std::hypot(ax * w.x, ay * w.y);
    if (!(a < 6)) return 0;
    return (std::exp(-a * a) / (a * std::sqrt(kPi<double>)) - std::erfc(a)) / 2;
  }
  /// All slopes as polar coordinates, those that are seen by their weight.
  Vec3d seen(Vec3d o, double u, double v, double& weight) const {
    const double r = std::sqrt(-2 * std::log(v)), phi = 2 * kPi<double> * u;
    const Vec3d slopes{ax * r * std::cos(phi), ay * r * std::sin(phi), 1};
    weight = 2 * v * std::max(0.0, dot(o, slopes)) / (o.z * (1 + lambda(o)));
    return normalize(slopes);
  }
};

/// Fresnel's reflectance at a relative index by quotients of cosines.
inline double textbook_fresnel(double c, double eta) {
  const double ct2 = 1 - (1 - c * c) / (eta * eta);
  if (ct2 <= 0) return 1;
  const double ct = std::sqrt(ct2), s = (c - eta * ct) / (c + eta * ct),
               p = (eta * c - ct) / (eta * c + ct);
  return (s * s + p * p) / 2;
}

/// Of an interface at a relative index and a cosine where it does not reflect totally.
using Reflectance = std::function<double(double c, double eta)>;

/// An interface of facets between a near side, z > 0, and a far one of relative index `eta`.
template <class Facets>
struct Interface {
  Facets facets;
  double eta;
  Reflectance reflectance = textbook_fresnel;

  /// What comes along `o` and leaves for good at the first facet, times `weight` of where it goes:
  /// the mean over the normals that are seen of both ways on, each with what masks it. A lattice of
  /// `n` points along each axis: a grid's rows would meet the horizon and the critical angle as
  /// one.
  template <class Weight>
  double once(Vec3d o, int n, const Weight& weight) const {
    double sum = 0;
    for (int k = 0; k < n; ++k) {
      const double offset = std::fmod((k + 0.5) * std::numbers::phi, 1.0);
      for (int i = 0; i < n; ++i) {
        double seen = 0;
        const Vec3d h = facets.seen(o, (k + 0.5) / n, (i + offset) / n, seen);
        const double c = dot(o, h), f = reflected(c);
        const Vec3d r = h * (2 * c) - o;
        if (r.z > 0) sum += seen * f * unmasked(o, r) * weight(r);
        if (f == 1) continue;
        const double ct = std::sqrt(1 - (1 - c * c) / (eta * eta));
        const Vec3d t = h * (c / eta - ct) - o / eta;
        if (t.z < 0) sum += seen * (1 - f) * unmasked(o, t) * weight(t);
      }
    }
    return sum / n / n;
  }

  /// f of the first bounce, of importance.
  double value(Vec3d o, Vec3d i) const {
    const bool reflects = i.z > 0;
    Vec3d h = reflects ? o + i : o + i * eta;
    const double norm = length(h);
    h = h * ((h.z < 0 ? -1 : 1) / norm);
    const double oh = dot(o, h), ih = dot(i, h);
    if (!(oh > 0) || (ih > 0) != reflects) return 0;
    const double f = reflected(oh), zo = o.z, zi = std::abs(i.z);
    const double g = 1 / (1 + facets.lambda(o) + facets.lambda(i));
    if (reflects) return f * facets.normals(h) * g / (4 * zo * zi);
    return oh * -ih / (zo * zi) * eta * eta * (1 - f) * g * facets.normals(h) / (norm * norm);
  }

 private:
  double reflected(double c) const {
    return c * c > (1 - eta) * (1 + eta) ? reflectance(c, eta) : 1;
  }
  double unmasked(Vec3d o, Vec3d i) const {
    const double lo = facets.lambda(o);
    return (1 + lo) / (1 + lo + facets.lambda(i));
  }
};

/// All that comes back of light along `wo` from either side of `m`, or from the `far` one alone,
/// without deltas: `facets` of that index, whose value is about that times `weight`, of a direction
/// that is turned to +z as `wo` is.
template <class Facets, class Weight>
double glass_albedo(const Material& m, const Facets& facets, double ior, Vec3d wo,
                    const Weight& weight, bool far = false,
                    const Reflectance& reflectance = textbook_fresnel) {
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  const materials::Bsdf<double> bsdf(layout, p.data());
  const auto choice = bsdf.choose(wo);
  const double side = wo.z > 0 ? 1 : -1;
  const Interface<Facets> face{facets, wo.z > 0 ? ior : 1 / ior, reflectance};
  const Vec3d up{wo.x, wo.y, wo.z * side};
  // The rest is alike in each quarter of a turn: in one across wo, where the first bounce is small.
  const int azimuths = facets.ax == facets.ay ? 1 : 12;
  double rest = 0;
  const int panels = azimuths == 1 ? 16 : 8;
  for (const double to : {1.0, -1.0}) {
    // What is lost has a ridge as narrow as alpha along the critical angle, and ends in the
    // surface.
    const double beyond = to > 0 ? face.eta : 1 / face.eta;
    const double ridge = std::pow(std::max(0.0, (1 - beyond) * (1 + beyond)), 0.25);
    for (int a = 0; a < azimuths && !(far && to > 0); ++a) {
      const double phi = (a + 0.5) / azimuths * kPi<double> / 2;
      const Vec3d across{std::copysign(std::cos(phi), -up.x), std::copysign(std::sin(phi), up.y),
                         0};
      const auto more = [&](double u) {
        const double z = u * u;
        const Vec3d wi = across * std::sqrt(1 - z * z) + Vec3d{0, 0, z * to};
        const double all =
            bsdf.evaluate(wo, {wi.x, wi.y, wi.z * side}, materials::Mode::Importance, choice).f[0];
        return 4 * kPi<double> * u * z * (all - face.value(up, wi) * weight(wi)) / azimuths;
      };
      for (const auto& [from, reach] : {std::pair(0.0, ridge), std::pair(ridge, 1 - ridge)})
        for (int k = 0; reach > 0 && k < panels; ++k)
          rest += reach * integrate<8>(
                              [&](double t) {  // crowded at both ends
                                return more(from + reach * t * t * (3 - 2 * t)) * 6 * t * (1 - t);
                              },
                              double(k) / panels, (k + 1.0) / panels);
    }
  }
  const auto asked = [&](Vec3d w) { return far && w.z > 0 ? 0.0 : weight(w); };
  return face.once(up, kSanitized ? 100 : 150, asked) + rest;
}

}  // namespace mms::test
