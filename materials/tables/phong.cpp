// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/phong_coat.h and writes them as C++ to the named file: run by
// the build, in half a minute of one core.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "base/quadrature.h"
#include "materials/phong_coat.h"
#include "materials/tables/glass.h"

namespace mms::materials::tables {
namespace {

/// K of materials/phong_glass.h.
struct Kernel {
  double n;

  double at(double p2) const {
    return p2 < 1 ? (n + 2) / (2 * kPi<double>)*std::exp(n / 2 * std::log1p(-p2)) : 0;
  }
  /// Beyond this it has less than 1e-14 of its integral.
  double reach() const { return std::sqrt(-std::expm1(-64 / (n + 2))); }
  /// The integral over the azimuths of `p`, `momentum` away.
  double around(double momentum, double p) const {
    const double r = reach(), product = 2 * momentum * p;
    const double least = momentum * momentum + p * p - r * r;
    if (least >= product) return 0;
    const double most = least <= -product ? kPi<double> : std::acos(least / product);
    const double d = momentum - p;
    return 2 * integrate<24>(
                   [&](double phi) {
                     const double s = std::sin(phi / 2);
                     return at(d * d + 2 * product * s * s);
                   },
                   0, most);
  }
};

using Weights = std::array<double, kGlassPoints>;

/// Of light outside of momenta up to `most`: without and with `share(z)` of it.
template <class Share>
std::array<Weights, 2> weights(double n, double momentum, double most, const Share& share) {
  const Kernel kernel{n};
  const double reach = kernel.reach();
  // Where the circle of momenta enters the kernel's, where it is all in it, and the edge of F.
  const double least = std::max(momentum - reach, 0.0), end = std::min(momentum + reach, most);
  double ends[] = {least, std::abs(reach - momentum), 1, end};
  for (double& p : ends) p = std::clamp(p, std::min(least, end), end);
  std::sort(std::begin(ends), std::end(ends));
  Weights sum[2] = {};
  const auto add = [&](double from, double to) {
    constexpr int parts = 16, points = 8;
    const auto cosine = [most](double p) { return std::sqrt((most - p) * (most + p)) / most; };
    const double z0 = cosine(to), z1 = cosine(from);
    for (int part = 0; part < parts; ++part)
      for (int k = 0; k < points; ++k) {
        // Points crowd at both ends, where the circle's share begins as a root.
        const double x = (part + gauss<points>().x[k]) / parts;
        const double z = z0 + (z1 - z0) * x * x * (3 - 2 * x);
        const double weight = gauss<points>().w[k] / parts * (z1 - z0) * 6 * x * (1 - x);
        const double p = most * std::sqrt((1 - z) * (1 + z));
        const auto terms = chebyshev_terms<kGlassPoints>(z);
        const double there = weight * most * most * z * kernel.around(momentum, p);
        const double its = there * share(z);
        for (int i = 0; i < kGlassPoints; ++i)
          sum[0][i] += there * terms[i], sum[1][i] += its * terms[i];
      }
  };
  for (std::size_t i = 0; i + 1 < std::size(ends); ++i)
    if (ends[i] < ends[i + 1]) add(ends[i], ends[i + 1]);
  return {point_weights(sum[0]), point_weights(sum[1])};
}

double exponent_at(double place) {
  constexpr double most = 2 * kMaxExponent;
  return most * inverse([](double x) { return axes::phong_exponent(most * x); }, place);
}

std::vector<float> table() {
  using namespace axes;
  Grid grid({kPhongExponent, kPhongMomentum, kGlassPoints});
  parallel(kPhongExponent, [&](int e) {
    const double n = exponent_at(double(e) / (kPhongExponent - 1));
    for (int m = 0; m < kPhongMomentum; ++m) {
      const double momentum = 2 * inverse([n](double x) { return phong_momentum(2 * x, n); },
                                          double(m) / (kPhongMomentum - 1));
      const Weights w = weights(n, momentum, 1, [](double) { return 0.0; })[0];
      std::copy(w.begin(), w.end(), &grid.values[(e * kPhongMomentum + m) * kGlassPoints]);
    }
  });
  return spline_of(grid);
}

/// Of glass of a lower index than outside.
std::vector<float> low_table() {
  using namespace axes;
  Grid grid({kLowPhongExponent, kLowPhongIndex, kLowPhongMomentum, 2 * kGlassPoints});
  parallel(kLowPhongExponent * kLowPhongIndex, [&](int i) {
    const double n = exponent_at(double(i / kLowPhongIndex) / (kLowPhongExponent - 1));
    const double index =
        glass_index_at(double(i % kLowPhongIndex) / (kLowPhongIndex - 1), /*falls=*/true);
    const double most = 1 / index;
    for (int m = 0; m < kLowPhongMomentum; ++m) {
      const double momentum =
          most * inverse([&](double x) { return low_phong_momentum(most * x, n, index); },
                         double(m) / (kLowPhongMomentum - 1));
      const auto both =
          weights(n, momentum, most, [&](double z) { return fresnel_split(z, index).reflected; });
      double* to = &grid.values[(i * kLowPhongMomentum + m) * 2 * kGlassPoints];
      for (const Weights& w : both) to = std::copy(w.begin(), w.end(), to);
    }
  });
  return spline_of(grid);
}

}  // namespace
}  // namespace mms::materials::tables

int main(int argc, char** argv) {
  using namespace mms::materials::tables;
  return make_tables(argc, argv, [](const TableFiles& to) {
    write_numbers(to, "kPhong", table());
    write_numbers(to, "kLowPhong", low_table());
  });
}
