// SPDX-License-Identifier: Apache-2.0
// Samples against densities: chi-square, weights, the mean weight against quadrature, and float
// against double.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "tests/stats/chi_square.h"
#include "tests/unit/materials/cases.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

namespace {

/// MMS_STATS_MODEL takes one model, by the start of its name.
bool asked(const Case& c) {
  const char* only = std::getenv("MMS_STATS_MODEL");
  return !only || c.name.starts_with(only);
}

/// Where the density of the hero jumps besides the horizon, as `ChiSquareTest::jumps`: phong_glass
/// draws from both sides where both have a direction, and beyond the critical angle from one.
std::vector<double> jumps(const Material& m) {
  if (m.tree.nodes.back().lobe != int(Lobe::PhongGlass)) return {};
  const double ior = m.numbers.front(), critical = std::asin(std::min(ior, 1 / ior));
  return {std::sin((ior < 1 ? critical : kPi<double> - critical) / 2)};
}

/// Of so many draws along `wo`, those whose direction depends on wavelengths that are not the hero:
/// none should.
int turned_by_others(const Bsdf<float>& hero, const Bsdf<float>& whole, Vec3<float> wo,
                     std::uint64_t seed) {
  constexpr int kDraws = 200;
  const auto choice = hero.choose(wo), whole_choice = whole.choose(wo);
  stats::Random random(seed);
  int turned = 0;
  for (int i = 0; i < kDraws; ++i) {
    const float u = random.next_float(), u1 = random.next_float(), u2 = random.next_float();
    const auto a = hero.sample(wo, u, u1, u2, Mode::Radiance, choice);
    const auto b = whole.sample(wo, u, u1, u2, Mode::Radiance, whole_choice);
    turned += a.has_value() != b.has_value() || (a && a->wi != b->wi);
  }
  return turned;
}

/// Float samples of each case along each direction against the density in double, of the hero
/// alone: that of eight is slow, and turns no direction. The level is of all together.
void check_samples_follow(const std::vector<Case>& cases, std::span<const double> all_degrees,
                          std::uint64_t seed) {
  const int tests = int(cases.size() * all_degrees.size());
  const double level = stats::sidak(0.01, tests);
  double worst = 1;
  for (const Case& c : cases) {
    if (!asked(c)) {
      seed += all_degrees.size();  // the others keep theirs
      continue;
    }
    const materials::Layout layout = c.material.layout();
    const Material hero = hero_only(c.material);
    const auto p_whole = c.material.params<float>(), p32 = hero.params<float>();
    const auto p64 = hero.params<double>();
    const Bsdf<float> whole(layout, p_whole.data()), sampled(layout, p32.data());
    const Bsdf<double> exact(layout, p64.data());
    for (double degrees : all_degrees) {
      ++seed;
      const Vec3<float> wo(direction(degrees, 0.7));
      const Vec3d wo_exact = normalize(Vec3d(wo));
      CHECK_MESSAGE(turned_by_others(sampled, whole, wo, seed) == 0, c.name, " at ", degrees);
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
               [&](Vec3d wi) { return exact.pdf(wo_exact, wi, Mode::Radiance, choice_exact)[0]; },
           .jumps = jumps(c.material),
           .seed = seed});
      worst = std::min(worst, r.p_value);
      CHECK_MESSAGE(r.passed(level), c.name, " at ", degrees, ": ", r.report());
    }
  }
  MESSAGE("smallest of ", tests, " p-values ", worst, ", level ", level);
}

std::vector<Case> narrow_cases() {
  return {{"microfacet 0.03", microfacet(1, 0.03)},
          {"microfacet 0.05, anisotropic", microfacet(1, 0.05, 0.8)},
          {"beckmann 0.03", beckmann(1, 0.03)},
          {"conductor 0.03", conductor(0.2, 3.4, 0.03)},
          {"glossy 1e4", glossy(1, 1e4)},
          {"phong 2000", tinted(Lobe::Phong, 1, {2e3})},
          {"max_phong 2000", tinted(Lobe::MaxPhong, 1, {2e3})},
          {"ward 0.03", tinted(Lobe::Ward, 1, {0.03, 0})},
          {"dielectric 0.05", dielectric(1.5, 0.05)},
          {"beckmann_dielectric 0.05", beckmann_dielectric(1.5, 0.05)},
          {"phong_glass 1e4", phong_glass(1.5, 1e4)}};
}

}  // namespace

TEST_CASE("samples follow the density: MMS_STATS_MODEL names a model") {
  const auto any_asked = [](const std::vector<Case>& cases) {
    return std::any_of(cases.begin(), cases.end(), asked);
  };
  CHECK((any_asked(smooth_cases()) || any_asked(narrow_cases())));
}

TEST_CASE("samples follow the density") { check_samples_follow(smooth_cases(), kDegrees, 0); }

TEST_CASE("samples follow the density where lobes are narrow") {
  constexpr double all_degrees[] = {0, 30, 75, 150};
  check_samples_follow(narrow_cases(), all_degrees, 5000);
}

TEST_CASE("samples follow the density at other numbers of models that are swept at one") {
  const std::vector<Case> cases = {
      {"glossy_back, wide", tinted(Lobe::GlossyBack, 1, {5, 9})},
      {"glossy_through, narrow", tinted(Lobe::GlossyThrough, 1, {200, 200})},
      {"glossy_refraction, narrow", glossy_refraction(1.5, {200, 200})},
      {"spot, a hard edge", tinted(Lobe::Spot, 1, {0.5, 0.5})},
      {"conductor 0.7, anisotropic", conductor(1.5, 0.2, 0.7, 0.6)},
      {"coloured_metal 0.15", coloured_metal(0.4, 0.1, 0.15)},
      {"film_conductor 0.8", film_conductor(0.3, 3, 2.2, 150e-9, 550e-9, 0.8)}};
  constexpr double all_degrees[] = {0, 60, 89, 150};
  check_samples_follow(cases, all_degrees, 6000);
}

namespace {

/// What both hemispheres get of `wo` without deltas, within `tolerance` where quadrature settles.
/// Cells meet where a lobe may be narrow, at `peak` of either hemisphere.
stats::detail::Integral quadrature(const Bsdf<double>& bsdf, Vec3d wo, const Vec3d (&peak)[2],
                                   double tolerance) {
  const auto choice = bsdf.choose(wo);
  const Frame<double> frame = Frame<double>::around({0, 0, 1});
  constexpr double equator = std::numbers::sqrt2 / 2, round = 2 * std::numbers::pi;
  stats::detail::Integral sum{0, 0};
  for (const bool upper : {false, true}) {
    const auto [t, phi] = stats::detail::to_polar(frame, peak[upper]);
    const double first = upper ? 0 : equator, last = upper ? equator : 1;
    for (const Rectangle& cell : {Rectangle{first, t, 0, phi},
                                  {first, t, phi, round},
                                  {t, last, 0, phi},
                                  {t, last, phi, round}}) {
      const auto part = stats::detail::integrate_peaked(
          cell, tolerance / 8, [&](double) { return tolerance / 8; },
          [&](double u, double v) {
            const Vec3d wi = stats::detail::from_polar(frame, u, v);
            return 4 * u * std::abs(wi.z) * bsdf.evaluate(wo, wi, Mode::Importance, choice).f[0];
          });
      sum = {sum.value + part.value, sum.error + part.error};
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("a sample reports what eval and pdf say, and its mean weight is the albedo") {
  const auto cases = smooth_cases();
  const int tests = int(cases.size() * std::size(kDegrees));
  const double level = stats::sidak(0.01, tests);
  std::uint64_t seed = 1000;
  double least = 1;
  for (const Case& c : cases) {
    if (!asked(c)) {
      seed += std::size(kDegrees);
      continue;
    }
    const materials::Layout layout = c.material.layout();
    const auto p = c.material.params<double>(), p_hero = hero_only(c.material).params<double>();
    const Bsdf<double> bsdf(layout, p.data()), hero(layout, p_hero.data());
    for (double degrees : kDegrees) {
      ++seed;
      const Vec3d wo = direction(degrees, 0.7);
      const auto choice = bsdf.choose(wo), another = bsdf.choose(wo), hero_choice = hero.choose(wo);
      stats::Random random(seed);
      int wrong = 0;
      for (int i = 0; i < 200; ++i) {
        const double u = random.next(), u1 = random.next(), u2 = random.next();
        const auto s = bsdf.sample(wo, u, u1, u2, Mode::Importance, choice);
        if (!s || s->specular) continue;
        const auto l = bsdf.evaluate(wo, s->wi, Mode::Importance, another);
        wrong += !(s->f == l.f) + !(s->pdf == l.pdf) + (s->transmitted != (s->wi.z * wo.z < 0));
        wrong += !(bsdf.pdf(wo, s->wi, Mode::Importance, another) == l.pdf);
      }
      CHECK_MESSAGE(wrong == 0, c.name, " at ", degrees);
      stats::Moments drawn;
      Vec3d peak[2] = {direction(100, 1), direction(80, 1)};  // only to place cells
      double most[2] = {0, 0};
      for (int i = 0, n = stats::sample_count(20000); i < n; ++i) {
        const double u = random.next(), u1 = random.next(), u2 = random.next();
        const auto s = hero.sample(wo, u, u1, u2, Mode::Importance, hero_choice);
        const bool smooth = s && !s->specular;
        drawn.add(smooth ? s->f[0] * std::abs(s->wi.z) / s->pdf[0] : 0);
        if (!smooth) continue;
        const bool upper = s->wi.z > 0;
        if (const double size = s->f[0] * std::abs(s->wi.z); size > most[upper]) {
          most[upper] = size;
          peak[upper] = s->wi;
        }
      }
      // One more is counted as lost: what happens once in n samples may not have happened yet.
      drawn.add(0);
      // Where all samples weigh the same, 1e-4 is left to quadrature.
      const double tolerance = std::max(drawn.standard_error() / 4, 1e-4 * drawn.mean);
      const auto q = quadrature(hero, wo, peak, tolerance);
      CHECK_MESSAGE(q.error <= tolerance, c.name, " at ", degrees, ": quadrature errs by ",
                    q.error);
      const double p_value = stats::z_test(drawn, q.value, tolerance);
      least = std::min(least, p_value);
      CHECK_MESSAGE(p_value > level, c.name, " at ", degrees, ": ", drawn.mean, " against ",
                    q.value, " within ", drawn.standard_error());
    }
  }
  MESSAGE("smallest of ", tests, " p-values ", least, ", level ", level);
}

namespace {

/// Per steradian: all directions that are rarer than this together hold 4 pi of it, or less.
constexpr double kRare = 0.01;

/// Infinite where one is not a number.
double relative_difference(double a, double b) {
  const double d = a == b ? 0 : std::abs(a - b) / std::max(std::abs(a), std::abs(b));
  return d >= 0 ? d : std::numeric_limits<double>::infinity();
}

}  // namespace

TEST_CASE("float samples are what double says of the same directions") {
  // Directions and numbers are rounded already: what is left are the roundings within. Each is as
  // if a direction moved by 1e-7. Where that is a part kBound of the width of a lobe, which is
  // about 1 / sqrt(pi pdf), the lobe is all but a delta and is left out.
  constexpr double kBound = 1e-3, kNarrow = (kBound / 1e-7) * (kBound / 1e-7) / kPi<double>;
  std::vector<Case> cases = smooth_cases();
  for (Case& c : narrow_cases()) cases.push_back(std::move(c));
  int compared = 0, narrow = 0, rare = 0;
  double worst = 0;
  for (const Case& c : cases) {
    if (!asked(c)) continue;
    const materials::Layout layout = c.material.layout();
    const auto p = c.material.params<float>();
    const std::vector<double> p_exact(p.begin(), p.end());
    const Bsdf<float> bsdf(layout, p.data());
    const Bsdf<double> exact(layout, p_exact.data());
    for (double degrees : kDegrees) {
      const Vec3<float> wo(direction(degrees, 0.7));
      const auto choice = bsdf.choose(wo);
      const auto choice_exact = exact.choose(Vec3d(wo));
      stats::Random random(4);
      for (int i = 0; i < 100; ++i) {
        const float u = random.next_float(), u1 = random.next_float(), u2 = random.next_float();
        const auto s = bsdf.sample(wo, u, u1, u2, Mode::Importance, choice);
        if (!s || s->specular) continue;
        const auto l = exact.evaluate(Vec3d(wo), Vec3d(s->wi), Mode::Importance, choice_exact);
        if (l.pdf[0] > kNarrow) {
          ++narrow;
          continue;
        }
        double off = 0;
        for (int j = 0; j < kWavelengths; ++j) {
          if (std::max(l.pdf[j], double(s->pdf[j])) < kRare) {
            ++rare;
            continue;
          }
          ++compared;
          off = std::max({off, relative_difference(s->pdf[j], l.pdf[j]),
                          relative_difference(s->f[j], l.f[j])});
        }
        worst = std::max(worst, off);
        CHECK_MESSAGE(off <= kBound, c.name, " at ", degrees, " to ", s->wi.z, ": ", off, ", pdf ",
                      l.pdf[0]);
      }
    }
  }
  MESSAGE("largest relative difference ", worst, " of ", compared, "; left out as narrow ", narrow,
          ", as rare ", rare);
  CHECK(narrow <= 0.05 * compared);
  CHECK(rare <= 0.05 * compared);
}

TEST_CASE("pdf of a wavelength is the density with that wavelength as the hero") {
  double largest_pdf = 0, largest_f = 0;
  for (const Case& c : smooth_cases()) {
    if (!asked(c)) continue;
    const materials::Layout layout = c.material.layout();
    const auto p = c.material.params<double>();
    const Bsdf<double> bsdf(layout, p.data());
    for (int j = 1; j < kWavelengths; j += 3) {
      const auto q = with_hero(c.material, j).params<double>();
      const Bsdf<double> other(layout, q.data());
      int tried = 0, drawn = 0, rare = 0;
      double pdf_off = 0, f_off = 0;
      for (double degrees : kDegrees) {
        const Vec3d wo = direction(degrees, 0.7);
        const auto choice = bsdf.choose(wo), other_choice = other.choose(wo);
        stats::Random random(j);
        for (int i = 0; i < 100; ++i) {
          const double u = random.next(), u1 = random.next(), u2 = random.next();
          const auto by_first = bsdf.sample(wo, u, u1, u2, Mode::Radiance, choice);
          const auto by_other = other.sample(wo, u, u1, u2, Mode::Radiance, other_choice);
          for (const auto& s : {by_first, by_other}) {
            if (!s || s->specular) continue;
            const auto l = bsdf.evaluate(wo, s->wi, Mode::Radiance, choice);
            const auto as_hero = other.evaluate(wo, s->wi, Mode::Radiance, other_choice);
            pdf_off = std::max(pdf_off, relative_difference(l.pdf[j], as_hero.pdf[0]));
            f_off = std::max(f_off, relative_difference(l.f[j], as_hero.f[0]));
          }
          ++tried;
          if (!by_other || by_other->specular) continue;
          ++drawn;
          rare += by_other->pdf[0] < kRare;
        }
      }
      CHECK_MESSAGE(pdf_off <= 1e-12, c.name, ", wavelength ", j);
      CHECK_MESSAGE(f_off <= 1e-12, c.name, ", wavelength ", j);
      CHECK_MESSAGE(drawn >= 0.2 * tried, c.name, ", wavelength ", j);
      CHECK_MESSAGE(rare <= 4 * kPi<double> * kRare * tried, c.name, ", wavelength ", j);
      largest_pdf = std::max(largest_pdf, pdf_off);
      largest_f = std::max(largest_f, f_off);
    }
  }
  MESSAGE("largest relative difference of pdf ", largest_pdf, ", of f ", largest_f);
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
      dielectric(ramp(1.6, 1.4), 0, ramp(0.2, 0.9), ramp(0.8, 0.3)),
      refraction(ramp(1.6, 1.4), ramp(0.9, 0.1)),
      film_dielectric(ramp(1.6, 1.4), ramp(1.3, 1.4), 300e-9, ramp(400e-9, 700e-9)),
      film_conductor(ramp(0.2, 1), 3, 1.5, 300e-9, ramp(400e-9, 700e-9), 0),
      conductor(ramp(0.2, 1), 3),
      coat(mirror(0.9), dielectric(ramp(1.6, 1.4)), 0.1, ramp(0.2, 2), 1.5),
      fresnel_mix(mix(dielectric(1.5), matte(0.5), 0.3), mirror(1), ramp(1.3, 2.5))};
  const int n = 4000;
  for (const Material& m : materials) {
    const materials::Layout layout = m.layout();
    const auto p = m.params<double>();
    const Bsdf<double> bsdf(layout, p.data());
    // At 138, of indices from 1.6 to 1.4, some wavelengths are reflected in full.
    for (double degrees : {10.0, 60.0, 85.0, 170.0, 145.0, 138.0, 130.0, 95.0}) {
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
