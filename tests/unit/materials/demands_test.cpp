// SPDX-License-Identifier: Apache-2.0
// What thesis 6.3.2 asks of a reflection, of every model: positive everywhere, smooth everywhere,
// matte at one end and a mirror at the other; and which of it each model keeps.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "materials/film.h"
#include "tests/sanitized.h"
#include "tests/stats/random.h"
#include "tests/unit/materials/cases.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

namespace {

/// A material with its numbers laid out.
template <class R>
struct Made {
  materials::Layout layout;
  std::vector<R> params;
  explicit Made(const Material& m) : layout(m.layout()), params(m.params<R>()) {}
  Bsdf<R> bsdf() const { return {layout, params.data()}; }
  double eval(Vec3<R> wo, Vec3<R> wi) const { return bsdf().eval(wo, wi, Mode::Importance)[0]; }
};

struct Demand {
  std::string name;
  Material material;
  bool positive;  ///< everywhere on the sides it scatters to
  bool smooth;    ///< its first derivatives are continuous, but at the poles and in the surface
};

std::vector<Demand> demands() {
  return {
      {"matte", matte(1), true, true},
      {"translucent", translucent(1), true, true},
      {"glossy 0.5", glossy(1, 0.5), true, true},
      {"glossy 20", glossy(1, 20), true, true},
      {"glossy_product", tinted(Lobe::GlossyProduct, 1, {5, 9}), true, true},
      {"glossy_back", tinted(Lobe::GlossyBack, 1, {5, 9}), true, true},
      {"glossy_through", tinted(Lobe::GlossyThrough, 1, {5, 9}), true, true},
      {"glossy_refraction", glossy_refraction(1.5, {5, 9}), false, false},
      {"oren_nayar", tinted(Lobe::OrenNayar, 1, {0.5}), true, false},
      {"rough_matte", tinted(Lobe::RoughMatte, 1, {0.5}), true, false},
      {"phong", tinted(Lobe::Phong, 1, {4}), false, true},
      {"max_phong", tinted(Lobe::MaxPhong, 1, {4}), false, false},
      {"spot", tinted(Lobe::Spot, 1, {0.4, 1.2}), false, true},
      {"ward", tinted(Lobe::Ward, 1, {0.6, 0}), false, true},  // below all numbers at steep facets
      {"ashikhmin_shirley", tinted(Lobe::AshikhminShirley, 1, {5, 3}), true, false},
      {"sheen", tinted(Lobe::Sheen, 1, {0.6}), true, true},
      {"microfacet", microfacet(1, 0.6), true, true},
      {"microfacet, stretched", microfacet(1, 0.6, 0.8), true, true},
      {"beckmann", beckmann(1, 0.6), true, true},
      {"conductor", conductor(0.2, 3, 0.6), true, true},
      {"coloured_metal", coloured_metal(0.7, 0.5, 0.6), true, true},
      {"film_conductor", film_conductor(2.5, 3, 1.5, 3e-7, 5e-7, 0.6), true, true},
      {"dielectric", dielectric(1.5, 0.6), true, false},
      {"dielectric, stretched", dielectric(1.5, 0.6, 1, 1, 0.8), true, false},
      {"beckmann_dielectric", beckmann_dielectric(1.5, 0.6), true, false},
      {"phong_glass", phong_glass(1.5, 4), false, false},
      {"mix", mix(matte(0.8), glossy(1, 20), 0.4), true, true},
      {"add", add(translucent(0.4), scale(microfacet(1, 0.6), 0.5)), true, true},
      {"fresnel_mix", fresnel_mix(matte(0.8), microfacet(1, 0.6), 1.5), true, true},
      {"coat", coat(glossy(1, 20), matte(0.8), 0.5, 1, 1.5), true, true},
      {"coat over facets", coat(beckmann(1, 0.6), conductor(0.2, 3, 0.6), 0.5, 1, 1.5), true, true},
      {"layer", layer(tinted(Lobe::Sheen, 0.8, {0.6}), microfacet(1, 0.6), 0.7), true, true}};
}

}  // namespace

TEST_CASE("positive everywhere: which models are") {
  for (const Demand& d : demands()) {
    const Made<double> m(d.material);
    stats::Random random(3);
    long long zero = 0;
    const int count = kSanitized ? 2'000 : 50'000;
    for (int i = 0; i < count; ++i) {
      const Vec3d wo = square_to_sphere(random.next(), random.next());
      Vec3d wi = square_to_sphere(random.next(), random.next());
      const bool across =
          materials::same_side(wo, wi) ? !m.layout.reflects() : !m.layout.transmits();
      if (across) wi.z = -wi.z;
      zero += !(m.eval(wo, wi) > 0);
    }
    CHECK_MESSAGE((zero == 0) == d.positive, d.name, ": black in ", zero, " of ", count);
  }
}

namespace {

/// The largest change of slope over a step of `step` radians of wi, over random pairs of directions
/// away from the surface and the poles: falls with the step where slopes are continuous. In units
/// of the mean value.
double largest_kink(const Made<double>& m, double step) {
  stats::Random random(11);
  double largest = 0, sum = 0;
  const int count = 25'000;  // a kink that is not aimed at is met by a few
  int used = 0;
  while (used < count) {
    const Vec3d wo = square_to_sphere(random.next(), random.next());
    Vec3d wi = square_to_sphere(random.next(), random.next());
    // Half of the pairs at one height, where models of the larger cosine have their edge.
    if (used % 2) wi = direction(std::acos(wo.z) * 180 / kPi<double>, 7 * wi.z);
    const bool reflects = m.layout.reflects() && !m.layout.transmits();
    if (m.layout.reflects() != m.layout.transmits() && reflects != materials::same_side(wo, wi))
      wi.z = -wi.z;
    const double a = 2 * kPi<double> * random.next();
    const auto hard = [](Vec3d w) { return std::abs(w.z) < 0.2 || std::abs(w.z) > 0.98; };
    if (hard(wo) || hard(wi)) continue;
    ++used;
    const Frame<double> frame = Frame<double>::around(wi);
    const auto at = [&](double t) {
      return m.eval(
          wo, frame.to_world({std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)}));
    };
    const double here = at(0);
    sum += here;
    largest = std::max(largest, std::abs(at(step) - 2 * here + at(-step)) / step);
  }
  return largest / (sum / count);
}

}  // namespace

TEST_CASE("smooth everywhere: which models are") {
  int index = 0;
  for (const Demand& d : demands()) {
    if (kSanitized && ++index % 8 != 0) continue;
    const Made<double> m(d.material);
    // The second difference over the step: of a smooth function a tenth of the step gives a tenth;
    // of one with a kink as much, as often as it is met.
    const double wide = largest_kink(m, 1e-3), fine = largest_kink(m, 1e-4);
    const bool smooth = fine < 0.3 * wide || fine < 1e-6;
    CHECK_MESSAGE(smooth == d.smooth, d.name, ": ", wide, " and ", fine);
  }
}

TEST_CASE("gloss towards 0 is matte: which models get there") {
  struct Row {
    const char* name;
    Material material;
  };
  const Row rows[] = {{"glossy", glossy(0.7, 1e-4)},
                      {"glossy_product", tinted(Lobe::GlossyProduct, 0.7, {1e-4, 1e-4})},
                      {"glossy_back", tinted(Lobe::GlossyBack, 0.7, {1e-4, 1e-4})},
                      {"glossy_through", tinted(Lobe::GlossyThrough, 0.7, {1e-4, 1e-4})},
                      {"oren_nayar", tinted(Lobe::OrenNayar, 0.7, {1e-6})},
                      {"rough_matte", tinted(Lobe::RoughMatte, 0.7, {1e-6})}};
  for (const Row& row : rows) {
    const Made<double> m(row.material);
    stats::Random random(2);
    for (int i = 0; i < 2000; ++i) {
      const Vec3d wo = square_to_sphere(random.next(), random.next());
      Vec3d wi = square_to_sphere(random.next(), random.next());
      if (materials::same_side(wo, wi) != m.layout.reflects()) wi.z = -wi.z;
      CHECK_MESSAGE(m.eval(wo, wi) == doctest::Approx(0.7 / kPi<double>).epsilon(3e-4),
                    std::string(row.name));
    }
  }
}

namespace {

/// The deltas of a model that is nothing else, and the sum of their weights.
struct Deltas {
  std::vector<Vec3<float>> directions;
  double kept = 0;

  Deltas(const Made<float>& m, Vec3<float> wo) {
    for (float u = 0; u < 1; u += 0x1p-7f) {
      const auto s = m.bsdf().sample(wo, u, 0.5f, 0.5f, Mode::Importance);
      REQUIRE(s);
      REQUIRE(s->specular);
      if (std::find(directions.begin(), directions.end(), s->wi) != directions.end()) continue;
      directions.push_back(s->wi);
      kept += s->f[0] * std::abs(s->wi.z);
    }
  }

  double distance(Vec3<float> w) const {
    double least = 2;
    for (Vec3<float> d : directions) least = std::min(least, double(length(w - d)));
    return least;
  }
};

/// Of samples: |mean weight - that of the deltas|, and the share that lies further than `reach`
/// radians from all of them.
struct Narrow {
  double weight = 0, outside = 0;
};
Narrow narrow(const Made<float>& m, Vec3<float> wo, const Deltas& deltas, double reach) {
  Narrow n;
  stats::Random random(8);
  const int count = kSanitized ? 500 : 5'000;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const float u = random.next_float(), u1 = random.next_float();
    const auto s = m.bsdf().sample(wo, u, u1, random.next_float(), Mode::Importance);
    if (!s) {
      n.outside += 1.0 / count;
      continue;
    }
    sum += s->f[0] * std::abs(s->wi.z) / s->pdf[0];
    n.outside += double(deltas.distance(s->wi) > reach) / count;
  }
  n.weight = std::abs(sum / count - deltas.kept);
  return n;
}

}  // namespace

TEST_CASE("gloss towards infinity is the mirror, and is handed over to it without a seam") {
  struct Row {
    const char* name;
    Material below, above;                          ///< just below and above where it is deltas
    double share;                                   ///< of samples further than 0.02 rad from them
    std::function<double(double)> kept = constant;  ///< what deltas keep, of the cosine of wo

    static double constant(double) { return 0.7; }
  };
  const auto pair = [](const char* name, Lobe lobe, std::vector<double> lo, std::vector<double> hi,
                       double share) {
    return Row{name, tinted(lobe, 0.7, std::move(lo)), tinted(lobe, 0.7, std::move(hi)), share};
  };
  const auto metal = [](double c) { return materials::fresnel_conductor(c, 0.2, 3.0); };
  const auto coloured = [](double c) { return 0.7 + 0.3 * std::pow(1 - c, 5); };
  const auto coated = [](double c) {
    return materials::Film<double>(1.5, 3e-7, 5e-7)
        .split(c, 1, std::complex<double>(0.2, 3.0))
        .reflected;
  };
  const auto all = [](double) { return 1.0; };
  // GGX of alpha 1e-4 leaves alpha^2 / tan^2 of its facets beyond an angle: 1e-4 beyond 0.01; that
  // of glass, whose refraction is the narrower lobe, is handed over at alpha 2e-4.
  const Row rows[] = {
      pair("glossy", Lobe::Glossy, {4.99e4}, {5.01e4}, 1e-3),
      pair("glossy_product", Lobe::GlossyProduct, {4.99e4, 9.99e6}, {5.01e4, 1.01e7}, 1e-3),
      pair("glossy_through", Lobe::GlossyThrough, {4.99e4, 9.99e6}, {5.01e4, 1.01e7}, 1e-3),
      {"glossy_refraction", glossy_refraction(1.5, {4.99e4, 9.99e6}, 0.7),
       glossy_refraction(1.5, {5.01e4, 1.01e7}, 0.7), 1e-3},
      // The reciprocal Phong keeps the cosine, however narrow.
      {"phong", tinted(Lobe::Phong, 0.7, {0.999e7}), tinted(Lobe::Phong, 0.7, {1.001e7}), 1e-3,
       [](double c) { return 0.7 * c; }},
      pair("max_phong", Lobe::MaxPhong, {0.999e7}, {1.001e7}, 1e-3),
      pair("microfacet", Lobe::Microfacet, {0.01001, 0}, {0.00999, 0}, 2e-3),
      pair("beckmann", Lobe::Beckmann, {0.01001, 0}, {0.00999, 0}, 2e-3),
      pair("ward", Lobe::Ward, {0.01001, 0}, {0.00999, 0}, 2e-3),
      {"conductor", conductor(0.2, 3, 0.01001), conductor(0.2, 3, 0.00999), 2e-3, metal},
      {"coloured_metal", coloured_metal(0.7, 1, 0.01001), coloured_metal(0.7, 1, 0.00999), 2e-3,
       coloured},
      {"film_conductor", film_conductor(0.2, 3, 1.5, 3e-7, 5e-7, 0.01001),
       film_conductor(0.2, 3, 1.5, 3e-7, 5e-7, 0.00999), 2e-3, coated},
      {"dielectric", dielectric(1.5, 0.01415), dielectric(1.5, 0.01414), 2e-3, all},
      {"beckmann_dielectric", beckmann_dielectric(1.5, 0.01415), beckmann_dielectric(1.5, 0.01414),
       2e-3, all}};
  for (const Row& row : rows) {
    const Made<float> below(row.below), above(row.above);
    CHECK(!below.bsdf().specular_only());
    CHECK(above.bsdf().specular_only());
    for (double degrees : {0.5, 20.0, 45.0, 70.0, 85.0, 100.0, 150.0}) {
      const Vec3<float> wo(direction(degrees, 0.4));
      const Deltas deltas(above, wo);
      const std::string where = std::string(row.name) + " at " + std::to_string(degrees);
      CHECK_MESSAGE(deltas.kept == doctest::Approx(row.kept(std::abs(wo.z))).epsilon(1e-6), where);
      const Narrow n = narrow(below, wo, deltas, 0.02);
      // The thesis' model lies within 5 / sqrt(m) = 0.016 of the pole at its widest.
      CHECK_MESSAGE(n.outside <= row.share, where, ": ", n.outside);
      CHECK_MESSAGE(n.weight < 0.7 * 2e-3, where, ": ", n.weight);
    }
  }
}
