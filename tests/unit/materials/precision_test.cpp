// SPDX-License-Identifier: Apache-2.0
// Every model in float against itself in long double: as right as its inputs are.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "materials/bsdf_definitions.h"
#include "tests/sanitized.h"
#include "tests/stats/random.h"
#include "tests/unit/materials/cases.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

namespace {

using Real = long double;

/// f of the hero over the two directions, with their six coordinates and all numbers free to move.
struct Exact {
  const materials::Layout& layout;
  std::vector<Real> numbers;

  Real at(const std::array<Real, 6>& x) const {
    return Bsdf<Real>(layout, numbers.data())
        .eval({x[0], x[1], x[2]}, {x[3], x[4], x[5]}, Mode::Importance)[0];
  }

  /// The change of f, in units of itself, where every coordinate moves by 1 and every number by
  /// itself, all for the worst: differences over a millionth.
  Real condition(const std::array<Real, 6>& x, Real f) const {
    constexpr Real h = 1e-6L;
    Real sum = 0;
    for (int k = 0; k < 6; ++k) {
      std::array<Real, 6> up = x, down = x;
      up[k] += h;
      down[k] -= h;
      sum += std::abs(at(up) - at(down));
    }
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      Exact up = *this, down = *this;
      up.numbers[k] *= 1 + h;
      down.numbers[k] *= 1 - h;
      sum += std::abs(up.at(x) - down.at(x));
    }
    return sum / (2 * h * f);
  }
};

}  // namespace

TEST_CASE("float is as right as its directions and numbers are, in every model") {
  // A result computed in some steps that matter, each right within eps = 2^-24 of what enters it,
  // is off by no more than rounding directions and numbers as often would make it. Most steps do
  // not.
  constexpr double kSteps = 6, eps = 0x1p-24;
  for (const Case& c : smooth_cases()) {
    const materials::Layout layout = c.material.layout();
    const auto p = c.material.params<float>();
    const Bsdf<float> bsdf(layout, p.data());
    const Exact exact{layout, {p.begin(), p.end()}};
    stats::Random random(6);
    double worst = 0, relative = 0;
    for (int i = 0; i < (kSanitized ? 20 : 100); ++i) {
      const Vec3<float> wo(square_to_sphere(random.next(), random.next()));
      const float u = random.next_float(), u1 = random.next_float();
      const auto s = bsdf.sample(wo, u, u1, random.next_float(), Mode::Importance);
      if (!s || s->specular || std::abs(wo.z) < 0.02f || std::abs(s->wi.z) < 0.02f) continue;
      const std::array<Real, 6> x{wo.x, wo.y, wo.z, s->wi.x, s->wi.y, s->wi.z};
      const Real f = exact.at(x);
      if (!(f > 0)) continue;  // at an edge of the lobe
      const double error = double(std::abs(s->f[0] - f) / f);
      const double bound = kSteps * eps * double(1 + exact.condition(x, f));
      relative = std::max(relative, error);
      worst = std::max(worst, error / bound);
      CHECK_MESSAGE(error <= bound, c.name, " at ", wo.z, " ", s->wi.z, ": ", error, " of ", bound);
    }
    if (std::getenv("MMS_EXTREME_CALLS"))
      MESSAGE(c.name, ": largest relative error ", relative, ", over its bound ", worst);
  }
}

TEST_CASE("at grazing, where directions nearly cancel, float loses no sample") {
  // The half vector's cosine is as small as that of wo here; as a product of float directions it
  // would be rounding alone, and 2e-3 of the samples drawn would have density 0.
  const Material models[] = {tinted(Lobe::Ward, 1, {0.2, 0}),
                             tinted(Lobe::AshikhminShirley, 1, {100, 10})};
  for (const Material& m : models) {
    const materials::Layout layout = m.layout();
    const auto p = m.params<float>();
    const auto p64 = m.params<double>();
    const Bsdf<float> bsdf(layout, p.data());
    const Bsdf<double> exact(layout, p64.data());
    for (double degrees : {89.99, 90.01}) {
      const Vec3<float> wo(direction(degrees, 0.7));
      const Vec3d wo_exact = normalize(Vec3d(wo));
      stats::Random random(8);
      int lost = 0;
      for (int i = 0; i < (kSanitized ? 5'000 : 20'000); ++i) {
        const float u = random.next_float(), u1 = random.next_float(), u2 = random.next_float();
        const bool drawn = bool(bsdf.sample(wo, u, u1, u2, Mode::Radiance));
        lost += drawn != bool(exact.sample(wo_exact, u, u1, u2, Mode::Radiance));
      }
      CHECK_MESSAGE(lost <= 1, degrees, ": ", lost);  // one may be at the very horizon
    }
  }
}
