// SPDX-License-Identifier: Apache-2.0
// `slab` against the sum over its bounces, `phong_glass` against its distribution of momenta.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/quadrature.h"
#include "materials/thin_film.h"
#include "tests/stats/random.h"
#include "tests/sums.h"
#include "tests/unit/materials/albedo.h"
#include "tests/unit/materials/cases.h"
#include "tests/unit/materials/walter.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

namespace {

using Real = long double;

/// Weights of the reflected and the transmitted delta of wavelength `j`.
std::array<double, 2> deltas(const Material& m, Vec3d wo, int j = 0) {
  const Material turned = with_hero(m, j);
  const materials::Layout layout = turned.layout();
  const auto p = turned.params<double>();
  std::array<double, 2> weights{};
  for (double u : {0.0, 1 - 1e-9}) {
    const auto s = Bsdf<double>(layout, p.data()).sample(wo, u, 0.5, 0.5, Mode::Radiance);
    if (s) weights[s->transmitted] = s->f[0] * std::abs(s->wi.z);
  }
  return weights;
}

/// One face and one polarisation by the textbook's quotients of cosines.
Real face(Real ci, Real ct, Real eta, bool parallel) {
  const Real a = parallel ? eta * ci : ci, b = parallel ? ct : eta * ct;
  return (a - b) * (a - b) / ((a + b) * (a + b));
}

/// Bounce after bounce between the faces, until nothing is left.
std::array<Real, 2> plate_oracle(Real ci, Real eta, Real depth) {
  const Real ct = std::sqrt(1 - (1 - ci * ci) / (eta * eta)), kept = std::exp(-depth / ct);
  std::array<Real, 2> sum{};
  for (const bool parallel : {false, true}) {
    const Real r = face(ci, ct, eta, parallel);
    sum[0] += r / 2;
    Real inside = (1 - r) / 2;
    for (int i = 0; i < 100'000 && inside > 1e-22L; ++i) {
      inside *= kept;
      sum[1 - i % 2] += inside * (1 - r);
      inside *= r;
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("a slab sums its bounces, loses only what it absorbs, and goes straight on") {
  for (double degrees : {0.0, 30.0, 56.0, 75.0, 85.0, 89.0, 110.0, 180.0})
    for (double ior : {1.01, 1.33, 1.5, 2.4, 4.0})
      for (double depth : {0.0, 1e-6, 0.1, 2.0}) {
        const Vec3d wo = direction(degrees, 0.6);
        const auto w = deltas(slab(ior, 0.5, 2 * depth), wo);
        const auto expected = plate_oracle(std::abs(Real(wo.z)), ior, depth);
        for (int k = 0; k < 2; ++k)
          CHECK_MESSAGE(std::abs(w[k] - double(expected[k])) < 1e-12, degrees, " ", ior, " ", depth,
                        ": ", w[k], " against ", double(expected[k]));
        if (depth == 0) CHECK(w[0] + w[1] == doctest::Approx(1).epsilon(1e-13));
      }
  const Material pane = slab(ramp(1.6, 1.4));
  const materials::Layout layout = pane.layout();
  const auto p = pane.params<double>();
  CHECK(Bsdf<double>(layout, p.data()).specular_only());
  const Vec3d wo = direction(70, 1);
  const auto s = Bsdf<double>(layout, p.data()).sample(wo, 0.999, 0.5, 0.5, Mode::Radiance);
  REQUIRE(s);
  CHECK(s->transmitted);
  CHECK(length(s->wi + wo) < 1e-15);
  for (double f : s->f.v) CHECK(f > 0);  // all wavelengths go on together
}

namespace {

/// Quadrature of `value(x, y)` over the momenta added, of Phong's distribution K with exponent n:
/// rings of equal shares of K, and spokes.
template <class F>
double over_disc(double n, const F& value) {
  constexpr int spokes = 400, panels = 12;
  const auto ring = [n](double u) { return std::sqrt(1 - std::pow(1 - u, 2 / (n + 2))); };
  double sum = 0;
  for (int i = 0; i < spokes; ++i) {
    const double a = 2 * kPi<double> * (i + 0.5) / spokes, c = std::cos(a), s = std::sin(a);
    for (int k = 0; k < panels; ++k)
      sum += integrate<8>(
          [&](double u) {
            const double r = ring(u);
            return std::pow(1 - u, 2 / (n + 2) - 1) / (n + 2) * value(r * c, r * s);
          },
          double(k) / panels, (k + 1.0) / panels);
  }
  return sum * 2 * kPi<double> / spokes;
}

/// Albedo of both sides together, Importance mode. The sum of momenta is (x, y); `no`, `ni`: the
/// indices of wo's and the other side.
double albedo(const Material& m, double exponent, Vec3d wo, double no, double ni) {
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  const Bsdf<double> bsdf(layout, p.data());
  const auto choice = bsdf.choose(wo);
  return over_disc(exponent, [&](double x, double y) {
    double sum = 0;
    for (const double n : {no, ni}) {
      const double a = (x - no * wo.x) / n, b = (y - no * wo.y) / n, c2 = 1 - a * a - b * b;
      if (!(c2 > 0)) continue;
      const double c = std::sqrt(c2);
      const Vec3d wi{a, b, (n == no) == (wo.z > 0) ? c : -c};
      sum += bsdf.evaluate(wo, wi, Mode::Importance, choice).f[0] / (n * n);  // |cos| dw = dp / n^2
    }
    return sum;
  });
}

/// How much of K about the momentum `from` is within `radius`: of each of its rings an arc.
double within(double n, double from, double radius) {
  return integrate_adaptive(
      [&](double u) {
        const double r2 = 1 - std::pow(1 - u, 2 / (n + 2));
        const double end = (r2 + from * from - radius * radius) / (2 * std::sqrt(r2) * from);
        return from > 0 ? std::acos(std::clamp(end, -1.0, 1.0)) / kPi<double>
                        : double(r2 < radius * radius);
      },
      0, 1, 1e-7);
}

/// The same without the model: all of the lobe within the rarer side's disc, and half, more or
/// less by Fresnel's reflectance at wo, of what only the denser side has room for.
double albedo_oracle(double n, Vec3d wo, double no, double ni) {
  const double f = no > 1 ? materials::fresnel_dielectric(std::abs(wo.z), ni / no)
                          : materials::fresnel_dielectric(std::abs(wo.z), ni),
               dense = std::max(no, ni), half = (no > 1 ? 1 + f : 1 - f) / 2;
  const double from = no * std::sqrt(wo.x * wo.x + wo.y * wo.y), both = within(n, from, 1);
  return both + half * (within(n, from, dense) - both);
}

}  // namespace

TEST_CASE("phong_glass loses what its lobe spreads beyond grazing, and nothing else") {
  for (double n : {0.0, 3.0, 40.0, 1000.0})
    for (double ior : {1.2, 1.5, 2.5})
      for (double degrees : {0.0, 40.0, 80.0, 130.0, 175.0}) {
        const Vec3d wo = direction(degrees, 0.3);
        const double no = wo.z > 0 ? 1 : ior, ni = wo.z > 0 ? ior : 1;
        const double a = albedo(phong_glass(ior, n), n, wo, no, ni);
        const double expected = albedo_oracle(n, wo, no, ni);
        // Where a disc's edge crosses the lobe the rule sees a step.
        CHECK_MESSAGE(std::abs(a - expected) < 1e-3, n, " ", ior, " ", degrees, ": ", a,
                      " against ", expected);
        CHECK(a < 1 + 1e-6);
        if (degrees == 0 || (n == 1000 && degrees == 40)) CHECK(std::abs(a - 1) < 1e-4);
      }
}

TEST_CASE("below a polished coat phong_glass loses what it does alone, from both sides" * kSum) {
  double worst = 0;
  for (double n : {0.0, 0.7, 3.0, 40.0, 1000.0})
    for (double ior : {1.02, 1.5, 2.5})
      for (double degrees : {0.0, 40.0, 80.0, 89.9, 100.0, 130.0, 175.0}) {
        const Vec3d wo = direction(degrees, 0.3);
        const bool outside = wo.z > 0;
        const double no = outside ? 1 : ior, ni = outside ? ior : 1;
        const double bare = albedo_oracle(n, wo, no, ni);
        const auto check = [&](const Material& m, double through, const std::string& coat) {
          const materials::Layout layout = m.layout();
          const auto p = m.params<double>();
          const auto [here, across] = deltas(layout, p.data(), wo);
          CHECK(across == 0);
          const double a = albedo(m, n, wo, no, ni) + here;
          const double error = a - (outside ? 1 - through + through * bare : bare);
          worst = std::max(worst, std::abs(error));
          CHECK_MESSAGE(std::abs(error) < 1e-3, n, " ", ior, " ", degrees, " under ", coat, ": ",
                        error);
        };
        const Material base = phong_glass(ior, n);
        for (double coat : {1.005, 1.5, 3.0})
          check(fresnel_mix(base, mirror(1), coat), 1 - textbook_fresnel(std::abs(wo.z), coat),
                "an index of " + std::to_string(coat));
        const materials::Film<double> film(1.8, 3e-7, 5e-7);
        check(film_mix(base, mirror(1), 1.4, 1.8, 3e-7, 5e-7),
              film.split(std::abs(wo.z), 1.0, 1.4).transmitted, "a film");
      }
  MESSAGE("largest error of albedos: ", worst);
}

TEST_CASE("phong_glass is Phong's lobe at normal incidence, and smooth glass where it is narrow") {
  const Material glass = phong_glass(1.5, 20), lobe = tinted(Lobe::Phong, 1, {20});
  const Vec3d up{0, 0, 1};
  for (double degrees : {0.0, 20.0, 70.0}) {
    const Vec3d wi = direction(degrees, 2);
    const double f =
        (materials::fresnel_dielectric(1.0, 1.5) + materials::fresnel_dielectric(wi.z, 1.5)) / 2;
    CHECK(value(glass, up, wi) == doctest::Approx(f * value(lobe, up, wi)));
  }
  const Material narrow = phong_glass(ramp(1.6, 1.4), 0.999e7);
  const materials::Layout thin = narrow.layout();
  const auto r = narrow.params<double>();
  for (double degrees : {20.0, 70.0, 150.0}) {
    const Vec3d wo = direction(degrees, 1);
    const double eta = wo.z > 0 ? 1.6 : 1 / 1.6;
    for (double u : {0.0, 0.99999}) {
      const auto s = Bsdf<double>(thin, r.data()).sample(wo, u, 0.5, 0.3, Mode::Radiance);
      REQUIRE(s);
      const Vec3d ideal = s->transmitted ? materials::refracted(wo, eta) : materials::mirrored(wo);
      CHECK(s->transmitted == (u > 0.5));
      CHECK(length(s->wi - ideal) < 3e-3);  // (1 - P^2)^n/2 = 1/2 is P = 3.7e-4
    }
  }
}

namespace {

/// f of phong_glass by its definition, with the textbook's Fresnel.
Real phong_glass_oracle(Vec3d wo, Vec3d wi, Real ior, Real n) {
  const bool reflects = wo.z * wi.z > 0;
  const Real no = wo.z > 0 ? 1 : ior, nt = wo.z > 0 ? ior : 1, ni = reflects ? no : nt;
  const Real x = no * wo.x + ni * wi.x, y = no * wo.y + ni * wi.y, p2 = x * x + y * y;
  if (p2 >= 1) return 0;
  const auto reflectance = [&](Real c, Real eta) -> Real {
    const Real ct2 = 1 - (1 - c * c) / (eta * eta);
    if (ct2 <= 0) return 1;
    return (face(c, std::sqrt(ct2), eta, false) + face(c, std::sqrt(ct2), eta, true)) / 2;
  };
  const Real o = reflectance(std::abs(Real(wo.z)), nt / no),
             i = reflectance(std::abs(Real(wi.z)), reflects ? nt / no : no / nt);
  return ni * ni * (n + 2) / (2 * kPi<Real>)*std::pow(1 - p2, n / 2) *
         (reflects ? (o + i) / 2 : 1 - (o + i) / 2);
}

}  // namespace

TEST_CASE("phong_glass in float is its definition within a stated bound") {
  stats::Random random(4);
  double worst = 0;
  for (double n : {1.0, 50.0, 3000.0, 1e5})
    for (double ior : {1.1, 1.5, 2.5}) {
      const Material m = phong_glass(float(ior), n);
      const materials::Layout layout = m.layout();
      const auto p = m.params<float>();
      const Bsdf<float> bsdf(layout, p.data());
      for (int k = 0; k < 3000; ++k) {
        Vec3<float> wo(square_to_sphere(random.next(), random.next()));
        const float u = random.next_float(), u1 = random.next_float();
        const auto s = bsdf.sample(wo, u, u1, random.next_float(), Mode::Importance);
        if (!s || std::abs(wo.z) < 0.05f || std::abs(s->wi.z) < 0.05f) continue;
        const Vec3d o(wo), i(s->wi);
        const double no = wo.z > 0 ? 1 : ior, ni = s->transmitted ? (wo.z > 0 ? ior : 1) : no;
        const double eta = wo.z > 0 ? ior : 1 / ior;
        // Next to the critical angle of either side Fresnel's factor is ill-conditioned.
        const double go = materials::refraction_g2(std::abs(o.z), eta),
                     gi = materials::refraction_g2(std::abs(i.z), s->transmitted ? 1 / eta : eta);
        if (std::abs(go) < 0.02 || std::abs(gi) < 0.02) continue;
        const double x = no * o.x + ni * i.x, y = no * o.y + ni * i.y, p2 = x * x + y * y;
        const double truth = double(phong_glass_oracle(o, i, float(ior), n));
        if (!(truth > 0) || p2 > 0.99) continue;
        // A sum of tangents is right within 2 eps (n_o + n_i), and f ~ (1 - P^2)^(n/2) changes by n
        // P / (1 - P^2) of itself for each unit of P. The rest: a dozen roundings, those of
        // Fresnel's factor enlarged by 1 / g^2.
        const double eps = 0x1p-24;
        const double bound =
            eps * (40 + 40 * ior * ior + n * (std::sqrt(p2) * 2 * (no + ni) + 2 * p2) / (1 - p2));
        const double error = std::abs(s->f[0] - truth) / truth;
        worst = std::max(worst, error / bound);
        CHECK_MESSAGE(error < bound, n, " ", ior, " ", o.z, " ", i.z, ": ", error, " of ", bound);
      }
    }
  MESSAGE("phong_glass: largest error over its bound ", worst);
}

TEST_CASE("slab in float is within 2e-6 of its sum, absolutely") {
  double worst = 0;
  for (double ior : {1.001, 1.33, 1.5, 4.0})
    for (double depth : {0.0, 1e-3, 0.5})
      for (double degrees = 0; degrees < 89.9; degrees += 1.7) {
        const Material m = slab(float(ior), 1, float(depth));
        const materials::Layout layout = m.layout();
        const auto p = m.params<float>();
        const Vec3<float> wo(direction(degrees, 1));
        const auto expected = plate_oracle(Real(wo.z), float(ior), float(depth));
        for (float u : {0.0f, 0x1.fffffep-1f}) {
          const auto s = Bsdf<float>(layout, p.data()).sample(wo, u, 0.5f, 0.5f, Mode::Radiance);
          if (!s) continue;
          const double w = double(s->f[0]) * std::abs(s->wi.z);
          worst = std::max(worst, std::abs(w - double(expected[s->transmitted])));
        }
      }
  CHECK(worst < 2e-6);
  MESSAGE("slab: largest error ", worst);
}
