// SPDX-License-Identifier: Apache-2.0
// Thin films against characteristic matrices, coats against Beer and Lambert's law.
#include <doctest/doctest.h>

#include <complex>

#include "tests/unit/materials/cases.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

namespace {

using C = std::complex<double>;

/// Reflectance by the characteristic matrix of the film (Born and Wolf, 1.6.2), light from vacuum.
double matrix_oracle(double c, C film, C base, double thickness, double wavelength) {
  const C s2 = 1 - c * c, cf = std::sqrt(1.0 - s2 / (film * film)),
          cb = std::sqrt(1.0 - s2 / (base * base));
  const C beta = 2 * kPi<double> * film * thickness * cf / wavelength;
  double sum = 0;
  for (bool parallel : {false, true}) {
    const C a = parallel ? C(c) : C(1 / c), f = parallel ? cf / film : 1.0 / (film * cf),
            b = parallel ? cb / base : 1.0 / (base * cb);  // inverse admittances
    const C i(0, 1), e = std::cos(beta) - i * std::sin(beta) * f / b,
                     h = std::cos(beta) / b - i * std::sin(beta) / f;
    sum += std::norm((e - h * a) / (e + h * a));
  }
  return sum / 2;
}

Spectrum<double> weights(const Material& m, Vec3d wo, bool reflected) {
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  for (double u : {0.0, 1 - 1e-9}) {
    const auto s = Bsdf<double>(layout, p.data()).sample(wo, u, 0.5, 0.5, Mode::Importance);
    if (s && s->transmitted != reflected) return s->f * std::abs(s->wi.z);
  }
  return {};
}

}  // namespace

TEST_CASE("thin films reflect as characteristic matrices say") {
  const auto lambda = ramp(380e-9, 780e-9);
  for (double degrees : {0.0, 40.0, 70.0, 89.0})
    for (double thickness : {0.0, 50e-9, 120e-9, 400e-9, 2e-6})
      for (double film : {1.0, 1.38, 2.2}) {
        const Vec3d wo = direction(degrees, 0.4);
        const auto metal = weights(film_conductor(0.3, 3.2, film, thickness, lambda, 0), wo, true);
        const auto glass = weights(film_dielectric(1.5, film, thickness, lambda), wo, true);
        for (int j = 0; j < kWavelengths; ++j) {
          const double m = matrix_oracle(wo.z, film, C(0.3, 3.2), thickness, lambda[j]);
          const double g = matrix_oracle(wo.z, film, 1.5, thickness, lambda[j]);
          CHECK(metal[j] == doctest::Approx(m).epsilon(1e-9));
          CHECK(std::abs(glass[j] - g) < 1e-11);
        }
      }
}

TEST_CASE("a quarter wave of the root of the index does not reflect") {
  const auto r = weights(film_dielectric(1.5, std::sqrt(1.5), 550e-9 / 4 / std::sqrt(1.5), 550e-9),
                         {0, 0, 1}, true);
  CHECK(r[0] < 1e-20);
}

TEST_CASE("film and glass together lose nothing, from both sides alike") {
  for (double degrees : {10.0, 60.0, 85.0}) {
    const Material m = film_dielectric(1.5, 2.0, 200e-9, 500e-9);
    const Vec3d out = direction(degrees, 0);
    const auto r = weights(m, out, true), t = weights(m, out, false);
    CHECK(r[0] + t[0] == doctest::Approx(1).epsilon(1e-12));
    const double s = out.x / 1.5;
    const Vec3d in{s, 0, -std::sqrt(1 - s * s)};
    CHECK(weights(m, in, true)[0] == doctest::Approx(r[0]).epsilon(1e-9));
  }
}

TEST_CASE("a coat dims its base by its two ways through the layer") {
  const double depth = 0.7, ior = 1.5;
  const Material clear = coat(mirror(1), matte(0.8), 0, 1, ior);
  const Material plain = fresnel_mix(matte(0.8), mirror(1), ior);
  const Material dim = coat(mirror(1), matte(0.8), 0.35, 2, ior);
  const auto value = [](const Material& m, Vec3d o, Vec3d i) {
    const materials::Layout layout = m.layout();
    const auto p = m.params<double>();
    return Bsdf<double>(layout, p.data()).eval(o, i, Mode::Radiance)[0];
  };
  for (double a : {0.0, 50.0, 89.0})
    for (double b : {20.0, 80.0}) {
      const Vec3d o = direction(a, 0), i = direction(b, 2);
      const double ca = std::cos(std::asin(std::sin(a * kPi<double> / 180) / ior));
      const double cb = std::cos(std::asin(std::sin(b * kPi<double> / 180) / ior));
      CHECK(value(clear, o, i) == doctest::Approx(value(plain, o, i)));
      CHECK(value(dim, o, i) ==
            doctest::Approx(value(plain, o, i) * std::exp(-depth * (1 / ca + 1 / cb))));
    }
}

TEST_CASE("turned glossy lobes are the mirrored one") {
  const auto value = [](Lobe lobe, Vec3d o, Vec3d i) {
    const Material m = tinted(lobe, 1, {30, 80});
    const materials::Layout layout = m.layout();
    const auto p = m.params<double>();
    return Bsdf<double>(layout, p.data()).eval(o, i, Mode::Radiance)[0];
  };
  const Vec3d o = direction(50, 0.3);
  for (double degrees : {20.0, 50.0, 85.0}) {
    const Vec3d i = direction(degrees, 3);
    const double f = value(Lobe::GlossyProduct, o, i);
    CHECK(value(Lobe::GlossyBack, o, {-i.x, -i.y, i.z}) == f);
    CHECK(value(Lobe::GlossyThrough, o, {i.x, i.y, -i.z}) == f);
  }
}
