// SPDX-License-Identifier: Apache-2.0
// Lobes that reflect, under a coat: what both together keep, by quadrature.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <span>
#include <string>

#include "tests/unit/materials/albedo.h"
#include "tests/unit/materials/cases.h"
#include "tests/unit/materials/walter.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

namespace {

constexpr double kAngles[] = {0, 30, 60, 75, 85, 89, 89.99};

struct Range {
  double least = 2, most = 0;
  void add(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
  }
};

/// Albedo of `base` under a polished coat; the delta's part is added by hand.
double coated_albedo(const Material& base, double ior, double degrees, double azimuth, int panels) {
  return albedo(coat(mirror(1), base, 0, 0, ior), degrees, azimuth, panels) +
         materials::fresnel_dielectric(direction(degrees, azimuth).z, ior);
}

/// What the deltas of a material reflect: all that fall on the mirror's direction are summed by one
/// sample of any.
double mirrored(const Material& m, double degrees) {
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  const Bsdf<double> bsdf(layout, p.data());
  const Vec3d wo = direction(degrees, 0);
  const auto choice = bsdf.choose(wo);
  double before = 0;
  for (std::size_t i = 0; i < layout.nodes().size(); ++i) {
    const double chosen = choice.probability.of[i][0];
    const auto s = bsdf.sample(wo, before + chosen / 2, 0.5, 0.5, Mode::Radiance, choice);
    if (chosen > 0 && s && s->specular) return s->f[0] * std::abs(s->wi.z);
    before += chosen;
  }
  return 0;
}

template <class Make>
Range under_coats(const Make& make, std::initializer_list<double> numbers,
                  std::initializer_list<double> iors, double azimuth, int panels) {
  Range range;
  for (double ior : iors)
    for (double number : numbers)
      for (double degrees : kAngles)
        range.add(coated_albedo(make(number), ior, degrees, azimuth, panels));
  return range;
}

}  // namespace

TEST_CASE("a lossless lobe under a lossless coat keeps its energy") {
  struct Row {
    std::string name;
    Material (*make)(double number);
    std::initializer_list<double> numbers;
  };
  const Row rows[] = {
      {"microfacet",
       [](double r) { return microfacet(1, r); },
       {0.1, 0.2, 0.25, 0.35, 0.47, 0.5, 0.75, 1.0}},
      {"beckmann", [](double r) { return beckmann(1, r); }, {0.1, 0.35, 0.6, 1.0}},
      {"conductor", [](double r) { return conductor(1, 1e25, r); }, {0.3}},
      {"glossy", [](double g) { return glossy(1, g); }, {0.0, 0.7, 4.0, 40.0, 1000.0}}};
  for (const Row& row : rows) {
    const Range a = under_coats(row.make, row.numbers, {1.01, 1.1, 1.5, 4.0}, 0, 4);
    CHECK_MESSAGE(a.least > 1 - 1e-4, row.name, ": ", a.least);
    CHECK_MESSAGE(a.most < 1 + 1e-4, row.name, ": ", a.most);
    MESSAGE(row.name, " under a coat: albedo from ", a.least, " to ", a.most);
  }
  const Range narrow = under_coats(rows[0].make, {0.08}, {1.03, 1.5, 3.5}, 0, 4);
  CHECK(narrow.least > 1 - 1e-4);
  CHECK(narrow.most < 1 + 1e-4);
}

TEST_CASE("rough_matte under a polished coat keeps its energy") {
  const auto make = [](double r) { return tinted(Lobe::RoughMatte, 1, {r}); };
  const Range a = under_coats(make, {0.15, 0.5, 1.0}, {1.05, 1.5, 4.0}, 0, 8);
  CHECK(a.least > 1 - 1e-4);
  CHECK(a.most < 1 + 1e-4);
  MESSAGE("albedo from ", a.least, " to ", a.most);
}

// Widths of a lattice, which are none of the tables' nodes.
TEST_CASE("a lossless lobe under a rough lossless coat keeps its energy") {
  struct Kind {
    std::string name;
    Material (*make)(double place);
    int panels = 3;
  };
  const Kind bases[] = {
      {"microfacet", [](double x) { return microfacet(1, 0.1 + 0.9 * x); }},
      {"beckmann", [](double x) { return beckmann(1, 0.1 + 0.9 * x); }},
      {"glossy", [](double x) { return glossy(1, std::expm1(7 * x)); }},
      {"rough_matte", [](double x) { return tinted(Lobe::RoughMatte, 1, {x}); }, 8},
      {"matte", [](double) { return matte(1); }}};
  const Kind metal = {"conductor", [](double x) { return conductor(1, 1e25, 0.1 + 0.9 * x); }};
  const int cases = swept(40);
  for (const Kind& base : bases)
    for (const Kind& top : {bases[0], bases[1], bases[2], metal}) {
      Range a;
      for (int k = 1; k <= cases; ++k) {
        const auto place = [k](double step) { return std::fmod(k * step, 1.0); };
        const double ior = 1.02 * std::pow(4 / 1.02, place(0.5497));
        const double degrees = kAngles[k % std::size(kAngles)];
        const Material m = coat(top.make(place(0.6710)), base.make(place(0.8192)), 0, 0, ior);
        a.add(albedo(m, degrees, 0, base.panels));
      }
      CHECK_MESSAGE(a.least > 1 - 1e-4, base.name, " under ", top.name);
      CHECK_MESSAGE(a.most < 1 + 1e-4, base.name, " under ", top.name);
      MESSAGE(base.name, " under ", top.name, ": albedo from ", a.least, " to ", a.most);
    }
}

TEST_CASE("a matte under a stretched coat keeps its energy") {
  struct Row {
    std::string name;
    Material (*make)(double roughness, double anisotropy);
  };
  const Row rows[] = {{"microfacet", [](double r, double a) { return microfacet(1, r, a); }},
                      {"beckmann", [](double r, double a) { return scale(beckmann(1, r, a), 1); }}};
  for (const Row& row : rows)
    for (double anisotropy : {0.3, -0.6, 0.9, 1.0}) {
      Range range;
      for (int k = 1; k <= swept(40); ++k) {
        const auto place = [k](double step) { return std::fmod(k * step, 1.0); };
        const double ior = 1.02 * std::pow(4 / 1.02, place(0.5497));
        const Material top = row.make(0.2 + 0.8 * place(0.6710), anisotropy);
        range.add(albedo(coat(top, matte(1), 0, 0, ior), kAngles[k % std::size(kAngles)],
                         kPi<double> / 2 * place(0.4503), anisotropy > 0.9 ? 10 : 7));
      }
      CHECK_MESSAGE(range.least > 1 - 1e-4, row.name, " ", anisotropy);
      CHECK_MESSAGE(range.most < 1 + 1e-4, row.name, " ", anisotropy);
      MESSAGE("matte under ", row.name, " of anisotropy ", anisotropy, ": albedo from ",
              range.least, " to ", range.most);
    }
}

TEST_CASE("lossless lobes under a coat of several lobes keep their energy") {
  struct Row {
    std::string name;
    Material (*make)(double x, double y);
    double mirrored = 0;  ///< the share of mirrors
  };
  static constexpr auto roughness = [](double x) { return 0.2 + 0.8 * x; };
  const Row rows[] = {
      {"two facets",
       [](double x, double y) {
         return mix(microfacet(1, roughness(x)), microfacet(1, roughness(y)), 0.4);
       },
       0},
      {"facets and a lobe that sends back",
       [](double x, double y) {
         return mix(microfacet(1, roughness(x)), tinted(Lobe::GlossyBack, 1, {20 * y, 3}), 0.4);
       },
       0},
      {"a mirror and glossy",
       [](double x, double) { return mix(mirror(1), glossy(1, 1000 * x * x), 0.3); }, 0.7},
      {"a sum of three",
       [](double x, double y) {
         return add(scale(beckmann(1, roughness(x)), 0.2),
                    add(scale(glossy(1, 1000 * y * y), 0.3),
                        scale(microfacet(1, roughness(y), 0.6), 0.5)));
       },
       0}};
  for (const Row& row : rows) {
    Range matte_below, facets_below;
    for (int k = 1; k <= swept(20); ++k) {
      const auto place = [k](double step) { return std::fmod(k * step, 1.0); };
      const double ior = 1.02 * std::pow(4 / 1.02, place(0.5497));
      const double degrees = kAngles[k % std::size(kAngles)];
      const double azimuth = kPi<double> / 2 * place(0.4503);
      const Material top = row.make(place(0.6710), place(0.3019));
      const double mirrored =
          row.mirrored * materials::fresnel_dielectric(direction(degrees, azimuth).z, ior);
      const auto both = [&](const Material& base) {
        return albedo(coat(top, base, 0, 0, ior), degrees, azimuth, 5) + mirrored;
      };
      matte_below.add(both(matte(1)));
      facets_below.add(both(microfacet(1, roughness(place(0.7549)))));
    }
    for (const Range& a : {matte_below, facets_below}) {
      CHECK_MESSAGE(a.least > 1 - 1e-4, row.name);
      CHECK_MESSAGE(a.most < 1 + 1e-4, row.name);
    }
    MESSAGE("under ", row.name, ": matte from ", matte_below.least, " to ", matte_below.most,
            ", facets from ", facets_below.least, " to ", facets_below.most);
  }
}

TEST_CASE("lossless lobes under two lossless coats keep their energy") {
  struct Kind {
    std::string name;
    Material (*make)(double place);
  };
  const Kind lobes[] = {{"mirror", [](double) { return mirror(1); }},
                        {"microfacet", [](double x) { return microfacet(1, 0.1 + 0.9 * x); }},
                        {"beckmann", [](double x) { return scale(beckmann(1, 0.1 + 0.9 * x), 1); }},
                        {"glossy", [](double x) { return glossy(1, std::expm1(7 * x)); }}};
  const Kind bases[] = {{"matte", [](double) { return matte(1); }},
                        {"rough_matte", [](double x) { return tinted(Lobe::RoughMatte, 1, {x}); }},
                        lobes[1],
                        lobes[3]};
  constexpr int kCases = 6;
  for (const Kind& base : bases) {
    const int panels = base.name == "rough_matte" ? 8 : 3;  // it is not smooth
    Range a;
    int k = 0;
    for (const Kind& above : lobes)
      for (const Kind& below : lobes)
        for (int n = 0; n < kCases; ++n) {
          ++k;
          const auto place = [k](double step) { return std::fmod(k * step, 1.0); };
          const auto ior = [&](double step) { return 1.02 * std::pow(4 / 1.02, place(step)); };
          const double degrees = kAngles[k % std::size(kAngles)];
          const double ior_above = ior(0.5497);
          const double ior_below = k % 4 ? ior(0.4503) : 1 / ior(0.4503);
          const auto under = [&](const Material& m) {
            return coat(above.make(place(0.6710)), m, 0, 0, ior_above);
          };
          const Material m =
              under(fresnel_mix(base.make(place(0.3019)), below.make(place(0.8192)), ior_below));
          a.add(albedo(m, degrees, 0, panels) + mirrored(m, degrees));
        }
    CHECK_MESSAGE(a.least > 1 - 1e-4, base.name);
    CHECK_MESSAGE(a.most < 1 + 1e-4, base.name);
    MESSAGE(base.name, " under two coats: albedo from ", a.least, " to ", a.most);
  }
}

TEST_CASE("what lies under a film, and a coat under one, keeps its energy") {
  struct Kind {
    std::string name;
    Material (*make)(double place);
  };
  const Kind round[] = {{"mirror", [](double) { return mirror(1); }},
                        {"microfacet", [](double x) { return microfacet(1, 0.1 + 0.9 * x); }},
                        {"glossy", [](double x) { return glossy(1, std::expm1(7 * x)); }}};
  const Kind stretched[] = {
      {"anisotropy 0.5", [](double x) { return microfacet(1, 0.2 + 0.8 * x, 0.5); }},
      {"anisotropy 0.9", [](double x) { return microfacet(1, 0.2 + 0.8 * x, -0.9); }},
      {"Beckmann, anisotropy 0.9", [](double x) { return beckmann(1, 0.2 + 0.8 * x, 0.9); }},
      {"anisotropy 1", [](double x) { return microfacet(1, 0.2 + 0.8 * x, 1); }}};
  // Of light of 500 nm; one that does away with it along the normal where `most` is 0.
  const auto under_films = [](const Kind& base, std::span<const Kind> tops, double least,
                              double most, int panels) {
    Range a;
    int k = 0;
    for (const Kind& top : tops)
      for (int n = 0; n < swept(12); ++n) {
        ++k;
        const auto place = [k](double step) { return std::fmod(k * step, 1.0); };
        const double degrees = kAngles[k % std::size(kAngles)];
        const double ior = 1.02 * std::pow(2.5 / 1.02, place(0.5497)),
                     film = most > 0 ? 1 + 1.5 * place(0.2137) : std::sqrt(ior),
                     thickness = most > 0 ? least * std::pow(most / least, place(0.7549))
                                          : 5e-7 / (4 * film);
        const Material m =
            film_mix(base.make(place(0.3019)), top.make(place(0.8192)), ior, film, thickness, 5e-7);
        a.add(albedo(m, degrees, 2 * kPi<double> * place(0.6711), panels) + mirrored(m, degrees));
      }
    MESSAGE(base.name, " under ", tops[0].name, " and a film of up to ", most * 1e6,
            " um: albedo from ", a.least, " to ", a.most);
    return a;
  };
  const Kind bases[] = {{"matte", [](double) { return matte(1); }},
                        {"rough_matte", [](double x) { return tinted(Lobe::RoughMatte, 1, {x}); }},
                        round[1],
                        round[2],
                        {"plastic under a coat", [](double x) {
                           return fresnel_mix(microfacet(1, 0.1 + 0.9 * x), glossy(1, 30), 1.5);
                         }}};
  struct Thickness {
    double least, most;
  };
  for (const Thickness& t :
       {Thickness{0, 0}, {1e-8, 6e-7}, {6e-7, 1e-6}, {1e-6, 4e-6}, {4e-6, 1e-4}})
    for (const Kind& base : bases) {
      const int panels = base.name == "rough_matte" ? 8 : 6;  // it is not smooth
      const Range a = under_films(base, round, t.least, t.most, panels);
      CHECK_MESSAGE(a.least > 1 - 1e-4, base.name);
      CHECK_MESSAGE(a.most < 1 + 1e-4, base.name);
    }
  for (const Kind& kind : stretched)
    for (const double most : {0.0, 6e-7, 1e-6}) {
      const int panels = kind.name == "anisotropy 0.5" ? 4 : 10;  // lobes are narrow
      const Range under = under_films(kind, round, 1e-8, most, panels),
                  coat = under_films(bases[0], {&kind, 1}, 1e-8, most, panels);
      CHECK_MESSAGE(under.least > 1 - 1e-4, kind.name);
      CHECK_MESSAGE(under.most < 1 + 1e-4, kind.name);
      CHECK_MESSAGE(coat.least > 1 - 1e-4, kind.name);
      CHECK_MESSAGE(coat.most < 1 + 1e-4, kind.name);
    }
}

TEST_CASE("plastic under coats of several lobes, of stretched ones, and under two") {
  struct Row {
    std::string name;
    Material (*make)(double x, double y, double ior_above, double ior_below);
    int panels = 4;
  };
  static constexpr auto both = [](double x, double y) {
    return mix(microfacet(1, x), microfacet(1, y), 0.4);
  };
  static constexpr auto stack = [](int coats, double x, double y, double a, double b) {
    Material m = fresnel_mix(beckmann(1, x), microfacet(1, y), 1 + (b - 1) / 4);
    for (int k = 1; k < coats; ++k) m = coat(microfacet(1, y), m, 0, 0, 1 + (a - 1) / 4);
    return m;
  };
  const Row rows[] = {
      {"stretched above",
       [](double x, double y, double a, double b) {
         return coat(microfacet(1, x, 0.5), fresnel_mix(matte(1), microfacet(1, y), b), 0, 0, a);
       }},
      {"stretched below",
       [](double x, double y, double a, double b) {
         return coat(microfacet(1, x),
                     fresnel_mix(microfacet(1, 0.5, 0.5), microfacet(1, y, 0.5), b), 0, 0, a);
       }},
      {"stretched everywhere, crossed",
       [](double x, double y, double a, double b) {
         return coat(microfacet(1, x, 0.9),
                     fresnel_mix(microfacet(1, 0.6, 0.6), microfacet(1, y, -0.9), b), 0, 0, a);
       },
       6},
      {"several lobes above and below",
       [](double x, double y, double a, double b) {
         return coat(both(x, y), fresnel_mix(microfacet(1, y), both(y, x), b), 0, 0, a);
       }},
      {"three coats",
       [](double x, double y, double a, double b) {
         return coat(
             glossy(1, 30 * x),
             coat(microfacet(1, y), fresnel_mix(microfacet(1, x), microfacet(1, y), b), 0, 0, a), 0,
             0, 1.3);
       }},
      {"a coat of index 0.8 above",  // which counts as one of 1.25
       [](double x, double y, double a, double b) {
         return coat(glossy(1, 30),
                     coat(microfacet(1, x), fresnel_mix(matte(1), microfacet(1, y), b), 0, 0, a), 0,
                     0, 0.8);
       }},
      {"a coat of index 0.8 between",
       [](double x, double y, double a, double b) {
         return coat(glossy(1, 30),
                     coat(microfacet(1, x), fresnel_mix(matte(1), microfacet(1, y), b), 0, 0, 0.8),
                     0, 0, a);
       }},
      {"eight coats", [](double x, double y, double a, double b) { return stack(8, x, y, a, b); }},
      {"thirty coats",
       [](double x, double y, double a, double b) { return stack(30, x, y, a, b); }}};
  for (const Row& row : rows) {
    Range a;
    for (int k = 1; k <= swept(20); ++k) {
      const auto place = [k](double step) { return std::fmod(k * step, 1.0); };
      const auto ior = [&](double step) { return 1.02 * std::pow(2.5 / 1.02, place(step)); };
      a.add(albedo(
          row.make(0.2 + 0.8 * place(0.6710), 0.2 + 0.8 * place(0.8192), ior(0.4503), ior(0.5497)),
          kAngles[k % std::size(kAngles)], 0.3, row.panels));
    }
    CHECK_MESSAGE(a.least > 1 - 1e-4, row.name);
    CHECK_MESSAGE(a.most < 1 + 1e-4, row.name);
    MESSAGE(row.name, ": albedo from ", a.least, " to ", a.most);
  }
}

TEST_CASE("stretched facets, rough coats of them, and both keep their energy") {
  using Make = Material (*)(double roughness, double anisotropy);
  const struct {
    std::string name;
    Make make;
  } kinds[] = {{"microfacet", [](double r, double a) { return microfacet(1, r, a); }},
               {"beckmann", [](double r, double a) { return scale(beckmann(1, r, a), 1); }}};
  for (const auto& top : kinds)
    for (const auto& base : kinds)
      for (const double anisotropy : {0.4, 0.9}) {
        Range range;
        for (int k = 1; k <= swept(24); ++k) {
          const auto place = [k](double step) { return std::fmod(k * step, 1.0); };
          const double ior = 1.05 * std::pow(3.5 / 1.05, place(0.5497));
          const double which = k % 3;  // 0: the coat alone is round; 1: the base alone; 2: crossed
          const double above = which == 0 ? 0 : -anisotropy, below = which == 1 ? 0 : anisotropy;
          range.add(albedo(coat(top.make(0.3 + 0.7 * place(0.6710), above),
                                base.make(0.3 + 0.7 * place(0.8192), below), 0, 0, ior),
                           kAngles[k % std::size(kAngles)], kPi<double> / 2 * place(0.4503),
                           anisotropy > 0.8 ? 6 : 5));
        }
        CHECK_MESSAGE(range.least > 1 - 1e-4, base.name, " under ", top.name);
        CHECK_MESSAGE(range.most < 1 + 1e-4, base.name, " under ", top.name);
        MESSAGE(base.name, " under ", top.name, " of anisotropy ", anisotropy, ": albedo from ",
                range.least, " to ", range.most);
      }
}

// Walter et al. (2007): of one bounce, F D G / (4 c c') towards the mirror's direction.
TEST_CASE("highlights of a coat of facets are as bright as its interface's") {
  double least = 2, most = 0;
  for (const double ior : {1.5, 2.5})
    for (const double roughness : {0.2, 0.3, 0.5})
      for (const double degrees : {0.0, 30.0, 60.0}) {
        const double alpha = roughness * roughness;
        const Vec3d wo = direction(degrees, 0), wi{-wo.x, -wo.y, wo.z};
        const GgxFacets facets{alpha, alpha};
        const double once = textbook_fresnel(wo.z, ior) * facets.normals({0, 0, 1}) /
                            (1 + facets.lambda(wo) + facets.lambda(wi)) / (4 * wo.z * wi.z);
        const Material m = coat(microfacet(1, roughness), matte(0), 0, 0, ior);
        const double quotient = value(m, wo, wi) / once;
        least = std::min(least, quotient);
        most = std::max(most, quotient);
        if (degrees == 0) CHECK(quotient == doctest::Approx(1).epsilon(0.03));
      }
  CHECK(least > 0.8);
  CHECK(most < 1.03);
  MESSAGE("over its interface's: from ", least, " to ", most);
}

TEST_CASE("a coat of index 1 is not there") {
  const Material base = fresnel_mix(matte(1), microfacet(1, 0.4), 1.5);
  for (double degrees : kAngles) {
    CHECK(albedo(coat(microfacet(1, 0.3), base, 0, 0, 1), degrees) == albedo(base, degrees));
    CHECK(albedo(coat(mirror(1), fresnel_mix(matte(1), glossy(1, 9), 1), 0, 0, 1.5), degrees) ==
          albedo(coat(mirror(1), matte(1), 0, 0, 1.5), degrees));
  }
}

TEST_CASE("a choice that was made for other materials changes nothing") {
  const Material made[] = {
      coat(mirror(1), fresnel_mix(matte(1), microfacet(1, 0.4), 1.5), 0, 0, 1.6),
      coat(microfacet(1, 0.3), fresnel_mix(matte(1), microfacet(1, 0.4), 1.5), 0, 0, 1.6),
      coat(microfacet(1, 0.3), fresnel_mix(matte(1), microfacet(1, 0.4), 1.4), 0, 0, 1.6),
      coat(microfacet(1, 0.3), fresnel_mix(glossy(1, 30), microfacet(1, 0.4), 1.4), 0, 0, 1.6),
      coat(microfacet(1, 0.3), glossy(1, 30), 0, 0, 1.6),
      coat(microfacet(1, 0.3), glossy(1, 20), 0, 0, 1.6),
      coat(glossy(1, 9), glossy(1, 20), 0, 0, 1.6),
      coat(conductor(0.2, 3.4, 0.3), glossy(1, 20), 0, 0, 1.6),
      coat(coloured_metal(0.8, 1, 0.3), glossy(1, 20), 0, 0, 1.6),
      coat(film_conductor(0.2, 3.4, 1.5, 3e-7, 5e-7, 0.3), glossy(1, 20), 0, 0, 1.6),
      coat(glossy(1, 9), matte(1), 0, 0, 1),
      coat(microfacet(1, 0.3), dielectric(1.5, 0.3), 0, 0, 1.6),
      coat(microfacet(1, 0.3), dielectric(1.5, 0.3), 0, 0, 1.7),
      coat(microfacet(1, 0.3), dielectric(1.5, 0.35), 0, 0, 1.7),
      coat(microfacet(1, 0.3), phong_glass(1.5, 1e3), 0, 0, 1.7),
      coat(microfacet(1, 0.3), phong_glass(1.5, 1e2), 0, 0, 1.7),
      coat(microfacet(1, 0.3), film_dielectric(1.5, 1.8, 3e-7, 5e-7, 0.3), 0, 0, 1.7),
      coat(microfacet(1, 0.3), film_dielectric(1.5, 1.8, 4e-7, 5e-7, 0.3), 0, 0, 1.7),
      film_mix(dielectric(1.5, 0.3), mirror(1), 1.5, 1.8, 3e-7, 5e-7),
      film_mix(dielectric(1.5, 0.3), mirror(1), 1.5, 1.8, 4e-7, 5e-7),
      coat(mirror(1), dielectric(1.5, 0.3), 0, 0, 1.6),
      coat(microfacet(1, 0.3), coat(mirror(1), dielectric(1.5, 0.3), 0, 0, 1.2), 0, 0, 1.6),
      film_mix(microfacet(1, 0.35, 0.9), microfacet(1, 0.3, 0.8), 1.5, 1.3, 3e-7, 5e-7),
      film_mix(microfacet(1, 0.35, 0.9), microfacet(1, 0.4, 0.8), 1.5, 1.3, 3e-7, 5e-7),
      film_mix(beckmann(1, 0.35, 0.9), mirror(1), 1.5, 1.3, 3e-7, 5e-7),
      // One node each, at one place.
      microfacet(1, 0.3), microfacet(0.5, 0.3), microfacet(0.5, 0.4), microfacet(0.5, 0.4, 0.7),
      beckmann(0.5, 0.4, 0.7), conductor(0.2, 3.4, 0.3), coloured_metal(0.2, 3.4, 0.3),
      film_conductor(0.2, 3.4, 1.5, 3e-7, 5e-7, 0.3),
      film_conductor(0.2, 3.4, 1.5, 3e-7, 6e-7, 0.3), dielectric(1.5, 0.3),
      dielectric(1.5, 0.3, 1, 0.5), dielectric(1.5, 0.3, 1, 0.5, 0, Lobe::BeckmannDielectric),
      dielectric(1.6, 0.3, 1, 0.5), dielectric(1.6, 0.35, 1, 0.5),
      dielectric(1.6, 0.35, 1, 0.5, 0.6), film_dielectric(1.6, 1.4, 3e-7, 5e-7, 0.35),
      film_dielectric(1.6, 1.4, 3e-7, 6e-7, 0.35)};
  Bsdf<double>::Choice kept;
  for (int round = 0; round < 2; ++round)
    for (const Material& m : made)
      for (double degrees : {20.0, 70.0, 130.0}) {
        const materials::Layout layout = m.layout();
        const auto p = m.params<double>();
        const Bsdf<double> bsdf(layout, p.data());
        const Vec3d wo = direction(degrees, 0.3);
        bsdf.choose(wo, kept);
        for (double there : {40.0, 140.0}) {
          const Vec3d wi = direction(there, 2.0);
          CHECK(bsdf.evaluate(wo, wi, Mode::Radiance, kept).f.v ==
                bsdf.eval(wo, wi, Mode::Radiance).v);
        }
      }
}

TEST_CASE("stretched facets under a coat keep their energy") {
  struct Row {
    std::string name;
    Material (*make)(double roughness, double anisotropy);
  };
  const Row rows[] = {{"microfacet", [](double r, double a) { return microfacet(1, r, a); }},
                      {"beckmann", [](double r, double a) { return beckmann(1, r, a); }},
                      {"conductor", [](double r, double a) { return conductor(1, 1e25, r, a); }}};
  for (const Row& row : rows)
    for (double anisotropy : {0.3, -0.6, 0.9, 1.0}) {
      const bool most = anisotropy > 0.9;
      const int panels = anisotropy < 0.9 ? 4 : 10;  // lobes are narrow
      Range range;
      for (double roughness : {0.3, 0.45, 0.9})
        for (double ior : {1.05, 2.2})
          for (double degrees : {10.0, 60.0, 86.0})
            for (double azimuth : {0.2, 1.3}) {
              if (most && roughness != 0.45) continue;
              if (panels > 4 && degrees == 60) continue;
              range.add(
                  coated_albedo(row.make(roughness, anisotropy), ior, degrees, azimuth, panels));
            }
      const double bound = most ? 5e-4 : 1e-4;
      CHECK_MESSAGE(range.least > 1 - bound, row.name, " ", anisotropy);
      CHECK_MESSAGE(range.most < 1 + bound, row.name, " ", anisotropy);
      MESSAGE(row.name, " of anisotropy ", anisotropy, " under a coat: albedo from ", range.least,
              " to ", range.most);
    }
}

TEST_CASE("a base that absorbs takes what it takes of what the coat lets through") {
  // Narrow lobes, away from grazing, are all but mirrors: T F of a metal's F.
  const Material metal = conductor(0.2, 3.9, 0.1);
  for (double degrees : {0.0, 30.0, 60.0}) {
    const double c = direction(degrees, 0).z, through = 1 - materials::fresnel_dielectric(c, 1.5);
    const double alone = albedo(metal, degrees, 0, 4);
    const double under = albedo(coat(mirror(1), metal, 0, 0, 1.5), degrees, 0, 4);
    CHECK(under == doctest::Approx(alone * through).epsilon(1e-3));
  }
}
