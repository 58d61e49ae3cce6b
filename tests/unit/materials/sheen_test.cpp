// SPDX-License-Identifier: Apache-2.0
// `sheen` against random walks through its fibres, and at roughness 1 against the integral equation
// of a layer that scatters evenly; what it and `layer` keep of the light.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "base/quadrature.h"
#include "materials/sheen.h"
#include "materials/tables/fibres.h"
#include "tests/sanitized.h"
#include "tests/stats/distributions.h"
#include "tests/stats/random.h"
#include "tests/unit/materials/cases.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;
using materials::SheenLayer;

namespace {

Material sheen(Value colour, double roughness) { return tinted(Lobe::Sheen, colour, {roughness}); }

/// int f(wi) wi.z dwi over the upper hemisphere, of a function that is smooth but narrow near the
/// surface: the cosine as a fourth power.
template <class F>
double hemisphere(const F& f, int panels = 12) {
  const int n = 8 * panels;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double u = (i / 8 + gauss<8>().x[i % 8]) / panels, z = u * u * u * u;
    const double s = std::sqrt((1 - z) * (1 + z));
    double ring = 0;
    for (int k = 0; k < n; ++k) {
      const double phi = 2 * kPi<double> * (k + 0.5) / n;
      ring += f(Vec3d{s * std::cos(phi), s * std::sin(phi), z});
    }
    sum += gauss<8>().w[i % 8] / panels * 4 * u * u * u * z * ring * 2 * kPi<double> / n;
  }
  return sum;
}

double albedo(const Material& m, double degrees, Mode mode) {
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  const Bsdf<double> bsdf(layout, p.data());
  const Vec3d wo = direction(degrees, 0.7);
  return hemisphere([&](Vec3d wi) { return bsdf.eval(wo, wi, mode)[0]; });
}

}  // namespace

TEST_CASE("sheen sends back what walks through its fibres do, between the table's nodes") {
  const int count = kSanitized ? 2'000 : 20'000;
  double worst = 0, worst_z = 0, worst_x = 0;
  for (double roughness : {0.13, 0.27, 0.44, 0.61, 0.77, 0.95})
    for (double degrees : {5.0, 35.0, 62.0, 76.0, 84.0, 88.5}) {
      const Vec3d wo = direction(degrees, 0);
      stats::Random random(std::uint64_t(1000 * roughness + degrees));
      stats::Moments back, z, x;
      for (int i = 0; i < count; ++i) {
        const auto w = materials::tables::walk_in_fibres(roughness, wo, random);
        back.add(w ? 1 : 0);
        if (!w) continue;
        z.add(w->z);
        x.add(w->x);
      }
      const double r = SheenLayer<double>(roughness).albedo(wo.z);
      // Five standard errors of this walk; the table's own, of 20 times as many; 2e-3 of the
      // spline.
      const double e = std::sqrt(std::max(r, 1e-3) / count);
      worst = std::max(worst, std::abs(back.mean - r));
      CHECK_MESSAGE(std::abs(back.mean - r) < 5.2 * e + 2e-3, roughness, " at ", degrees, ": ",
                    back.mean, " against ", r);
      if (r < 0.02 || kSanitized) continue;
      // Where the light goes: the mean direction of the transformed cosine, which is a fit.
      const Material m = sheen(1, roughness);
      const materials::Layout layout = m.layout();
      const auto p = m.params<double>();
      const Bsdf<double> bsdf(layout, p.data());
      const double mean_z =
          hemisphere([&](Vec3d wi) { return wi.z * bsdf.eval(wo, wi, Mode::Radiance)[0] / r; });
      const double mean_x =
          hemisphere([&](Vec3d wi) { return wi.x * bsdf.eval(wo, wi, Mode::Radiance)[0] / r; });
      worst_z = std::max(worst_z, std::abs(mean_z - z.mean));
      worst_x = std::max(worst_x, std::abs(mean_x - x.mean));
      CHECK_MESSAGE(std::abs(mean_z - z.mean) < 0.05, roughness, " at ", degrees, ": ", mean_z,
                    " against ", z.mean);
      CHECK_MESSAGE(std::abs(mean_x - x.mean) < 0.05, roughness, " at ", degrees, ": ", mean_x,
                    " against ", x.mean);
    }
  MESSAGE("sheen: albedo off by at most ", worst, ", the mean direction by ", worst_z, " upwards, ",
          worst_x, " along");
}

TEST_CASE("sheen of roughness 1 is a layer that scatters evenly") {
  // Collisions J over the depth t in [0, 1]: J(t) = exp(-t / z) / z + 1/2 int E1(|t - s|) J(s) ds,
  // and of those E2(t) / 2 leave above. In cells, over each of which E1 is integrated exactly.
  const auto e2 = [](double x) {
    return x > 0 ? std::exp(-x) + x * std::expint(-x) : 1.0;  // E1(x) = -Ei(-x)
  };
  constexpr int n = 100;
  for (double degrees : {0.0, 40.0, 70.0, 85.0}) {
    const double z = direction(degrees, 0).z;
    std::vector<double> first(n), all(n);
    for (int i = 0; i < n; ++i)
      first[i] = (std::exp(-i / (z * n)) - std::exp(-(i + 1) / (z * n))) * n;
    all = first;
    for (int bounce = 0; bounce < 40; ++bounce) {  // each leaves less than 0.6 of the one before
      std::vector<double> next = first;
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
          const double near = (std::abs(i - k) - 0.5) / n, far = (std::abs(i - k) + 0.5) / n;
          next[i] += all[k] / 2 * (i == k ? 2 * (1 - e2(far)) : e2(near) - e2(far));
        }
      all = next;
    }
    double out = 0;
    for (int i = 0; i < n; ++i) out += all[i] / n * e2((i + 0.5) / n) / 2;
    const double r = SheenLayer<double>(1).albedo(z);
    // The table's walks: 5e-4 / sqrt(0.4 million / 10^6), the cells 1e-3.
    CHECK_MESSAGE(std::abs(r - out) < 4e-3, degrees, ": ", r, " against ", out);
  }
}

TEST_CASE("sheen's albedo is its table's, and a white base under it stays white") {
  for (double roughness : {0.1, 0.3, 0.5, 1.0})
    for (double degrees : {0.0, 30.0, 60.0, 80.0, 89.0}) {
      if (kSanitized && degrees != 60) continue;
      INFO(roughness, " at ", degrees);
      const double r = SheenLayer<double>(roughness).albedo(direction(degrees, 0).z);
      CHECK(r < 0.9);
      CHECK(std::abs(albedo(sheen(0.5, roughness), degrees, Mode::Radiance) - 0.5 * r) < 1e-4);
      CHECK(std::abs(albedo(layer(sheen(1, roughness), matte(1)), degrees, Mode::Radiance) - 1) <
            1e-4);
      CHECK(albedo(layer(turn(sheen(1, roughness), 0.7), matte(1)), degrees, Mode::Radiance) ==
            doctest::Approx(1).epsilon(1e-4));
      // Light that comes along this direction: what the fit of `sheen` is off in its adjoint.
      CHECK(std::abs(albedo(layer(sheen(1, roughness), matte(1)), degrees, Mode::Importance) - 1) <
            0.2);
      // 0.6 of the fibres, and two bases.
      const Material base = mix(matte(1), glossy(1, 2), 0.4);
      CHECK(std::abs(albedo(layer(sheen(1, roughness), base, 0.6), degrees, Mode::Radiance) - 1) <
            1e-4);
      // What a scale takes of the fibres is left to the base.
      CHECK(std::abs(albedo(layer(scale(turn(sheen(1, roughness), 0.7), 0.3), base, 0.6), degrees,
                            Mode::Radiance) -
                     1) < 1e-4);
      // A colour only takes away.
      CHECK(albedo(layer(sheen(0.3, roughness), matte(1)), degrees, Mode::Radiance) ==
            doctest::Approx(1 - 0.7 * r).epsilon(1e-3));
    }
  // Over what is not sheen it is a mixture.
  CHECK(albedo(layer(matte(0.2), matte(1), 0.25), 50, Mode::Radiance) ==
        doctest::Approx(0.05 + 0.75).epsilon(1e-9));
}

TEST_CASE("sheen is its own adjoint, and how far from reciprocal") {
  double most = 0, furthest = 0;
  for (double roughness : {0.1, 0.2, 0.3, 0.5, 0.7, 1.0}) {
    const Material m = sheen(1, roughness);
    const materials::Layout layout = m.layout();
    const auto p = m.params<double>();
    const Bsdf<double> bsdf(layout, p.data());
    stats::Random random(4);
    for (int i = 0; i < 1000; ++i) {
      const Vec3d a = square_to_cosine_hemisphere(random.next(), random.next());
      const Vec3d b = square_to_cosine_hemisphere(random.next(), random.next());
      const double ab = bsdf.eval(a, b, Mode::Radiance)[0], ba = bsdf.eval(b, a, Mode::Radiance)[0];
      CHECK(bsdf.eval(b, a, Mode::Importance)[0] == ab);
      furthest = std::max(furthest, std::abs(ab - ba));
    }
    // Of light that comes along a direction, all that it becomes: no more than there was.
    for (double degrees : {0.0, 40.0, 70.0, 80.0, 86.0, 89.0}) {
      const double a = albedo(m, degrees, Mode::Importance);
      most = std::max(most, a);
      CHECK_MESSAGE(a < 1, roughness, " at ", degrees, ": ", a);
    }
  }
  MESSAGE("sheen: |f(a, b) - f(b, a)| up to ", furthest, ", albedo of importance up to ", most);
}
