// SPDX-License-Identifier: Apache-2.0
// What white rough glass scatters in all, from both sides and up to grazing.
#include <doctest/doctest.h>

#include <cmath>

#include "materials/coated.h"
#include "materials/film_coat.h"
#include "materials/tables/losses.h"
#include "materials/thin_film.h"
#include "tests/stats/random.h"
#include "tests/unit/materials/albedo.h"
#include "tests/unit/materials/cases.h"
#include "tests/unit/materials/walter.h"

using namespace mms;
using namespace mms::test;
using materials::Beckmann, materials::Bsdf, materials::Ggx;

namespace {

/// Whether a ShapeBasis has room for polynomials of that order.
constexpr bool fits(materials::ShapeOrder order) {
  using Basis = materials::ShapeBasis<double>;
  return order.around <= Basis::kMostAround && order.outwards() <= Basis::kMostOutwards &&
         Basis::terms(order) <= Basis::kMost;
}
constexpr bool fit(const auto& grids) { return fits(grids[0].shapes) && fits(grids[1].shapes); }
static_assert(fit(materials::kGgxBent) && fit(materials::kBeckmannBent));
static_assert(fit(materials::axes::kFilmBent) && fit(materials::axes::kBentFilmGlass));
static_assert(fit(materials::axes::kBentGlass) && fits(materials::axes::kStretchedCoatShapes) &&
              fits(materials::axes::kStretchedShapes));

/// All that comes back of light along `wo` from either side of `m`.
double albedo(const Material& m, const auto& facets, double ior, Vec3d wo) {
  return glass_albedo(m, facets, ior, wo, [](Vec3d) { return 1.0; });
}

bool smooth_everywhere(const Material& m) {
  const materials::Layout layout = m.layout();
  return Bsdf<double>(layout, m.params<double>().data()).specular_only();
}

/// The largest |albedo - 1| that is met, and where.
struct Worst {
  double error = 0;
  int cases = 0;
  std::string where;

  void meet(double a, double ior, double roughness, double angle) {
    ++cases;
    if (!(std::abs(a - 1) > error)) return;
    error = std::abs(a - 1);
    where = std::to_string(ior) + ", " + std::to_string(roughness) + " at " + std::to_string(angle);
  }
};

/// A white glass of that lobe and its facets.
template <class FacetsOf>
struct Glass {
  using Facets = FacetsOf;
  std::string name;
  Lobe lobe;
};

void check_round(const auto& glass) {
  Worst worst;
  for (double index : {1.001, 1.01, 1.02, 1.05, 1.1, 1.33, 1.5, 2.0, 2.5, 4.0})
    for (double ior : {index, 1 / index})
      for (double roughness : {0.05, 0.11, 0.16, 0.225, 0.4, 0.6, 0.85, 1.0}) {
        const Material m = dielectric(ior, roughness, 1, 1, 0, glass.lobe);
        if (smooth_everywhere(m)) continue;
        const double alpha = roughness * roughness;
        const typename std::decay_t<decltype(glass)>::Facets facets{alpha, alpha};
        // The ridge of what is lost, a little to its left and right; from the denser side.
        const double critical = std::asin(1 / index) * 180 / kPi<double>;
        for (double degrees : {0.0, 30.0, 60.0, 75.0, 85.0, 89.0, 89.99, critical, critical - 3})
          for (const double angle : {degrees, 180 - degrees}) {
            const double a = albedo(m, facets, ior, direction(angle, 0.4));
            worst.meet(a, ior, roughness, angle);
            CHECK_MESSAGE(std::abs(a - 1) < 1e-3, glass.name, " ", ior, " ", roughness, " at ",
                          angle, ": ", a - 1);
          }
      }
  MESSAGE(glass.name, ": largest |albedo - 1| of ", worst.cases, ": ", worst.error, ", at index ",
          worst.where);
}

void check_stretched(const auto& glass) {
  for (const double anisotropy : {0.3, -0.6, 0.9}) {
    Worst worst[2];
    for (double index : {1.006, 1.01, 1.1, 1.5, 4.0})
      for (double ior : {index, 1 / index})
        for (double roughness : {0.16, 0.4, 0.7, 1.0}) {
          const auto alpha = materials::Alpha<double>::from(roughness, anisotropy);
          const typename std::decay_t<decltype(glass)>::Facets facets{alpha.ax, alpha.ay};
          const Material m = dielectric(ior, roughness, 1, 1, anisotropy, glass.lobe);
          if (smooth_everywhere(m)) continue;
          for (double degrees : {0.0, 40.0, 70.0, 85.0, 89.99})
            for (double azimuth : {0.2, 0.8, 1.4}) {
              const double a = albedo(m, facets, ior, direction(degrees, azimuth));
              worst[ior < 1].meet(a, ior, roughness, degrees);
              CHECK_MESSAGE(std::abs(a - 1) < 1e-3, glass.name, " ", anisotropy, " ", ior, " ",
                            roughness, " at ", degrees, " ", azimuth, ": ", a - 1);
            }
        }
    for (const Worst& w : worst)
      MESSAGE(glass.name, ", anisotropy ", anisotropy, ": largest |albedo - 1| of ", w.cases, ": ",
              w.error, ", at index ", w.where);
  }
}

/// Cases that no node of a table is near: roughness from `least` to `most`, any index to 4.
void check_between(const auto& glass, double least, double most, double anisotropy, double bound) {
  Worst worst;
  const auto place = [](int k, double step) { return std::fmod(k * step, 1.0); };
  constexpr double kDegrees[] = {0, 30, 60, 75, 85, 89, 89.9, 89.99};
  for (int k = 1; k <= swept(300); ++k) {
    const double index = std::pow(4, place(k, 0.8192)), ior = k % 3 ? 1 / index : index;
    const double roughness = least * std::pow(most / least, place(k, 0.6710));
    const auto alpha = materials::Alpha<double>::from(roughness, anisotropy);
    const typename std::decay_t<decltype(glass)>::Facets facets{alpha.ax, alpha.ay};
    const Material m = dielectric(ior, roughness, 1, 1, anisotropy, glass.lobe);
    if (smooth_everywhere(m)) continue;
    const double degrees = kDegrees[k / 3 % 8], azimuth = kPi<double> / 2 * place(k, 0.3019);
    const double a = albedo(m, facets, ior, direction(degrees, azimuth));
    worst.meet(a, ior, roughness, degrees);
    CHECK_MESSAGE(std::abs(a - 1) < bound, glass.name, " ", anisotropy, " ", ior, " ", roughness,
                  " at ", degrees, " ", azimuth, ": ", a - 1);
  }
  MESSAGE(glass.name, ", anisotropy ", anisotropy, ": largest |albedo - 1| of ", worst.cases, ": ",
          worst.error, ", at index ", worst.where);
}

/// By the quadrature that tables are made with, which sums over facets hold (bounces_test.cpp): of
/// many more settings than albedos can be had of, to the least bend that is not a mirror's.
template <template <class> class Distribution>
void check_losses(const std::string& name) {
  for (const double anisotropy : {0.4, 0.9, 1.0}) {
    Worst worst;
    stats::Random random(5);
    for (int k = 0; k < swept(4000); ++k) {
      const double roughness = 0.02 * std::pow(50, random.next());
      const auto alpha = materials::Alpha<double>::from(roughness, anisotropy);
      const double least = 1 + materials::kMinAlpha / std::min(alpha.ax, alpha.ay);
      const double index = least * std::pow(4 / least, random.next());
      const double ior = k % 4 ? 1 / index : index, azimuth = kPi<double> / 2 * random.next();
      const double degrees = k % 3 ? std::acos(random.next()) * 180 / kPi<double>
                                   : 90 - std::pow(10, -2 + 3 * random.next());
      const Vec3d w = direction(degrees, azimuth);
      const Distribution<double> facets{{alpha.ax, alpha.ay}};
      const double held =
          materials::InterfaceLoss<double>{facets.interface(), alpha.ax, alpha.ay, ior}.at(w);
      const double off = held - materials::tables::interface_loss(facets, ior, w, 24);
      worst.meet(1 + off, ior, roughness, degrees);
      CHECK_MESSAGE(std::abs(off) < 1e-3, name, " ", anisotropy, " ", ior, " ", roughness, " at ",
                    degrees, " ", azimuth, ": ", off);
    }
    MESSAGE(name, ", anisotropy ", anisotropy, ": losses of ", worst.cases, " within ", worst.error,
            ", at index ", worst.where);
  }
}

/// What a facet of rough glass reflects of light at the cosine `c` under a film: of more than one
/// and a half fringes, or two waves, some part is the mean over films of all thicknesses, here over
/// a turn of the phase.
double filmed_reflectance(const materials::Film<double>& film, double c, double near, double far) {
  const double sharp = film.split(c, near, far).reflected;
  const materials::Film<double> seen = film.in(std::min(near, far));
  const double more = std::max(seen.fringes - 1.5, seen.waves() - 2);
  if (more <= 0) return sharp;
  constexpr int kPhases = 32;
  double mean = 0;
  for (int k = 0; k < kPhases; ++k) {
    materials::Film<double> thicker = film;
    const double normal = std::sqrt(film.ior * film.ior - near * near * (1 - c * c));
    thicker.phases += kPi<double> / normal * k / kPhases;
    mean += thicker.split(c, near, far).reflected / kPhases;
  }
  return mean + std::exp(-more * more) * (sharp - mean);
}

const Glass<GgxFacets> kGgx{"dielectric", Lobe::Dielectric};
const Glass<BeckmannFacets> kBeckmann{"beckmann_dielectric", Lobe::BeckmannDielectric};

}  // namespace

TEST_CASE("white rough glass is lossless within 1e-3, from both sides and up to 89.99 degrees") {
  check_round(kGgx);
  check_round(kBeckmann);
}

TEST_CASE("white rough glass of stretched facets is too, up to anisotropy 0.9") {
  check_stretched(kGgx);
  check_stretched(kBeckmann);
}

TEST_CASE(
    "white glass is lossless within 1e-3 between the nodes of its tables, nearly smooth too") {
  check_between(kGgx, 0.02, 0.1, 0, 1e-3);
  check_between(kBeckmann, 0.02, 0.1, 0, 1e-3);
  check_between(kGgx, 0.1, 1, 0, 1e-3);
  check_between(kBeckmann, 0.1, 1, 0, 1e-3);
}

TEST_CASE("so is that of stretched facets, to anisotropy 1") {
  for (const double anisotropy : {0.6, -0.9, 1.0}) {
    check_between(kGgx, 0.1, 1, anisotropy, 1e-3);
    check_between(kBeckmann, 0.1, 1, anisotropy, 1e-3);
  }
  check_between(kGgx, 0.02, 0.1, -0.8, 1e-3);
  check_between(kBeckmann, 0.02, 0.1, -0.8, 1e-3);
}

TEST_CASE("what stretched facets lose is in their tables within 1e-3, whatever they are") {
  check_losses<Ggx>("dielectric");
  check_losses<Beckmann>("beckmann_dielectric");
}

TEST_CASE("rough glass under a film keeps its energy, from both sides") {
  constexpr double kDegrees[] = {0, 30, 60, 75, 85, 89, 89.9};
  struct Row {
    double anisotropy, most, bound;
  };
  for (const Row& row : {Row{0, 1500e-9, 5e-4},
                         {0, 5e-6, 1e-3},
                         {0, 50e-6, 1e-3},
                         {0.6, 1500e-9, 1e-3},
                         {-0.9, 1500e-9, 1e-3},
                         {-0.9, 5e-6, 1e-3},
                         {-0.9, 50e-6, 1e-3},
                         {1, 1500e-9, 1e-3},
                         {1, 50e-6, 1e-3}}) {
    Worst worst;
    for (int k = 1; k <= swept(300); ++k) {
      const auto place = [k](double step) { return std::fmod(k * step, 1.0); };
      const double index = 1.1 * std::pow(2.5 / 1.1, place(0.8192));
      const double ior = k % 2 ? 1 / index : index, film = 1.2 + 1.2 * place(0.4503);
      const double roughness = 0.05 + 0.95 * place(0.6710);
      const double thickness = row.most * place(0.5497);
      const auto alpha = materials::Alpha<double>::from(roughness, row.anisotropy);
      const GgxFacets facets{alpha.ax, alpha.ay};
      const Material m =
          film_dielectric(ior, film, thickness, 550e-9, roughness, 1, 1, row.anisotropy);
      const bool outside = k % 4 < 2;
      const double degrees = outside ? kDegrees[k / 4 % 7] : 180 - kDegrees[k / 4 % 7];
      const Vec3d wo = direction(degrees, kPi<double> / 2 * place(0.3019));
      const double a = glass_albedo(
          m, facets, ior, wo, [](Vec3d) { return 1.0; }, false,
          [&](double c, double) {
            return filmed_reflectance({film, thickness, 550e-9}, c, outside ? 1 : ior,
                                      outside ? ior : 1.0);
          });
      worst.meet(a, ior, roughness, degrees);
      CHECK_MESSAGE(std::abs(a - 1) < row.bound, ior, " ", roughness, " ", film, " ",
                    thickness * 1e9, " nm at ", degrees, ": ", a - 1);
    }
    MESSAGE("film of up to ", row.most * 1e9, " nm, anisotropy ", row.anisotropy,
            ": largest |albedo - 1| of ", worst.cases, ": ", worst.error, ", at index ",
            worst.where);
  }
}
