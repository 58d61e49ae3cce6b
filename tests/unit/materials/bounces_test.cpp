// SPDX-License-Identifier: Apache-2.0
// What one bounce off facets of an interface loses, as the tables are made from it: against sums
// over the normals that a direction sees, which share none of its quadrature.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/energy.h"
#include "materials/tables/slopes.h"

using namespace mms;
using namespace mms::materials;

namespace {

/// The same by a lattice of visible normals.
double summed_loss(const auto& facets, double eta, Vec3d wo) {
  constexpr int kNormals = 200000;
  const double hidden = facets.shadow(wo);
  const auto taken = [&](Vec3d wi) {
    const double other = wo.z * facets.shadow(wi), c = std::abs(wi.z);
    return other / (wo.z * c + hidden * c + other);
  };
  double sum = 0;
  for (int k = 0; k < kNormals; ++k) {
    const double u = (k + 0.5) / kNormals, v = std::fmod((k + 0.5) * std::numbers::phi, 1.0);
    const Vec3d h = facets.sample_visible(wo, u, v);
    const double c = std::min(1.0, dot(wo, h)), g2 = eta * eta - (1 - c) * (1 + c);
    const double reflected = fresnel_dielectric(c, eta);
    const Vec3d up = h * (2 * c) - wo;
    sum += reflected * (up.z > 0 ? taken(up) : 1);
    if (!(g2 > 0)) continue;
    const Vec3d down = (h * (c - std::sqrt(g2)) - wo) / eta;
    sum += (1 - reflected) * (down.z < 0 ? taken(down) : 1);
  }
  return sum / kNormals;
}

template <template <class> class Distribution>
void check() {
  struct Setting {
    double wide, narrow, eta;
    Vec3d wo;
  };
  // Stretched facets whose slopes crowd about a line that conics cross; wide ones across which
  // light leaves; next to the critical angle; round ones.
  const Setting settings[] = {
      {0.198, 0.0198, 0.8309, {0.7971, 0.6039, 0.00499}},
      {0.0486, 0.00486, 0.8309, {0.7904, 0.6125, 0.0003}},
      {0.174, 0.0174, 0.8309, {0.9135, 0.4069, 0.00499}},
      {0.0912, 0.0103, 0.8851, {0.7414, 0.6708, 0.0205}},
      {0.502, 0.0502, 0.8309, {0.9197, 0.3919, 0.0215}},
      {0.158, 0.0158, 0.9857, {0.6472, 0.7623, 0.00115}},
      {0.349, 0.0349, 0.8309, {0.9069, 0.3938, 0.149}},
      {1.92, 0.291, 0.4546, {0.07894, 0.9939, 0.0768}},
      {3.16, 0.316, 1.76, {0.1055, 0.9924, 0.0641}},
      {2.57, 0.389, 2.401, {0.1491, 0.9841, 0.0966}},
      {0.0808, 0.808, 0.714, {0.699, 0.123, 0.7047}},  // the wider axis is y
      {0.3, 0.3, 0.66, {0.7, 0, 0.714}},
      {0.3, 0.3, 1.5, {0.999, 0, 0.0447}},
  };
  double worst = 0;
  for (const auto& [wide, narrow, eta, along] : settings) {
    const Distribution<double> facets{{wide, narrow}};
    const Vec3d wo = normalize(along);
    const double loss = tables::interface_loss(facets, eta, wo, tables::slopes_of(facets).kPoints);
    const double off = loss - summed_loss(facets, eta, wo);
    worst = std::max(worst, std::abs(off));
    CHECK_MESSAGE(std::abs(off) < 2e-4, wide, " ", narrow, " ", eta, ": ", loss, " off by ", off);
  }
  MESSAGE("worst ", worst);
}

}  // namespace

TEST_CASE("what one bounce off an interface of facets loses") {
  SUBCASE("ggx") { check<Ggx>(); }
  SUBCASE("beckmann") { check<Beckmann>(); }
}

TEST_CASE("slopes and masking without libm are those of libm") {
  const auto relative = [](double value, double exact) { return std::abs(value / exact - 1); };
  double ggx = 0, beckmann = 0, shadow = 0;
  float ggx_float = 0, beckmann_float = 0;  // of slopes, from those of double
  double shadow_float = 0;
  for (int k = 1; k < 4000; ++k)
    for (const double m : {k / 4000.0, 1 - std::pow(10, -k / 400.0)}) {
      // Next to 1, tan is of the angle that is left: m pi / 2 would round it away.
      const double slope = 1 / std::tan((1 - m) * kPi<double> / 2);
      ggx = std::max(ggx, relative(tables::GgxSlopes::slope(m), slope));
      CHECK(tables::GgxSlopes::slope(-m) == -tables::GgxSlopes::slope(m));
      beckmann = std::max(beckmann, std::abs(tables::BeckmannSlopes::slope(m) - std::atanh(m)));
      const float f = float(m);
      if (f == 1) continue;
      ggx_float = std::max(
          ggx_float,
          std::abs(tables::GgxSlopes::slope(f) / float(tables::GgxSlopes::slope(double(f))) - 1));
      beckmann_float =
          std::max(beckmann_float, std::abs(tables::BeckmannSlopes::slope(f) -
                                            float(tables::BeckmannSlopes::slope(double(f)))));
    }
  const Beckmann<double> facets{{0.5, 0.05}};
  const Beckmann<float> facets_float{{0.5f, 0.05f}};
  for (int k = 1; k < 4000; ++k) {
    const double a = float(6.0 * k / 4000);  // the same of both types
    const Vec3d w{2, 0, a};                  // of any length; stretched, its tangent is 1
    // In long double: what is left of both parts of a double is a few digits.
    const long double b = a,
                      left = std::exp(-b * b) / std::sqrt(kPi<long double>) - b * std::erfc(b);
    shadow =
        std::max(shadow, relative(tables::BeckmannSlopes::shadow(facets, w), double(left / 2)));
    shadow_float = std::max(
        shadow_float,
        relative(tables::BeckmannSlopes::shadow(facets_float, Vec3<float>(w)), double(left / 2)));
  }
  CHECK(ggx < 5e-11);
  CHECK(beckmann < 1e-14);
  CHECK(shadow < 2e-8);
  // Of float, 2^-24 is half a step; an exponential is off by those of its argument, up to 36.
  CHECK(ggx_float < 8 * 0x1p-24f);
  CHECK(beckmann_float < 2 * 9 * 0x1p-24f);  // up to 9
  CHECK(shadow_float < 2 * 36 * 0x1p-24f);
  MESSAGE("worst ", ggx, " ", beckmann, " ", shadow, "; of float ", ggx_float, " ", beckmann_float,
          " ", shadow_float);
}

TEST_CASE("tables of stretched facets hold that where their kink crosses the critical angle") {
  double worst = 0;
  for (const double eta : {0.685, 0.698, 0.702, 0.7071, 0.712, 0.742})
    for (const double wide : {0.1, 0.4, 0.63, 0.8, 1.0})
      for (const double aspect : {5.0, 10.0})
        for (const double azimuth : {1.0, 1.29, 1.45})
          for (const double off : {-0.02, 0.0, 0.02}) {
            const Ggx<double> facets{{wide, wide / aspect}};
            const double z = std::sqrt((1 - eta) * (1 + eta)) + off, s = std::sqrt(1 - z * z);
            const Vec3d w{s * std::cos(azimuth), s * std::sin(azimuth), z};
            const double is = tables::interface_loss(facets, eta, w, 32);
            const double held =
                InterfaceLoss<double>{facets.interface(), facets.ax, facets.ay, eta}.at(w);
            worst = std::max(worst, std::abs(held - is));
            CHECK_MESSAGE(std::abs(held - is) < 1e-3, eta, " ", wide, " ", aspect, " ", azimuth,
                          " ", off, ": ", held - is);
          }
  MESSAGE("worst ", worst);
}
