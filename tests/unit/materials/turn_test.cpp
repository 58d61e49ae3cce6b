// SPDX-License-Identifier: Apache-2.0
// A turned tangent: the same material, seen in another frame.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "base/warp.h"
#include "tests/sanitized.h"
#include "tests/stats/random.h"
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
  const auto value = [](const Material& m, Vec3d o, Vec3d i) {
    const materials::Layout layout = m.layout();
    return Bsdf<double>(layout, m.params<double>().data()).eval(o, i, Mode::Radiance)[0];
  };
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
