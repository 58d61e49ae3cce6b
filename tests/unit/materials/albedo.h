// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Albedo by quadrature, which uses nothing of a model's own sampling.

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "base/quadrature.h"
#include "tests/sanitized.h"
#include "tests/setting.h"
#include "tests/unit/materials/make.h"

namespace mms::test {

/// How many settings a sweep of energy tries: `all` of them in `./run nightly`, half else.
inline int swept(int all) { return setting("MMS_ENERGY_SWEEP", 0) > 0 ? all : all / 2; }

/// The integral over the hemisphere of z > 0 or z < 0 of `value(wi)` |wi.z|: over x = cos^2 and the
/// azimuth from `wo`'s opposite, both from the direction (cos^2 = `peak`) where the lobe may be
/// narrow, as eighth powers near it: `panels` Gauss rules of N points along each. Where models
/// change across cos^2 = `edge`, each side of it is integrated alone. Where one point in 64 says
/// that both sides of wo's plane are alike, as of round facets, one is.
template <int N = 16, class Value>
double over_hemisphere(const Value& value, Vec3d wo, bool upper, double peak, int panels,
                       double edge = 0) {
  const int n = N * panels;
  const double start = std::atan2(-wo.y, -wo.x);
  std::vector<double> offset(n), weight(n);  // 1 - (1 - u^8)^2: smooth in z where z is 0
  for (int i = 0; i < n; ++i) {
    const double u = (i / N + gauss<N>().x[i % N]) / panels;
    const double far = 1 - std::pow(u, 8);
    offset[i] = 1 - far * far;
    weight[i] = 16 * far * std::pow(u, 7) * gauss<N>().w[i % N] / panels;
  }
  const auto f = [&](double x, double azimuth) {
    const double z = std::sqrt(x), r = std::sqrt(1 - x);
    return value(
        Vec3d{r * std::cos(start + azimuth), r * std::sin(start + azimuth), upper ? z : -z});
  };
  std::vector<std::array<double, 2>> parts;  // from, to
  for (const auto& [a, b] : {std::array{0.0, edge}, std::array{edge, 1.0}})
    if (a <= peak && peak <= b)
      parts.insert(parts.end(), {{peak, a}, {peak, b}});
    else
      parts.push_back(b == edge ? std::array{b, a} : std::array{a, b});
  bool alike = true;
  for (const auto& [from, to] : parts)
    for (int i = 0; from != to && i < n; i += 8)
      for (int k = 0; alike && k < n; k += 8) {
        const double x = from + (to - from) * offset[i], azimuth = kPi<double> * offset[k];
        const double a = f(x, azimuth), b = f(x, -azimuth);
        alike = std::abs(a - b) <= 1e-9 * std::max(a, b);
      }
  double sum = 0;
  for (const auto& [from, to] : parts)
    for (int i = 0; from != to && i < n; ++i) {
      const double x = from + (to - from) * offset[i];
      double ring = 0;
      for (int k = 0; k < n; ++k) {
        const double azimuth = kPi<double> * offset[k], one = f(x, azimuth);
        ring += weight[k] * (one + (alike ? one : f(x, -azimuth)));
      }
      sum += std::abs(to - from) * weight[i] * ring;
    }
  return sum * kPi<double> / 2;  // dx = 2 cos sin dtheta
}

/// What that hemisphere gets of `wo`, without deltas.
template <int N = 16>
double hemisphere(const materials::Bsdf<double>& bsdf, Vec3d wo, bool upper, double peak,
                  int panels, double edge = 0) {
  const auto choice = bsdf.choose(wo);
  return over_hemisphere<N>(
      [&](Vec3d wi) { return bsdf.evaluate(wo, wi, materials::Mode::Importance, choice).f[0]; }, wo,
      upper, peak, panels, edge);
}

/// Albedo towards the side of `wo` without deltas.
inline double albedo(const Material& m, double degrees, double azimuth = 0,
                     int panels = kSanitized ? 3 : 4) {
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  const Vec3d wo = direction(degrees, azimuth);
  return hemisphere(materials::Bsdf<double>(layout, p.data()), wo, wo.z > 0, wo.z * wo.z, panels);
}

/// Weights of the deltas of light along `wo`, of which there is at most one on each side: [0] on
/// its own, [1] across. The choice among lobes by multiples of the golden ratio.
inline std::array<double, 2> deltas(const materials::Layout& layout, const double* p, Vec3d wo) {
  const materials::Bsdf<double> bsdf(layout, p);
  const auto choice = bsdf.choose(wo);
  std::array<double, 2> weights{};
  bool seen[2] = {!layout.reflects(), !layout.transmits()};
  constexpr int kDraws = 16384;
  for (int k = 0; k < kDraws && !(seen[0] && seen[1]); ++k) {
    const double u = std::fmod((k + 0.5) * std::numbers::phi, 1.0);
    const auto s = bsdf.sample(wo, u, 0.5, 0.5, materials::Mode::Importance, choice);
    if (!s || !s->specular || std::exchange(seen[s->transmitted], true)) continue;
    weights[s->transmitted] = s->f[0] * std::abs(s->wi.z);
  }
  return weights;
}

/// cos^2 of the direction on the far side, opposite to `wo`, to which most goes.
inline double brightest_through(const materials::Bsdf<double>& bsdf, Vec3d wo) {
  const auto choice = bsdf.choose(wo);
  const double a = std::atan2(-wo.y, -wo.x);
  double best = 0, most = 0;
  constexpr int kSteps = 400;
  for (int k = 0; k <= kSteps; ++k) {
    const double z = double(k) / kSteps, r = std::sqrt(1 - z * z);
    const Vec3d wi{r * std::cos(a), r * std::sin(a), wo.z > 0 ? -z : z};
    const double f = bsdf.evaluate(wo, wi, materials::Mode::Importance, choice).f[0];
    if (f > most) most = f, best = z * z;
  }
  return best;
}

/// cos^2 of the critical angle of `glossy_refraction` on the side of z > 0 or z < 0, where it ends,
/// or of `phong_glass`, which has an edge there; 0 without any, and on the side of the lower index.
inline double end_of_lobe(const materials::Layout& layout, const double* p, bool upper) {
  for (const auto& node : layout.nodes()) {
    const double n = p[node.first_param];
    if ((node.lobe == Lobe::GlossyRefraction || node.lobe == Lobe::PhongGlass) && upper != (n > 1))
      return 1 - 1 / std::max(n * n, 1 / (n * n));
  }
  return 0;
}

/// All that becomes of light along `wo`: by the first of ever finer rules that says what the one
/// before does within `tolerance`. Multiples of 7 panels have an edge where models change across wo
/// (6/7 of the azimuth's axis, within 6e-4).
inline double two_sided(const Material& m, Vec3d wo, double tolerance) {
  const materials::Layout layout = m.layout();
  const auto p = m.params<double>();
  const materials::Bsdf<double> bsdf(layout, p.data());
  const auto [here, beyond] = deltas(layout, p.data(), wo);
  double sum = here + beyond;
  if (bsdf.specular_only()) return sum;
  for (const bool across : {false, true}) {
    if (!(across ? layout.transmits() : layout.reflects())) continue;
    const bool upper = across != (wo.z > 0);
    const double edge = end_of_lobe(layout, p.data(), upper);
    const double peak = across ? brightest_through(bsdf, wo) : wo.z * wo.z;
    const auto side = [&](int panels) { return hemisphere(bsdf, wo, upper, peak, panels, edge); };
    double coarse = hemisphere<8>(bsdf, wo, upper, peak, 7, edge), fine = side(7);
    for (int panels = 14; std::abs(fine - coarse) > tolerance; panels *= 2) {
      REQUIRE(panels <= 112);
      coarse = fine;
      fine = side(panels);
    }
    sum += fine;
  }
  return sum;
}

}  // namespace mms::test
