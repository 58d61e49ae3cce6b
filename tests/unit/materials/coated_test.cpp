// SPDX-License-Identifier: Apache-2.0
// Lobes that reflect, under a coat: what both together keep, by quadrature.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <string>

#include "tests/unit/materials/albedo.h"
#include "tests/unit/materials/cases.h"

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

template <class Make>
Range under_coats(const Make& make, std::initializer_list<double> numbers,
                  std::initializer_list<double> iors, double azimuth, int panels) {
  Range range;
  for (double ior : iors)
    for (double number : numbers)
      for (double degrees : kAngles) {
        if (kSanitized && (ior != 1.5 || degrees != 85)) continue;
        range.add(coated_albedo(make(number), ior, degrees, azimuth, panels));
      }
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
    const Range a = under_coats(row.make, row.numbers, {1.01, 1.1, 1.5, 4.0}, 0, 12);
    CHECK_MESSAGE(a.least > 1 - 1e-4, row.name, ": ", a.least);
    CHECK_MESSAGE(a.most < 1 + 1e-4, row.name, ": ", a.most);
    MESSAGE(row.name, " under a coat: albedo from ", a.least, " to ", a.most);
  }
  const Range narrow = under_coats(rows[0].make, {0.08}, {1.03, 1.5, 3.5}, 0, 12);
  CHECK(narrow.least > 1 - 1e-4);
  CHECK(narrow.most < 1 + 1e-4);
}

TEST_CASE("rough_matte under a polished coat keeps its energy") {
  const auto make = [](double r) { return tinted(Lobe::RoughMatte, 1, {r}); };
  const Range a = under_coats(make, {0.15, 0.5, 1.0}, {1.05, 1.5, 4.0}, 0, 16);
  CHECK(a.least > 1 - 3e-4);
  CHECK(a.most < 1 + 3e-4);
  MESSAGE("albedo from ", a.least, " to ", a.most);
}

// Widths of a lattice, which are none of the tables' nodes.
TEST_CASE("a lossless lobe under a rough lossless coat keeps its energy") {
  struct Kind {
    std::string name;
    Material (*make)(double place);
    double bound = 1e-4;
  };
  const Kind bases[] = {
      {"microfacet", [](double x) { return microfacet(1, 0.1 + 0.9 * x); }},
      {"beckmann", [](double x) { return beckmann(1, 0.1 + 0.9 * x); }},
      {"glossy", [](double x) { return glossy(1, std::expm1(7 * x)); }},
      {"rough_matte", [](double x) { return tinted(Lobe::RoughMatte, 1, {x}); }, 2e-4},
      {"matte", [](double) { return matte(1); }}};
  constexpr int kCases = kSanitized ? 2 : 40;
  for (const Kind& base : bases)
    for (const Kind& top : {bases[0], bases[1], bases[2]}) {
      Range a;
      for (int k = 1; k <= kCases; ++k) {
        const auto place = [k](double step) { return std::fmod(k * step, 1.0); };
        const double ior = 1.02 * std::pow(4 / 1.02, place(0.5497));
        const double degrees = kAngles[k % std::size(kAngles)];
        const Material m = coat(top.make(place(0.6710)), base.make(place(0.8192)), 0, 0, ior);
        a.add(albedo(m, degrees, 0, 8));
      }
      CHECK_MESSAGE(a.least > 1 - base.bound, base.name, " under ", top.name);
      CHECK_MESSAGE(a.most < 1 + base.bound, base.name, " under ", top.name);
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
    for (double anisotropy : {0.3, -0.6, 0.9}) {
      if (kSanitized && anisotropy > 0.8) continue;  // too few panels
      Range range;
      for (int k = 1; k <= (kSanitized ? 4 : 40); ++k) {
        const auto place = [k](double step) { return std::fmod(k * step, 1.0); };
        const double ior = 1.02 * std::pow(4 / 1.02, place(0.5497));
        const Material top = row.make(0.2 + 0.8 * place(0.6710), anisotropy);
        range.add(albedo(coat(top, matte(1), 0, 0, ior), kAngles[k % std::size(kAngles)],
                         kPi<double> / 2 * place(0.4503), 14));
      }
      CHECK_MESSAGE(range.least > 1 - 3e-4, row.name, " ", anisotropy);
      CHECK_MESSAGE(range.most < 1 + 3e-4, row.name, " ", anisotropy);
      MESSAGE("matte under ", row.name, " of anisotropy ", anisotropy, ": albedo from ",
              range.least, " to ", range.most);
    }
}

TEST_CASE("a matte under a coat of several lobes keeps its energy, and others lose little") {
  struct Row {
    std::string name;
    Material (*make)(double x, double y);
    double mirrored;     ///< the share of mirrors
    double facets_keep;  ///< at least, below it
  };
  static constexpr auto roughness = [](double x) { return 0.2 + 0.8 * x; };
  const Row rows[] = {
      {"two facets",
       [](double x, double y) {
         return mix(microfacet(1, roughness(x)), microfacet(1, roughness(y)), 0.4);
       },
       0, 1 - 1e-4},
      {"a mirror and glossy",
       [](double x, double) { return mix(mirror(1), glossy(1, 1000 * x * x), 0.3); }, 0.7,
       1 - 1e-4},
      {"a sum of three",
       [](double x, double y) {
         return add(scale(beckmann(1, roughness(x)), 0.2),
                    add(scale(glossy(1, 1000 * y * y), 0.3),
                        scale(microfacet(1, roughness(y), 0.6), 0.5)));
       },
       0, 0.95}};
  for (const Row& row : rows) {
    Range matte_below, facets_below;
    for (int k = 1; k <= (kSanitized ? 2 : 20); ++k) {
      const auto place = [k](double step) { return std::fmod(k * step, 1.0); };
      const double ior = 1.02 * std::pow(4 / 1.02, place(0.5497));
      const double degrees = kAngles[k % std::size(kAngles)];
      const double azimuth = kPi<double> / 2 * place(0.4503);
      const Material top = row.make(place(0.6710), place(0.3019));
      const double mirrored =
          row.mirrored * materials::fresnel_dielectric(direction(degrees, azimuth).z, ior);
      const auto both = [&](const Material& base) {
        return albedo(coat(top, base, 0, 0, ior), degrees, azimuth, 14) + mirrored;
      };
      matte_below.add(both(matte(1)));
      facets_below.add(both(microfacet(1, roughness(place(0.7549)))));
    }
    CHECK_MESSAGE(matte_below.least > 1 - 3e-4, row.name);
    CHECK_MESSAGE(matte_below.most < 1 + 3e-4, row.name);
    CHECK_MESSAGE(facets_below.least > row.facets_keep, row.name);
    CHECK_MESSAGE(facets_below.most < 1 + 3e-4, row.name);
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
  constexpr int kCases = kSanitized ? 1 : 6;
  for (const Kind& base : bases) {
    Range a;
    int k = 0;
    for (const Kind& above : lobes)
      for (const Kind& below : lobes)
        for (int n = 0; n < kCases; ++n) {
          ++k;
          const auto place = [k](double step) { return std::fmod(k * step, 1.0); };
          const auto ior = [&](double step) { return 1.02 * std::pow(4 / 1.02, place(step)); };
          const double degrees = kAngles[k % std::size(kAngles)], z = direction(degrees, 0).z;
          const double ior_above = ior(0.5497), ior_below = ior(0.4503);
          const auto under = [&](const Material& m) {
            return coat(above.make(place(0.6710)), m, 0, 0, ior_above);
          };
          // Deltas by hand: what the mirror above reflects, and the one below of what reaches it.
          double sum = albedo(
              under(fresnel_mix(base.make(place(0.3019)), below.make(place(0.8192)), ior_below)),
              degrees, 0, 8);
          const bool mirror_above = &above == lobes, mirror_below = &below == lobes;
          const double f = materials::fresnel_dielectric(z, ior_above);
          if (mirror_above) sum += f;
          if (mirror_below)
            sum += (1 - (mirror_above ? f : albedo(under(matte(0)), degrees, 0, 8))) *
                   materials::fresnel_dielectric(z, ior_below);
          a.add(sum);
        }
    CHECK_MESSAGE(a.least > 1 - 1e-4, base.name);
    CHECK_MESSAGE(a.most < 1 + 1e-4, base.name);
    MESSAGE(base.name, " under two coats: albedo from ", a.least, " to ", a.most);
  }
}

TEST_CASE("plastic under coats of other kinds loses little, and never gains") {
  Range a;
  for (int k = 1; k <= (kSanitized ? 4 : 40); ++k) {
    const auto place = [k](double step) { return std::fmod(k * step, 1.0); };
    const auto ior = [&](double step) { return 1.02 * std::pow(2.5 / 1.02, place(step)); };
    const double x = 0.2 + 0.8 * place(0.6710), y = 0.2 + 0.8 * place(0.8192);
    const Material both = mix(microfacet(1, x), microfacet(1, y), 0.4);
    const Material coats[] = {microfacet(1, x, 0.5), both};
    const bool stretched = k % 2;  // above; if not, there are several lobes below
    const Material plastic =
        fresnel_mix(matte(1), stretched ? microfacet(1, y) : both, ior(0.5497));
    a.add(albedo(coat(coats[stretched ? 0 : 1], plastic, 0, 0, ior(0.4503)),
                 kAngles[k % std::size(kAngles)], 0.3, 12));
  }
  CHECK(a.least > 0.98);
  CHECK(a.most < 1 + 1e-4);
  MESSAGE("albedo from ", a.least, " to ", a.most);
}

TEST_CASE("a coat of index 1 is not there") {
  const Material base = fresnel_mix(matte(1), microfacet(1, 0.4), 1.5);
  for (double degrees : kAngles) {
    CHECK(albedo(coat(microfacet(1, 0.3), base, 0, 0, 1), degrees) == albedo(base, degrees));
    CHECK(albedo(coat(mirror(1), fresnel_mix(matte(1), glossy(1, 9), 1), 0, 0, 1.5), degrees) ==
          albedo(coat(mirror(1), matte(1), 0, 0, 1.5), degrees));
  }
}

TEST_CASE("a choice that was made for other coats changes nothing") {
  const Material made[] = {
      coat(mirror(1), fresnel_mix(matte(1), microfacet(1, 0.4), 1.5), 0, 0, 1.6),
      coat(microfacet(1, 0.3), fresnel_mix(matte(1), microfacet(1, 0.4), 1.5), 0, 0, 1.6),
      coat(microfacet(1, 0.3), fresnel_mix(matte(1), microfacet(1, 0.4), 1.4), 0, 0, 1.6),
      coat(microfacet(1, 0.3), fresnel_mix(glossy(1, 30), microfacet(1, 0.4), 1.4), 0, 0, 1.6),
      coat(microfacet(1, 0.3), glossy(1, 30), 0, 0, 1.6),
      coat(microfacet(1, 0.3), glossy(1, 20), 0, 0, 1.6),
      coat(glossy(1, 9), glossy(1, 20), 0, 0, 1.6),
      coat(glossy(1, 9), matte(1), 0, 0, 1)};
  Bsdf<double>::Choice kept;
  const Vec3d wi = direction(40, 2.0);
  for (int round = 0; round < 2; ++round)
    for (const Material& m : made)
      for (double degrees : {20.0, 70.0}) {
        const materials::Layout layout = m.layout();
        const auto p = m.params<double>();
        const Bsdf<double> bsdf(layout, p.data());
        const Vec3d wo = direction(degrees, 0.3);
        bsdf.choose(wo, kept);
        CHECK(bsdf.evaluate(wo, wi, Mode::Radiance, kept).f[0] ==
              bsdf.eval(wo, wi, Mode::Radiance)[0]);
      }
}

TEST_CASE("stretched facets under a coat keep their energy") {
  struct Row {
    std::string name;
    Material (*make)(double roughness, double anisotropy);
    double bound, most_stretched;  ///< the second beyond anisotropy 0.9
  };
  const Row rows[] = {
      {"microfacet", [](double r, double a) { return microfacet(1, r, a); }, 3e-4, 1e-3},
      {"beckmann", [](double r, double a) { return beckmann(1, r, a); }, 3e-4, 1.5e-3},
      {"conductor", [](double r, double a) { return conductor(1, 1e25, r, a); }, 3e-4, 1e-3}};
  for (const Row& row : rows)
    for (double anisotropy : {0.3, -0.6, 0.9, 1.0}) {
      if (kSanitized && anisotropy > 0.8) continue;  // too few panels
      const bool most = anisotropy > 0.9;
      const int panels = kSanitized ? 10 : anisotropy < 0.9 ? 12 : 20;  // lobes are narrow
      Range range;
      for (double roughness : {0.3, 0.45, 0.9})
        for (double ior : {1.05, 2.2})
          for (double degrees : {10.0, 60.0, 86.0})
            for (double azimuth : {0.2, 1.3}) {
              if ((kSanitized || most) && roughness != 0.45) continue;
              if ((kSanitized || panels > 12) && degrees == 60) continue;
              range.add(
                  coated_albedo(row.make(roughness, anisotropy), ior, degrees, azimuth, panels));
            }
      const double bound = most ? row.most_stretched : row.bound;
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
    const double alone = albedo(metal, degrees, 0, 12);
    const double under = albedo(coat(mirror(1), metal, 0, 0, 1.5), degrees, 0, 12);
    CHECK(under == doctest::Approx(alone * through).epsilon(1e-3));
  }
}
