// SPDX-License-Identifier: Apache-2.0
// Albedo by quadrature, two-sided where a model is lossless; reciprocity; delta weights.
#include <doctest/doctest.h>

#include "tests/stats/quadrature.h"
#include "tests/stats/random.h"
#include "tests/unit/materials/cases.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

namespace {

/// Albedo of the upper side without deltas, over x = cos^2 and the azimuth from the mirror
/// direction's, both refined towards the mirror direction.
double albedo(const Material& m, double degrees, double tolerance = 1e-9) {
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  const Bsdf<double> bsdf(layout, p.data());
  const Vec3d wo = direction(degrees, 0.0);
  const double y = wo.z * wo.z;
  const auto ring = [&](double x) {
    const double z = std::sqrt(x), r = std::sqrt(1 - x);
    const auto f = [&](double phi) {
      return bsdf.eval(wo, {-r * std::cos(phi), -r * std::sin(phi), z}, Mode::Radiance)[0];
    };
    double sum = 0, a = 0;
    for (double b = 1e-6; a < kPi<double>; a = b, b = std::min(4 * b, kPi<double>))
      sum += stats::integrate_adaptive(f, a, b, tolerance);
    return sum;  // half the circle, dx = 2 cos sin dtheta
  };
  double sum = 0;
  // Cut geometrically on both sides of y.
  const auto side = [&](double end) {
    double a = 0;
    const double reach = std::abs(end - y);
    for (double b = std::min(1e-7, reach); a < reach; a = b, b = std::min(4 * b, reach)) {
      const double s = end > y ? 1 : -1;
      sum += stats::integrate_adaptive([&](double d) { return ring(y + s * d); }, a, b, tolerance);
    }
  };
  side(1);
  side(0);
  return sum;
}

}  // namespace

TEST_CASE("the thesis' glossy model is lossless") {
  double worst = 0;
  // m = 2 ln cosh n is about 2 n - 1.39: n = 5000 is m = 1e4.
  for (double gloss : {0.0, 1e-6, 0.01, 0.5, 4.0, 40.0, 1000.0, 5000.0})
    for (double degrees : {0.0, 30.0, 60.0, 85.0, 89.99}) {
      const double a = albedo(glossy(1, gloss), degrees);
      worst = std::max(worst, std::abs(a - 1));
      CHECK_MESSAGE(std::abs(a - 1) < 1e-6, gloss, " at ", degrees, ": ", a);
    }
  MESSAGE("glossy, m <= 1e4: largest |albedo - 1| ", worst);
}

TEST_CASE("one-sided albedos of what may lose") {
  CHECK(albedo(matte(0.37), 40) == doctest::Approx(0.37).epsilon(1e-9));
  for (double roughness : {0.1, 0.3, 0.5, 1.0}) {
    double low = 1, high = 0;
    for (double degrees : {0.0, 30.0, 60.0, 85.0, 89.99}) {
      const double a = albedo(microfacet(1, roughness), degrees, 1e-6);
      low = std::min(low, a);
      high = std::max(high, a);
      CHECK(a <= 1 + 1e-4);
      // Single scattering at alpha = 1 and normal incidence: D G2 / 4 integrates to 1 - ln 2.
      if (roughness == 1.0 && degrees == 0.0)
        CHECK(a == doctest::Approx(1 - std::log(2.0)).epsilon(1e-5));
    }
    MESSAGE("microfacet ", roughness, ": white albedo ", low, " to ", high);
  }
}

TEST_CASE("white under a white coat") {
  for (double ior : {1.2, 1.5, 2.5}) {
    // The delta's part is added by hand: F.
    for (double degrees : {0.0, 30.0, 60.0, 85.0, 89.99}) {
      const double c = direction(degrees, 0).z;
      const double a = albedo(fresnel_mix(matte(1), mirror(1), ior), degrees) +
                       materials::fresnel_dielectric(c, ior);
      CHECK_MESSAGE(std::abs(a - 1) < 1e-6, ior, " at ", degrees, ": ", a);
    }
    for (double gloss : {4.0, 40.0, 1000.0}) {
      double low = 2, high = 0;
      for (double degrees : {0.0, 30.0, 60.0, 75.0, 85.0, 89.99}) {
        const double a = albedo(fresnel_mix(matte(1), glossy(1, gloss), ior), degrees, 1e-7);
        low = std::min(low, a);
        high = std::max(high, a);
        CHECK_MESSAGE(a <= 1 + 1e-4, ior, " ", gloss, " at ", degrees, ": ", a);
      }
      MESSAGE("white matte under index ", ior, ", gloss ", gloss, ": ", low, " to ", high);
    }
  }
}

TEST_CASE("reciprocity") {
  double worst = 0;
  for (const Case& c : smooth_cases()) {
    const materials::Layout layout = c.material.layout();
    const auto p = c.material.params<double>();
    const Bsdf<double> bsdf(layout, p.data());
    stats::Random random(3);
    for (int i = 0; i < 2000; ++i) {
      const Vec3d a = square_to_sphere(random.next(), random.next());
      const Vec3d b = square_to_sphere(random.next(), random.next());
      const auto ab = bsdf.eval(a, b, Mode::Radiance), ba = bsdf.eval(b, a, Mode::Importance);
      for (int j = 0; j < kWavelengths; ++j) {
        const double scale = std::max(ab[j], ba[j]);
        if (scale == 0) continue;
        worst = std::max(worst, std::abs(ab[j] - ba[j]) / scale);
        CHECK(ab[j] == doctest::Approx(ba[j]).epsilon(1e-9));
      }
    }
  }
  MESSAGE("largest relative difference of f(a, b) and its adjoint ", worst);
}

TEST_CASE("refracted radiance scales by the squared index") {
  const Material m = dielectric(1.5, 0.4);
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  const Bsdf<double> bsdf(layout, p.data());
  const Vec3d wo = direction(30, 0.3), wi = direction(160, 3.3);
  const double radiance = bsdf.eval(wo, wi, Mode::Radiance)[0];
  CHECK(radiance > 0);
  CHECK(bsdf.eval(wo, wi, Mode::Importance)[0] == doctest::Approx(2.25 * radiance));
  // f_r(a, b) / n_b^2 is symmetric.
  CHECK(bsdf.eval(wi, wo, Mode::Radiance)[0] == doctest::Approx(2.25 * radiance));
}

TEST_CASE("glossy is reciprocal to the bit in float") {
  const Material m = glossy(1, 200);
  const materials::Layout layout = m.layout();
  const auto p = m.params<float>();
  const Bsdf<float> bsdf(layout, p.data());
  stats::Random random(9);
  for (int i = 0; i < 20000; ++i) {
    const Vec3<float> a(square_to_sphere(random.next(), random.next()));
    const Vec3<float> b(square_to_sphere(random.next(), random.next()));
    CHECK(bsdf.eval(a, b, Mode::Radiance) == bsdf.eval(b, a, Mode::Radiance));
  }
}

TEST_CASE("lossless deltas carry everything") {
  for (double ior : {0.4, 0.9999999, 1.0, 1.0000001, 1.3, 4.0})
    for (double degrees : {0.0, 45.0, 80.0, 89.9, 100.0, 135.0, 180.0}) {
      const Material m = dielectric(ior);
      const materials::Layout layout = m.layout();
      const auto p = m.params<double>();
      const Bsdf<double> bsdf(layout, p.data());
      CHECK(bsdf.specular_only());
      const Vec3d wo = direction(degrees, 1);
      double sum = 0, sum_pdf = 0;
      bool seen[2] = {};
      for (double u : {0.0, 0.01, 0.1, 0.5, 0.9999}) {
        const auto s = bsdf.sample(wo, u, 0.5, 0.5, Mode::Importance);
        REQUIRE(s);
        CHECK(length(s->wi) == doctest::Approx(1).epsilon(1e-12));
        CHECK(s->f[0] * std::abs(s->wi.z) / s->pdf[0] == doctest::Approx(1).epsilon(1e-12));
        // Snell: tangential lengths.
        const double eta = wo.z > 0 ? ior : 1 / ior;
        if (s->transmitted) CHECK(eta * s->wi.x == doctest::Approx(-wo.x).epsilon(1e-12));
        if (!seen[s->transmitted]) {
          sum += s->f[0] * std::abs(s->wi.z);
          sum_pdf += s->pdf[0];
        }
        seen[s->transmitted] = true;
      }
      if (seen[0] && seen[1]) {
        CHECK(sum == doctest::Approx(1).epsilon(1e-12));
        CHECK(sum_pdf == doctest::Approx(1).epsilon(1e-12));
      }
    }
}
