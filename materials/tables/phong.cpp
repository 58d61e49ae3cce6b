// SPDX-License-Identifier: Apache-2.0
// Computes the table of materials/phong_coat.h and writes it as C++ to the named file: run by the
// build, in seconds.
#include <algorithm>
#include <array>
#include <cmath>
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

std::array<double, kGlassPoints> weights(double n, double momentum) {
  const Kernel kernel{n};
  const double reach = kernel.reach();
  // Where the circle of momenta enters the kernel's, and where it is all in it.
  const double ends[] = {std::max(momentum - reach, 0.0), std::abs(reach - momentum),
                         std::min(momentum + reach, 1.0)};
  std::array<double, kGlassPoints> sum{};
  const auto add = [&](double from, double to) {
    constexpr int parts = 16, points = 8;
    const double z0 = std::sqrt((1 - to) * (1 + to)), z1 = std::sqrt((1 - from) * (1 + from));
    for (int part = 0; part < parts; ++part)
      for (int k = 0; k < points; ++k) {
        // Points crowd at both ends, where the circle's share begins as a root.
        const double x = (part + gauss<points>().x[k]) / parts;
        const double z = z0 + (z1 - z0) * x * x * (3 - 2 * x);
        const double weight = gauss<points>().w[k] / parts * (z1 - z0) * 6 * x * (1 - x);
        const double p = std::sqrt((1 - z) * (1 + z));
        const auto terms = chebyshev_terms<kGlassPoints>(z);
        const double there = weight * z * kernel.around(momentum, p);
        for (int i = 0; i < kGlassPoints; ++i) sum[i] += there * terms[i];
      }
  };
  const double middle = std::min(ends[1], 1.0);
  if (ends[0] < middle) add(ends[0], middle);
  if (middle < ends[2]) add(middle, ends[2]);
  return point_weights(sum);
}

std::vector<float> table() {
  using namespace axes;
  Grid grid({kPhongExponent, kPhongMomentum, kGlassPoints});
  parallel(kPhongExponent, [&](int e) {
    constexpr double most = 2 * kMaxExponent;
    const double n = most * inverse([](double x) { return phong_exponent(most * x); },
                                    double(e) / (kPhongExponent - 1));
    for (int m = 0; m < kPhongMomentum; ++m) {
      const double momentum = 2 * inverse([n](double x) { return phong_momentum(2 * x, n); },
                                          double(m) / (kPhongMomentum - 1));
      const auto w = weights(n, momentum);
      std::copy(w.begin(), w.end(), &grid.values[(e * kPhongMomentum + m) * kGlassPoints]);
    }
  });
  return spline_of(grid);
}

}  // namespace
}  // namespace mms::materials::tables

int main(int argc, char** argv) {
  using namespace mms::materials::tables;
  return make_tables(argc, argv,
                     [](const TableFiles& to) { write_numbers(to, "kPhong", table()); });
}
