// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/film_coat.h and writes them as C++ to the named file: run by the
// build, in a minute of one core.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "materials/facets.h"
#include "materials/film_coat.h"
#include "materials/tables/films.h"
#include "materials/tables/glass.h"
#include "materials/tables/shapes.h"

namespace mms::materials::tables {
namespace {

constexpr int kPoints = kFewGlassPoints, kTerms = axes::kFilmTerms;
constexpr int kBentPoints = axes::kFilmBentPoints, kBentTerms = axes::kFilmBentTerms;

double alpha_of(int i) { return glass_alpha_at(double(i) / (axes::kFilmGlassAlpha - 1)); }
double index_of(int i, bool falls) {
  return glass_index_at(double(i) / (axes::kFilmGlassIndex - 1), falls);
}

/// For each of `Terms` k, the moments over z outside of t_k(c) times what facets let through, where
/// that or what is reflected goes outside.
template <int Points, int Terms>
Numbers<Points * Terms> changes(bool inside, const Ggx<double>& facets, double eta, Vec3d w) {
  const int panels = eta < 1 ? 14 : 24;
  return interface_mean(facets, eta, w, panels, [inside, eta](const Way& up, const Way& down) {
    Numbers<Points * Terms> to;
    const Way& out = inside ? down : up;
    const double leaves = down.share * (1 - out.taken);
    if (!(leaves > 0)) return to;
    const auto at = chebyshev_terms<Points>(out.cosine);
    const auto film = film_terms(eta, up, down);
    for (int k = 0; k < Terms; ++k)
      for (int m = 0; m < Points; ++m) to.of[k * Points + m] = leaves * film[k] * at[m];
    return to;
  });
}

/// The weights of the points, [point][k], from the moments of each of `count` functions.
template <int Points>
void put_weights(const double* moments, int count, double* to) {
  for (int k = 0; k < count; ++k) {
    std::array<double, Points> its;
    std::copy_n(moments + k * Points, Points, its.begin());
    const auto weights = point_weights(its);
    for (int m = 0; m < Points; ++m) to[m * count + k] = weights[m];
  }
}

std::vector<float> side(bool inside, bool falls) {
  using namespace axes;
  const int directions = kFilmGlassDirection[falls];
  Grid grid({kFilmGlassAlpha, kFilmGlassIndex, directions, kPoints * kTerms});
  parallel(kFilmGlassAlpha * kFilmGlassIndex, [&](int i) {
    const double alpha = alpha_of(i / kFilmGlassIndex);
    const double eta = index_of(i % kFilmGlassIndex, falls);
    for (int d = 0; d < directions; ++d) {
      const double z = glass_cosine_at(inside, double(d) / (directions - 1), alpha, eta, alpha);
      const auto all =
          changes<kPoints, kTerms>(inside, {{alpha, alpha}}, eta, {std::sqrt(1 - z * z), 0, z});
      put_weights<kPoints>(all.of.data(), kTerms,
                           &grid.values[(i * directions + d) * kPoints * kTerms]);
    }
  });
  return spline_of(grid);
}

/// What stretched ones have above the round ones of `tables`.
std::vector<float> bent_side(bool inside, bool falls, const FilmGlassTables& tables) {
  const axes::BentGlassGrid& grid = axes::kFilmBentGlass[falls];
  constexpr int count = kBentPoints * kBentTerms;
  const auto& fewer = chebyshev_transfer<kPoints, kBentPoints>();
  const ShapeFit shapes(grid.degree);
  const int terms = shapes.terms();
  Grid bent({grid.width, grid.index, grid.direction, count * terms});
  parallel(grid.width * grid.index, [&](int i) {
    const double like = glass_alpha_at(double(i / grid.index) / (grid.width - 1));
    const double eta = glass_index_at(double(i % grid.index) / (grid.index - 1), falls);
    for (int d = 0; d < grid.direction; ++d) {
      std::vector<double> values[count];
      for (int shape = 0; shape < shapes.count(); ++shape) {
        auto seen = shapes.facets_like(shape, like, axes::widening(eta, like));
        const double z =
            glass_cosine_at(inside, double(d) / (grid.direction - 1), like, eta, seen.root());
        const double s = std::sqrt(1 - z * z);
        seen.x *= s, seen.y *= s, seen.z = z;
        const auto moments = changes<kBentPoints, kBentTerms>(inside, {{seen.wide, seen.narrow}},
                                                              eta, {seen.x, seen.y, z});
        double all[count];
        put_weights<kBentPoints>(moments.of.data(), kBentTerms, all);
        const auto alike = round_film_weights(tables, seen, inside, eta);
        for (int m = 0; m < kBentPoints; ++m)
          for (int k = 0; k < kBentTerms; ++k) {
            double& more = all[m * kBentTerms + k];
            for (int n = 0; n < kPoints; ++n) more -= alike[n * kTerms + k] * fewer[n][m];
            values[m * kBentTerms + k].push_back(more);
          }
      }
      for (int k = 0; k < count; ++k)
        for (int t = 0; t < terms; ++t)
          bent.values[((i * grid.direction + d) * count + k) * terms + t] =
              shapes.term(t, values[k].data());
    }
  });
  return spline_of(bent);
}

void write_side(const TableFiles& to, bool inside, bool falls) {
  const std::string name =
      std::string("kGgxFilmGlass") + (inside ? "Inside" : "Outside") + (falls ? "Rare" : "Dense");
  const std::vector<float> round = side(inside, falls);
  write_numbers(to, name, round);
  FilmGlassTables tables{};
  tables.change[inside][falls] = round.data();
  write_numbers(to, name + "Bent", bent_side(inside, falls, tables));
}

/// The moments over z of l(w), and then of each D_k(w), of materials/film_energy.h, outside.
Numbers<kPoints*(1 + kTerms)> losses(const Ggx<double>& facets, double glass) {
  const InterfaceLoss<double> loss{facets.interface(), facets.ax, facets.ay, glass};
  const FacetLoss<double> mirrors{&facets.tables(), facets.ax, facets.ay};
  const double aspect = facets.ax / facets.ay;
  return height_mean(
      [&](double z, double s) {
        const auto at = chebyshev_terms<kPoints>(z);
        const auto each = quarter_mean(aspect, aspect > 1 ? 6 : 1, [&](double x, double y) {
          const auto along =
              FilmedLoss<double>::at(kGgxFilm, loss, mirrors, {s * x, s * y, z}, kTerms);
          Numbers<1 + kTerms> l;
          l.of[0] = along.bare;
          std::copy_n(along.terms, kTerms, l.of.begin() + 1);
          return l;
        });
        Numbers<kPoints*(1 + kTerms)> to;
        for (int k = 0; k <= kTerms; ++k)
          for (int m = 0; m < kPoints; ++m) to.of[k * kPoints + m] = each.of[k] * at[m];
        return to;
      },
      facets.ax * facets.ay, ridge_of(glass), 6);
}

std::vector<float> further(bool falls) {
  using namespace axes;
  Grid grid({kFilmGlassAlpha, kFilmGlassAspect, kFilmGlassIndex, kPoints * (1 + kTerms)});
  parallel(kFilmGlassAlpha * kFilmGlassAspect * kFilmGlassIndex, [&](int i) {
    const double alpha = alpha_of(i / (kFilmGlassAspect * kFilmGlassIndex));
    const double place = double(i / kFilmGlassIndex % kFilmGlassAspect) / (kFilmGlassAspect - 1);
    const double wide = alpha * std::pow(10, place / 2);
    const double glass = index_of(i % kFilmGlassIndex, falls);
    put_weights<kPoints>(losses({{wide, alpha * alpha / wide}}, glass).of.data(), 1 + kTerms,
                         &grid.values[i * kPoints * (1 + kTerms)]);
  });
  return spline_of(grid);
}

}  // namespace
}  // namespace mms::materials::tables

int main(int argc, char** argv) {
  using namespace mms::materials::tables;
  return make_tables(argc, argv, [](const TableFiles& to) {
    for (const bool falls : {false, true}) {
      for (const bool inside : {false, true}) write_side(to, inside, falls);
      write_numbers(to, std::string("kGgxFilmGlassFurther") + (falls ? "Rare" : "Dense"),
                    further(falls));
    }
  });
}
