// SPDX-License-Identifier: Apache-2.0
// What white rough glass scatters in all, from both sides and up to grazing: its first bounce as
// Walter et al. (2007) write it, with the textbook's Fresnel, and of the model's value the rest.
#include <doctest/doctest.h>

#include <cmath>

#include "base/quadrature.h"
#include "tests/sanitized.h"
#include "tests/unit/materials/cases.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

namespace {

/// GGX facets between a near side, z > 0, and a far one of relative index `eta`.
struct Facets {
  double alpha, eta;

  double normals(double z) const {
    const double z2 = z * z, t = alpha * alpha * z2 + 1 - z2;
    return alpha * alpha / (kPi<double> * t * t);
  }
  double lambda(double z) const {
    return (std::sqrt(1 + alpha * alpha * (1 - z * z) / (z * z)) - 1) / 2;
  }
  double reflectance(double c) const {
    const double ct2 = 1 - (1 - c * c) / (eta * eta);
    if (ct2 <= 0) return 1;
    const double ct = std::sqrt(ct2), s = (c - eta * ct) / (c + eta * ct),
                 p = (eta * c - ct) / (eta * c + ct);
    return (s * s + p * p) / 2;
  }

  /// What comes along `o` and leaves for good at the first facet: the mean over the normals that
  /// are seen of both ways on, each with what masks it. `n` points along each axis, by the middle
  /// of cells; the tail of steep facets is as long as 1 / alpha^2.
  double once(Vec3d o, int n) const {
    const materials::Ggx<double> seen{{alpha, alpha}};
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const double s = (i + 0.5) / n, left = s * s * s * s, steep = 4 * s * s * s;
      for (int k = 0; k < n; ++k) {
        const Vec3d h = seen.sample_visible(o, (k + 0.5) / n, 1 - left);
        const double c = dot(o, h), f = reflectance(c);
        const Vec3d r = h * (2 * c) - o;
        if (r.z > 0) sum += steep * f * unmasked(o.z, r.z);
        if (f == 1) continue;
        const double ct = std::sqrt(1 - (1 - c * c) / (eta * eta));
        const Vec3d t = h * (c / eta - ct) - o / eta;
        if (t.z < 0) sum += steep * (1 - f) * unmasked(o.z, -t.z);
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
    const double g = 1 / (1 + lambda(zo) + lambda(zi));
    if (reflects) return f * normals(h.z) * g / (4 * zo * zi);
    return oh * -ih / (zo * zi) * eta * eta * (1 - f) * g * normals(h.z) / (norm * norm);
  }

 private:
  double unmasked(double zo, double zi) const {
    return (1 + lambda(zo)) / (1 + lambda(zo) + lambda(zi));
  }
};

/// All that comes back from either side of light along `wo`.
double albedo(double ior, double roughness, Vec3d wo) {
  const Material m = dielectric(ior, roughness);
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  const Bsdf<double> bsdf(layout, p.data());
  const double side = wo.z > 0 ? 1 : -1;
  const Facets facets{roughness * roughness, wo.z > 0 ? ior : 1 / ior};
  const Vec3d up{wo.x, wo.y, wo.z * side};
  // The rest does not depend on azimuths: across wo's, where the first bounce is small.
  const Vec3d across = up.z < 1 ? normalize(Vec3d{-up.y, up.x, 0}) : Vec3d{1, 0, 0};
  double rest = 0;
  constexpr int panels = 12;
  for (const double to : {1.0, -1.0})
    for (int k = 0; k < panels; ++k)
      rest += integrate<8>(
          [&](double u) {
            const double z = u * u;
            const Vec3d wi = across * std::sqrt(1 - z * z) + Vec3d{0, 0, z * to};
            const double all = bsdf.eval(wo, {wi.x, wi.y, wi.z * side}, Mode::Importance)[0];
            return 4 * kPi<double> * u * z * (all - facets.value(up, wi));
          },
          double(k) / panels, (k + 1.0) / panels);
  return facets.once(up, kSanitized ? 100 : 200) + rest;
}

}  // namespace

TEST_CASE("white rough glass is lossless within 1e-3, from both sides and up to 89.99 degrees") {
  double worst = 0;
  std::string where;
  int cases = 0;
  for (double index : {1.001, 1.01, 1.02, 1.05, 1.1, 1.33, 1.5, 2.0, 2.5, 4.0})
    for (double ior : {index, 1 / index})
      for (double roughness : {0.05, 0.11, 0.16, 0.225, 0.4, 0.6, 0.85, 1.0}) {
        const Material m = dielectric(ior, roughness);
        const materials::Layout layout = m.layout();
        if (Bsdf<double>(layout, m.params<double>().data()).specular_only()) continue;
        // The ridge of what is lost, a little to its left and right; from the denser side.
        const double critical = std::asin(1 / index) * 180 / kPi<double>;
        for (double degrees : {0.0, 30.0, 60.0, 75.0, 85.0, 89.0, 89.99, critical, critical - 3})
          for (const double angle : {degrees, 180 - degrees}) {
            if (kSanitized && (roughness != 0.225 || degrees < 70)) continue;
            const double a = albedo(ior, roughness, direction(angle, 0.4));
            ++cases;
            if (std::abs(a - 1) > worst) {
              worst = std::abs(a - 1);
              where = std::to_string(ior) + ", " + std::to_string(roughness) + " at " +
                      std::to_string(angle);
            }
            CHECK_MESSAGE(std::abs(a - 1) < 1e-3, ior, " ", roughness, " at ", angle, ": ", a - 1);
          }
      }
  MESSAGE("dielectric: largest |albedo - 1| of ", cases, ": ", worst, ", at index ", where);
}
