// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/film_coat.h and writes them as C++ to the named file: run by the
// build, in half a minute of one core.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "materials/facets.h"
#include "materials/film_coat.h"
#include "materials/tables/films.h"
#include "materials/tables/glass.h"

namespace mms::materials::tables {
namespace {

constexpr int kPoints = kFewGlassPoints, kTerms = axes::kFilmTerms;

double alpha_of(int i) { return glass_alpha_at(double(i) / (axes::kFilmGlassAlpha - 1)); }
double index_of(int i) { return glass_index_at(double(i) / (axes::kFilmGlassIndex - 1)); }

/// For each k, the moments over z outside of t_k(c) times what facets let through, where that or
/// what is reflected goes outside.
Numbers<kPoints * kTerms> changes(bool inside, const Ggx<double>& facets, double glass, Vec3d w) {
  const double eta = inside ? 1 / glass : glass;
  return interface_mean(facets, eta, w, inside ? 14 : 24, [inside](const Way& up, const Way& down) {
    Numbers<kPoints * kTerms> to;
    const Way& out = inside ? down : up;
    const double leaves = down.share * (1 - out.taken);
    if (!(leaves > 0)) return to;
    const auto at = chebyshev_terms<kPoints>(out.cosine);
    const auto film = chebyshev_terms<kTerms>(out.facet);
    for (int k = 0; k < kTerms; ++k)
      for (int m = 0; m < kPoints; ++m) to.of[k * kPoints + m] = leaves * film[k] * at[m];
    return to;
  });
}

/// The weights of the points, [point][k], from the moments of each of `count` functions.
void put_weights(const double* moments, int count, double* to) {
  for (int k = 0; k < count; ++k) {
    std::array<double, kPoints> its;
    std::copy_n(moments + k * kPoints, kPoints, its.begin());
    const auto weights = point_weights(its);
    for (int m = 0; m < kPoints; ++m) to[m * count + k] = weights[m];
  }
}

std::vector<float> side(bool inside) {
  using namespace axes;
  const int directions = kFilmGlassDirection[inside];
  Grid grid({kFilmGlassAlpha, kFilmGlassIndex, directions, kPoints * kTerms});
  parallel(kFilmGlassAlpha * kFilmGlassIndex, [&](int i) {
    const double alpha = alpha_of(i / kFilmGlassIndex), glass = index_of(i % kFilmGlassIndex);
    for (int d = 0; d < directions; ++d) {
      const double z = glass_cosine_at(inside, double(d) / (directions - 1), alpha,
                                       inside ? 1 / glass : glass, alpha);
      const auto all =
          changes(inside, Ggx<double>{{alpha, alpha}}, glass, {std::sqrt(1 - z * z), 0, z});
      put_weights(all.of.data(), kTerms, &grid.values[(i * directions + d) * kPoints * kTerms]);
    }
  });
  return spline_of(grid);
}

/// The moments over z of l(w), and then of each D_k(w), of materials/film_energy.h, outside.
Numbers<kPoints*(1 + kTerms)> losses(const Ggx<double>& facets, double glass) {
  const InterfaceLoss<double> loss{facets.interface(), facets.ax, facets.ay, glass};
  return height_mean(
      [&](double z, double s) {
        const auto each = interface_mean(
            facets, glass, {s, 0, z}, 24,
            [glass](const Way& up, const Way& down) { return changes_at(glass, up, down); });
        const double l = loss.at({s, 0, z});
        const auto at = chebyshev_terms<kPoints>(z);
        Numbers<kPoints*(1 + kTerms)> to;
        for (int k = 0; k <= kTerms; ++k)
          for (int m = 0; m < kPoints; ++m)
            to.of[k * kPoints + m] = (k == 0 ? l : each.of[k - 1]) * at[m];
        return to;
      },
      facets.ax * facets.ay, 0, 8);
}

std::vector<float> further() {
  using namespace axes;
  Grid grid({kFilmGlassAlpha, kFilmGlassIndex, kPoints * (1 + kTerms)});
  parallel(kFilmGlassAlpha * kFilmGlassIndex, [&](int i) {
    const double alpha = alpha_of(i / kFilmGlassIndex), glass = index_of(i % kFilmGlassIndex);
    put_weights(losses(Ggx<double>{{alpha, alpha}}, glass).of.data(), 1 + kTerms,
                &grid.values[i * kPoints * (1 + kTerms)]);
  });
  return spline_of(grid);
}

}  // namespace
}  // namespace mms::materials::tables

int main(int argc, char** argv) {
  using namespace mms::materials::tables;
  return make_tables(argc, argv, [](const TableFiles& to) {
    write_numbers(to, "kGgxFilmGlassOutside", side(false));
    write_numbers(to, "kGgxFilmGlassInside", side(true));
    write_numbers(to, "kGgxFilmGlassFurther", further());
  });
}
