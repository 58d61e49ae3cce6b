// SPDX-License-Identifier: Apache-2.0
// Coats of any kind over anything, most often up to three of them: they may lose light, and never
// gain any.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/sanitized.h"
#include "tests/stats/random.h"
#include "tests/unit/materials/cases.h"
#include "tests/unit/materials/make.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

namespace {

/// Lossless materials by chance, and what they are in words.
class Nests {
 public:
  explicit Nests(stats::Random& random) : random_(random) {}

  Material nest(int depth) {
    if (depth == 0) return base();
    const double which = random_.next();
    const double ior = which < 0.15   ? 0.8
                       : which < 0.35 ? 1 + 0.05 * random_.next()
                                      : random_.between(1, 3);
    text += "index " + std::to_string(ior) + ": (";
    const Material top = reflecting();
    text += " over ";
    Material below = nest(depth - 1);
    if (depth <= 3 && random_.next() < 0.3) below = mix(below, nest(depth - 1), random_.next());
    text += ")";
    return random_.next() < 0.5 ? coat(top, below, 0, 0, ior) : fresnel_mix(below, top, ior);
  }

  std::string text;

 private:
  Material reflecting() {
    const int kind = int(9 * random_.next());
    const double r = random_.next();
    text += "reflecting " + std::to_string(kind) + " of " + std::to_string(r);
    switch (kind) {
      case 0:
        return mirror(1);
      case 1:
        return microfacet(1, r);
      case 2:
        return microfacet(1, r, random_.between(-1, 1));
      case 3:
        return beckmann(1, r);
      case 4:
        return glossy(1, std::expm1(7 * r));
      case 5:
        return conductor(1, 1e25, r);
      case 6:
        return mix(mirror(1), microfacet(1, r), random_.next());
      case 7:
        return tinted(Lobe::GlossyBack, 1, {100 * r, 10 * r});
      default:
        return tinted(Lobe::Ward, 1, {0.1 + 0.9 * r, 0});
    }
  }

  Material base() {
    const int kind = int(9 * random_.next());
    if (kind < 2) return reflecting();
    const double ior = random_.between(1.1, 2.1), r = random_.next();
    text += "base " + std::to_string(kind) + " of " + std::to_string(ior) + " " + std::to_string(r);
    switch (kind) {
      case 2:
        return matte(1);
      case 3:
        return dielectric(ior);
      case 4:
        return dielectric(ior, 0.1 + 0.9 * r);
      case 5:
        return glossy_refraction(random_.next() < 0.2 ? 1 / ior : ior, {100 * r, 10 * r});
      case 6:
        return tinted(Lobe::GlossyThrough, 1, {100 * r, 10 * r});
      case 7:
        return film_dielectric(ior, 1 + random_.next(), 6e-7 * random_.next(), 5.5e-7,
                               0.1 + 0.9 * r);
      default:
        return mix(matte(1), dielectric(ior, r < 0.5 ? 0 : r), random_.next());
    }
  }

  stats::Random& random_;
};

}  // namespace

// By samples: six standard errors above 1 are met once in 10^9, and a part in a thousand is what
// coated glass may be off by (materials/glass_coat.h).
TEST_CASE("coats of any kind over anything never gain") {
  stats::Random random(5);
  double most = 0;
  for (int k = 0; k < (kSanitized ? 20 : 300); ++k) {
    Nests nests(random);
    const Material m = nests.nest(random.next() < 0.05 ? 12 : 1 + int(3 * random.next()));
    REQUIRE(!m.layout().empty());
    const double degrees =
        random.next() < 0.3 ? random.between(85, 89.9) : random.between(0, 179) + 0.05;
    const Vec3d wo = direction(degrees, random.between(0, 2));
    const materials::Layout layout = m.layout();
    const auto p = m.params<double>();
    const Bsdf<double> bsdf(layout, p.data());
    const auto choice = bsdf.choose(wo);
    constexpr int kSamples = kSanitized ? 500 : 5000;
    double sum = 0, squares = 0;
    for (int i = 0; i < kSamples; ++i) {
      const auto s =
          bsdf.sample(wo, random.next(), random.next(), random.next(), Mode::Importance, choice);
      const double x = s ? s->f[0] * std::abs(s->wi.z) / s->pdf[0] : 0;
      sum += x;
      squares += x * x;
    }
    const double mean = sum / kSamples;
    const double error = std::sqrt(std::max(0.0, squares / kSamples - mean * mean) / kSamples);
    CHECK_MESSAGE(mean < 1 + 6 * error + 1e-3, nests.text, " at ", degrees, ": ", mean, " +- ",
                  error);
    most = std::max(most, mean - 6 * error);
  }
  MESSAGE("albedo less six standard errors: up to ", most);
}
