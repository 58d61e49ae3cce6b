// SPDX-License-Identifier: Apache-2.0
// Lobes as matrices, and coats that are solved for by them.
#include "materials/spread.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "materials/bsdf.h"
#include "tests/stats/random.h"
#include "tests/unit/materials/cases.h"
#include "tests/unit/materials/make.h"

using namespace mms;
using namespace mms::test;
using materials::CoatedLobe;
using materials::Mode;

namespace {

/// Some stretched facets, along any direction.
struct Stretched {
  double ax, ay;
  Vec3d w;

  explicit Stretched(stats::Random& random) {
    const double root = random.between(0.03, 1), aspect = std::pow(10, random.next());
    ax = root * std::sqrt(aspect), ay = root / std::sqrt(aspect);
    if (random.next() < 0.5) std::swap(ax, ay);
    w = direction(90 * random.next(), 2 * kPi<double> * random.next());
  }
  CoatedLobe<double> lobe(const materials::CoatedTables& tables) const {
    return CoatedLobe<double>::facets(tables, ax, ay, w);
  }
};

}  // namespace

TEST_CASE("stretched lobes spread what is alike along all directions to as much") {
  const auto matrix = std::make_unique<materials::StretchedMatrix<double>>();
  stats::Random random(1);
  for (const auto* tables : {&materials::kGgxCoated, &materials::kBeckmannCoated})
    for (int k = 0; k < 300; ++k) {
      const Stretched facets(random);
      const auto lobe = facets.lobe(*tables);
      matrix->read(lobe);
      const double all = materials::mean_along(*matrix, lobe, [](double) { return 1.0; });
      CHECK_MESSAGE(std::abs(all - 1) < 1e-4, facets.ax, " ", facets.ay, ": ", all);
    }
}

// White facets spread |cos i| to its mean over their lobe, which is summed here by what they are
// drawn with.
TEST_CASE("and cosines to what facets that are drawn see of them") {
  const auto matrix = std::make_unique<materials::StretchedMatrix<double>>();
  stats::Random random(2);
  for (int k = 0; k < 40; ++k) {
    const double roughness = random.between(0.3, 1), anisotropy = random.between(-1, 1);
    const Vec3d wo = direction(random.between(0, 85), 2 * kPi<double> * random.next());
    const Material m = microfacet(1, roughness, anisotropy);
    const materials::Layout layout = m.layout();
    const auto p = m.params<double>();
    const materials::Bsdf<double> bsdf(layout, p.data());
    const auto choice = bsdf.choose(wo);
    double sum = 0, squares = 0;
    constexpr int kDraws = 40000;
    for (int n = 0; n < kDraws; ++n) {
      const auto s =
          bsdf.sample(wo, random.next(), random.next(), random.next(), Mode::Radiance, choice);
      const double x = s ? s->f[0] / s->pdf[0] * s->wi.z * s->wi.z : 0.0;
      sum += x, squares += x * x;
    }
    const double mean = sum / kDraws,
                 deviation = std::sqrt((squares / kDraws - mean * mean) / kDraws);
    const auto alpha = materials::Alpha<double>::from(roughness, anisotropy);
    const auto lobe = CoatedLobe<double>::facets(materials::kGgxCoated, alpha.ax, alpha.ay, wo);
    matrix->read(lobe);
    const double seen = materials::mean_along(*matrix, lobe, [](double z) { return z; });
    CHECK_MESSAGE(std::abs(seen - mean) < 4 * deviation + 5e-4, roughness, " ", anisotropy, ": ",
                  seen - mean, " of deviation ", deviation);
  }
}

// Along what a mirror reflects, a narrow coat's f is its white lobe's times g^2, which is nearly E;
// next to all of E is done away with along the normal here.
TEST_CASE("narrow coats under films that do away with reflection reflect next to nothing") {
  stats::Random random(3);
  for (int k = 0; k < 400; ++k) {
    const double ior = random.between(1.02, 2.5), film = std::sqrt(ior), length = 5e-7;
    const double roughness = random.between(0.03, 0.2), anisotropy = random.between(-1, 1);
    const Vec3d wo = direction(random.between(0, 60), 2 * kPi<double> * random.next()),
                wi{-wo.x, -wo.y, wo.z};
    const bool beckmann_lobe = k % 2;
    const Material white =
        beckmann_lobe ? beckmann(1, roughness, anisotropy) : microfacet(1, roughness, anisotropy);
    const double thickness = length / (4 * film);
    const auto f = [&](const Material& m) {
      const materials::Layout layout = m.layout();
      const auto p = m.params<double>();
      return materials::Bsdf<double>(layout, p.data()).eval(wo, wi, Mode::Radiance)[0];
    };
    const double squared = f(film_mix(matte(0), white, ior, film, thickness, length)) / f(white);
    const materials::Face<double> face(ior, {film, thickness, length});
    const auto alpha = materials::Alpha<double>::from(roughness, anisotropy);
    const materials::CoatShape<double> shape(
        materials::Broadness<double>::facets(std::sqrt(alpha.ax * alpha.ay)),
        materials::FaceMeans<double>()(face));
    const double e = shape.split(wo.z, face).reflected;
    CHECK_MESSAGE(squared < 1.5 * e + 1e-3, ior, " ", roughness, " ", anisotropy, " ", wo.z, ": ",
                  squared, ", E ", e);
    CHECK_MESSAGE(squared > e / 1.5 - 1e-3, ior, " ", roughness, " ", anisotropy, " ", wo.z, ": ",
                  squared, ", E ", e);
  }
}
