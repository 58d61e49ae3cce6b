// SPDX-License-Identifier: Apache-2.0
// Albedo by quadrature: 1 from both sides where a model is lossless (published_test.cpp has the
// others); reciprocity; delta weights.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "materials/tables/losses.h"
#include "tests/stats/random.h"
#include "tests/unit/materials/albedo.h"
#include "tests/unit/materials/cases.h"
#include "tests/unit/materials/walter.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

TEST_CASE("the thesis' glossy model is lossless") {
  double worst = 0;
  // m = 2 ln cosh n is about 2 n - 1.39: n = 5000 is m = 1e4.
  for (double gloss : {0.0, 1e-6, 0.01, 0.5, 4.0, 40.0, 1000.0, 5000.0})
    for (double degrees : {0.0, 30.0, 60.0, 85.0, 89.99}) {
      const double a = albedo(glossy(1, gloss), degrees, 0, 5);  // panels for 1e-6
      worst = std::max(worst, std::abs(a - 1));
      CHECK_MESSAGE(std::abs(a - 1) < 1e-6, gloss, " at ", degrees, ": ", a);
    }
  MESSAGE("glossy, m <= 1e4: largest |albedo - 1| ", worst);
}

namespace {

/// Largest |albedo - 1| over directions.
double worst_loss(const Material& m, double azimuth = 0, int panels = 4) {
  double worst = 0;
  for (double degrees : {0.0, 30.0, 60.0, 75.0, 85.0, 89.0, 89.99, 150.0, 91.0})
    worst = std::max(worst, std::abs(albedo(m, degrees, azimuth, panels) - 1));
  return worst;
}

}  // namespace

TEST_CASE("white microfacets are lossless at every roughness") {
  struct Model {
    std::string name;
    Material (*make)(double roughness, double anisotropy);
  };
  const Model models[] = {
      {"microfacet", [](double r, double a) { return microfacet(1, r, a); }},
      {"beckmann", [](double r, double a) { return beckmann(1, r, a); }},
      {"conductor", [](double r, double a) { return conductor(1, 1e25, r, a); }}};
  for (const Model& model : models) {
    double round = 0, slightly = 0, stretched = 0, most = 0;
    for (double roughness : {0.02, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 0.9, 1.0})
      round = std::max(round, worst_loss(model.make(roughness, 0), 0, roughness < 0.05 ? 8 : 4));
    for (double roughness : {0.2, 0.45, 0.7, 1.0})
      for (double azimuth : {0.0, 0.5, 1.5}) {
        const int panels = 7, fewer = roughness < 0.3 ? panels : 4;
        slightly = std::max(slightly, worst_loss(model.make(roughness, -0.5), azimuth, fewer));
        stretched = std::max(stretched, worst_loss(model.make(roughness, 0.9), azimuth, panels));
        most = std::max(most, worst_loss(model.make(roughness, 1), azimuth, 10));
      }
    CHECK_MESSAGE(round < 1e-4, model.name);
    CHECK_MESSAGE(slightly < 1e-4, model.name);
    CHECK_MESSAGE(stretched < 1e-4, model.name);
    CHECK_MESSAGE(most < 1e-4, model.name);
    MESSAGE(model.name, ": largest |albedo - 1| ", round, "; anisotropy 0.5: ", slightly,
            "; 0.9: ", stretched, "; 1: ", most);
  }
}

namespace {

/// By the quadrature that tables are made with: of many more settings than albedos can be had of.
template <template <class> class Distribution>
void check_losses(const std::string& name) {
  for (const double anisotropy : {0.3, 0.9, 1.0}) {
    stats::Random random(3);
    double worst = 0;
    for (int k = 0; k < swept(2000); ++k) {
      const double roughness = random.between(0.02, 1), even = random.next(),
                   z = k % 3 ? even : even * even * even * even;
      const double s = std::sqrt(1 - z * z), azimuth = kPi<double> / 2 * random.next();
      const Vec3d w{s * std::cos(azimuth), s * std::sin(azimuth), z};
      const auto alpha = materials::Alpha<double>::from(roughness, anisotropy);
      const Distribution<double> facets{{alpha.ax, alpha.ay}};
      const materials::FacetLoss<double> held{&facets.tables(), alpha.ax, alpha.ay};
      const double off = held.at(w) - materials::tables::loss(facets, w, 44);
      worst = std::max(worst, std::abs(off));
      CHECK_MESSAGE(std::abs(off) < 1e-4, name, " ", anisotropy, " ", roughness, " ", z, " ",
                    azimuth, ": ", off);
    }
    MESSAGE(name, ", anisotropy ", anisotropy, ": losses are off by up to ", worst);
  }
}

}  // namespace

TEST_CASE("what stretched mirrors lose is in their tables, whatever they are") {
  check_losses<materials::Ggx>("microfacet");
  check_losses<materials::Beckmann>("beckmann");
}

TEST_CASE("rough matte is lossless, and older models lose") {
  for (double r : {0.0, 1e-6, 0.3, 1.0})
    for (double degrees : {0.0, 45.0, 75.0, 89.0, 89.99, 150.0})
      CHECK(std::abs(albedo(tinted(Lobe::RoughMatte, 1, {r}), degrees, 0, 7) - 1) < 1e-4);
  // A colour: the sum over bounces of its closed form, at normal incidence, where one bounce keeps
  // a (1 - r (c1 - G / pi)) with G = 0: c1 = 1/2 - 2 / (3 pi), and c2 = 2/3 - 28 / (15 pi).
  const double pi = kPi<double>, c1 = 0.5 - 2 / (3 * pi), c2 = 2.0 / 3 - 28 / (15 * pi);
  const double one = 1 / (1 + c1), kept = (1 + c2) / (1 + c1), rho = 0.5;
  CHECK(albedo(tinted(Lobe::RoughMatte, rho, {1}), 0) ==
        doctest::Approx(rho * one + (1 - one) * rho * rho * kept / (1 - rho * (1 - kept)))
            .epsilon(1e-6));
  // Oren and Nayar's at normal incidence has no second term.
  CHECK(albedo(tinted(Lobe::OrenNayar, 1, {0.4}), 0) ==
        doctest::Approx(1 - 0.5 * 0.16 / (0.16 + 0.33)).epsilon(1e-6));
  struct Row {
    Lobe lobe;
    std::vector<double> numbers;
    double normal;  ///< albedo of white at normal incidence
  };
  const Row rows[] = {{Lobe::Phong, {20}, 1},
                      {Lobe::MaxPhong, {20}, 21.0 / 22},
                      {Lobe::Spot, {0.2, 0.5}, 1},
                      {Lobe::GlossyProduct, {30, 0}, 1},
                      {Lobe::OrenNayar, {1.0}, 0},
                      {Lobe::Ward, {0.5, 0.5}, 0},
                      {Lobe::AshikhminShirley, {30, 5}, 0}};
  for (const Row& row : rows) {
    const Material m = tinted(row.lobe, 1, row.numbers);
    if (row.normal > 0) CHECK(albedo(m, 0, 0, 16) == doctest::Approx(row.normal).epsilon(1e-4));
    for (double degrees : {0.0, 30.0, 60.0, 80.0, 89.0, 89.99})
      CHECK_MESSAGE(albedo(m, degrees) < 1 + 1e-3, materials::rows()[int(row.lobe)].signature, " ",
                    degrees);
  }
}

namespace {

/// All that becomes of light along `wo`; of rough glass alone by its first bounce, as steep facets
/// make edges.
double two_sided(const Case& c, Vec3d wo, double tolerance) {
  const Material m = hero_only(c.material);
  const auto lobe = static_cast<Lobe>(m.tree.nodes.back().lobe);
  const bool ggx = lobe == Lobe::Dielectric, beckmann = lobe == Lobe::BeckmannDielectric;
  if (!(ggx || beckmann) || m.numbers[kWavelengths] == 0) return two_sided(m, wo, tolerance);
  const auto alpha = materials::Alpha<double>::from(m.numbers[kWavelengths], m.numbers.back());
  const auto by = [&](const auto& facets) {
    return glass_albedo(m, facets, m.numbers[0], wo, [](Vec3d) { return 1.0; });
  };
  return ggx ? by(GgxFacets{alpha.ax, alpha.ay}) : by(BeckmannFacets{alpha.ax, alpha.ay});
}

}  // namespace

TEST_CASE("every model that is lossless by theory is, from both sides") {
  struct Group {
    std::string name;
    double bound, worst = 0;
  };
  Group deltas_alone{"deltas", 1e-12}, thesis{"glossy, m <= 1e4", 1e-6}, reflecting{"others", 1e-4},
      transmitting{"others, transmitting", 1e-3};
  for (const Case& c : lossless_cases()) {
    const materials::Layout layout = c.material.layout();
    Group& g = Bsdf<double>(layout, c.material.numbers.data()).specular_only() ? deltas_alone
               : c.name.starts_with("glossy")                                  ? thesis
               : layout.transmits()                                            ? transmitting
                                                                               : reflecting;
    for (double degrees : kDegrees) {
      const double a = two_sided(c, direction(degrees, 0.7), g.bound / 4);
      CHECK_MESSAGE(std::abs(a - 1) < g.bound, c.name, " at ", degrees, ": ", a - 1);
      g.worst = std::max(g.worst, std::abs(a - 1));
    }
  }
  for (const Group& g : {deltas_alone, thesis, reflecting, transmitting})
    MESSAGE(g.name, ": largest |albedo - 1| ", g.worst);
}

TEST_CASE("matte keeps its colour") {
  CHECK(albedo(matte(0.37), 40) == doctest::Approx(0.37).epsilon(1e-9));
}

TEST_CASE("white under a white coat") {
  for (double ior : {1.01, 1.1, 1.5, 2.5}) {
    const double bound = 1e-4;
    // The delta's part is added by hand: F.
    for (double degrees : {0.0, 30.0, 60.0, 85.0, 89.99}) {
      const double c = direction(degrees, 0).z;
      const double a = albedo(fresnel_mix(matte(1), mirror(1), ior), degrees, 0, 5) +  // for 1e-6
                       materials::fresnel_dielectric(c, ior);
      CHECK_MESSAGE(std::abs(a - 1) < 1e-6, ior, " at ", degrees, ": ", a);
    }
    double worst = 0;
    const auto under = [&](const Material& coat, double number, double degrees) {
      const double a = albedo(fresnel_mix(matte(1), coat, ior), degrees);
      worst = std::max(worst, std::abs(a - 1));
      CHECK_MESSAGE(std::abs(a - 1) < bound, ior, " ", number, " at ", degrees, ": ", a);
      // Any other base and coat never gain.
      const double b = albedo(fresnel_mix(glossy(1, 10), coat, ior), degrees);
      CHECK_MESSAGE(b < 1 + bound, ior, " ", number, " at ", degrees, ": ", b);
    };
    for (double gloss : {0.0, 0.7, 4.0, 40.0, 1000.0, 2e4})
      for (double degrees : {0.0, 30.0, 60.0, 75.0, 85.0, 89.0, 89.99})
        under(glossy(1, gloss), gloss, degrees);
    MESSAGE("white matte under index ", ior, " and gloss: largest |albedo - 1| ", worst);
    worst = 0;
    for (double roughness : {0.1, 0.35, 1.0})
      for (double degrees : {0.0, 60.0, 80.0, 89.0, 89.99})
        under(microfacet(1, roughness), roughness, degrees);
    MESSAGE("white matte under index ", ior, " and microfacets: largest |albedo - 1| ", worst);
  }
}

TEST_CASE("rough matte under a coat keeps its energy") {
  double most = 0, least = 1;
  for (double ior : {1.02, 1.1, 1.5, 2.5})
    for (double roughness : {0.0, 0.1, 0.5, 1.0})
      for (double degrees : {0.0, 50.0, 80.0}) {
        const Material base = tinted(Lobe::RoughMatte, 1, {roughness});
        const double under_mirror = albedo(fresnel_mix(base, mirror(1), ior), degrees, 0, 8) +
                                    materials::fresnel_dielectric(direction(degrees, 0).z, ior);
        const double under_facets =
            albedo(fresnel_mix(base, microfacet(1, 0.5), ior), degrees, 0, 8);
        for (const double a : {under_mirror, under_facets}) {
          CHECK_MESSAGE(a < 1 + 1e-4, ior, " ", roughness, " at ", degrees, ": ", a);
          CHECK_MESSAGE(a > 1 - 1e-4, ior, " ", roughness, " at ", degrees, ": ", a);
          most = std::max(most, a);
          least = std::min(least, a);
        }
      }
  MESSAGE("rough matte under a coat: albedo from ", least, " to ", most);
}

namespace {

/// Lobes and combiners whose f is the same to the bit with its directions exchanged, also in float.
constexpr Lobe kToTheBit[] = {Lobe::Matte,         Lobe::Translucent, Lobe::Glossy,
                              Lobe::GlossyProduct, Lobe::GlossyBack,  Lobe::Phong,
                              Lobe::GlossyThrough, Lobe::OrenNayar,   Lobe::MaxPhong,
                              Lobe::Spot,          Lobe::Ward,        Lobe::AshikhminShirley,
                              Lobe::Sheen,         Lobe::Mirror,      Lobe::Mix,
                              Lobe::Scale,         Lobe::Add,         Lobe::Layer,
                              Lobe::FresnelMix,    Lobe::Coat,        Lobe::Turn};

bool refracts_at_facets(const Material& m) {
  return std::any_of(m.tree.nodes.begin(), m.tree.nodes.end(), [](const vm::LayoutNode& n) {
    const auto lobe = static_cast<Lobe>(n.lobe);
    return lobe == Lobe::Dielectric || lobe == Lobe::BeckmannDielectric ||
           lobe == Lobe::FilmDielectric;
  });
}

bool to_the_bit(const Material& m) {
  return std::all_of(m.tree.nodes.begin(), m.tree.nodes.end(), [](const vm::LayoutNode& n) {
    return std::find(std::begin(kToTheBit), std::end(kToTheBit), static_cast<Lobe>(n.lobe)) !=
           std::end(kToTheBit);
  });
}

/// `visit(drawn, ab, ba)` for f(a, b) and its adjoint, of pairs of which every other is drawn by
/// the model.
template <class R, class Visit>
void exchanged(const Case& c, int pairs, const Visit& visit) {
  const materials::Layout layout = c.material.layout();
  const auto p = c.material.params<R>();
  const Bsdf<R> bsdf(layout, p.data());
  typename Bsdf<R>::Choice choice;  // for a new direction each time, but of one material
  const auto f = [&](Vec3<R> wo, Vec3<R> wi, Mode mode) {
    bsdf.choose(wo, choice);
    return bsdf.evaluate(wo, wi, mode, choice).f;
  };
  stats::Random random(3);
  if (c.tilted())
    return;  // either direction holds the normal back in its own way (frames_test.cpp)
  for (int i = 0; i < pairs; ++i) {
    const Vec3<R> a(square_to_sphere(random.next(), random.next()));
    Vec3<R> b(square_to_sphere(random.next(), random.next()));
    if (i % 2) {
      const R u = random.next_float(), u1 = random.next_float();
      bsdf.choose(a, choice);
      const auto s = bsdf.sample(a, u, u1, random.next_float(), Mode::Radiance, choice);
      if (!s || s->specular) continue;
      b = s->wi;
    }
    // On one side no index lies between: f itself is symmetric, without its adjoint.
    const bool alike = c.reciprocal() && a.z * b.z > 0;
    const Spectrum<R> ab = f(a, b, Mode::Radiance);
    visit(i % 2 == 1, ab, f(b, a, alike ? Mode::Radiance : Mode::Importance));
  }
}

/// How far two values are apart, in units of the larger; 0 where they have few digits.
template <class R>
double apart(R x, R y) {
  const double scale = std::max(x, y);
  return scale < std::numeric_limits<R>::min() ? 0 : std::abs(double(x) - y) / scale;
}

}  // namespace

TEST_CASE("reciprocity") {
  double worst = 0;
  for (const Case& c : smooth_cases())
    exchanged<double>(c, 3000, [&](bool, const auto& ab, const auto& ba) {
      for (int j = 0; j < kWavelengths; ++j) {
        worst = std::max(worst, apart(ab[j], ba[j]));
        CHECK_MESSAGE(apart(ab[j], ba[j]) < 1e-10, c.name);
      }
    });
  MESSAGE("largest relative difference of f(a, b) and its adjoint ", worst);
}

TEST_CASE("reciprocity in float: to the bit, or within rounding") {
  // Two results that are each right within six steps, as in precision_test.cpp. Where facets
  // refract, the half vector may be short and f no better than its condition: there, of what the
  // hero draws, as much as at the narrowest lobes (kMinAlpha).
  constexpr double kRounding = 2 * 6 * 0x1p-24, kRefraction = 2e-3;
  double rounding = 0, refraction = 0;
  int exact = 0, rounded = 0, refracting = 0;
  for (const Case& c : smooth_cases()) {
    const bool equal = to_the_bit(c.material), facets = refracts_at_facets(c.material);
    ++(equal ? exact : facets ? refracting : rounded);
    double& worst = facets ? refraction : rounding;
    exchanged<float>(c, 2000, [&](bool drawn, const auto& ab, const auto& ba) {
      if (equal) CHECK_MESSAGE(ab == ba, c.name);
      if (facets && !drawn) return;
      for (int j = 0; j < (facets ? 1 : kWavelengths); ++j) {
        worst = std::max(worst, apart(ab[j], ba[j]));
        CHECK_MESSAGE(apart(ab[j], ba[j]) <= (facets ? kRefraction : kRounding), c.name);
      }
    });
  }
  MESSAGE(exact, " cases are reciprocal to the bit, ", rounded, " within ", rounding, ", ",
          refracting, " that refract within ", refraction);
}

TEST_CASE("refracted radiance scales by the squared index") {
  const Material m = dielectric(1.5, 0.4);
  const Vec3d wo = direction(30, 0.3), wi = direction(160, 3.3);
  const double radiance = value(m, wo, wi);
  CHECK(radiance > 0);
  CHECK(value(m, wo, wi, Mode::Importance) == doctest::Approx(2.25 * radiance));
  // f_r(a, b) / n_b^2 is symmetric.
  CHECK(value(m, wi, wo) == doctest::Approx(2.25 * radiance));
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
