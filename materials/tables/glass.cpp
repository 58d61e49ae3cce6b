// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/glass_coat.h and writes them as C++ to the named file: run by
// the build, in three minutes of one core.
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

/// Light from inside the glass or from outside, that meets a lower index or a higher one.
struct Side {
  bool inside, falls;

  std::string name() const {
    return std::string(inside ? "Inside" : "Outside") + (falls ? "Rare" : "Dense");
  }
  double index_at(double place) const { return glass_index_at(place, falls); }
};

/// Those of further bounces, as a share of all of them.
template <int Points, class Facets>
Moments<Points> further(const Facets& facets, double eta, bool inside) {
  const auto mean = [&](double index) {
    return InterfaceLoss<double>{facets.interface(), facets.ax, facets.ay, index}.mean();
  };
  const double across = transmitted_share(mean(eta), mean(1 / eta), eta);
  return further_outside<Points>(facets, inside ? 1 / eta : eta) * (inside ? across : 1 - across);
}

/// The weights for light along `w`, z > 0.
template <int Points, class Facets>
std::array<double, Points> weights(const Facets& facets, double eta, bool inside, Vec3d w,
                                   const Moments<Points>& further) {
  Moments<Points> sum =
      interface_mean(facets, eta, w, eta < 1 ? 14 : 24, [inside](const Way& up, const Way& down) {
        const Way& out = inside ? down : up;
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
template <template <class> class Distribution>
std::vector<float> bent_side(Side side, const GlassTables& round) {
  const axes::BentGlassGrid& grid = axes::kBentGlass[side.falls];
  constexpr int points = kFewGlassPoints;
  const ShapeFit shapes(grid.degree);
  const int count = shapes.count(), terms = shapes.terms();
  Grid bent({grid.width, grid.index, grid.direction, points * terms});
  parallel(grid.width * grid.index, [&](int i) {
    const double like = glass_alpha_at(double(i / grid.index) / (grid.width - 1));
    const double eta = side.index_at(double(i % grid.index) / (grid.index - 1));
    std::vector<std::vector<double>> values(grid.direction * points, std::vector<double>(count));
    for (int shape = 0; shape < count; ++shape) {
      auto seen = shapes.facets_like(shape, like, axes::widening(eta, like));
      const double x = seen.x, y = seen.y;
      const Distribution<double> facets{{seen.wide, seen.narrow}};
      const auto further_bounces = further<points>(facets, eta, side.inside);
      for (int d = 0; d < grid.direction; ++d) {
        const double z =
            glass_cosine_at(side.inside, double(d) / (grid.direction - 1), like, eta, seen.root());
        const double s = std::sqrt(1 - z * z);
        seen.x = x * s, seen.y = y * s, seen.z = z;
        const auto all =
            weights<points>(facets, eta, side.inside, {seen.x, seen.y, z}, further_bounces);
        const auto alike = fewer(round_weights(round, seen, side.inside, eta));
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

template <template <class> class Distribution>
void write_side(const TableFiles& to, const std::string& name, Side side) {
  using namespace axes;
  constexpr int widths = kGlassAlpha, indices = kGlassIndex;
  const int directions = kGlassDirection[side.falls];
  Grid grid({widths, indices, directions, kGlassPoints});
  parallel(widths * indices, [&](int i) {
    const double alpha = glass_alpha_at(double(i / indices) / (widths - 1));
    const double eta = side.index_at(double(i % indices) / (indices - 1));
    const Distribution<double> facets{{alpha, alpha}};
    const auto further_bounces = further<kGlassPoints>(facets, eta, side.inside);
    for (int d = 0; d < directions; ++d) {
      const double z =
          glass_cosine_at(side.inside, double(d) / (directions - 1), alpha, eta, alpha);
      const auto all = weights<kGlassPoints>(facets, eta, side.inside, {std::sqrt(1 - z * z), 0, z},
                                             further_bounces);
      std::copy(all.begin(), all.end(), &grid.values[(i * directions + d) * kGlassPoints]);
    }
  });
  const std::vector<float> round = spline_of(grid);
  write_numbers(to, name + "Round" + side.name(), round);
  GlassTables tables{};
  tables.round[side.inside][side.falls] = round.data();
  write_numbers(to, name + "Bent" + side.name(), bent_side<Distribution>(side, tables));
}

template <template <class> class Distribution>
void write_sides(const TableFiles& to, const std::string& name) {
  for (const bool inside : {false, true})
    for (const bool falls : {false, true}) write_side<Distribution>(to, name, {inside, falls});
}

}  // namespace
}  // namespace tables
}  // namespace mms::materials

int main(int argc, char** argv) {
  using namespace mms::materials;
  return tables::make_tables(argc, argv, [](const tables::TableFiles& to) {
    tables::write_sides<Ggx>(to, "kGgx");
    tables::write_sides<Beckmann>(to, "kBeckmann");
  });
}
