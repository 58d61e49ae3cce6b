// SPDX-License-Identifier: Apache-2.0
// Phase functions and the shapes of emission.
#include "materials/phase.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "materials/emission.h"
#include "tests/stats/chi_square.h"
#include "tests/unit/materials/cases.h"

using namespace mms;
using namespace mms::test;

TEST_CASE("phase functions: samples, total, mean cosine, symmetry") {
  struct Row {
    Material material;
    double total, mean_cosine;
  };
  const Row rows[] = {
      {isotropic(), 1, 0},
      {henyey_greenstein(0), 1, 0},
      {henyey_greenstein(1e-9), 1, 1e-9},
      {henyey_greenstein(0.6), 1, 0.6},
      {henyey_greenstein(-0.8), 1, -0.8},
      {henyey_greenstein(0.99), 1, 0.99},
      {rayleigh_phase(), 1, 0},
      {draine(0, 0.5), 1, 0},
      // <c> of Draine's: g (1 + a (3 + 2 g^2) / 5) / (1 + a (1 + 2 g^2) / 3)
      {draine(0.03, 1), 1, 0.03 * (1 + 3.0018 / 5) / (1 + 1.0018 / 3)},
      {draine(0.7, 0.8), 1, 0.7 * (1 + 0.8 * 3.98 / 5) / (1 + 0.8 * 1.98 / 3)},
      {draine(-0.9, 1), 1, -0.9 * (1 + 4.62 / 5) / (1 + 2.62 / 3)},
      {mix(henyey_greenstein(0.7), henyey_greenstein(-0.5), ramp(0.25, 0.75)), 1, 0.4},
      {add(scale(isotropic(), 0.3), scale(henyey_greenstein(0.5), ramp(0.6, 0.1))), 0.9, 0.3 / 0.9},
  };
  const double level = stats::sidak(0.01, 3 * int(std::size(rows)));
  double worst = 1;
  std::uint64_t seed = 0;
  for (const Row& row : rows) {
    const materials::Layout layout = row.material.layout();
    CHECK(layout.phase());
    const auto p32 = row.material.params<float>();
    const auto p64 = row.material.params<double>();
    const materials::Phase<float> sampled(layout, p32.data());
    const materials::Phase<double> exact(layout, p64.data());
    for (const Vec3d wo : {Vec3d{0, 0, -1}, Vec3d{0.6, 0, 0.8}, normalize(Vec3d{-1, 2, -0.5})}) {
      const auto r =
          stats::chi_square({.sample = [&](stats::Random& random) -> std::optional<Vec3d> {
                               const float u = random.next_float(), a = random.next_float();
                               const auto s =
                                   sampled.sample(Vec3<float>(wo), u, a, random.next_float());
                               if (!s) return {};
                               return normalize(Vec3d(s->wi));
                             },
                             .pdf = [&](Vec3d wi) { return exact.pdf(wo, wi)[0]; },
                             .axis = wo,
                             .seed = ++seed});
      worst = std::min(worst, r.p_value);
      CHECK_MESSAGE(r.passed(level), row.mean_cosine, ": ", r.report());
      CHECK(r.mass == doctest::Approx(1).epsilon(1e-3));

      stats::Random random(seed);
      stats::Moments cosine;
      for (int i = 0; i < 20000; ++i) {
        const double u = random.next(), a = random.next();
        const auto s = exact.sample(wo, u, a, random.next());
        REQUIRE(s);
        CHECK(s->f[0] / s->pdf[0] == doctest::Approx(row.total).epsilon(1e-12));
        CHECK(exact.eval(wo, s->wi)[3] == doctest::Approx(exact.eval(s->wi, wo)[3]).epsilon(1e-9));
        cosine.add(dot(-wo, s->wi));
      }
      CHECK(stats::z_test(cosine, row.mean_cosine, 1e-9) > level);
    }
  }
  MESSAGE("smallest p-value ", worst, ", level ", level);
}

TEST_CASE("Henyey-Greenstein stays finite where it peaks") {
  for (double g : {1.0, -1.0, 2.0, 0.99999, std::nan("")}) {
    const Material m = henyey_greenstein(g);
    const materials::Layout layout = m.layout();
    const auto p = m.params<float>();
    const materials::Phase<float> phase(layout, p.data());
    for (float u : {0.0f, 1e-7f, 0.5f, 1 - 0x1p-24f}) {
      const auto s = phase.sample({0, 0, 1}, 0, u, 0.3f);
      REQUIRE(s);
      CHECK(std::isfinite(s->pdf[0]));
      CHECK(s->pdf[0] > 0);
      CHECK(length(s->wi) == doctest::Approx(1).epsilon(1e-6));
    }
  }
}

TEST_CASE("emission shapes") {
  const auto shape = [](const Material& m, Vec3d w) {
    const materials::Layout layout = m.layout();
    const auto p = m.params<double>();
    return materials::emission_shape(layout, p.data(), w)[0];
  };
  for (double degrees : {0.0, 40.0, 89.0}) {
    const Vec3d front = direction(degrees, 1), back = -front;
    CHECK(shape(matte(1), front) == doctest::Approx(1));
    CHECK(shape(matte(1), back) == 0);
    CHECK(shape(translucent(0.5), back) == doctest::Approx(0.5));
    CHECK(shape(mix(matte(0.2), matte(1), 0.25), front) == doctest::Approx(0.4));
    CHECK(shape(add(matte(0.2), scale(matte(1), 0.5)), front) == doctest::Approx(0.7));
    CHECK(shape(mirror(1), front) == 0);
  }
  CHECK(shape(glossy(1, 40), direction(0, 0)) > shape(glossy(1, 40), direction(30, 0)));
}

TEST_CASE("emission shapes: samples follow them, sharp ones too") {
  struct Row {
    const char* name;
    Material material;
  };
  const Row rows[] = {{"matte", matte(1)},
                      {"translucent", translucent(1)},
                      {"phong 1", tinted(Lobe::Phong, 1, {1})},
                      {"phong 400", tinted(Lobe::Phong, 1, {400})},
                      {"phong 1e6", tinted(Lobe::Phong, 1, {1e6})},
                      {"glossy", glossy(1, 30)},
                      {"spot, soft", tinted(Lobe::Spot, 1, {0, 1.5})},
                      {"spot, sharp", tinted(Lobe::Spot, 1, {0.3, 0.3})},
                      {"spot, narrow and all but sharp", tinted(Lobe::Spot, 1, {0.01, 0.0101})},
                      {"spots", mix(tinted(Lobe::Spot, 1, {0.1, 0.2}), matte(1), 0.5)}};
  const double level = stats::sidak(0.01, int(std::size(rows)));
  double worst = 1;
  std::uint64_t seed = 40;
  for (const Row& row : rows) {
    const materials::Layout layout = row.material.layout();
    const auto p32 = row.material.params<float>();
    const auto p64 = row.material.params<double>();
    const materials::Bsdf<float> sampled(layout, p32.data());
    const materials::Bsdf<double> exact(layout, p64.data());
    const auto r =
        stats::chi_square({.sample = [&](stats::Random& random) -> std::optional<Vec3d> {
                             const float u = random.next_float(), u1 = random.next_float();
                             const auto s = sampled.sample({0, 0, 1}, u, u1, random.next_float(),
                                                           materials::Mode::Importance);
                             if (!s) return {};
                             return normalize(Vec3d(s->wi));
                           },
                           .pdf =
                               [&](Vec3d w) {
                                 return exact.pdf({0, 0, 1}, w, materials::Mode::Importance)[0];
                               },
                           .seed = ++seed});
    worst = std::min(worst, r.p_value);
    CHECK_MESSAGE(r.passed(level), row.name, ": ", r.report());
    // What a sample carries is the shape.
    stats::Random random(seed);
    for (int i = 0; i < 200; ++i) {
      const double u = random.next(), u1 = random.next();
      const auto s = exact.sample({0, 0, 1}, u, u1, random.next(), materials::Mode::Importance);
      REQUIRE(s);
      CHECK(
          s->f[0] * kPi<double> ==
          doctest::Approx(materials::emission_shape(layout, p64.data(), s->wi)[0]).epsilon(1e-12));
    }
  }
  MESSAGE("smallest p-value ", worst, ", level ", level);
}
