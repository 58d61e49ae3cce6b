// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/glass_coat.h and writes them as C++ to the named file: run by
// the build, in a minute of one core.
#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "materials/glass_coat.h"
#include "materials/tables/glass.h"
#include "materials/tables/shapes.h"

namespace mms::materials {
namespace tables {
namespace {

/// Those of further bounces, as a share of all of them.
template <bool Inside, int Points, class Facets>
Moments<Points> further(const Facets& facets, double glass) {
  const double mean_outside =
      InterfaceLoss<double>{facets.interface(), facets.ax, facets.ay, glass}.mean();
  const double mean_inside =
      InterfaceLoss<double>{facets.interface(), facets.ax, facets.ay, 1 / glass}.mean();
  const double outside = Inside ? transmitted_share(mean_inside, mean_outside, 1 / glass)
                                : 1 - transmitted_share(mean_outside, mean_inside, glass);
  return further_outside<Points>(facets, glass) * outside;
}

/// The weights for light along `w`, z > 0.
template <bool Inside, int Points, class Facets>
std::array<double, Points> weights(const Facets& facets, double glass, Vec3d w,
                                   const Moments<Points>& further) {
  const double eta = Inside ? 1 / glass : glass;
  Moments<Points> sum =
      interface_mean(facets, eta, w, Inside ? 14 : 24, [](const Way& up, const Way& down) {
        const Way& out = Inside ? down : up;
        const double leaves = out.share * (1 - out.taken);
        return leaves > 0 ? terms_at<Points>(out.cosine) * leaves : Moments<Points>();
      });
  sum += further * InterfaceLoss<double>{facets.interface(), facets.ax, facets.ay, eta}.at(w);
  return point_weights(sum.of);
}

/// The same by fewer points.
std::array<double, kFewGlassPoints> fewer(const std::array<double, kGlassPoints>& weights) {
  std::array<double, kFewGlassPoints> few{};
  const auto& matrix = chebyshev_transfer<kGlassPoints, kFewGlassPoints>();
  for (int i = 0; i < kGlassPoints; ++i)
    for (int m = 0; m < kFewGlassPoints; ++m) few[m] += weights[i] * matrix[i][m];
  return few;
}

/// From that of round ones.
template <bool Inside, template <class> class Distribution>
std::vector<float> bent_side(const GlassTables& round) {
  constexpr axes::BentGlassGrid grid = axes::kBentGlass[Inside];
  constexpr int points = kFewGlassPoints;
  const ShapeFit shapes(grid.degree);
  const int count = shapes.count(), terms = shapes.terms();
  Grid bent({grid.width, grid.index, grid.direction, points * terms});
  parallel(grid.width * grid.index, [&](int i) {
    const double like = glass_alpha_at(double(i / grid.index) / (grid.width - 1));
    const double glass = glass_index_at(double(i % grid.index) / (grid.index - 1));
    std::vector<std::vector<double>> values(grid.direction * points, std::vector<double>(count));
    for (int shape = 0; shape < count; ++shape) {
      auto seen = shapes.facets_like(shape, like, axes::widening(Inside ? 1 / glass : glass, like));
      const double x = seen.x, y = seen.y;
      const Distribution<double> facets{{seen.wide, seen.narrow}};
      const auto further_bounces = further<Inside, points>(facets, glass);
      for (int d = 0; d < grid.direction; ++d) {
        const double z =
            glass_cosine_at(Inside, double(d) / (grid.direction - 1), like, glass, seen.root());
        const double s = std::sqrt(1 - z * z);
        seen.x = x * s, seen.y = y * s, seen.z = z;
        const auto all =
            weights<Inside, points>(facets, glass, {seen.x, seen.y, z}, further_bounces);
        const auto alike = fewer(round_weights(round, seen, Inside, glass));
        for (int m = 0; m < points; ++m) values[d * points + m][shape] = all[m] - alike[m];
      }
    }
    for (int k = 0; k < grid.direction * points; ++k)
      for (int t = 0; t < terms; ++t)
        bent.values[(i * grid.direction * points + k) * terms + t] =
            shapes.term(t, values[k].data());
  });
  return spline_of(bent);
}

template <bool Inside, template <class> class Distribution>
void write_side(const TableFiles& to, const std::string& name) {
  using namespace axes;
  constexpr int widths = kGlassAlpha, indices = kGlassIndex, directions = kGlassDirection[Inside];
  const std::string side = Inside ? "Inside" : "Outside";
  Grid grid({widths, indices, directions, kGlassPoints});
  parallel(widths * indices, [&](int i) {
    const double alpha = glass_alpha_at(double(i / indices) / (widths - 1));
    const double glass = glass_index_at(double(i % indices) / (indices - 1));
    const Distribution<double> facets{{alpha, alpha}};
    const auto further_bounces = further<Inside, kGlassPoints>(facets, glass);
    for (int d = 0; d < directions; ++d) {
      const double z = glass_cosine_at(Inside, double(d) / (directions - 1), alpha, glass, alpha);
      const auto all = weights<Inside, kGlassPoints>(facets, glass, {std::sqrt(1 - z * z), 0, z},
                                                     further_bounces);
      std::copy(all.begin(), all.end(), &grid.values[(i * directions + d) * kGlassPoints]);
    }
  });
  const std::vector<float> round = spline_of(grid);
  write_numbers(to, name + "Round" + side, round);
  GlassTables tables{};
  tables.round[Inside] = round.data();
  write_numbers(to, name + "Bent" + side, bent_side<Inside, Distribution>(tables));
}

}  // namespace
}  // namespace tables
}  // namespace mms::materials

int main(int argc, char** argv) {
  using namespace mms::materials;
  return tables::make_tables(argc, argv, [](const tables::TableFiles& to) {
    tables::write_side<false, Ggx>(to, "kGgx");
    tables::write_side<true, Ggx>(to, "kGgx");
    tables::write_side<false, Beckmann>(to, "kBeckmann");
    tables::write_side<true, Beckmann>(to, "kBeckmann");
  });
}
