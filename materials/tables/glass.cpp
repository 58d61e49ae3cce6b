// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/glass_coat.h and writes them as C++ to the named file: run by
// the build, in two minutes of one core.
#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "base/quadrature.h"
#include "materials/glass_coat.h"
#include "materials/tables/grid.h"
#include "materials/tables/losses.h"
#include "materials/tables/points.h"
#include "materials/tables/shapes.h"
#include "materials/tables/slopes.h"

namespace mms::materials {
namespace tables {
namespace {

double index_at(double place) {
  return index_of(axes::kLeastGlassIndex +
                  (axes::kMostGlassIndex - axes::kLeastGlassIndex) * place);
}
double alpha_at(double place) {
  return std::pow(axes::kLeastGlassAlpha + (1 - axes::kLeastGlassAlpha) * place, 3);
}

/// Integrals of t_k of the |cosine| outside.
template <int Points>
using Moments = Numbers<Points>;

template <int Points>
Moments<Points> terms_at(double z) {
  Moments<Points> to;
  const auto t = chebyshev_terms<Points>(z);
  std::copy(t.begin(), t.end(), to.of.begin());
  return to;
}

/// Those of further bounces: their means over l outside (materials/energy.h), as a share of all of
/// them.
template <bool Inside, int Points, class Facets>
Moments<Points> further(const Facets& facets, double glass) {
  const InterfaceLoss<double> outside{facets.interface(), facets.ax, facets.ay, glass},
      inside{facets.interface(), facets.ax, facets.ay, 1 / glass};
  const double mean_outside = outside.mean(), mean_inside = inside.mean();
  const double across = Inside ? transmitted_share(mean_inside, mean_outside, 1 / glass)
                               : transmitted_share(mean_outside, mean_inside, glass);
  const bool round = facets.ax == facets.ay;
  const auto azimuth_mean = [&](const auto& f) {
    return quarter_mean(facets.ax / facets.ay, round ? 1 : 6, f);
  };
  std::vector<decltype(along_azimuth(outside, 0, 0))> along;
  azimuth_mean([&](double x, double y) {
    along.push_back(along_azimuth(outside, x, y));
    return 0.0;
  });
  const auto sum = height_mean(
      [&](double z, double s) {
        auto next = along.begin();
        const double l = azimuth_mean([&](double, double) { return (*next++)(z, s); });
        return terms_at<Points>(z) * l;
      },
      facets.ax * facets.ay, 0, round ? 24 : 12);
  return sum * ((Inside ? across : 1 - across) / sum.of[0]);  // t_0 is 1
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
std::array<double, kBentGlassPoints> fewer(const std::array<double, kGlassPoints>& weights) {
  std::array<double, kBentGlassPoints> moments{};
  for (int i = 0; i < kGlassPoints; ++i) {
    const auto t = chebyshev_terms<kBentGlassPoints>(chebyshev_points<kGlassPoints>()[i]);
    for (int k = 0; k < kBentGlassPoints; ++k) moments[k] += weights[i] * t[k];
  }
  return point_weights(moments);
}

/// The |cosine| at a place on the axis of directions.
double cosine_at(bool inside, double place, double alpha, double glass) {
  return cosine(std::min(place, 1 - kLeast), [&](double c, double s) {
    return axes::glass_direction(inside, c, s, alpha, glass);
  });
}

const auto kZero = [](const double*) { return 0.0; };

std::vector<float> spline(const Grid& grid) {
  const std::vector<double> of = grid.spline(1);
  return {of.begin(), of.end()};
}

/// From that of round ones.
template <bool Inside, template <class> class Distribution>
std::vector<float> bent_side(const GlassTables& round) {
  constexpr axes::BentGlassGrid grid = axes::kBentGlass[Inside];
  constexpr int points = kBentGlassPoints;
  const ShapeFit shapes(grid.degree);
  const int count = shapes.count(), terms = shapes.terms();
  Grid bent({grid.width, grid.index, grid.direction, points * terms}, kZero);
  parallel(grid.width * grid.index, [&](int i) {
    const double like = alpha_at(double(i / grid.index) / (grid.width - 1));
    const double glass = index_at(double(i % grid.index) / (grid.index - 1));
    std::vector<std::vector<double>> values(grid.direction * points, std::vector<double>(count));
    for (int shape = 0; shape < count; ++shape) {
      auto seen = shapes.facets_like(shape, like, axes::widening(Inside ? 1 / glass : glass, like));
      const double x = seen.x, y = seen.y;
      const Distribution<double> facets{{seen.wide, seen.narrow}};
      const auto further_bounces = further<Inside, points>(facets, glass);
      for (int d = 0; d < grid.direction; ++d) {
        const double z = std::max(cosine_at(Inside, double(d) / (grid.direction - 1), like, glass),
                                  kLeast * seen.root());
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
  return spline(bent);
}

template <bool Inside, template <class> class Distribution>
void write_side(const TableFiles& to, const std::string& name) {
  using namespace axes;
  constexpr int widths = kGlassAlpha, indices = kGlassIndex, directions = kGlassDirection[Inside];
  const std::string side = Inside ? "Inside" : "Outside";
  Grid grid({widths, indices, directions, kGlassPoints}, kZero);
  parallel(widths * indices, [&](int i) {
    const double alpha = alpha_at(double(i / indices) / (widths - 1));
    const double glass = index_at(double(i % indices) / (indices - 1));
    const Distribution<double> facets{{alpha, alpha}};
    const auto further_bounces = further<Inside, kGlassPoints>(facets, glass);
    for (int d = 0; d < directions; ++d) {
      const double z =
          std::max(cosine_at(Inside, double(d) / (directions - 1), alpha, glass), kLeast * alpha);
      const auto all = weights<Inside, kGlassPoints>(facets, glass, {std::sqrt(1 - z * z), 0, z},
                                                     further_bounces);
      std::copy(all.begin(), all.end(), &grid.values[(i * directions + d) * kGlassPoints]);
    }
  });
  const std::vector<float> round = spline(grid);
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
