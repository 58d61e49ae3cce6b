// SPDX-License-Identifier: Apache-2.0
// Samples against densities: chi-square, weights, and the mean weight against quadrature.
#include <doctest/doctest.h>

#include <cstdlib>

#include "tests/stats/chi_square.h"
#include "tests/unit/materials/cases.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

TEST_CASE("samples follow the density") {
  const auto cases = smooth_cases();
  const int tests = int(cases.size() * std::size(kDegrees));
  const double level = stats::sidak(0.01, tests);
  // `./run nightly` draws 10^6; MMS_STATS_MODEL takes one model, by the start of its name.
  const char* samples = std::getenv("MMS_STATS_SAMPLES");
  const char* only = std::getenv("MMS_STATS_MODEL");
  const int count = samples ? std::atoi(samples) : stats::ChiSquareTest{}.count;
  double worst = 1;
  std::uint64_t seed = 0;
  for (const Case& c : cases) {
    if (only && !c.name.starts_with(only)) {
      seed += std::size(kDegrees);  // the others keep theirs
      continue;
    }
    const materials::Layout layout = c.material.layout();
    const auto p32 = c.material.params<float>();
    const auto p64 = hero_only(c.material).params<double>();
    const Bsdf<float> sampled(layout, p32.data());
    const Bsdf<double> exact(layout, p64.data());
    for (double degrees : kDegrees) {
      const Vec3<float> wo(direction(degrees, 0.7));
      const Vec3d wo_exact = normalize(Vec3d(wo));
      const auto choice = sampled.choose(wo);
      const auto choice_exact = exact.choose(wo_exact);
      const auto r = stats::chi_square(
          {.sample = [&](stats::Random& random) -> std::optional<Vec3d> {
             const float u = random.next_float(), u1 = random.next_float();
             const auto s = sampled.sample(wo, u, u1, random.next_float(), Mode::Radiance, choice);
             if (!s || s->specular) return {};
             return normalize(Vec3d(s->wi));
           },
           .pdf =
               [&](Vec3d wi) {
                 return exact.evaluate(wo_exact, wi, Mode::Radiance, choice_exact).pdf[0];
               },
           .count = count,
           .seed = ++seed});
      worst = std::min(worst, r.p_value);
      CHECK_MESSAGE(r.passed(level), c.name, " at ", degrees, ": ", r.report());
    }
  }
  MESSAGE("smallest of ", tests, " p-values ", worst, ", level ", level);
}

TEST_CASE("a sample reports what eval and pdf say, and its mean weight is the albedo") {
  const auto cases = smooth_cases();
  const int tests = int(cases.size() * std::size(kDegrees));
  const double level = stats::sidak(0.01, tests);
  std::uint64_t seed = 1000;
  for (const Case& c : cases) {
    const materials::Layout layout = c.material.layout();
    const auto p = c.material.params<double>(), p_hero = hero_only(c.material).params<double>();
    const Bsdf<double> bsdf(layout, p.data()), hero(layout, p_hero.data());
    for (double degrees : kDegrees) {
      const Vec3d wo = direction(degrees, 0.7);
      const auto choice = bsdf.choose(wo), hero_choice = hero.choose(wo);
      stats::Random random(++seed);
      // With wi drawn uniformly over projected solid angle of both sides, an estimate that does not
      // use the model's own sampling at all.
      stats::Moments drawn, reference, squares;
      double largest = 0;
      int wrong = 0;
      for (int i = 0; i < (kSanitized ? 5000 : 20000); ++i) {
        const double u = random.next(), u1 = random.next(), u2 = random.next();
        const auto s = bsdf.sample(wo, u, u1, u2, Mode::Importance, choice);
        const bool smooth = s && !s->specular;
        const double share = smooth ? s->f[0] * std::abs(s->wi.z) / s->pdf[0] : 0;
        drawn.add(share);
        squares.add(smooth ? share * (2 * kPi<double> * s->f[0]) : 0);
        if (smooth && i < 2000) {
          wrong += !(s->f == bsdf.eval(wo, s->wi, Mode::Importance));
          wrong += !(s->pdf == bsdf.pdf(wo, s->wi, Mode::Importance));
          wrong += s->transmitted != (s->wi.z * wo.z < 0);
        }
        Vec3d wi = square_to_cosine_hemisphere(u1, u2);
        if (u < 0.5) wi.z = -wi.z;
        const double weight =
            2 * kPi<double> * hero.evaluate(wo, wi, Mode::Importance, hero_choice).f[0];
        largest = std::max(largest, weight);
        reference.add(weight);
      }
      CHECK_MESSAGE(wrong == 0, c.name, " at ", degrees);
      // Lobes far narrower than the reference's samples are left to the chi-square test: where one
      // sample of 20 000 is 50 times the mean, the rest does not tell how far it is off; and where
      // none meets the lobe at all, only the drawn ones tell the mean of the reference's squares.
      if (largest > 50 * reference.mean) continue;
      if (std::sqrt(squares.mean / reference.n) > 0.03 * drawn.mean) continue;
      if (reference.standard_error() > 0.03 * reference.mean || reference.mean == 0) continue;
      const double e = std::hypot(drawn.standard_error(), reference.standard_error());
      const double z = e > 0 ? (drawn.mean - reference.mean) / e : 0;
      CHECK_MESSAGE(stats::normal_two_sided(z) > level, c.name, " at ", degrees, ": ", drawn.mean,
                    " against ", reference.mean);
    }
  }
}

TEST_CASE("pdf of a wavelength is the density with that wavelength as the hero") {
  for (const Case& c : smooth_cases()) {
    const materials::Layout layout = c.material.layout();
    const auto p = c.material.params<double>();
    const Bsdf<double> bsdf(layout, p.data());
    for (int j = 1; j < kWavelengths; j += 3) {
      const Material turned = with_hero(c.material, j);
      const auto q = turned.params<double>();
      const Bsdf<double> other(layout, q.data());
      for (double degrees : kDegrees) {
        const Vec3d wo = direction(degrees, 0.7);
        stats::Random random(j);
        for (int i = 0; i < 100; ++i) {
          const Vec3d wi = square_to_sphere(random.next(), random.next());
          CHECK(bsdf.pdf(wo, wi, Mode::Radiance)[j] ==
                doctest::Approx(other.pdf(wo, wi, Mode::Radiance)[0]).epsilon(1e-12));
        }
      }
    }
  }
}

namespace {

/// How often, of `n` draws with wavelength `j` as the hero, a delta leads to `wi` exactly (within
/// rounding).
double frequency(const Material& m, int j, Vec3d wo, Vec3d wi, int n) {
  const Material turned = with_hero(m, j);
  const materials::Layout layout = turned.layout();
  const auto p = turned.params<double>();
  const Bsdf<double> bsdf(layout, p.data());
  stats::Random random(77 + j);
  int hits = 0;
  for (int i = 0; i < n; ++i) {
    const double u = random.next(), u1 = random.next();
    const auto s = bsdf.sample(wo, u, u1, random.next(), Mode::Radiance);
    hits += s && s->specular && length(s->wi - wi) < 1e-9;
  }
  return double(hits) / n;
}

}  // namespace

TEST_CASE("pdf of a delta is how often each wavelength as the hero would have led there") {
  const Material materials[] = {
      dielectric(ramp(1.6, 1.4)),
      dielectric(1.5, 0, 0.5, 0.9),
      refraction(ramp(2.0, 1.2)),
      mix(mirror(1), matte(0.5), ramp(0.2, 0.6)),
      add(mirror(0.3), fresnel_mix(matte(0.5), dielectric(ramp(1.6, 1.5)), 1.5)),
      mix(dielectric(1.5), refraction(1.5), ramp(0.2, 0.8)),
      slab(ramp(1.6, 1.4), 0.1, ramp(0.2, 3)),
      phong_glass(ramp(1.6, 1.4), 1e9),
      conductor(ramp(0.2, 1), 3),
      coat(mirror(0.9), dielectric(ramp(1.6, 1.4)), 0.1, ramp(0.2, 2), 1.5),
      fresnel_mix(mix(dielectric(1.5), matte(0.5), 0.3), mirror(1), ramp(1.3, 2.5))};
  const int n = 4000;
  for (const Material& m : materials) {
    const materials::Layout layout = m.layout();
    const auto p = m.params<double>();
    const Bsdf<double> bsdf(layout, p.data());
    for (double degrees : {10.0, 60.0, 85.0, 170.0, 145.0, 130.0, 95.0}) {
      const Vec3d wo = direction(degrees, 0.3);
      stats::Random random(5);
      for (int i = 0; i < 4; ++i) {
        const double u = random.next(), u1 = random.next();
        const auto s = bsdf.sample(wo, u, u1, random.next(), Mode::Radiance);
        if (!s || !s->specular) continue;
        for (int j = 0; j < kWavelengths; j += 2) {
          const double observed = frequency(m, j, wo, s->wi, n), expected = s->pdf[j];
          // Five standard deviations: a false alarm of 6e-7 in each of about 800 comparisons.
          const double e = std::sqrt(expected * (1 - std::min(1.0, expected)) / n);
          CHECK_MESSAGE(std::abs(observed - expected) <= 5 * e + 1e-12, degrees, " ", j, ": ",
                        observed, " against ", expected);
          if (expected == 0) CHECK(s->f[j] == 0);
        }
      }
    }
  }
}
