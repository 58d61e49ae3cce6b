// SPDX-License-Identifier: Apache-2.0
// What white rough glass scatters in all, from both sides and up to grazing: its first bounce as
// Walter et al. (2007) write it, with the textbook's Fresnel, and of the model's value the rest.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "base/quadrature.h"
#include "tests/sanitized.h"
#include "tests/unit/materials/cases.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

namespace {

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

/// An interface of facets between a near side, z > 0, and a far one of relative index `eta`.
template <class Facets>
struct Interface {
  Facets facets;
  double eta;

  double reflectance(double c) const {
    const double ct2 = 1 - (1 - c * c) / (eta * eta);
    if (ct2 <= 0) return 1;
    const double ct = std::sqrt(ct2), s = (c - eta * ct) / (c + eta * ct),
                 p = (eta * c - ct) / (eta * c + ct);
    return (s * s + p * p) / 2;
  }

  /// What comes along `o` and leaves for good at the first facet: the mean over the normals that
  /// are seen of both ways on, each with what masks it. A lattice of `n` points along each axis: a
  /// grid's rows would meet the horizon and the critical angle as one.
  double once(Vec3d o, int n) const {
    double sum = 0;
    for (int k = 0; k < n; ++k) {
      const double offset = std::fmod((k + 0.5) * std::numbers::phi, 1.0);
      for (int i = 0; i < n; ++i) {
        double weight = 0;
        const Vec3d h = facets.seen(o, (k + 0.5) / n, (i + offset) / n, weight);
        const double c = dot(o, h), f = reflectance(c);
        const Vec3d r = h * (2 * c) - o;
        if (r.z > 0) sum += weight * f * unmasked(o, r);
        if (f == 1) continue;
        const double ct = std::sqrt(1 - (1 - c * c) / (eta * eta));
        const Vec3d t = h * (c / eta - ct) - o / eta;
        if (t.z < 0) sum += weight * (1 - f) * unmasked(o, t);
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
    const double f = reflectance(oh), zo = o.z, zi = std::abs(i.z);
    const double g = 1 / (1 + facets.lambda(o) + facets.lambda(i));
    if (reflects) return f * facets.normals(h) * g / (4 * zo * zi);
    return oh * -ih / (zo * zi) * eta * eta * (1 - f) * g * facets.normals(h) / (norm * norm);
  }

 private:
  double unmasked(Vec3d o, Vec3d i) const {
    const double lo = facets.lambda(o);
    return (1 + lo) / (1 + lo + facets.lambda(i));
  }
};

/// All that comes back of light along `wo` from either side of `m`, which is `facets` of that
/// index.
template <class Facets>
double albedo(const Material& m, const Facets& facets, double ior, Vec3d wo) {
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  const Bsdf<double> bsdf(layout, p.data());
  const double side = wo.z > 0 ? 1 : -1;
  const Interface<Facets> face{facets, wo.z > 0 ? ior : 1 / ior};
  const Vec3d up{wo.x, wo.y, wo.z * side};
  // The rest is alike in each quarter of a turn: in one across wo, where the first bounce is small.
  const int azimuths = facets.ax == facets.ay ? 1 : 12;
  double rest = 0;
  const int panels = azimuths == 1 ? 48 : 12;  // a ridge of what is lost is as narrow as alpha
  for (const double to : {1.0, -1.0})
    for (int a = 0; a < azimuths; ++a) {
      const double phi = (a + 0.5) / azimuths * kPi<double> / 2;
      const Vec3d across{std::copysign(std::cos(phi), -up.x), std::copysign(std::sin(phi), up.y),
                         0};
      for (int k = 0; k < panels; ++k)
        rest += integrate<8>(
            [&](double u) {
              const double z = u * u;
              const Vec3d wi = across * std::sqrt(1 - z * z) + Vec3d{0, 0, z * to};
              const double all = bsdf.eval(wo, {wi.x, wi.y, wi.z * side}, Mode::Importance)[0];
              return 4 * kPi<double> * u * z * (all - face.value(up, wi)) / azimuths;
            },
            double(k) / panels, (k + 1.0) / panels);
    }
  return face.once(up, kSanitized ? 100 : 200) + rest;
}

bool smooth_everywhere(const Material& m) {
  const materials::Layout layout = m.layout();
  return Bsdf<double>(layout, m.params<double>().data()).specular_only();
}

/// The largest |albedo - 1| that is met, and where.
struct Worst {
  double error = 0;
  int cases = 0;
  std::string where;

  void meet(double a, double ior, double roughness, double angle) {
    ++cases;
    if (!(std::abs(a - 1) > error)) return;
    error = std::abs(a - 1);
    where = std::to_string(ior) + ", " + std::to_string(roughness) + " at " + std::to_string(angle);
  }
};

/// A white glass of that lobe and its facets.
template <class FacetsOf>
struct Glass {
  using Facets = FacetsOf;
  std::string name;
  Lobe lobe;
};

void check_round(const auto& glass) {
  Worst worst;
  for (double index : {1.001, 1.01, 1.02, 1.05, 1.1, 1.33, 1.5, 2.0, 2.5, 4.0})
    for (double ior : {index, 1 / index})
      for (double roughness : {0.05, 0.11, 0.16, 0.225, 0.4, 0.6, 0.85, 1.0}) {
        const Material m = dielectric(ior, roughness, 1, 1, 0, glass.lobe);
        if (smooth_everywhere(m)) continue;
        const double alpha = roughness * roughness;
        const typename std::decay_t<decltype(glass)>::Facets facets{alpha, alpha};
        // The ridge of what is lost, a little to its left and right; from the denser side.
        const double critical = std::asin(1 / index) * 180 / kPi<double>;
        for (double degrees : {0.0, 30.0, 60.0, 75.0, 85.0, 89.0, 89.99, critical, critical - 3})
          for (const double angle : {degrees, 180 - degrees}) {
            if (kSanitized && (roughness != 0.225 || degrees < 70)) continue;
            const double a = albedo(m, facets, ior, direction(angle, 0.4));
            worst.meet(a, ior, roughness, angle);
            CHECK_MESSAGE(std::abs(a - 1) < 1e-3, glass.name, " ", ior, " ", roughness, " at ",
                          angle, ": ", a - 1);
          }
      }
  MESSAGE(glass.name, ": largest |albedo - 1| of ", worst.cases, ": ", worst.error, ", at index ",
          worst.where);
}

void check_stretched(const auto& glass) {
  for (const double anisotropy : {0.3, -0.6, 0.9}) {
    Worst worst[2];
    for (double index : {1.006, 1.01, 1.1, 1.5, 4.0})
      for (double ior : {index, 1 / index})
        for (double roughness : {0.16, 0.4, 0.7, 1.0}) {
          const auto alpha = materials::Alpha<double>::from(roughness, anisotropy);
          const typename std::decay_t<decltype(glass)>::Facets facets{alpha.ax, alpha.ay};
          const Material m = dielectric(ior, roughness, 1, 1, anisotropy, glass.lobe);
          if (smooth_everywhere(m)) continue;
          for (double degrees : {0.0, 40.0, 70.0, 85.0, 89.99})
            for (double azimuth : {0.2, 0.8, 1.4}) {
              if (kSanitized && (roughness != 0.4 || degrees != 70)) continue;
              const double a = albedo(m, facets, ior, direction(degrees, azimuth));
              worst[ior < 1].meet(a, ior, roughness, degrees);
              CHECK_MESSAGE(std::abs(a - 1) < 1e-3, glass.name, " ", anisotropy, " ", ior, " ",
                            roughness, " at ", degrees, " ", azimuth, ": ", a - 1);
            }
        }
    for (const Worst& w : worst)
      MESSAGE(glass.name, ", anisotropy ", anisotropy, ": largest |albedo - 1| of ", w.cases, ": ",
              w.error, ", at index ", w.where);
  }
}

const Glass<GgxFacets> kGgx{"dielectric", Lobe::Dielectric};
const Glass<BeckmannFacets> kBeckmann{"beckmann_dielectric", Lobe::BeckmannDielectric};

}  // namespace

TEST_CASE("white rough glass is lossless within 1e-3, from both sides and up to 89.99 degrees") {
  check_round(kGgx);
  check_round(kBeckmann);
}

TEST_CASE("white rough glass of stretched facets is too, up to anisotropy 0.9") {
  check_stretched(kGgx);
  check_stretched(kBeckmann);
}
