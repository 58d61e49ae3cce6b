// SPDX-License-Identifier: Apache-2.0
// Float Fresnel against the textbook closed forms in long double.
#include "materials/fresnel.h"

#include <doctest/doctest.h>

#include <complex>

#include "base/quadrature.h"
#include "materials/conductor.h"

using namespace mms::materials;

namespace {

using Ld = long double;

Ld dielectric_oracle(Ld c, Ld eta) {
  const Ld s2 = (1 - c) * (1 + c) / (eta * eta);
  if (s2 >= 1) return 1;
  const Ld t = std::sqrt(1 - s2);
  const Ld rs = (c - eta * t) / (c + eta * t), rp = (eta * c - t) / (eta * c + t);
  return (rs * rs + rp * rp) / 2;
}

/// Absorptance; complex arithmetic as in a textbook.
Ld conductor_oracle(Ld c, Ld n, Ld k, bool absorbed) {
  const std::complex<Ld> eps = std::complex<Ld>(n, k) * std::complex<Ld>(n, k);
  const std::complex<Ld> g = std::sqrt(eps - (1 - c) * (1 + c));
  const Ld as = 4 * c * g.real() / std::norm(c + g);
  const Ld ap = 4 * c * (eps * std::conj(g)).real() / std::norm(eps * c + g);
  const Ld rs = std::norm((c - g) / (c + g)), rp = std::norm((eps * c - g) / (eps * c + g));
  return absorbed ? (as + ap) / 2 : (rs + rp) / 2;
}

constexpr float kCosines[] = {0,    1e-7f, 1e-5f,  1e-3f,     0.01f, 0.05f, 0.1f, 0.2f,
                              0.3f, 0.5f,  0.707f, 0.745357f, 0.8f,  0.95f, 1};

}  // namespace

TEST_CASE("dielectric Fresnel in float") {
  double worst = 0, near_total = 0;
  for (float eta : {1 + 1e-6f, 1 - 1e-6f, 1.0001f, 0.999f, 1.1f, 1 / 1.1f, 1.33f, 1.5f, 1 / 1.5f,
                    2.4f, 4.0f, 0.25f, 100.0f})
    for (float c : kCosines) {
      const FresnelSplit<float> s = fresnel_split(c, eta);
      const Ld truth = dielectric_oracle(c, eta);
      CHECK(s.reflected >= 0);
      CHECK(s.reflected <= 1);
      CHECK(std::abs(s.reflected + s.transmitted - 1) < 1e-6f);
      const Ld e = (Ld(eta) - 1) * (Ld(eta) + 1), g2 = Ld(c) * c + e;
      if (g2 < -1e-3L * c * c) {
        CHECK(s.reflected == 1);
      } else if (g2 > 1e-3L * c * c) {
        // e, g^2 and the fused numerator carry a few ulp each, r is squared: 16 ulp. The p term is
        // absolute against r_s where it vanishes at Brewster's angle.
        const double error = double(std::abs(s.reflected - truth) / truth);
        worst = std::max(worst, error);
        CHECK_MESSAGE(error < 16 * 1.2e-7, eta, " ", c);
      } else {
        // Next to total reflection g = sqrt(g^2) turns an ulp of c^2 into sqrt(1.2e-7) c = 3.5e-4 c
        // of g, and R = 1 - 4 g / c ... at worst: conditioning, not the form.
        const double error = double(std::abs(s.reflected - truth));
        near_total = std::max(near_total, error);
        CHECK_MESSAGE(error < 4 * 3.5e-4 * std::max(1.0f, 1 / (eta * eta)), eta, " ", c);
      }
    }
  MESSAGE("dielectric: largest relative error ", worst, "; near total reflection, absolute ",
          near_total);
  CHECK(fresnel_dielectric(0.0f, 1.0f) == 0);
  CHECK(fresnel_dielectric(1.0f, 1.5f) == doctest::Approx(0.04).epsilon(1e-6));
}

TEST_CASE("conductor Fresnel in float") {
  double worst = 0, worst_r = 0;
  const float indices[][2] = {{0.05f, 3.4f}, {0.2f, 3.4f}, {1.3f, 7.5f},   {3.1f, 3.3f},
                              {1.5f, 0},     {1.0001f, 0}, {1.01f, 0.01f}, {0.01f, 10},
                              {200, 300},    {1, 1e-4f},   {2.5f, 1e-6f},  {1e-3f, 5}};
  for (const auto& nk : indices)
    for (float c : kCosines) {
      const Ld a = conductor_oracle(c, nk[0], nk[1], true);
      const Ld r = conductor_oracle(c, nk[0], nk[1], false);
      const float got = fresnel_conductor_absorptance(c, nk[0], nk[1]);
      const float got_r = fresnel_conductor(c, nk[0], nk[1]);
      if (c > 0) worst = std::max(worst, double(std::abs(got - a) / a));
      worst_r = std::max(worst_r, double(std::abs(got_r - r) / r));
      // About twenty roundings, none amplified.
      CHECK_MESSAGE(std::abs(got - a) <= 20 * 6e-8L * a, nk[0], " ", nk[1], " ", c);
      CHECK_MESSAGE(std::abs(got_r - r) <= 40 * 6e-8L * r, nk[0], " ", nk[1], " ", c);
    }
  MESSAGE("conductor: largest relative error of absorptance ", worst, ", of reflectance ", worst_r);
}

TEST_CASE("conductor Fresnel far out") {
  for (float k : {1e3f, 1e10f, 1e19f, 1e25f})
    for (float n : {0.0f, 1.0f, 1e10f, 1e25f})
      for (float c : kCosines) {
        const float a = fresnel_conductor_absorptance(c, n, k);
        const float r = fresnel_conductor(c, n, k);
        CHECK(a >= 0);
        CHECK(a <= 1);
        CHECK(r >= 0);
        CHECK(r <= 1);
        const Ld truth = conductor_oracle(c, n, k, true);
        // Where a c falls below the normal floats (1e-38) and c^2 >= 1e-14 divides it, digits go.
        CHECK_MESSAGE(std::abs(a - truth) <= 1e-5L * truth + 1e-30L, n, " ", k, " ", c);
      }
}

TEST_CASE("diffuse reflectance of a dielectric is the integral of Fresnel's") {
  for (double eta : {0.3, 0.7, 0.999, 0.99999, 1.0, 1.00002, 1.001, 1.2, 1.5, 2.5, 10.0}) {
    const double critical = eta < 1 ? std::sqrt((1 - eta) * (1 + eta)) : 0;
    const auto f = [&](double c) { return 2 * c * double(fresnel_dielectric(Ld(c), Ld(eta))); };
    const double truth = mms::integrate_adaptive(f, 0, critical, 1e-12) +
                         mms::integrate_adaptive(f, critical, 1, 1e-12);
    CHECK_MESSAGE(std::abs(fresnel_dielectric_diffuse(eta) - truth) < 2e-6, eta, ": ", truth);
  }
  // Published value for n = 1.5.
  CHECK(fresnel_dielectric_diffuse(1.5) == doctest::Approx(0.0918).epsilon(1e-3));
}

TEST_CASE(
    "coloured metal reflects what its colours say, at the normal, the edge and in the surface") {
  for (double facing : {0.0, 0.04, 0.5, 0.95, 1.0})
    for (double edge : {0.0, 0.3, 1.0}) {
      const double numbers[2 * mms::kWavelengths] = {facing, 1, 1, 1, 1, 1, 1, 1, edge};
      const auto at = [&](double c) { return ColouredFresnel<double>{numbers}(c)[0]; };
      const auto schlick = [&](double c) { return facing + (1 - facing) * std::pow(1 - c, 5); };
      CHECK(at(1) == facing);
      CHECK(at(0) == doctest::Approx(1).epsilon(1e-14));
      CHECK(std::abs(at(1.0 / 7) - edge * schlick(1.0 / 7)) < 1e-15);
      for (int i = 0; i <= 100; ++i) {
        const double c = i / 100.0, f = at(c);
        CHECK(f >= 0);
        CHECK(f <= schlick(c) + 1e-15);
        if (edge == 1) CHECK(f == doctest::Approx(schlick(c)).epsilon(1e-14));
      }
    }
}
