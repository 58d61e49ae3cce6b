// SPDX-License-Identifier: Apache-2.0
// Thin films against characteristic matrices, coats against Beer and Lambert's law.
#include <doctest/doctest.h>

#include <complex>

#include "materials/film.h"
#include "tests/unit/materials/cases.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;
using materials::refraction_g2;

namespace {

using Ld = long double;
using C = std::complex<Ld>;

double importance(const Material& m, Vec3d o, Vec3d i) { return value(m, o, i, Mode::Importance); }

/// Reflectance by the characteristic matrix of the film (Born and Wolf, 1.6.2), in the angle of
/// cosine `c` and the index of `near`; `phases` is 2 pi thickness / wavelength.
Ld matrix_oracle(Ld c, Ld near, C film, C base, Ld phases) {
  const C s2 = near * near * (1 - c * c), cf = std::sqrt(Ld(1) - s2 / (film * film)),
          cb = std::sqrt(Ld(1) - s2 / (base * base));
  const C beta = phases * film * cf;
  Ld sum = 0;
  for (bool parallel : {false, true}) {  // inverse admittances
    const C a = parallel ? c / near : 1 / (near * c),
            f = parallel ? cf / film : Ld(1) / (film * cf),
            b = parallel ? cb / base : Ld(1) / (base * cb);
    const C i(0, 1), e = std::cos(beta) - i * std::sin(beta) * f / b,
                     h = std::cos(beta) / b - i * std::sin(beta) / f;
    sum += std::norm((e - h * a) / (e + h * a));
  }
  return sum / 2;
}

/// Of fringes of that contrast, along `c` as the second of three directions.
template <class R>
materials::FresnelSplit<R> filmed(R c, R film, R far, R phases, R contrast) {
  const auto e = materials::FilmAlong<R, 3>({R(0), c, R(1)}, film, far).split(phases, contrast);
  CHECK(e.reflected[0] == 1);
  CHECK(e.transmitted[0] == 0);
  return {e.reflected[1], e.transmitted[1]};
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
          const double phases = 2 * kPi<double> * thickness / lambda[j];
          const double m = matrix_oracle(wo.z, 1, film, C(0.3, 3.2), phases);
          const double g = matrix_oracle(wo.z, 1, film, 1.5, phases);
          CHECK(metal[j] == doctest::Approx(m).epsilon(1e-9));
          CHECK(std::abs(glass[j] - g) < 1e-11);
        }
      }
}

TEST_CASE("what goes through a film has its digits in float, however little it is") {
  double worst = 0, worst_r = 0;
  struct Sides {
    float near;
    std::complex<float> far;
  };
  for (const Sides& s : {Sides{1, 1.5f}, {1.5f, 1}, {1, 2.5f}, {1, {0.3f, 3.2f}}, {1, {2.5f, 3}}})
    for (float film : {1.01f, 1.38f, 2.2f})
      for (float phases : {0.0f, 0.5f, 1.3f, 5.0f})
        for (float c : {1e-7f, 1e-5f, 1e-3f, 0.05f, 0.3f, 0.6f, 0.8f, 0.95f, 1.0f}) {
          if (refraction_g2(c, std::abs(s.far) / s.near) < 0) continue;
          materials::Film<float> f(film, 0, 1);
          f.phases = phases;
          const Ld r = matrix_oracle(c, s.near, film, C(s.far), phases);
          // About forty roundings; those of the phase are turned `phases` film times.
          const double bound = 6e-8 * (40 + 2 * phases * film);
          const auto check = [&](const materials::FresnelSplit<float>& got) {
            const double error = double(std::abs(got.transmitted - (1 - r)) / (1 - r));
            const double error_r = double(std::abs(got.reflected - r));
            worst = std::max(worst, error), worst_r = std::max(worst_r, error_r);
            CHECK_MESSAGE(error < bound, s.near, " ", film, " ", phases, " ", c);
            CHECK_MESSAGE(error_r < bound, s.near, " ", film, " ", phases, " ", c);
          };
          check(f.split(c, s.near, s.far));
          if (s.far.imag() == 0) check(f.split(c, s.near, s.far.real()));
          if (s.far.imag() == 0 && s.near == 1)
            check(filmed<float>(c, film, float(s.far.real()), phases, 1));
        }
  MESSAGE("largest error of what is transmitted, relative, ", worst, "; reflected, ", worst_r);
}

TEST_CASE("films of all thicknesses reflect and transmit as their mean") {
  double worst = 0;
  for (float c : {1e-3f, 0.1f, 0.5f, 0.9f, 1.0f})
    for (float film : {1.0f, 1.38f, 2.2f})
      for (float ior : {1.0001f, 1.2f, 1.5f, 2.5f}) {
        const double n = film, g = std::sqrt((n - 1) * (n + 1) + double(c) * c);
        constexpr int kPhases = 4096;
        double mean = 0;
        for (int i = 0; i < kPhases; ++i)
          mean += double(matrix_oracle(c, 1, film, ior, kPi<double> * (i + 0.5) / kPhases / g)) /
                  kPhases;
        const auto got = filmed<double>(c, film, ior, 2 * kPi<double>, 0);
        const auto in_float = filmed<float>(c, film, ior, 2 * kPi<float>, 0);
        worst = std::max(worst, std::abs(got.reflected - mean));
        CHECK_MESSAGE(std::abs(got.reflected - mean) < 1e-10, c, " ", film, " ", ior);
        CHECK(std::abs(got.reflected + got.transmitted - 1) < 1e-14);
        CHECK(std::abs(in_float.reflected - mean) < 3e-6);
      }
  MESSAGE("largest error ", worst);
}

TEST_CASE("a polished film_mix reflects as characteristic matrices say") {
  const auto lambda = ramp(380e-9, 780e-9);
  for (double degrees : {0.0, 40.0, 70.0, 89.0})
    for (double thickness : {50e-9, 120e-9, 400e-9})
      for (double film : {1.0, 1.38, 2.2})
        for (double ior : {1.2, 1.5, 2.5}) {
          const Vec3d wo = direction(degrees, 0.4);
          const auto seen =
              weights(film_mix(matte(0), mirror(1), ior, film, thickness, lambda), wo, true);
          for (int j = 0; j < kWavelengths; ++j) {
            const double phases = 2 * kPi<double> * thickness / lambda[j];
            CHECK(std::abs(seen[j] - double(matrix_oracle(wo.z, 1, film, ior, phases))) < 1e-11);
          }
        }
}

TEST_CASE("a film that is not there is none") {
  for (const Material& base : {matte(0.7), microfacet(0.7, 0.4), dielectric(1.5, 0.4)})
    for (const Material& top : {mirror(1), microfacet(1, 0.3), glossy(1, 30)}) {
      const Material none = film_mix(base, top, 1.5, 1.38, 0, 5e-7),
                     bare = fresnel_mix(base, top, 1.5);
      const materials::Layout a = none.layout(), b = bare.layout();
      const auto p = none.params<double>(), q = bare.params<double>();
      for (double degrees : {10.0, 60.0, 88.0, 130.0})
        CHECK(Bsdf<double>(a, p.data())
                  .eval(direction(degrees, 0), direction(35, 1), Mode::Radiance)
                  .v == Bsdf<double>(b, q.data())
                            .eval(direction(degrees, 0), direction(35, 1), Mode::Radiance)
                            .v);
    }
}

TEST_CASE("rough glass under a film that is not there is bare") {
  for (const double anisotropy : {0.0, 0.6}) {
    const Material none = film_dielectric(1.5, 1.38, 0, 5e-7, 0.4, 0.9, 0.8, anisotropy),
                   bare = dielectric(1.5, 0.4, 0.9, 0.8, anisotropy);
    const materials::Layout a = none.layout(), b = bare.layout();
    const auto pa = none.params<double>(), pb = bare.params<double>();
    for (double degrees : {10.0, 60.0, 130.0})
      for (double other : {20.0, 80.0, 160.0}) {
        const Vec3d wo = direction(degrees, 0.4), wi = direction(other, 2.5);
        const auto of_none = Bsdf<double>(a, pa.data()).evaluate(wo, wi, Mode::Radiance),
                   of_bare = Bsdf<double>(b, pb.data()).evaluate(wo, wi, Mode::Radiance);
        CHECK(of_none.f[0] == doctest::Approx(of_bare.f[0]).epsilon(1e-9));
        CHECK(of_none.pdf[0] == doctest::Approx(of_bare.pdf[0]).epsilon(1e-9));
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

TEST_CASE("a layer below coats is crossed as Snell's law has it, through all of them") {
  const double depth = 0.7;
  for (const double above : {1.2, 1.5})
    for (const double below : {0.9, 1.0, 1.3})  // of it over that above
      for (const double degrees : {10.0, 50.0, 80.0}) {
        const auto seen = [&](double thickness) {
          const Material m = coat(
              mirror(1), coat(microfacet(1, 0.3), matte(0.8), thickness, 1, below), 0, 0, above);
          const Material black =
              coat(mirror(1), coat(microfacet(1, 0.3), matte(0), thickness, 1, below), 0, 0, above);
          const Vec3d o = direction(degrees, 0.4), i = direction(35, 3);
          return value(m, o, i) - value(black, o, i);
        };
        double ways = 0;
        for (const double angle : {degrees, 35.0}) {
          const double sine = std::sin(angle * kPi<double> / 180) / (above * below);
          ways += 1 / std::sqrt(1 - sine * sine);
        }
        CHECK(seen(depth) == doctest::Approx(seen(0) * std::exp(-depth * ways)).epsilon(1e-12));
      }
}

TEST_CASE("a coat of an index below 1 with none above reflects as its inverse, and bends nothing") {
  const double ior = 0.75, depth = 0.7;
  for (const Material& top : {mirror(1), microfacet(1, 0.4), tinted(Lobe::Ward, 1, {0.3, 0})})
    for (const Material& base : {matte(0.8), beckmann(1, 0.5, 0.3), dielectric(1.5, 0.4)})
      for (const double degrees : {10.0, 60.0, 85.0, 130.0})  // beyond the critical angle too
        for (const double there : {30.0, 80.0, 150.0}) {
          const Vec3d o = direction(degrees, 0.4), i = direction(there, 3);
          const double of_inverse = value(fresnel_mix(base, top, 1 / ior), o, i);
          CHECK(value(fresnel_mix(base, top, ior), o, i) ==
                doctest::Approx(of_inverse).epsilon(1e-12));
        }
  for (const double degrees : {10.0, 60.0, 85.0}) {
    const Vec3d o = direction(degrees, 0.4), i = direction(35, 3);
    const double layers = std::exp(-depth * (1 / o.z + 1 / i.z));
    CHECK(value(coat(mirror(1), matte(0.8), depth, 1, ior), o, i) ==
          doctest::Approx(value(coat(mirror(1), matte(0.8), 0, 0, ior), o, i) * layers));
  }
}

TEST_CASE("turned glossy lobes are the mirrored one") {
  const auto of = [](Lobe lobe) { return tinted(lobe, 1, {30, 80}); };
  const Vec3d o = direction(50, 0.3);
  for (double degrees : {20.0, 50.0, 85.0}) {
    const Vec3d i = direction(degrees, 3);
    const double f = value(of(Lobe::GlossyProduct), o, i);
    CHECK(value(of(Lobe::GlossyBack), o, {-i.x, -i.y, i.z}) == f);
    CHECK(value(of(Lobe::GlossyThrough), o, {i.x, i.y, -i.z}) == f);
  }
}

TEST_CASE("the glossy lobe around refraction is the one that goes through, bent") {
  const double n = 1.5, critical = std::asin(1 / n) * 180 / kPi<double>;
  const auto sine = [](double degrees) { return std::sin(degrees * kPi<double> / 180); };
  const Material through = tinted(Lobe::GlossyThrough, 1, {30, 80});
  const Material bent = glossy_refraction(n, {30, 80}), same = glossy_refraction(1, {30, 80});
  for (double a : {5.0, 50.0, 89.0})
    for (double b : {10.0, 50.0, 80.0}) {
      const Vec3d o = direction(a, 0.3), i = direction(180 - b, 3.2);
      const double f = importance(through, o, i);
      CHECK(importance(same, o, i) == f);
      // By Snell's law, within the cone of what is refracted.
      const Vec3d inside = direction(180 - std::asin(sine(b) / n) * 180 / kPi<double>, 3.2);
      CHECK(importance(bent, o, inside) == doctest::Approx(n * n * f).epsilon(1e-10));
      CHECK(importance(bent, inside, o) == doctest::Approx(f).epsilon(1e-10));
      CHECK(importance(glossy_refraction(1 / n, {30, 80}), {o.x, o.y, -o.z},
                       {inside.x, inside.y, -inside.z}) ==
            doctest::Approx(n * n * f).epsilon(1e-10));
      CHECK(importance(bent, o, {i.x, i.y, -i.z}) == 0);
    }
  // What is reflected totally: cos^2, of which there is k, is stretched to all of [0, 1].
  const double k = 1 - 1 / (n * n);
  const Material flat = tinted(Lobe::GlossyProduct, 1, {30, 0});
  const auto stretched = [&](double degrees, double phi) {
    const double z = std::cos(degrees * kPi<double> / 180);
    return direction(std::acos(std::sqrt(z * z / k)) * 180 / kPi<double>, phi);
  };
  for (double a : {critical + 0.5, 60.0, 88.0})
    for (double b : {critical + 5, 75.0, 89.0}) {
      const double expected = importance(flat, stretched(a, 0.3), stretched(b, 2)) / k;
      CHECK(importance(glossy_refraction(n, {30, 0}), direction(180 - a, 0.3),
                       direction(180 - b, 2)) == doctest::Approx(expected).epsilon(1e-10));
      CHECK(importance(bent, direction(180 - a, 0.3), direction(critical - 1, 2)) == 0);
    }
}
