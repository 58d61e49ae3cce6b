// SPDX-License-Identifier: Apache-2.0
// Random calls of every model in float, with numbers over their whole range on log scales and
// directions where arithmetic is hard; and the integrals of the densities of some of them.
// `./run nightly` makes many more calls (MMS_EXTREME_CALLS); MMS_STATS_MODEL takes one model.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "materials/emission.h"
#include "tests/sanitized.h"
#include "tests/setting.h"
#include "tests/stats/chi_square.h"
#include "tests/unit/materials/cases.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

namespace {

/// Around 1, over all scales, and what a script may make by mistake.
double any_number(stats::Random& random) {
  const double sign = random.next() < 0.5 ? 1 : -1, u = random.next();
  switch (int(random.next() * 8)) {
    case 0:
      return 0;
    case 1:
      return 1 + sign * std::pow(10, -8 * u);
    case 2:
      return std::pow(10, 25 * u * sign);
    case 3:
      return u < 0.25 ? std::nan("") : u < 0.5 ? double(INFINITY) : -u;
    case 4:
      return std::pow(10, -4 * u);
    case 5:
      return 1 + 3 * u;
    case 6:
      return 1 / (1 + 3 * u);
    default:
      return u;
  }
}

/// Evenly, or near the surface, the normal or `other` and its images.
Vec3<float> any_direction(stats::Random& random, Vec3<float> other) {
  const double sign = random.next() < 0.5 ? 1 : -1, u = random.next(), v = random.next();
  const double tiny = std::pow(10, -20 * u);
  switch (int(random.next() * 5)) {
    case 0: {
      const double phi = 2 * kPi<double> * v;
      return normalize(Vec3<float>(Vec3d{std::cos(phi), std::sin(phi), sign * tiny}));
    }
    case 1:
      return normalize(Vec3<float>(Vec3d{tiny, 0.1 * tiny, sign}));
    case 2:
      return other * float(sign);
    case 3: {
      const float s = float(sign);
      return normalize(Vec3<float>{-other.x + float(tiny), -other.y, s * other.z});
    }
    default:
      return normalize(Vec3<float>(square_to_sphere(u, v)));
  }
}

/// What a combiner is given; `layered`: what a layer has on top.
Material any_child(bool layered, stats::Random& random) {
  const double x = random.next(), y = 2 * random.next() - 1, gloss = std::pow(10, 6 * x - 1);
  switch (int(random.next() * (layered ? 16 : 14))) {
    case 0:
      return mirror(1);
    case 1:
      return glossy(1, gloss);
    case 2:
      return microfacet(1, x, y);
    case 3:
      return beckmann(1, x, y);
    case 4:
      return mix(mirror(1), microfacet(1, x), std::abs(y));
    case 5:
      return scale(add(glossy(1, gloss), beckmann(1, std::abs(y))), 0.5);
    case 6:
      return tinted(Lobe::RoughMatte, 1, {x});
    case 7:
      return matte(1);
    case 8: {
      Material m = fresnel_mix(y > 0 ? matte(1) : tinted(Lobe::RoughMatte, 1, {x}),
                               y > 0 ? microfacet(1, x) : glossy(1, gloss),
                               1 + std::abs(any_number(random)));
      if (gloss < 1)
        m = film_mix(m, microfacet(1, x), 1 + std::abs(y), any_number(random), gloss * 1e-6, 5e-7);
      for (int more = x < 0.1 ? 8 : 0; more > 0; --more)
        m = coat(microfacet(1, x), m, 0, 0, 1 + std::abs(any_number(random)));
      return m;
    }
    case 9:
      return dielectric(any_number(random), x, 1, 1, y);
    case 10:
      return coat(mirror(1), beckmann_dielectric(1 + std::abs(any_number(random)), x), 0.1, 1,
                  1 + std::abs(any_number(random)));
    case 11:
      return glossy_refraction(any_number(random), {gloss, std::abs(y) * gloss});
    case 12:
      return tinted(Lobe::GlossyThrough, 1, {gloss, std::abs(y) * gloss});
    case 13:
      return phong_glass(any_number(random), gloss);
    default:
      return tinted(Lobe::Sheen, 1, {any_number(random)});
  }
}

/// The model alone; of combiners, over any children.
Material any_material(Lobe lobe, stats::Random& random) {
  const auto& f = materials::formals(lobe);
  Material m;
  vm::LayoutNode n;
  n.lobe = int(lobe);
  for (int i = 0; i < f.count; ++i) {
    if (f.kinds[i] == 'm') {
      append(m, any_child(lobe == Lobe::Layer && i == 0, random));
      n.children.push_back(std::uint32_t(m.tree.nodes.size() - 1));
      continue;
    }
    n.params.emplace_back();
    // Factors up to 1: more is the author's; half of the spectra are constant.
    const bool factor = f.tint[i] || lobe == Lobe::Scale, varies = random.next() < 0.5;
    const auto draw = [&] { return factor ? random.next() : any_number(random); };
    const double x = draw();
    for (int j = 0; j < (f.kinds[i] == 's' ? kWavelengths : 1); ++j)
      m.numbers.push_back(varies && j > 0 ? draw() : x);
  }
  m.tree.nodes.push_back(n);
  return m;
}

struct Counts {
  long long calls = 0, nan = 0, infinite = 0, negative = 0, empty = 0;
  void add(const Spectrumf& s) {
    for (float x : s.v) {
      nan += std::isnan(x);
      infinite += std::isinf(x);
      negative += x < 0;
    }
  }
  /// A sample of a surface or of a volume, if there is one.
  template <class Sample>
  void add_sample(const std::optional<Sample>& s) {
    if (!s) {
      ++empty;
      return;
    }
    add(s->f);
    add(s->pdf);
    nan += !(std::abs(length(s->wi) - 1) < 1e-4f);
  }
  bool good() const { return nan + infinite + negative == 0; }
};

/// How many calls of each model.
long long wanted_calls() { return setting("MMS_EXTREME_CALLS", kSanitized ? 1'000 : 30'000); }

/// All but what MMS_STATS_MODEL names, by the start of it; that must be one at least.
bool left_out(int lobe) {
  const char* only = std::getenv("MMS_STATS_MODEL");
  if (!only) return false;
  const auto named = [only](int k) {
    const std::string_view signature = materials::rows()[k].signature;  // "material name(..."
    return signature.substr(signature.find(' ') + 1).starts_with(only);
  };
  if (named(lobe)) return false;
  for (int k = 0; k < materials::kLobeCount; ++k)
    if (named(k)) return true;
  FAIL("MMS_STATS_MODEL names no model: ", std::string(only));
  return true;
}

void report(const std::string& name, const Counts& counts, const std::string& first) {
  CHECK_MESSAGE(counts.good(), name, ": ", counts.nan, " NaN, ", counts.infinite, " infinite, ",
                counts.negative, " negative; first: ", first);
  if (std::getenv("MMS_EXTREME_CALLS"))
    MESSAGE(name, ": ", counts.calls, " calls, ", counts.empty, " without sample; ", counts.nan,
            " NaN, ", counts.infinite, " infinite, ", counts.negative, " negative");
}

}  // namespace

TEST_CASE("random calls of every model are finite and non-negative") {
  const long long calls = wanted_calls();
  for (int k = 0; k < materials::kLobeCount; ++k) {
    const Lobe lobe = Lobe(k);
    if (left_out(k) || (materials::traits(lobe) & materials::PhaseFunction)) continue;
    stats::Random random(std::uint64_t(k + 1));
    Counts counts;
    std::string first;
    Bsdf<float>::Choice choice;  // of one material after the other, as renders have it
    while (counts.calls < calls) {
      const Material m = any_material(lobe, random);
      const materials::Layout layout = m.layout();
      const auto p = m.params<float>();
      const Bsdf<float> bsdf(layout, p.data());
      for (int i = 0; i < 50; ++i) {
        const Vec3<float> wo = any_direction(random, {0, 0, 1}), wi = any_direction(random, wo);
        const Mode mode = i % 2 ? Mode::Radiance : Mode::Importance;
        bsdf.choose(wo, choice);
        const auto l = bsdf.evaluate(wo, wi, mode, choice);
        counts.add(l.f);
        counts.add(l.pdf);
        const float u = random.next_float(), u1 = random.next_float(), u2 = random.next_float();
        counts.calls += 2;
        counts.add_sample(bsdf.sample(wo, u, u1, u2, mode, choice));
        if (!counts.good() && first.empty()) {
          for (float x : p) first += std::to_string(x) + " ";
          first += "; wo " + std::to_string(wo.x) + " " + std::to_string(wo.y) + " " +
                   std::to_string(wo.z * 1e6f) + "e-6; wi z " + std::to_string(wi.z * 1e6f) +
                   "e-6, f " + std::to_string(l.f[0]) + " pdf " + std::to_string(l.pdf[0]);
        }
      }
    }
    report(std::string(materials::rows()[k].signature), counts, first);
  }
}

TEST_CASE("random calls of every phase function and emission shape are finite and non-negative") {
  const long long calls = wanted_calls();
  for (int k = 0; k < materials::kLobeCount; ++k) {
    const Lobe lobe = Lobe(k);
    if (left_out(k)) continue;
    const bool phase = (materials::traits(lobe) & materials::PhaseFunction) != 0;
    stats::Random random(std::uint64_t(k + 100));
    Counts counts;
    std::string first;
    while (counts.calls < calls) {
      Material m = any_material(lobe, random);
      if (phase) m = mix(m, henyey_greenstein(any_number(random)), any_number(random));
      const materials::Layout layout = m.layout();
      const auto p = m.params<float>();
      for (int i = 0; i < 50; ++i) {
        const Vec3<float> wo = any_direction(random, {0, 0, 1}), wi = any_direction(random, wo);
        ++counts.calls;
        if (!phase) {
          counts.add(materials::emission_shape(layout, p.data(), wi));
        } else {
          const materials::Phase<float> function(layout, p.data());
          counts.add(function.eval(wo, wi));
          counts.add(function.pdf(wo, wi));
          counts.add(materials::volume_emission_shape(layout, p.data(), wi));
          const float u = random.next_float(), u1 = random.next_float();
          counts.add_sample(function.sample(wo, u, u1, random.next_float()));
        }
        if (!counts.good() && first.empty())
          for (float x : p) first += std::to_string(x) + " ";
      }
    }
    report(std::string(materials::rows()[k].signature), counts, first);
  }
}

namespace {

/// What one draw gives.
struct Drawn {
  Vec3d wi;
  double delta = 0;  ///< probability of this very direction, or 0 where it has a density
};

/// A distribution of directions. Where it jumps it does so at the equator of `axis`, or near the
/// plane through `axis` and `across`.
struct Distribution {
  std::function<std::optional<Drawn>(stats::Random&)> draw;
  std::function<double(Vec3d)> pdf;
  Vec3d axis, across;
};

struct Mass {
  double smooth = 0, deltas = 0;
  double change = 0;  ///< of `smooth`, where there were half as many cells
  double failed = 0;  ///< share of draws
  double total() const { return smooth + deltas; }
};

constexpr int kDraws = kSanitized ? 2048 : 8192;

/// Integral of a density over the half of the sphere around `pole`, in two parts of so many cells
/// each, cut at the medians of what was drawn: that says no more than where it is narrow.
double half_mass(const Distribution& d, Vec3d pole, const std::vector<Vec3d>& drawn, int cells) {
  const auto frame = Frame<double>::with_tangent(pole, d.across);
  std::vector<stats::detail::PolarPoint> points;
  for (Vec3d w : drawn)
    if (dot(w, pole) > 0) points.push_back(stats::detail::to_polar(frame, w));
  const auto behind = std::partition(points.begin(), points.end(),
                                     [](const auto& p) { return p.phi < kPi<double>; });
  const double equator = std::numbers::sqrt2 / 2, half = kPi<double>;
  std::vector<Rectangle> all;
  stats::detail::split({0, equator, 0, half}, points.begin(), behind, cells, true, all);
  stats::detail::split({0, equator, half, 2 * half}, behind, points.end(), cells, true, all);
  double sum = 0;
  // Each within a tenth of what 20 000 draws would tell of it: rounding in float densities keeps
  // narrow ones from settling closer.
  for (const Rectangle& cell : all)
    sum += stats::detail::integrate_cell(cell, 3e-4, 20'000, [&](double t, double phi) {
             return 4 * t * d.pdf(stats::detail::from_polar(frame, t, phi));
           }).value;
  return sum;
}

/// By quadrature, and the sum of the deltas that are drawn.
Mass mass(const Distribution& d, int draws) {
  stats::Random random(1);
  Mass m;
  std::vector<Vec3d> smooth, deltas;
  for (int i = 0; i < draws; ++i) {
    const auto s = d.draw(random);
    if (!s) {
      m.failed += 1.0 / draws;
    } else if (!(s->delta > 0)) {
      smooth.push_back(normalize(s->wi));
    } else if (std::find(deltas.begin(), deltas.end(), s->wi) == deltas.end()) {
      deltas.push_back(s->wi);
      m.deltas += s->delta;
    }
  }
  for (Vec3d pole : {d.axis, -d.axis}) {
    const double fine = half_mass(d, pole, smooth, 16);
    m.smooth += fine;
    m.change += std::abs(fine - half_mass(d, pole, smooth, 8));
  }
  return m;
}

/// Of what light along `degrees` meets, in float.
Mass mass(const Material& m, double degrees, int draws) {
  using R = float;
  const materials::Layout layout = m.layout();
  const auto p = m.params<R>();
  const Vec3<R> wo(direction(degrees, 0.7));
  const auto draw = [&](const auto& sample) {
    return [=](stats::Random& random) -> std::optional<Drawn> {
      const R u = random.next_float(), u1 = random.next_float(), u2 = random.next_float();
      return sample(u, u1, u2);
    };
  };
  if (layout.phase()) {
    const materials::Phase<R> phase(layout, p.data());
    return mass({.draw = draw([&](R u, R u1, R u2) -> std::optional<Drawn> {
                   const auto s = phase.sample(wo, u, u1, u2);
                   if (!s) return {};
                   return Drawn{Vec3d(s->wi)};
                 }),
                 .pdf = [&](Vec3d wi) { return phase.pdf(wo, Vec3<R>(wi))[0]; },
                 .axis = normalize(Vec3d(wo)),
                 .across = {0, 0, 1}},
                draws);
  }
  const Bsdf<R> bsdf(layout, p.data());
  const auto choice = bsdf.choose(wo);
  return mass(
      {.draw = draw([&](R u, R u1, R u2) -> std::optional<Drawn> {
         const auto s = bsdf.sample(wo, u, u1, u2, Mode::Radiance, choice);
         if (!s) return {};
         return Drawn{Vec3d(s->wi), s->specular ? double(s->pdf[0]) : 0};
       }),
       .pdf = [&](Vec3d wi) { return bsdf.pdf(wo, Vec3<R>(wi), Mode::Radiance, choice)[0]; },
       .axis = {0, 0, 1},
       .across = {-wo.y, wo.x, 0}},
      draws);
}

/// Quadrature is within this, or else the lobe is too narrow for it, which few are.
constexpr double kBound = 1e-3;

/// Integrals of densities, each held to be at most 1 and to lack what is not drawn.
struct Masses {
  int draws = kDraws;
  int integrals = 0, unresolved = 0;
  double most = 0, largest_change = 0;

  void add(const std::string& name, const Material& m, double degrees) {
    const Mass r = mass(m, degrees, draws);
    ++integrals;
    largest_change = std::max(largest_change, r.change);
    if (r.change > kBound) {
      ++unresolved;
      return;
    }
    most = std::max(most, r.total());
    const auto what = [&] {
      std::string numbers;
      for (double x : m.numbers) numbers += std::to_string(x) + " ";
      return name + " at " + std::to_string(degrees) + ": density " + std::to_string(r.smooth) +
             " deltas " + std::to_string(r.deltas) + " not drawn " + std::to_string(r.failed) +
             "; " + numbers;
    };
    CHECK_MESSAGE(r.total() <= 1 + kBound, what());
    const double lacks = 1 - r.total();
    // Five standard deviations of the share that was not drawn.
    const double e = std::sqrt(std::max(0.0, lacks) / draws);
    CHECK_MESSAGE(std::abs(lacks - r.failed) <= kBound + 5 * e, what());
  }
};

}  // namespace

TEST_CASE("random materials: no density integrates to above one; what lacks is what is not drawn") {
  const int each = kSanitized ? 1 : 2;
  int integrals = 0, unresolved = 0;
  for (int k = 0; k < materials::kLobeCount; ++k) {
    // Calls of all models are above: sanitizers have no more to find here than in a third of them.
    if (left_out(k) || (kSanitized && k % 3 != 1)) continue;
    const std::string name(materials::rows()[k].signature);
    stats::Random random(std::uint64_t(k + 200));
    Masses masses;
    for (int i = 0; i < each; ++i) {
      const Material m = hero_only(any_material(Lobe(k), random));
      for (double degrees : {0.0, 60.0, 89.0, 89.99, 90.01, 91.0, 120.0, 180.0})
        if (!kSanitized || degrees == (k % 2 ? 60 : 90.01)) masses.add(name, m, degrees);
    }
    integrals += masses.integrals, unresolved += masses.unresolved;
    if (std::getenv("MMS_EXTREME_CALLS"))
      MESSAGE(name, ": most ", masses.most, ", largest change ", masses.largest_change);
  }
  CHECK_MESSAGE(unresolved <= integrals / 50, unresolved, " of ", integrals);
}

TEST_CASE("narrow facets near the surface: densities integrate to what is drawn") {
  // Lobes narrower than what rounding moves the half vector of two directions by.
  Masses masses{.draws = 8192};  // fewer do not say where lobes as narrow as these are
  for (double roughness : {0.02, 0.03, 0.1})
    for (const Material& m : {microfacet(1, roughness), microfacet(1, roughness, 0.5),
                              dielectric(1.5, roughness), beckmann(1, 1.5 * roughness)})
      for (double degrees : {89.9, 89.99}) {
        if (roughness == 0.1 ? !kSanitized || degrees == 89.9 : kSanitized) continue;
        masses.add("facets", hero_only(m), degrees);
      }
  CHECK(masses.unresolved <= 1);
}
