// SPDX-License-Identifier: Apache-2.0
// A turned tangent, or a normal of its own: the same material, seen in another frame.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "base/quadrature.h"
#include "base/warp.h"
#include "materials/frames.h"
#include "materials/fresnel.h"
#include "tests/sanitized.h"
#include "tests/stats/distributions.h"
#include "tests/stats/random.h"
#include "tests/sums.h"
#include "tests/unit/materials/albedo.h"
#include "tests/unit/materials/cases.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

namespace {

Vec3d turned_back(Vec3d w, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * w.x + s * w.y, c * w.y - s * w.x, w.z};
}

bool near(const Spectrum<double>& a, const Spectrum<double>& b, double bound) {
  for (int j = 0; j < kWavelengths; ++j)
    if (!(std::abs(a[j] - b[j]) <= bound * (std::abs(b[j]) + 1e-9))) return false;
  return true;
}

/// Whether `m` is `plain` in a frame turned by `angle`: values, densities, and, where all that
/// draws them is turned, samples.
void check_turned(const std::string& name, const Material& m, const Material& plain, double angle,
                  double bound, bool all_turned) {
  const materials::Layout layout = m.layout(), plain_layout = plain.layout();
  const auto p = m.params<double>(), q = plain.params<double>();
  const Bsdf<double> bsdf(layout, p.data()), expected(plain_layout, q.data());
  stats::Random random(11);
  for (int k = 0; k < (kSanitized ? 50 : 500); ++k) {
    const Vec3d wo = square_to_sphere(random.next(), random.next());
    const Vec3d wi = square_to_sphere(random.next(), random.next());
    const Vec3d o = turned_back(wo, angle), i = turned_back(wi, angle);
    const auto a = bsdf.evaluate(wo, wi, Mode::Radiance);
    const auto b = expected.evaluate(o, i, Mode::Radiance);
    CHECK_MESSAGE(near(a.f, b.f, bound), name);
    CHECK_MESSAGE(near(a.pdf, b.pdf, bound), name);
    if (!all_turned) continue;
    const double u[] = {random.next(), random.next(), random.next()};
    const auto drawn = bsdf.sample(wo, u[0], u[1], u[2], Mode::Importance);
    const auto same = expected.sample(o, u[0], u[1], u[2], Mode::Importance);
    REQUIRE_MESSAGE(drawn.has_value() == same.has_value(), name);
    if (!drawn) continue;
    CHECK_MESSAGE(length(turned_back(drawn->wi, angle) - same->wi) < bound, name);
    CHECK_MESSAGE(near(drawn->f, same->f, bound * 10), name);
  }
}

}  // namespace

TEST_CASE("a turned material is the material in a turned frame") {
  const double angle = 0.7;
  const struct {
    const char* name;
    Material material;
    double bound = 1e-6;
    bool all_turned = true;
  } rows[] = {
      {"microfacet", microfacet(1, 0.4, 0.8)},
      {"ward", tinted(Lobe::Ward, 1, {0.4, 0.6})},
      {"ashikhmin_shirley", tinted(Lobe::AshikhminShirley, 1, {40, 8})},
      {"dielectric", dielectric(ramp(1.6, 1.4), 0.4, 1, 1, -0.7)},
      {"film_dielectric", film_dielectric(1.5, 1.8, 3e-7, ramp(4e-7, 7e-7), 0.4, 1, 1, 0.7)},
      {"coat of stretched facets", coat(microfacet(1, 0.4, 0.7), matte(0.5), 0.1, 1, 1.5)},
      {"over stretched facets", coat(mirror(1), beckmann(1, 0.5, 0.8), 0, 0, 1.5)},
      {"film", film_mix(matte(0.5), microfacet(1, 0.4, 0.6), 1.5, 1.8, 4e-7, ramp(4e-7, 7e-7))},
      {"two coats",
       coat(microfacet(1, 0.3, 0.5),
            fresnel_mix(beckmann(1, 0.5, -0.4), microfacet(1, 0.4, 0.6), 1.4), 0, 0, 1.5)},
      {"over glass", coat(mirror(1), dielectric(1.5, 0.4, 1, 1, 0.8), 0, 0, 1.3)},
      // What the coat sends back is drawn as from a matte; its mean is by few azimuths, and others.
      {"rough over glass", coat(microfacet(1, 0.4), dielectric(1.5, 0.4, 1, 1, 0.8), 0, 0, 1.3),
       2e-3, false}};
  for (const auto& row : rows) {
    check_turned(row.name, turn(row.material, angle), row.material, angle, row.bound,
                 row.all_turned);
    check_turned(row.name, turn(turn(row.material, 0.9), angle - 0.9), row.material, angle,
                 row.bound, row.all_turned);
  }
}

TEST_CASE("parts are turned each by its own angle; by none that is no number") {
  const Material a = microfacet(0.6, 0.4, 0.8), b = beckmann(0.5, 0.5, -0.6);
  const Vec3d wo = direction(40, 0.3), wi = direction(55, 2.6);
  const double both = value(turn(add(turn(a, 0.3), b), 0.5), wo, wi);
  CHECK(both == doctest::Approx(value(a, turned_back(wo, 0.8), turned_back(wi, 0.8)) +
                                value(b, turned_back(wo, 0.5), turned_back(wi, 0.5))));
  CHECK(both != doctest::Approx(value(add(a, b), wo, wi)).epsilon(0.01));
  for (const double angle :
       {0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    CHECK(value(turn(a, angle), wo, wi) == value(a, wo, wi));
  // A quarter of a turn exchanges both axes.
  CHECK(value(turn(a, kPi<double> / 2), wo, wi) ==
        doctest::Approx(value(microfacet(0.6, 0.4, -0.8), wo, wi)));
}

namespace {

constexpr double kIor = 1.5;

/// The frame of `tilt(a, u, v)`.
Frame<double> tilted(double u, double v) {
  const Vec3d n = normalize(Vec3d{-u, -v, 1});
  const Vec3d s = normalize(Vec3d{1, 0, 0} - n * n.x);
  return {s, cross(n, s), n};
}

/// Whether a bump of normal `n` shows what is seen along `view`, and mirrors it above the surface.
bool shows(Vec3d n, Vec3d view) {
  const double side = view.z < 0 ? -1 : 1, c = dot(n, view);
  return c * side > 0 &&
         (n * (2 * c) - view).z * side > std::min(0.9 * std::abs(view.z), 0.01) + 1e-9;
}

/// Whether `m` is `plain` about the normal of `frame`, where that is not held back.
void check_tilted(const std::string& name, const Material& m, const Material& plain,
                  const Frame<double>& frame, double bound) {
  const materials::Layout layout = m.layout(), plain_layout = plain.layout();
  const auto p = m.params<double>(), q = plain.params<double>();
  const Bsdf<double> bsdf(layout, p.data()), expected(plain_layout, q.data());
  stats::Random random(12);
  int shown = 0, leaks = 0, drawn = 0;
  for (int k = 0; k < (kSanitized ? 50 : 500); ++k) {
    const Vec3d wo = square_to_sphere(random.next(), random.next());
    const Vec3d wi = square_to_sphere(random.next(), random.next());
    const double u[] = {random.next(), random.next(), random.next()};
    if (!shows(frame.n, wo)) continue;
    ++shown;
    const Vec3d o = frame.to_local(wo), i = frame.to_local(wi);
    for (const Mode mode : {Mode::Radiance, Mode::Importance}) {
      const auto a = bsdf.evaluate(wo, wi, mode);
      auto b = expected.evaluate(o, i, mode);
      if (i.z * wi.z < 0) {
        ++leaks;
        b = {};
      }
      b.f *= mode == Mode::Radiance ? i.z / wi.z : o.z / wo.z;
      CHECK_MESSAGE(near(a.f, b.f, bound), name);
      CHECK_MESSAGE(near(a.pdf, b.pdf, bound), name);
      if (shows(frame.n, wi)) {
        const auto adjoint = mode == Mode::Radiance ? Mode::Importance : Mode::Radiance;
        CHECK_MESSAGE(near(bsdf.eval(wi, wo, adjoint), a.f, std::max(bound, 1e-9)), name);
      }
    }
    const Mode mode = k % 2 ? Mode::Radiance : Mode::Importance;
    const auto s = bsdf.sample(wo, u[0], u[1], u[2], mode);
    const auto same = expected.sample(o, u[0], u[1], u[2], mode);
    const Vec3d to = same ? frame.to_world(same->wi) : Vec3d{};
    REQUIRE_MESSAGE(s.has_value() == (same && to.z * same->wi.z > 0), name);
    if (!s) continue;
    ++drawn;
    CHECK_MESSAGE(length(s->wi - to) < 1e-9, name);
    CHECK(s->specular == same->specular);
    const double share = mode == Mode::Radiance ? same->wi.z / s->wi.z : o.z / wo.z;
    CHECK_MESSAGE(near(s->f, same->f * share, bound * 10), name);
    CHECK_MESSAGE(near(s->pdf, same->pdf, bound * 10), name);
  }
  CHECK(shown > 25);
  CHECK(leaks > 0);
  CHECK(drawn > 10);
}

}  // namespace

TEST_CASE("a tilted material is the material about another normal") {
  const struct {
    const char* name;
    Material material;
    double bound = 1e-7;
  } rows[] = {
      {"matte", matte(0.8)},
      {"mirror", mirror(0.9)},
      {"glass", dielectric(1.5)},
      {"mirror and matte", mix(matte(0.8), mirror(1), 0.3)},
      {"facets", microfacet(1, 0.4, 0.8)},
      {"rough glass", dielectric(ramp(1.6, 1.4), 0.4, 1, 1, -0.7)},
      {"plastic", fresnel_mix(matte(0.8), microfacet(1, 0.3), 1.5)},
      {"two coats", coat(mirror(1), fresnel_mix(microfacet(0.9, 0.4), microfacet(1, 0.3), 1.3), 0.1,
                         ramp(0.5, 2), 1.6)},
      {"over glass", coat(microfacet(1, 0.4), dielectric(1.5, 0.4), 0.1, 1, 1.3), 1e-6},
      {"velvet", layer(tinted(Lobe::Sheen, 1, {0.4}), matte(1))}};
  for (const auto& row : rows) {
    const Frame<double> frame = tilted(0.5, -0.3);
    check_tilted(row.name, tilt(row.material, 0.5, -0.3), row.material, frame, row.bound);
    // A tilt in a turned frame is about a turned normal.
    const Frame<double> turned{turned_back(frame.s, -0.8), turned_back(frame.t, -0.8),
                               turned_back(frame.n, -0.8)};
    check_tilted(row.name, turn(tilt(row.material, 0.5, -0.3), 0.8), row.material, turned,
                 row.bound);
  }
}

TEST_CASE("a tilt of a tilt is about its normal") {
  const Frame<double> outer = tilted(0.3, 0), inner = tilted(0.1, 0.2);
  const Frame<double> both{outer.to_world(inner.s), outer.to_world(inner.t),
                           outer.to_world(inner.n)};
  const Material plain = microfacet(0.9, 0.4, 0.5);
  const Material m = tilt(tilt(plain, 0.1, 0.2), 0.3, 0);
  const Vec3d wo = direction(30, 0.4), wi = direction(40, 2.9);
  const Vec3d o = both.to_local(wo), i = both.to_local(wi);
  CHECK(value(m, wo, wi) == doctest::Approx(value(plain, o, i) * i.z / wi.z));
}

TEST_CASE("deltas of several normals are apart") {
  const Material m = add(mirror(0.5), tilt(mirror(0.25), 0.2, 0));
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  const Bsdf<double> bsdf(layout, p.data());
  const Vec3d wo = direction(20, 0.3);
  const Vec3d n = tilted(0.2, 0).n;
  for (const double u : {0.1, 0.9}) {
    const auto s = bsdf.sample(wo, u, 0.5, 0.5, Mode::Radiance);
    REQUIRE(s);
    const bool first = u < 0.5;
    const Vec3d expected = first ? Vec3d{-wo.x, -wo.y, wo.z} : n * (2 * dot(n, wo)) - wo;
    CHECK(length(s->wi - expected) < 1e-12);
    CHECK(s->pdf[0] == doctest::Approx(first ? 2 / 3.0 : 1 / 3.0));
    CHECK(s->f[0] * s->wi.z == doctest::Approx(first ? 0.5 : 0.25));
  }
}

TEST_CASE("a tilted Lambert lobe keeps its light but for what leaves to a back") {
  for (const double t : {0.1, 0.4, 0.8}) {
    const Material bare = tilt(matte(1), std::tan(t), 0);
    const Material coated = coat(mirror(1), bare, 0, 0, 1.5);
    const materials::Layout layout = bare.layout(), coated_layout = coated.layout();
    const auto p = bare.params<double>(), q = coated.params<double>();
    const Bsdf<double> bsdf(layout, p.data()), under(coated_layout, q.data());
    const auto through = [](double z) { return 1 - materials::fresnel_dielectric(z, 1.5); };
    const double mean = 1 - materials::fresnel_dielectric_diffuse(1.5);
    const Vec3d n = tilted(std::tan(t), 0).n;
    for (const double degrees : {0.0, 30.0, 50.0, 70.0, 85.0}) {
      const Vec3d wo = direction(degrees, 2.5);  // where no normal is held back
      if (!shows(n, wo)) continue;
      const auto choice = bsdf.choose(wo), under_choice = under.choose(wo);
      double kept = 0, kept_under = 0;
      constexpr int kSteps = kSanitized ? 100 : 400;
      for (int a = 0; a < kSteps; ++a)
        for (int b = 0; b < kSteps; ++b) {
          const double z = (a + 0.5) / kSteps, r = std::sqrt(1 - z * z),
                       phi = 2 * kPi<double> * (b + 0.5) / kSteps;
          const Vec3d wi{r * std::cos(phi), r * std::sin(phi), z};
          const double f = bsdf.evaluate(wo, wi, Mode::Radiance, choice).f[0];
          const double f_under = under.evaluate(wo, wi, Mode::Radiance, under_choice).f[0];
          CHECK(f_under == doctest::Approx(f * through(wo.z) * through(z) / mean).epsilon(1e-9));
          kept += f * z, kept_under += f_under * z;
        }
      const double cell = 2 * kPi<double> / (double(kSteps) * kSteps);
      CHECK(kept * cell == doctest::Approx((1 + std::cos(t)) / 2).epsilon(1e-3));
      CHECK(kept_under * cell < through(wo.z) * (1 + std::cos(t)) / 2);
      CHECK(kept_under * cell > through(wo.z) * (1 + std::cos(t)) / 2 * 0.9);
    }
  }
}

/// What is lost of samples of a white `m`, of which glass is of the index kIor.
void add_lost(stats::Moments& lost, const Material& m, Vec3d wo) {
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  const Bsdf<double> bsdf(layout, p.data());
  const auto choice = bsdf.choose(wo);
  stats::Random random(5);
  constexpr int kSamples = kSanitized ? 300 : 3000;
  for (int i = 0; i < kSamples; ++i) {
    const double u = (i + random.next()) / kSamples, u1 = random.next(), u2 = random.next();
    const auto s = bsdf.sample(wo, u, u1, u2, Mode::Radiance, choice);
    const double squeezed = !s || !s->transmitted ? 1 : wo.z > 0 ? kIor * kIor : 1 / (kIor * kIor);
    lost.add(s ? 1 - s->f[0] * std::abs(s->wi.z) / s->pdf[0] * squeezed : 1);
  }
}

TEST_CASE("nothing that is tilted below coats is brighter than what lights it") {
  const Material bases[] = {
      matte(1),  glossy(1, 30),         microfacet(1, 0.4, 0.6),
      mirror(1), dielectric(kIor, 0.4), fresnel_mix(matte(1), microfacet(1, 0.3), 1.4)};
  const Material tops[] = {
      mirror(1), microfacet(1, 0.4),
      mix(tilt(microfacet(1, 0.3), 0.5, 0.2), tilt(mirror(1), -0.1, 0.4), 0.4)};
  double most = 0;
  for (const Material& base : bases)
    for (const Material& top : tops)
      for (const double u : {0.0, 0.1, 0.5, 1.5}) {
        const Material m = coat(top, mix(tilt(base, u, -0.3 * u), base, 0.3), 0, 0, 1.5);
        for (const double degrees : {0.0, 40.0, 70.0, 88.0, 100.0, 150.0}) {
          stats::Moments lost;
          add_lost(lost, m, direction(degrees, 0.9));
          most = std::max(most, 1 - lost.mean);
          CHECK(1 - lost.mean < 1 + 5 * lost.standard_error() + 1e-3);
        }
      }
  MESSAGE("largest albedo ", most);
}

TEST_CASE("bumps below coats and in them lose hardly more than without coats") {
  const Material metals[] = {microfacet(1, 0.1), microfacet(1, 0.3), microfacet(1, 0.6),
                             microfacet(1, 0.3, 0.8), glossy(1, 30)};
  struct Row {
    double slope, bound;
  };
  for (const Row& row : {Row{0.1, 0.015}, Row{0.3, 0.04}}) {
    double most = 0;
    for (const Material& metal : metals)
      for (const double degrees : {0.0, 30.0, 60.0, 75.0, 85.0}) {
        stats::Moments lost, below, below_rough, part;
        for (const double turn : {0.3, 1.9, 3.6, 5.2}) {
          const Material bumpy =
              tilt(metal, row.slope * std::cos(turn), row.slope * std::sin(turn));
          const Vec3d wo = direction(degrees, 0.4);
          add_lost(lost, bumpy, wo);
          add_lost(below, coat(mirror(1), bumpy, 0, 0, 1.5), wo);
          add_lost(below_rough, coat(microfacet(1, 0.4), bumpy, 0, 0, 1.5), wo);
          add_lost(part, coat(bumpy, matte(1), 0, 0, 1.5), wo);
        }
        for (const stats::Moments& coated : {below, below_rough, part}) {
          const double more = coated.mean - lost.mean;
          most = std::max(most, more);
          CHECK(more < row.bound + 5 * (coated.standard_error() + lost.standard_error()));
        }
      }
    MESSAGE("slope ", row.slope, ": lost more in and below coats, at most ", most);
  }
}

TEST_CASE("bumpy glass below coats loses what it does without") {
  double most = 0;
  for (const double roughness : {0.0, 0.1, 0.4})
    for (const double slope : {0.1, 0.3})
      for (const double degrees : {0.0, 30.0, 60.0, 75.0, 85.0, 105.0, 120.0, 150.0}) {
        stats::Moments lost, below, below_rough;
        for (const double turn : {0.3, 1.9, 3.6, 5.2}) {
          const Material bumpy =
              tilt(dielectric(kIor, roughness), slope * std::cos(turn), slope * std::sin(turn));
          const Vec3d wo = direction(degrees, 0.4);
          add_lost(lost, bumpy, wo);
          add_lost(below, coat(mirror(1), bumpy, 0, 0, 1.5), wo);
          add_lost(below_rough, coat(microfacet(1, 0.4), bumpy, 0, 0, 1.5), wo);
        }
        for (const stats::Moments& coated : {below, below_rough}) {
          const double more = coated.mean - lost.mean;
          most = std::max(most, more);
          CHECK(more < 2e-3 + 5 * (coated.standard_error() + lost.standard_error()));
        }
      }
  MESSAGE("lost more below coats, at most ", most);
}

TEST_CASE("bumpy mirrors below coats and in them lose nothing") {
  for (const Material& m :
       {coat(mirror(1), tilt(mirror(1), 0.2, -0.3), 0, 0, 1.5),
        coat(tilt(mirror(1), 0.3, 0.1), tilt(mirror(1), -0.3, 0.1), 0, 0, 1.7),
        coat(mirror(1), coat(tilt(mirror(1), 0.1, 0), tilt(mirror(1), 0, 0.2), 0, 0, 1.3), 0, 0,
             1.5)}) {
    const materials::Layout layout = m.layout();
    const auto p = m.params<double>();
    const Bsdf<double> bsdf(layout, p.data());
    for (const double degrees : {0.0, 30.0, 60.0, 75.0, 85.0, 89.0}) {
      const Vec3d wo = direction(degrees, 0.9);
      for (const double u : {0.01, 0.3, 0.6, 0.99}) {
        const auto s = bsdf.sample(wo, u, 0.5, 0.5, Mode::Radiance);
        REQUIRE(s.has_value());
        CHECK(s->f[0] * s->wi.z / s->pdf[0] == doctest::Approx(1).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("what is hardly tilted in and below coats keeps its energy" * kSum) {
  const auto hardly = [](const Material& m) { return tilt(m, 1e-5, -2e-5); };
  const Material metal = microfacet(1, 0.3), brushed = microfacet(1, 0.4, 0.6);
  for (const Material& m :
       {coat(microfacet(1, 0.5), hardly(metal), 0, 0, 1.5),
        coat(brushed, hardly(brushed), 0, 0, 1.7), coat(metal, hardly(glossy(1, 9)), 0, 0, 1.3),
        coat(hardly(metal), matte(1), 0, 0, 1.5), coat(hardly(brushed), hardly(metal), 0, 0, 1.5),
        coat(metal, coat(hardly(brushed), hardly(metal), 0, 0, 1.4), 0, 0, 1.5),
        coat(metal, hardly(coat(hardly(metal), matte(1), 0, 0, 1.4)), 0, 0, 1.5),
        coat(metal, hardly(coat(metal, brushed, 0, 0, 1.4)), 0, 0, 1.5),
        film_mix(hardly(metal), hardly(metal), 1.5, 1.9, 2e-7, 5e-7)})
    for (const double degrees : {0.0, 30.0, 60.0, 75.0, 85.0})
      CHECK(std::abs(albedo(m, degrees, 0.9) - 1) < 1e-3);
}

TEST_CASE("a normal is held back by no more than it has to be") {
  stats::Random random(8);
  int held = 0;
  for (int k = 0; k < 5000; ++k) {
    const Vec3d n = square_to_sphere(random.next(), random.next());
    const Vec3d view = square_to_sphere(random.next(), random.next());
    const Vec3d ng{0, 0, 1};
    if (n.z < 0.05 || std::abs(view.z) < 1e-3) continue;
    const Vec3d m = materials::held_back(n, ng, view);
    if (shows(n, view)) {
      CHECK(m == n);
      continue;
    }
    ++held;
    const double side = view.z < 0 ? -1 : 1;
    const double height = (m * (2 * dot(m, view)) - view).z * side;
    CHECK(std::abs(height - std::min(0.9 * std::abs(view.z), 0.01)) < 1e-8);
    CHECK(dot(m, view) * side > 0);
    CHECK(std::abs(dot(cross(n, ng), m)) < 1e-12);  // between both
    CHECK(m.z >= n.z);
  }
  CHECK(held > 500);
}
