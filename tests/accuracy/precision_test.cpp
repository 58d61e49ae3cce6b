// SPDX-License-Identifier: Apache-2.0
// Every model in float against itself in long double: as right as its inputs are.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "materials/bsdf_definitions.h"
#include "tests/stats/random.h"
#include "tests/unit/materials/cases.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

namespace {

using Real = long double;

/// What the hero gets: f (of a delta its weight) and pdf. Both 0 where nothing is scattered.
struct Pair {
  Real f = 0, pdf = 0;
};

/// Coordinates of wo, then of wi.
using Coordinates = std::array<Real, 6>;

/// A model in long double, with numbers rounded to float and all wavelengths as the hero: the
/// others are of no matter to it, and are the same in each spectrum.
struct Exact {
  materials::Layout layout;
  std::vector<Real> numbers;
  std::vector<double> first;  ///< of each number: which is the same by its meaning

  explicit Exact(const Material& m) : layout(m.layout()) {
    const auto p = hero_only(m).params<float>();
    numbers.assign(p.begin(), p.end());
    Material order = m;
    std::iota(order.numbers.begin(), order.numbers.end(), 0.0);
    first = hero_only(order).numbers;
  }

  /// The change of what `at(coordinates, numbers)` gives, in units of itself, where every
  /// coordinate moves by 1 and every number by itself, all for the worst: differences over a
  /// millionth.
  template <class Function>
  Pair condition(const Function& at, const Coordinates& x) const {
    constexpr Real h = 1e-6L;
    const Pair here = at(x, numbers);
    Pair sum;
    const auto add = [&](const Pair& moved) {
      sum.f += std::abs(moved.f - here.f) / (h * here.f);
      sum.pdf += std::abs(moved.pdf - here.pdf) / (h * here.pdf);
    };
    for (std::size_t k = 0; k < x.size(); ++k) {
      Coordinates moved = x;
      moved[k] += h;
      add(at(moved, numbers));
    }
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      if (first[k] != double(k)) continue;
      std::vector<Real> moved = numbers;
      for (std::size_t i = k; i < numbers.size(); ++i)
        if (first[i] == double(k)) moved[i] *= 1 + h;
      add(at(x, moved));
    }
    return sum;
  }
};

/// A result computed in some steps that matter, each right within eps = 2^-24 of what enters it, is
/// off by no more than rounding directions and numbers as often would make it. Most steps do not.
constexpr double kSteps = 6, kEps = 0x1p-24;

/// The largest errors met in one model: relative, and over their bounds.
struct Errors {
  std::string name;
  double relative = 0, of_bound = 0;

  void add(double computed, Real right, Real condition, const Coordinates& x) {
    const double error = double(std::abs(computed - right) / right);
    const double bound = kSteps * kEps * double(1 + condition);
    relative = std::max(relative, error);
    of_bound = std::max(of_bound, error / bound);
    CHECK_MESSAGE(error <= bound, name, " at ", double(x[2]), " ", double(x[5]), ": ", error,
                  " of ", bound);
  }

  ~Errors() {
    if (std::getenv("MMS_EXTREME_CALLS"))
      MESSAGE(name, ": largest relative error ", relative, ", over its bound ", of_bound);
  }
};

/// Where light comes along.
enum class From { BothSides, Outside };

/// f and pdf of a material over random directions of cosines from `least` on, wi being drawn: the
/// largest relative errors of each.
std::pair<double, double> check_smooth(const std::string& name, const Material& m, int count,
                                       float least, From from) {
  const materials::Layout layout = m.layout();
  const auto p = m.params<float>();
  const Bsdf<float> bsdf(layout, p.data());
  const Exact exact(m);
  Bsdf<Real>::Choice choice;  // along any direction
  const auto at = [&](const Coordinates& x, const std::vector<Real>& numbers) -> Pair {
    const Bsdf<Real> moved(exact.layout, numbers.data());
    const Vec3<Real> wo{x[0], x[1], x[2]};
    moved.choose(wo, choice);
    const auto l = moved.evaluate(wo, {x[3], x[4], x[5]}, Mode::Importance, choice);
    return {l.f[0], l.pdf[0]};
  };
  stats::Random random(6);
  Errors f{name + ", f"}, pdf{name + ", pdf"};
  for (int i = 0; i < count; ++i) {
    Vec3<float> wo(square_to_sphere(random.next(), random.next()));
    if (from == From::Outside) wo.z = std::abs(wo.z);
    const float u = random.next_float(), u1 = random.next_float();
    const auto s = bsdf.sample(wo, u, u1, random.next_float(), Mode::Importance);
    if (!s || s->specular || std::abs(wo.z) < least || std::abs(s->wi.z) < least) continue;
    const Coordinates x{wo.x, wo.y, wo.z, s->wi.x, s->wi.y, s->wi.z};
    const Pair right = at(x, exact.numbers);
    if (!(right.f > 0)) continue;  // at an edge of the lobe
    const Pair condition = exact.condition(at, x);
    f.add(s->f[0], right.f, condition.f, x);
    pdf.add(s->pdf[0], right.pdf, condition.pdf, x);
  }
  return {f.relative, pdf.relative};
}

}  // namespace

TEST_CASE("float is as right as its directions and numbers are, in every model") {
  for (const Case& c : smooth_cases())
    check_smooth(c.name, c.material, 100, 0.02f, From::BothSides);
}

TEST_CASE("narrow lobes: reflection is as right in float as of wide ones, refraction less") {
  // Outside, where Fresnel has no critical angle, and away from the surface: the half vector of a
  // reflection is right in each component, however near to the normal, and so are its slopes: seven
  // of 24 bits are lost at most. That of refraction is of length ior - 1 where it is the sum of
  // unit lengths 1 and ior: rounding moves it by (ior + 1) / (ior - 1) 2^-24 rad, and the lobe by
  // that times its slope, in units of itself:
  //   GGX of alpha          2 / alpha where it is steepest
  //   Beckmann              6 / alpha at three standard deviations, as far as samples reach
  //   phong_glass           4 sqrt(n) there, and its sum of both directions has no need of a length
  constexpr double kFlat = 0x1p-17, kIor = 1.5, kSum = (kIor + 1) * kEps, kTurn = kSum / (kIor - 1);
  struct Row {
    const char* name;
    std::vector<double> narrowness;
    std::function<Material(double)> material;
    std::function<double(double)> moved = [](double) { return 0.0; };
  };
  const std::vector<double> roughness{0.02, 0.05, 0.1, 0.2, 0.5, 1};
  const std::vector<double> gloss{1, 10, 100, 1e3, 1e4};
  const auto of = [](Lobe lobe) { return [lobe](double n) { return tinted(lobe, 0.7, {n}); }; };
  const Row rows[] = {
      {"microfacet", roughness, [](double r) { return microfacet(0.7, r); }},
      {"conductor", roughness, [](double r) { return conductor(0.2, 3, r); }},
      {"beckmann", roughness, [](double r) { return beckmann(0.7, r); }},
      {"ward", roughness,
       [](double r) {
         return tinted(Lobe::Ward, 0.7, {r, 0});
       }},
      {"glossy", gloss, of(Lobe::Glossy)},
      {"phong", gloss, of(Lobe::Phong)},
      {"max_phong", gloss, of(Lobe::MaxPhong)},
      {"dielectric", roughness, [](double r) { return dielectric(kIor, r); },
       [](double r) { return kTurn * 2 / (r * r); }},
      {"beckmann_dielectric", roughness, [](double r) { return beckmann_dielectric(kIor, r); },
       [](double r) { return kTurn * 6 / (r * r); }},
      {"phong_glass", gloss, [](double n) { return phong_glass(kIor, n); },
       [](double n) { return kSum * 4 * std::sqrt(n); }}};
  for (const Row& row : rows)
    for (double x : row.narrowness) {
      const std::string name = row.name + std::string(" ") + std::to_string(x);
      const auto [f, pdf] = check_smooth(name, row.material(x), 500, 0.1f, From::Outside);
      const double bound = kFlat + row.moved(x);
      CHECK_MESSAGE(std::max(f, pdf) <= bound, name, ": f ", f, ", pdf ", pdf, " of ", bound);
    }
}

TEST_CASE("float is as right as its direction and numbers are, in deltas") {
  struct Row {
    const char* name;
    Material material;
  };
  const Row rows[] = {
      {"mirror", mirror(0.7)},
      {"refraction", refraction(1.5)},
      {"dielectric 1.5", dielectric(1.5)},
      {"dielectric 1.001", dielectric(1.001)},
      {"dielectric 0.4", dielectric(0.4)},
      {"dielectric, dispersive and tinted", dielectric(ramp(1.6, 1.4), 0, 0.5, ramp(0.3, 0.9))},
      {"film_dielectric", film_dielectric(1.5, 1.38, 100e-9, ramp(400e-9, 700e-9))},
      {"film_dielectric, thick", film_dielectric(1.5, 2.2, 2e-6, ramp(400e-9, 700e-9))},
      {"slab", slab(1.5)},
      {"slab, absorbing", slab(1.5, 0.004, ramp(50, 200))},
      {"conductor", conductor(0.2, 3.4)},
      {"conductor, hardly one", conductor(1.01, 0.01)},
      {"coloured_metal", coloured_metal(0.7, 0.5, 0)},
      {"film_conductor", film_conductor(2.5, 3, 1.5, 300e-9, 500e-9, 0)},
      {"coat", coat(mirror(0.9), dielectric(1.4), 0.1, ramp(0.2, 2), 1.7)}};
  for (const Row& row : rows) {
    const materials::Layout layout = row.material.layout();
    const auto p = row.material.params<float>();
    const Bsdf<float> bsdf(layout, p.data());
    const Exact exact(row.material);
    stats::Random random(7);
    Errors weights{row.name + std::string(", weight")};
    Errors probabilities{row.name + std::string(", probability")};
    for (int i = 0; i < 500; ++i) {
      // Every other one near the surface, by all sizes of the cosine.
      Vec3d w = square_to_sphere(random.next(), random.next());
      if (i % 2) w.z *= std::pow(10, -6 * random.next());
      const Vec3<float> wo(normalize(w));
      const float u = i % 4 < 2 ? 0 : 1 - 0x1p-24f;  // what reflects, or what is refracted
      const auto s = bsdf.sample(wo, u, 0.5f, 0.5f, Mode::Radiance);
      if (!s) continue;
      const auto at = [&](const Coordinates& x, const std::vector<Real>& numbers) -> Pair {
        const auto r = Bsdf<Real>(exact.layout, numbers.data())
                           .sample({x[0], x[1], x[2]}, u, 0.5L, 0.5L, Mode::Radiance);
        if (!r || r->transmitted != s->transmitted) return {};
        return {r->f[0] * std::abs(r->wi.z), r->pdf[0]};
      };
      const Coordinates x{wo.x, wo.y, wo.z, 0, 0, 0};
      const Pair right = at(x, exact.numbers);
      if (!(right.f > 0)) continue;  // `u` is at the edge between both
      const Pair condition = exact.condition(at, x);
      weights.add(s->f[0] * std::abs(s->wi.z), right.f, condition.f, x);
      probabilities.add(s->pdf[0], right.pdf, condition.pdf, x);
    }
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
      for (int i = 0; i < 20'000; ++i) {
        const float u = random.next_float(), u1 = random.next_float(), u2 = random.next_float();
        const bool drawn = bool(bsdf.sample(wo, u, u1, u2, Mode::Radiance));
        lost += drawn != bool(exact.sample(wo_exact, u, u1, u2, Mode::Radiance));
      }
      CHECK_MESSAGE(lost <= 1, degrees, ": ", lost);  // one may be at the very horizon
    }
  }
}
