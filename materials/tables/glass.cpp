// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/glass_coat.h and writes them as C++ to the named file: run by
// the build, in a quarter of a minute of one core.
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "base/quadrature.h"
#include "materials/glass_coat.h"
#include "materials/tables/grid.h"
#include "materials/tables/losses.h"
#include "materials/tables/slopes.h"

namespace mms::materials {
namespace {

#pragma GCC diagnostic ignored "-Wunused"
#include "energy_tables.inc"  // made by the build: materials/tables/energy.cpp

}  // namespace

namespace tables {
namespace {

const InterfaceTables& losses_of(const Ggx<double>&) {
  static const InterfaceTables tables{{kGgxDense, kGgxRare},
                                      {kGgxDenseMean, kGgxRareMean},
                                      kGgxBent,
                                      {},
                                      {},
                                      kGgxLeastMean,
                                      kGgxKink};
  return tables;
}
const InterfaceTables& losses_of(const Beckmann<double>&) {
  static const InterfaceTables tables{{kBeckmannDense, kBeckmannRare},
                                      {kBeckmannDenseMean, kBeckmannRareMean},
                                      kBeckmannBent,
                                      {},
                                      {},
                                      kBeckmannLeastMean,
                                      kBeckmannKink};
  return tables;
}

double index_at(double place) {
  using namespace axes;
  const double x = kLeastGlassIndex + (kMostGlassIndex - kLeastGlassIndex) * place;
  return (1 + x * x * x * x) / (1 - x * x * x * x);
}
double alpha_at(double place) {
  return std::pow(axes::kLeastGlassAlpha + (1 - axes::kLeastGlassAlpha) * place, 3);
}

/// A number for each index of coats on the axis.
template <bool Inside>
struct Coats {
  static constexpr int kCount = axes::kGlassCoat[Inside];
  std::array<double, kCount> of{};

  Coats operator*(double x) const {
    Coats product = *this;
    for (double& v : product.of) v *= x;
    return product;
  }
  Coats& operator+=(const Coats& b) {
    for (int k = 0; k < kCount; ++k) of[k] += b.of[k];
    return *this;
  }

  /// Fresnel's T along a direction of |cosine| `z`.
  static Coats through(double z) {
    Coats t;
    for (int k = 0; k < kCount; ++k)
      t.of[k] = fresnel_split(z, index_at(double(k) / (kCount - 1))).transmitted;
    return t;
  }
  /// What the coats do not let through of light that leaves outside along a direction of |cosine|
  /// `z`: F where it comes from inside, else what its factor lacks.
  static Coats lacks(double z) {
    static const Coats normal = through(1);
    Coats lack = through(z);
    for (int k = 0; k < kCount; ++k)
      lack.of[k] = 1 - lack.of[k] / (Inside ? 1 : std::max(normal.of[k], lack.of[k]));
    return lack;
  }
};

/// What the coats do not let through of further bounces: their mean over l outside (materials/
/// energy.h), as a share of all of them.
template <bool Inside>
Coats<Inside> further(const InterfaceTables& tables, double alpha, double glass) {
  const InterfaceLoss<double> outside{&tables, alpha, alpha, glass},
      inside{&tables, alpha, alpha, 1 / glass};
  const double a2 = alpha * alpha, log = std::log1p(1 / a2);
  const double mean_outside = outside.mean(), mean_inside = inside.mean();
  const double across = Inside ? transmitted_share(mean_inside, mean_outside, 1 / glass)
                               : transmitted_share(mean_outside, mean_inside, glass);
  Coats<Inside> sum;
  constexpr int kPanels = 24;
  for (int n = 0; n < 8 * kPanels; ++n) {  // z^2 + alpha^2 spread evenly over its logarithm
    const double u = (n / 8 + gauss<8>().x[n % 8]) / kPanels;
    const double z2 = std::min(1.0, a2 * std::expm1(u * log)), z = std::sqrt(z2);
    const double l = outside.at({std::sqrt(1 - z2), 0, z});
    sum += Coats<Inside>::lacks(z) * (l * (z2 + a2) * log * gauss<8>().w[n % 8] / kPanels);
  }
  return sum * ((Inside ? across : 1 - across) / mean_outside);
}

/// What coats send back of light along a direction of |cosine| `z`.
template <bool Inside, class Facets>
Coats<Inside> sent_back(const Facets& facets, double glass, double z,
                        const Coats<Inside>& further) {
  const double eta = Inside ? 1 / glass : glass, s = std::sqrt(1 - z * z);
  Coats<Inside> sent =
      interface_mean(facets, eta, {s, 0, z}, 16, [](const Way& up, const Way& down) {
        const Way& out = Inside ? down : up;
        const double leaves = out.share * (1 - out.taken);
        return leaves > 0 ? Coats<Inside>::lacks(out.cosine) * leaves : Coats<Inside>();
      });
  sent +=
      further * InterfaceLoss<double>{&losses_of(facets), facets.ax, facets.ay, eta}.at({s, 0, z});
  if (Inside) return sent;
  const Coats<Inside> through = Coats<Inside>::through(z);
  for (int k = 0; k < sent.kCount; ++k) sent.of[k] *= through.of[k];
  return sent;
}

template <bool Inside, template <class> class Distribution>
void write_side(std::FILE* to, const std::string& name) {
  using namespace axes;
  constexpr int widths = kGlassAlpha[Inside], indices = kGlassIndex[Inside],
                directions = kGlassDirection[Inside], coats = kGlassCoat[Inside];
  std::vector<Coats<Inside>> sent(widths * indices * directions);
  parallel(widths * indices, [&](int i) {
    const double alpha = alpha_at(double(i / indices) / (widths - 1));
    const double glass = index_at(double(i % indices) / (indices - 1));
    const Distribution<double> facets{{alpha, alpha}};
    const auto rest = further<Inside>(losses_of(facets), alpha, glass);
    for (int d = 0; d < directions; ++d) {
      const double place = std::min(double(d) / (directions - 1), 1 - kLeast);
      const double z = cosine(
          place, [&](double c, double s) { return glass_direction(Inside, c, s, alpha, glass); });
      sent[i * directions + d] =
          sent_back<Inside>(facets, glass, std::max(z, kLeast * alpha), rest);
    }
  });
  Grid grid({widths, indices, directions, coats}, [](const double*) { return 0.0; });
  for (std::size_t i = 0; i < grid.values.size(); ++i) {
    const double value = sent[i / coats].of[i % coats];
    grid.values[i] = Inside ? std::sqrt(std::max(value, 0.0)) : value;
  }
  const std::vector<double> spline = grid.spline();
  write_numbers(to, name, {spline.begin(), spline.end()}, 6);
}

}  // namespace
}  // namespace tables
}  // namespace mms::materials

int main(int argc, char** argv) {
  using namespace mms::materials;
  return tables::make_tables(argc, argv, [](std::FILE* to) {
    tables::write_side<false, Ggx>(to, "kGgxOutside");
    tables::write_side<true, Ggx>(to, "kGgxInside");
    tables::write_side<false, Beckmann>(to, "kBeckmannOutside");
    tables::write_side<true, Beckmann>(to, "kBeckmannInside");
  });
}
