// SPDX-License-Identifier: Apache-2.0
// Extreme numbers and directions in float: nothing is NaN, infinite or negative.
#include <doctest/doctest.h>

#include <cfloat>
#include <cmath>

#include "tests/sanitized.h"
#include "tests/stats/random.h"
#include "tests/unit/materials/cases.h"

using namespace mms;
using namespace mms::test;
using materials::Bsdf;
using materials::Mode;

namespace {

bool sane(const Spectrumf& s) {
  for (float x : s.v)
    if (!(x >= 0) || std::isinf(x)) return false;
  return true;
}

std::vector<Vec3<float>> hard_directions() {
  std::vector<Vec3<float>> d;
  for (double degrees :
       {0.0, 1e-5, 0.01, 45.0, 80.0, 89.99, 89.99999, 90.0, 90.00001, 90.01, 135.0, 179.99, 180.0})
    for (double phi : {0.0, 0.7, 3.14159265358979 + 0.7}) d.emplace_back(direction(degrees, phi));
  for (float z : {FLT_MIN, 1e-20f, 1e-42f, -1e-20f, -1e-42f}) d.push_back({0.6f, 0.8f, z});
  return d;
}

std::vector<Material> extreme_materials() {
  std::vector<Material> m;
  for (double r : {0.0, 1e-30, 1e-4, 0.00999, 0.01001, 0.03, 0.1, 0.9, 1.0, 7.0}) {
    m.push_back(microfacet(1, r));
    m.push_back(microfacet(1, r, 1));
    m.push_back(microfacet(1, r, -1));
    for (double a : {0.0, 1.0, -1.0}) m.push_back(beckmann(1, r, a));
    m.push_back(conductor(ramp(0.05, 3), ramp(0, 8), r));
    m.push_back(coloured_metal(ramp(0, 1), ramp(1, 0), r));
    for (Lobe lobe : {Lobe::Dielectric, Lobe::BeckmannDielectric}) {
      for (double ior : {1 + 1e-7, 1 - 1e-7, 1.0, 1.001, 1.5, 4.0, 0.25, 1e-9, 1e20})
        m.push_back(dielectric(ior, r, 1, 1, 0, lobe));
      m.push_back(dielectric(ramp(0.9, 1.1), r, 1, 1, 0, lobe));
      for (double ior : {1 + 1e-7, 1.001, 1.5, 0.25, 1e20})
        for (double a : {1.0, -1.0}) m.push_back(dielectric(ior, r, 1, 1, a, lobe));
      for (double ior : {1 + 1e-7, 1.5, 0.25, 1e20})
        for (double above : {1 + 1e-7, 1.5, 0.7, 1e20})
          m.push_back(coat(mirror(1), dielectric(ior, r, 1, 1, 0, lobe), 0.1, 1, above));
    }
  }
  for (double g = 1e-12; g < 1e12; g *= 30) {
    m.push_back(glossy(1, g));
    for (Lobe lobe : {Lobe::GlossyProduct, Lobe::GlossyBack, Lobe::GlossyThrough}) {
      m.push_back(tinted(lobe, 1, {g, g}));
      m.push_back(tinted(lobe, 1, {0, g}));
    }
    m.push_back(tinted(Lobe::Phong, 1, {g}));
    for (double ior : {1 + 1e-7, 1.0, 1.5, 0.25}) m.push_back(phong_glass(ior, g));
    m.push_back(tinted(Lobe::MaxPhong, 1, {g}));
    m.push_back(tinted(Lobe::AshikhminShirley, 0.5, {g, 2}));
  }
  for (double x : {0.0, 1e-30, 1e-4, 0.3, 1.0, 1e20, std::nan(""), -1.0, double(INFINITY)}) {
    for (Lobe lobe : {Lobe::OrenNayar, Lobe::RoughMatte, Lobe::Sheen})
      m.push_back(tinted(lobe, 1, {x}));
    for (Lobe lobe : {Lobe::Spot, Lobe::Ward, Lobe::AshikhminShirley, Lobe::GlossyProduct})
      m.push_back(tinted(lobe, 1, {x, x}));
    m.push_back(layer(tinted(Lobe::Sheen, 1, {x}), mirror(1), x));
    m.push_back(phong_glass(x, x));
    m.push_back(slab(x, x, x));
    m.push_back(slab(1.5, 1e-3, x));
    m.push_back(slab(x));
    m.push_back(film_conductor(x, x, x, x, x, 0.3));
    m.push_back(film_conductor(2, 3, 1.5, x, 500e-9, 0));
    m.push_back(film_dielectric(1.5, x, 1e-7, 500e-9));
    m.push_back(film_dielectric(x, 1.5, x, x));
    m.push_back(film_dielectric(1.5, x, 1e-7, 500e-9, 0.4));
    m.push_back(film_dielectric(x, 1.5, x, x, 0.3, 1, 1, 0.7));
    m.push_back(film_mix(matte(1), glossy(1, 30), x, x, x, x));
    m.push_back(film_mix(microfacet(1, 0.3), microfacet(1, 0.3), 1.5, x, 3e-7, 5e-7));
    m.push_back(film_mix(dielectric(1.5), mirror(1), x, 1.38, x, 5e-7));
    m.push_back(coat(mirror(1), matte(1), x, x, 1.5));
    m.push_back(coat(glossy(1, 30), matte(1), 0.1, 1, x));
  }
  for (double k : {0.0, 1e-20, 1e5, 1e20, 1e25}) m.push_back(conductor(1, k, 0.3));
  for (double bad : {std::nan(""), -1.0, double(INFINITY)}) {
    m.push_back(matte(bad));
    m.push_back(glossy(0.5, bad));
    m.push_back(microfacet(0.5, bad, bad));
    for (Lobe lobe : {Lobe::Dielectric, Lobe::BeckmannDielectric}) {
      m.push_back(dielectric(bad, 0.2, 1, 1, 0, lobe));
      m.push_back(dielectric(1.5, bad, 1, 1, 0, lobe));
      m.push_back(dielectric(1.5, 0.2, 1, 1, bad, lobe));
    }
    m.push_back(mix(matte(0.2), mirror(0.5), bad));
    if (!std::isinf(bad)) m.push_back(scale(matte(0.2), bad));
  }
  m.push_back(refraction(1 + 1e-7));
  m.push_back(fresnel_mix(matte(1), glossy(1, 1e6), 1 + 1e-7));
  m.push_back(fresnel_mix(matte(1), glossy(1, 30), 1));
  m.push_back(fresnel_mix(dielectric(1.5, 0.2), microfacet(1, 0.2), 0.7));
  return m;
}

}  // namespace

TEST_CASE("extreme numbers and directions stay finite and non-negative") {
  const auto directions = hard_directions();
  int index = 0;
  for (const Material& m : extreme_materials()) {
    const materials::Layout layout = m.layout();
    const auto p = m.params<float>();
    const Bsdf<float> bsdf(layout, p.data());
    stats::Random random(++index);
    const int lobe = m.tree.nodes.back().lobe;
    const double first = m.numbers.front(), last = m.numbers.back();
    for (const auto& wo : directions) {
      for (const auto& wi : directions) {
        if (kSanitized && random.next() < 0.8) continue;
        const auto l = bsdf.evaluate(wo, wi, Mode::Radiance);
        CHECK_MESSAGE((sane(l.f) && sane(l.pdf)), lobe, " ", first, " ", last, " wo ", wo.z, " wi ",
                      wi.z, " f ", l.f[0], " pdf ", l.pdf[0]);
      }
      for (int i = 0; i < 20; ++i) {
        const float corner[] = {0, 1 - 0x1p-24f, random.next_float(), random.next_float()};
        const float u = corner[i % 4], u1 = corner[(i / 2) % 4], u2 = corner[(i / 4) % 4];
        const auto s = bsdf.sample(wo, u, u1, u2, Mode::Radiance);
        if (!s) continue;
        CHECK_MESSAGE((sane(s->f) && sane(s->pdf) && s->pdf[0] > 0), lobe, " ", first, " ", last,
                      " wo ", wo.z, " wi ", s->wi.z, " f ", s->f[0], " pdf ", s->pdf[0]);
        const float off = std::abs(length(s->wi) - 1);
        CHECK_MESSAGE(off < 1e-5f, lobe, " ", first, " ", last, " wo ", wo.z, " ", s->wi.z);
      }
    }
  }
}

TEST_CASE("roughness and gloss hand over to the mirror") {
  for (const Material& m : {glossy(0.5, 6e4), microfacet(0.5, 0.009), microfacet(0.5, 0)}) {
    const materials::Layout layout = m.layout();
    const auto p = m.params<float>();
    const Bsdf<float> bsdf(layout, p.data());
    CHECK(bsdf.specular_only());
    const auto s = bsdf.sample(Vec3<float>(direction(50, 0)), 0.5f, 0.2f, 0.3f, Mode::Radiance);
    REQUIRE(s);
    CHECK(s->specular);
    CHECK(s->f[0] * s->wi.z / s->pdf[0] == doctest::Approx(0.5));
  }
}

TEST_CASE("no lobe, nothing scattered") {
  const materials::Layout layout;
  const Bsdf<float> bsdf(layout, nullptr);
  const Vec3<float> w{0, 0, 1};
  CHECK(bsdf.eval(w, w, Mode::Radiance).is_black());
  CHECK(!bsdf.sample(w, 0.5f, 0.5f, 0.5f, Mode::Radiance));
  const Material black = matte(0);
  const materials::Layout l = black.layout();
  const auto p = black.params<float>();
  CHECK(!Bsdf<float>(l, p.data()).sample(w, 0.5f, 0.5f, 0.5f, Mode::Radiance));
}
