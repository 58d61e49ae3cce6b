// SPDX-License-Identifier: Apache-2.0
// Glass below coats: what both together keep, from outside and from inside. The first bounce of
// rough glass is as Walter et al. (2007) write it, times what the coats let through.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string>
#include <utility>

#include "materials/coat.h"
#include "materials/tables/glass.h"
#include "tests/stats/random.h"
#include "tests/unit/materials/albedo.h"
#include "tests/unit/materials/cases.h"
#include "tests/unit/materials/walter.h"

using namespace mms;
using namespace mms::test;
using materials::Beckmann, materials::Bsdf, materials::Ggx;
using materials::Mode;

namespace {

/// The sum of the deltas that light along `wo` is sent to, or of those across alone.
double deltas(const Material& m, Vec3d wo, bool reflected = true) {
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  const auto [here, across] = test::deltas(layout, p.data(), wo);
  return (reflected ? here : 0) + across;
}

bool smooth_everywhere(const Material& m) {
  const materials::Layout layout = m.layout();
  return Bsdf<double>(layout, m.params<double>().data()).specular_only();
}

/// What comes back of light along `wo` from `m`, which is glass of `facets` and index `glass` below
/// a polished coat of index `coat`.
template <class Facets>
double coated_albedo(const Material& m, const Facets& facets, double glass, double coat, Vec3d wo) {
  const bool outside = wo.z > 0;
  const auto through = [&](double z) { return 1 - textbook_fresnel(std::abs(z), coat); };
  const auto weight = [&](Vec3d wi) {
    const bool same = wi.z > 0;
    if (!same) return through(outside ? wo.z : wi.z);
    return outside ? through(wo.z) * through(wi.z) / through(1) : 1.0;
  };
  return glass_albedo(m, facets, glass, wo, weight) + deltas(m, wo);
}

/// The range of what is met, and where its ends are.
struct Range {
  double least = 2, most = 0;
  std::string where[2];
  void add(double a, const std::string& at) {
    if (a < least) least = a, where[0] = at;
    if (a > most) most = a, where[1] = at;
  }
  std::string text() const {
    return std::to_string(least - 1) + " (" + where[0] + ") to " + std::to_string(most - 1) + " (" +
           where[1] + ")";
  }
};

double place(int k, double step) { return std::fmod(k * step, 1.0); }
double between(double least, double most, double at) { return least * std::pow(most / least, at); }

/// Of glass; of what has a lower index than is above it, where it `falls`.
double index(int k, bool falls = false) {
  const double glass = between(1.02, 3.9, place(k, 0.8192));
  return falls ? 1 / glass : glass;
}

/// How many settings are swept: fewer of glass whose index falls.
int settings(int all, bool falls) { return swept(falls ? all / 3 : all); }

/// Degrees from the normal, outside and inside; the last two are about the critical angle.
double angle(int k, double glass) {
  constexpr double all[] = {0, 30, 60, 75, 85, 89, 89.99};
  const int count = int(std::size(all)), i = k / 2 % (count + 2);
  const double critical = std::asin(std::min(glass, 1 / glass)) * 180 / kPi<double>;
  const double degrees = i < count ? all[i] : critical - 4 * place(k, 0.7549) * (i - count + 0.2);
  return k % 2 ? degrees : 180 - degrees;
}

std::string text(double glass, double coat, double roughness, double degrees) {
  return std::to_string(glass) + " under " + std::to_string(coat) + ", roughness " +
         std::to_string(roughness) + " at " + std::to_string(degrees);
}

template <class Facets>
void check_round(const std::string& name, Lobe lobe, double least, double most, bool falls) {
  constexpr double kBound = 1e-3;
  Range range;
  for (int k = 1; k <= settings(500, falls); ++k) {
    const double glass = index(k, falls), ior = between(1.005, 3, place(k, 0.5497));
    const double roughness = least + (most - least) * std::pow(place(k, 0.6710), 1.5);
    const double alpha = roughness * roughness, degrees = angle(k, glass);
    const Material base = dielectric(glass, roughness, 1, 1, 0, lobe);
    const Material m = k % 3 ? coat(mirror(1), base, 0, 0, ior) : fresnel_mix(base, mirror(1), ior);
    if (smooth_everywhere(m)) continue;  // it hardly bends
    const double a = coated_albedo(m, Facets{alpha, alpha}, glass, ior, direction(degrees, 0.4));
    const std::string at = text(glass, ior, roughness, degrees);
    range.add(a, at);
    CHECK_MESSAGE(std::abs(a - 1) < kBound, name, " ", at, ": ", a - 1);
  }
  MESSAGE(name, " under a polished coat: albedo - 1 from ", range.text());
}

}  // namespace

TEST_CASE("white rough glass under a polished coat is lossless within 1e-3, from both sides") {
  for (const bool falls : {false, true}) {
    check_round<GgxFacets>("dielectric", Lobe::Dielectric, 0.1, 1, falls);
    check_round<BeckmannFacets>("beckmann_dielectric", Lobe::BeckmannDielectric, 0.1, 1, falls);
  }
}

TEST_CASE("nearly smooth glass under a polished coat is lossless within 1e-3") {
  for (const bool falls : {false, true}) {
    check_round<GgxFacets>("dielectric", Lobe::Dielectric, 0.02, 0.1, falls);
    check_round<BeckmannFacets>("beckmann_dielectric", Lobe::BeckmannDielectric, 0.02, 0.1, falls);
  }
}

TEST_CASE("smooth glass under a polished coat is lossless, from both sides") {
  struct Row {
    std::string name;
    Material (*make)(double ior);
  };
  const Row rows[] = {
      {"dielectric", [](double n) { return dielectric(n); }},
      {"beckmann_dielectric", [](double n) { return beckmann_dielectric(n); }},
      {"film_dielectric", [](double n) { return film_dielectric(n, 1.38, 3e-7, 5e-7); }},
      {"phong_glass", [](double n) { return phong_glass(n, 1e12); }},
      {"refraction", [](double n) { return refraction(n); }}};
  for (const Row& row : rows)
    for (int k = 1; k <= 400; ++k) {
      // What a coat of an index below 1.02 reflects is so rare there that it may not be met.
      const bool falls = k > 300;
      const double glass = index(k, falls),
                   ior = between(falls ? 1.02 : 1.005, 3, place(k, 0.5497)),
                   degrees = angle(k, glass);
      const double a =
          deltas(fresnel_mix(row.make(glass), mirror(1), ior), direction(degrees, 0.4));
      CHECK_MESSAGE(std::abs(a - 1) < 1e-5, row.name, " ", text(glass, ior, 0, degrees), ": ", a);
    }
}

template <class Facets>
void check_stretched(const std::string& name, Lobe lobe, bool falls) {
  for (const double anisotropy : {0.3, -0.5, 0.9, -0.9, 1.0}) {
    Range range;
    for (int k = 1; k <= settings(24, falls); ++k) {
      const double glass = index(k, falls), ior = between(1.005, 3, place(k, 0.5497)),
                   degrees = angle(k, glass);
      const double roughness = 0.15 + 0.85 * place(k, 0.6710);
      const auto alpha = materials::Alpha<double>::from(roughness, anisotropy);
      Material base = dielectric(glass, roughness, 1, 1, anisotropy);
      base.tree.nodes.back().lobe = int(lobe);
      const double a = coated_albedo(coat(mirror(1), base, 0, 0, ior), Facets{alpha.ax, alpha.ay},
                                     glass, ior, direction(degrees, 1.5 * place(k, 0.3019)));
      range.add(a, text(glass, ior, roughness, degrees));
    }
    CHECK(range.most < 1 + 1e-3);
    CHECK(range.least > 1 - 1e-3);
    MESSAGE(name, " of anisotropy ", anisotropy, ": albedo - 1 from ", range.text());
  }
}

TEST_CASE("stretched glass under a polished coat is lossless within 1e-3, from both sides") {
  for (const bool falls : {false, true}) {
    check_stretched<GgxFacets>("dielectric", Lobe::Dielectric, falls);
    check_stretched<BeckmannFacets>("beckmann_dielectric", Lobe::BeckmannDielectric, falls);
  }
}

// By the quadrature that tables are made with: of many more settings than albedos can be had of.
template <template <class> class Distribution>
void check_sent_back(const std::string& name, double anisotropy, double bound) {
  stats::Random random(7);
  Range range;
  for (int k = 0; k < swept(2000); ++k) {
    const double n = between(1.02, 4, random.next()), eta = k % 2 ? n : 1 / n;
    const bool inside = k % 4 < 2;
    const double ior = between(1.02, 3, random.next()), roughness = random.between(0.15, 1);
    const double critical = std::sqrt(1 - 1 / (n * n));
    const double z = k % 3 ? random.between(0.001, 1)
                           : std::clamp(critical + random.between(-0.05, 0.1), 0.001, 1.0);
    const double s = std::sqrt(1 - z * z), azimuth = kPi<double> / 2 * random.next();
    const Vec3d w{s * std::cos(azimuth), s * std::sin(azimuth), z};
    const auto alpha = materials::Alpha<double>::from(roughness, anisotropy);
    const Distribution<double> facets{{alpha.ax, alpha.ay}};
    materials::CoatOnGlass<double>::Points reflected, through;
    constexpr int kPoints = materials::kGlassPoints;
    for (int i = 0; i < kPoints; ++i) {
      const auto e = materials::fresnel_split(materials::chebyshev_points<kPoints>()[i], ior);
      reflected[i] = e.reflected, through[i] = e.transmitted;
    }
    const materials::CoatOnGlass<double> coat(reflected, through, 1 - textbook_fresnel(1, ior));
    const auto further = materials::tables::further_moments<kPoints>(facets, eta, inside);
    const auto weights = materials::tables::glass_weights<kPoints>(facets, eta, inside, w, further);
    double sent = 0;
    for (int i = 0; i < kPoints; ++i) sent += weights[i] * coat.sent[inside][i];
    const materials::GlassWeights<double> held(materials::glass_tables(facets), alpha.ax, alpha.ay,
                                               {w.x, w.y, inside ? -z : z}, eta);
    const double off = (held.sent_back(coat) - sent) * (inside ? 1 : 1 - textbook_fresnel(z, ior));
    const std::string at =
        text(inside ? 1 / eta : eta, ior, roughness, std::acos(z) * 180 / kPi<double>);
    range.add(1 + off, at);
    CHECK_MESSAGE(std::abs(off) < bound, name, " ", anisotropy, " ", inside, " ", at, " ", azimuth,
                  ": ", off);
  }
  MESSAGE(name, ", anisotropy ", anisotropy, ": what is sent back is off from ", range.text());
}

TEST_CASE("what coats send back of stretched glass is in its tables, whatever it is") {
  for (const double anisotropy : {0.4, 0.9, 1.0}) {
    check_sent_back<Ggx>("dielectric", anisotropy, 1e-3);
    check_sent_back<Beckmann>("beckmann_dielectric", anisotropy, anisotropy < 1 ? 1e-3 : 2e-3);
  }
}

namespace {

/// A film of that index and thickness in metres, at 500 nm.
struct Film {
  double ior = 1, thickness = 0;
};

/// A coat that is white and lossless, and what it lets through.
struct Coat {
  Material top;
  double ior;
  Film film;
  materials::CoatShape<double> shape;

  Coat(Material m, double index, double alpha, Film on = {})
      : top(std::move(m)),
        ior(index),
        film(on),
        shape(alpha > 0 ? materials::Broadness<double>::facets(alpha)
                        : materials::Broadness<double>(),
              materials::FaceMeans<double>()(face())) {}

  /// The `k`th, of any kind; polished where that is asked for.
  static Coat any(int k, bool polished, double steps) {
    const double ior = between(1.005, 3, place(k, steps)), roughness = 0.1 + 0.9 * place(k, 0.3371);
    const double alpha = roughness * roughness, gloss = 0.5 * (1 / (alpha * alpha) - 1);
    if (polished) return {mirror(1), ior, 0};
    if (k % 3 == 0) return {glossy(1, gloss), ior, alpha};
    return {k % 3 == 1 ? microfacet(1, roughness) : beckmann(1, roughness), ior, alpha};
  }
  materials::Face<double> face() const { return {ior, {film.ior, film.thickness, 5e-7}}; }
  double through(double z) const { return shape.split(std::abs(z), face()).transmitted; }
  Material over(const Material& base) const {
    return film.thickness > 0 ? film_mix(base, top, ior, film.ior, film.thickness, 5e-7)
                              : coat(top, base, 0, 0, ior);
  }
};

/// What comes back of light along `wo` from `m`, which is glass below coats that let `through(z)`
/// pass.
template <class Through>
double rough_albedo(const Material& m, double glass, double roughness, double anisotropy, Vec3d wo,
                    const Through& through, const Reflectance& reflectance = textbook_fresnel) {
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  const Bsdf<double> bsdf(layout, p.data());
  const bool outside = wo.z > 0;
  double sum = deltas(m, wo);
  if (roughness == 0) return sum + hemisphere(bsdf, wo, outside, wo.z * wo.z, 5);
  const auto alpha = materials::Alpha<double>::from(roughness, anisotropy);
  const GgxFacets facets{alpha.ax, alpha.ay};
  if (outside) {
    // What glass reflects at once has an edge where that is in full. Lobes of coats are about it.
    const Interface<GgxFacets> face{facets, glass, reflectance};
    const auto weight = [&](Vec3d wi) {
      return wi.z > 0 ? through(wo.z) * through(wi.z) / through(1) : 0.0;
    };
    const auto choice = bsdf.choose(wo);
    const auto rest = [&](Vec3d wi) {
      return bsdf.evaluate(wo, wi, Mode::Importance, choice).f[0] - face.value(wo, wi) * weight(wi);
    };
    sum += face.once(wo, 150, weight) + over_hemisphere(rest, wo, true, wo.z * wo.z, 5);
  }
  const auto weight = [&](Vec3d wi) {
    return wi.z > 0 ? 1 : through(outside ? wo.z : wi.z);  // of inside to inside
  };
  return sum + glass_albedo(m, facets, glass, wo, weight, /*far=*/outside, reflectance);
}

void check_under_rough(bool falls) {
  for (const double anisotropy : {0.0, 0.5, -0.9}) {
    Range range;
    for (int k = 1; k <= settings(anisotropy == 0 ? 120 : 30, falls); ++k) {
      const double glass = index(k, falls), degrees = angle(k, glass);
      const bool smooth = anisotropy == 0 && k % 4 == 0;
      const double roughness = smooth ? 0 : 0.15 + 0.85 * place(k, 0.6710);
      const Coat coat = Coat::any(k, false, 0.5497);
      const Material m = coat.over(dielectric(glass, roughness, 1, 1, anisotropy));
      const double a = rough_albedo(m, glass, roughness, anisotropy, direction(degrees, 0.4),
                                    [&](double z) { return coat.through(z); });
      range.add(a, text(glass, coat.ior, roughness, degrees));
    }
    CHECK(range.most < 1 + 1e-3);
    CHECK(range.least > 1 - 1e-3);
    MESSAGE("anisotropy ", anisotropy, ": albedo - 1 from ", range.text());
  }
}

}  // namespace

TEST_CASE("white glass under rough coats is lossless within 1e-3, from both sides") {
  for (const bool falls : {false, true}) check_under_rough(falls);
}

namespace {

void check_under_films(bool filmed, bool falls) {
  for (const double anisotropy : {0.0, 0.5, -0.9}) {
    Range range;
    for (int k = 1; k <= settings(anisotropy == 0 ? 120 : 30, falls); ++k) {
      const double glass = index(k, falls), degrees = angle(k, glass);
      const double roughness = 0.15 + 0.85 * place(k, 0.6710);
      const double rough = k % 3 ? 0 : 0.15 + 0.85 * place(k, 0.3371);
      const Film film{1 + 1.5 * place(k, 0.4503), between(1e-8, 6e-7, place(k, 0.7549))};
      const double ior = filmed  ? between(1.02, 2.5, place(k, 0.5497))
                         : k % 2 ? between(1.005, 1.03, place(k, 0.5497))
                                 : between(3, 8, place(k, 0.5497));
      const Coat coat(rough > 0 ? microfacet(1, rough) : mirror(1), ior, rough * rough,
                      filmed ? film : Film());
      const Material m = coat.over(dielectric(glass, roughness, 1, 1, anisotropy));
      const double a = rough_albedo(m, glass, roughness, anisotropy, direction(degrees, 0.4),
                                    [&](double z) { return coat.through(z); });
      const std::string on = filmed ? ", film " + std::to_string(film.ior) + ", " +
                                          std::to_string(film.thickness * 1e9) + " nm"
                                    : "";
      range.add(a, text(glass, ior, roughness, degrees) + on);
    }
    CHECK(range.most < 1 + 1e-3);
    CHECK(range.least > 1 - 1e-3);
    MESSAGE((filmed ? "films" : "coats"), ", anisotropy ", anisotropy, ": albedo - 1 from ",
            range.text());
  }
}

}  // namespace

TEST_CASE("white rough glass under films, and coats of any index, is lossless within 1e-3") {
  for (const bool filmed : {true, false})
    for (const bool falls : {false, true}) check_under_films(filmed, falls);
}

namespace {

void check_filmed(double anisotropy, bool falls) {
  Range range;
  for (int k = 1; k <= settings(anisotropy == 0 ? 120 : 30, falls); ++k) {
    const double n = between(1.1, 2.5, place(k, 0.8192)), glass = falls ? 1 / n : n;
    const double degrees = angle(k, glass), roughness = 0.15 + 0.85 * place(k, 0.6710);
    const double index = 1.2 + 1.2 * place(k, 0.4503), thickness = 6e-7 * place(k, 0.7549);
    const Coat coat = Coat::any(k, k % 3, 0.5497);
    const Material base =
        film_dielectric(glass, index, thickness, 550e-9, roughness, 1, 1, anisotropy);
    const Vec3d wo = direction(degrees, 0.4);
    const double a = rough_albedo(
        coat.over(base), glass, roughness, anisotropy, wo,
        [&](double z) { return coat.through(z); },
        [&](double c, double) {
          const materials::Film<double> film(index, thickness, 550e-9);
          return film.split(c, wo.z > 0 ? 1 : glass, wo.z > 0 ? glass : 1.0).reflected;
        });
    range.add(a, text(glass, coat.ior, roughness, degrees) + ", film " + std::to_string(index) +
                     ", " + std::to_string(thickness * 1e9) + " nm");
  }
  CHECK(range.most < 1 + 1e-3);
  CHECK(range.least > 1 - 1e-3);
  MESSAGE("anisotropy ", anisotropy, ": albedo - 1 from ", range.text());
}

}  // namespace

TEST_CASE("white rough glass of which a film is part is lossless under coats within 1e-3") {
  for (const bool falls : {false, true})
    for (const double anisotropy : {0.0, 0.5, -0.9}) check_filmed(anisotropy, falls);
}

namespace {

void check_under_two(bool falls) {
  Range range;
  for (int k = 1; k <= settings(120, falls); ++k) {
    const double glass = index(k, falls), degrees = angle(k, glass);
    const double roughness = k % 5 == 0 ? 0 : 0.15 + 0.85 * place(k, 0.6710);
    const Coat upper = Coat::any(k, k % 4 < 2, 0.5497),
               lower = Coat::any(k + 1, k % 4 % 3 == 0, 0.3117);
    // The lower one meets what the upper has refracted (materials/coat.h).
    Coat below = lower;
    below.shape = lower.shape.below(std::sqrt(1 - 1 / (upper.ior * upper.ior)), lower.ior);
    const Material m = upper.over(lower.over(dielectric(glass, roughness)));
    const double a = rough_albedo(m, glass, roughness, 0, direction(degrees, 0.4),
                                  [&](double z) { return upper.through(z) * below.through(z); });
    const std::string at =
        text(glass, lower.ior, roughness, degrees) + ", upper " + std::to_string(upper.ior);
    range.add(a, at);
  }
  CHECK(range.most < 1 + 1e-3);
  CHECK(range.least > 1 - 1e-3);
  MESSAGE("albedo - 1 from ", range.text());
}

}  // namespace

TEST_CASE("white glass under two coats is lossless within 1e-3, from both sides") {
  for (const bool falls : {false, true}) check_under_two(falls);
}

TEST_CASE("smooth glass and lobes that pass under a film are lossless, from both sides") {
  struct Row {
    std::string name;
    Material (*make)(double ior, double x);
  };
  const Row rows[] = {
      {"dielectric", [](double n, double) { return dielectric(n); }},
      {"film_dielectric", [](double n, double) { return film_dielectric(n, 1.38, 3e-7, 5e-7); }},
      {"phong_glass", [](double n, double) { return phong_glass(n, 1e12); }},
      {"refraction", [](double n, double) { return refraction(n); }},
      {"glossy_refraction", [](double n, double x) {
         return glossy_refraction(n, {std::expm1(5 * x), 3 * x});
       }}};
  for (const Row& row : rows) {
    Range smooth, glossy;
    for (int k = 1; k <= swept(120); ++k) {
      const double glass = index(k), degrees = angle(k, glass),
                   ior = between(1.02, 2.5, place(k, 0.5497)), film = 1 + 1.5 * place(k, 0.4503),
                   thickness = between(1e-8, 6e-7, place(k, 0.7549)), x = place(k, 0.6710);
      const Material top = k % 5 ? mirror(1) : microfacet(1, 0.15 + 0.85 * place(k, 0.3117));
      const Material m = film_mix(row.make(glass, x), top, ior, film, thickness, 5e-7);
      const Vec3d wo = direction(degrees, 0.4);
      const std::string at = text(glass, ior, x, degrees) + ", film " + std::to_string(film) +
                             ", " + std::to_string(thickness * 1e9) + " nm";
      if (smooth_everywhere(m))
        smooth.add(deltas(m, wo), at);
      else
        glossy.add(two_sided(m, wo, 1e-5), at);
    }
    CHECK_MESSAGE(std::max(smooth.most - 1, 1 - smooth.least) < 1e-5, row.name);
    CHECK_MESSAGE(std::max(glossy.most - 1, 1 - glossy.least) < 1e-4, row.name);
    MESSAGE(row.name, ": albedo - 1 from ", smooth.text(), ", glossy from ", glossy.text());
  }
}

TEST_CASE("what a nearly polished coat sends back into glass is nearly what a polished one does") {
  for (const double degrees : {130.0, 150.0, 180.0}) {
    const Vec3d wo = direction(degrees, 0.4);
    const auto mirrored = [&](const Material& top) {
      return deltas(coat(top, dielectric(1.5, 0.5), 0, 0, 1.5), wo);
    };
    const double polished = mirrored(mirror(1));
    CHECK(mirrored(microfacet(1, 0.02)) == doctest::Approx(polished).epsilon(0.03));
    // The rougher it is, the more of it is spread.
    double before = polished;
    for (const double roughness : {0.02, 0.1, 0.3, 0.8}) {
      const double share = mirrored(microfacet(1, roughness));
      CHECK(share < before);
      CHECK(share > 0);
      before = share;
    }
  }
}

namespace {

void check_glossy(bool falls) {
  Range range;
  for (int k = 1; k <= settings(120, falls); ++k) {
    const double bend = between(1.001, 3.9, place(k, 0.8192)), glass = falls ? 1 / bend : bend;
    const double degrees = angle(k, glass);
    const double n = std::expm1(5 * place(k, 0.6710)), n_phi = std::expm1(3 * place(k, 0.3247));
    const bool straight = k % 5 == 0;
    const Material base = straight ? tinted(Lobe::GlossyThrough, 1, {n, n_phi})
                                   : glossy_refraction(glass, {n, n_phi});
    const Coat upper = Coat::any(k, k % 3 == 0, 0.5497), lower = Coat::any(k + 1, k % 2, 0.3117);
    const Material m = upper.over(k % 4 < 2 ? base : lower.over(base));
    const double a = two_sided(m, direction(degrees, 0.4), 1e-5);
    const std::string at = (straight ? "straight on" : "index " + std::to_string(glass)) + ", n " +
                           std::to_string(n) + " under " + std::to_string(upper.ior) + " at " +
                           std::to_string(degrees);
    range.add(a, at);
    CHECK_MESSAGE(std::abs(a - 1) < 1e-4, at, ": ", a - 1);
  }
  MESSAGE("albedo - 1 from ", range.text());
}

}  // namespace

TEST_CASE("glossy lobes that pass below coats are lossless within 1e-4, from both sides") {
  for (const bool falls : {false, true}) check_glossy(falls);
}

namespace {

void check_phong(bool falls) {
  double worst = 0;
  for (int k = 1; k <= settings(60, falls); ++k) {
    const double glass = index(k, falls), degrees = angle(k, glass);
    const double n = between(2, 1000, place(k, 0.6710));
    const Material base = phong_glass(glass, n);
    const Coat upper = Coat::any(k, k % 3 == 0, 0.5497), lower = Coat::any(k + 1, k % 2, 0.3117);
    // The lower one meets what the upper has refracted (materials/coat.h).
    Coat below = lower;
    below.shape = lower.shape.below(std::sqrt(1 - 1 / (upper.ior * upper.ior)), lower.ior);
    const bool nested = k % 4 < 2;
    const Vec3d wo = direction(degrees, 0.4);
    const double bare = two_sided(base, wo, 1e-4);
    const double through = wo.z < 0 ? 1 : upper.through(wo.z) * (nested ? below.through(wo.z) : 1);
    const double a = two_sided(upper.over(nested ? lower.over(base) : base), wo, 1e-4);
    const double error = a - (1 - through + through * bare);
    worst = std::max(worst, std::abs(error));
    CHECK_MESSAGE(std::abs(error) < 1e-3, text(glass, upper.ior, n, degrees),
                  std::string(nested ? ", two coats: " : ": "), error);
  }
  MESSAGE("largest error of albedos: ", worst);
}

}  // namespace

TEST_CASE("phong_glass below coats loses what it does alone, from both sides") {
  for (const bool falls : {false, true}) check_phong(falls);
}

TEST_CASE("a mixture of glass and matte under a rough coat is lossless") {
  for (const double share : {0.2, 0.7})
    for (double degrees : {0.0, 50.0, 85.0, 100.0, 130.0, 175.0}) {
      const Material m = coat(microfacet(1, 0.4), mix(matte(1), dielectric(1.7), share), 0, 0, 1.4);
      const double a = albedo(m, degrees) + deltas(m, direction(degrees, 0));
      CHECK_MESSAGE(std::abs(a - 1) < 2e-4, share, " at ", degrees, ": ", a - 1);
    }
}

TEST_CASE("a mixture of glass and matte under a polished coat is lossless") {
  for (const double share : {0.2, 0.7})
    for (double degrees : {0.0, 50.0, 85.0, 100.0, 130.0, 175.0}) {
      const Material m = coat(mirror(1), mix(matte(1), dielectric(1.7), share), 0, 0, 1.4);
      const double a = albedo(m, degrees) + deltas(m, direction(degrees, 0));
      CHECK_MESSAGE(std::abs(a - 1) < 1e-4, share, " at ", degrees, ": ", a - 1);
    }
}

TEST_CASE("glass under a coat of a very high index is lossless, and no lobe is less than black") {
  // T is far above T(1) there, next to Brewster's angle.
  for (const double ior : {3.9, 5.0, 30.0, 1000.0})
    for (double degrees : {0.0, 60.0, 80.0, 88.0, 89.9, 100.0, 150.0}) {
      const Material m = fresnel_mix(dielectric(1.5), mirror(1), ior);
      const Vec3d wo = direction(degrees, 0.4);
      CHECK(deltas(m, wo) == doctest::Approx(1).epsilon(1e-5));
      for (const Material& coated : {m, fresnel_mix(dielectric(1.5), microfacet(1, 0.5), ior)}) {
        const materials::Layout layout = coated.layout();
        const auto p = coated.params<double>();
        const auto choice = Bsdf<double>(layout, p.data()).choose(wo);
        for (std::size_t i = 0; i < layout.nodes().size(); ++i)
          CHECK(choice.probability.of[i][0] >= 0);
      }
    }
}

TEST_CASE("light that changes sides passes the layer of a coat once") {
  const double depth = 0.7, ior = 1.4, glass = 1.7;
  const Material clear = coat(mirror(1), dielectric(glass), 0, 1, ior);
  const Material dim = coat(mirror(1), dielectric(glass), depth, 1, ior);
  for (double degrees : {0.0, 40.0, 80.0}) {
    const Vec3d out = direction(degrees, 0.3);
    const double s = std::sin(degrees * kPi<double> / 180),
                 inside = std::sqrt(1 - s * s / ior / ior);
    const Vec3d in = {out.x / glass, out.y / glass, -std::sqrt(1 - s * s / glass / glass)};
    for (const Vec3d& wo : {out, in})
      CHECK(deltas(dim, wo, false) ==
            doctest::Approx(deltas(clear, wo, false) * std::exp(-depth / inside)));
  }
}
