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

namespace mms::materials::tables {
namespace {

constexpr int kPoints = kFewGlassPoints, kTerms = axes::kFilmTerms;

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

/// What writes the weights of facets of the given widths.
template <int Points, int Terms>
auto weights_of(bool inside) {
  return [inside](double ax, double ay, double eta) {
    return [=](Vec3d w, double* to) {
      const auto moments = changes<Points, Terms>(inside, {{ax, ay}}, eta, w);
      put_weights<Points>(moments.of.data(), Terms, to);
    };
  };
}

void write_side(const TableFiles& files, bool inside, bool falls) {
  using namespace axes;
  const std::string name =
      std::string("kGgxFilmGlass") + (inside ? "Inside" : "Outside") + (falls ? "Rare" : "Dense");
  const auto round = round_table(kRoundFilmGlass[falls], inside, falls, kPoints * kTerms,
                                 weights_of<kPoints, kTerms>(inside));
  write_numbers(files, name, round);
  FilmGlassTables tables{};
  tables.change[inside][falls] = round.data();
  constexpr int points = kBentFilmPoints, terms = kBentFilmTerms;
  const auto alike = [&tables, inside](const StretchedFacets<double>& seen, double eta,
                                       double* to) {
    const auto weights = round_film_weights(tables, seen, inside, eta);
    double few[points * kTerms];
    fewer_points<kPoints, points>(weights.data(), kTerms, few);
    for (int m = 0; m < points; ++m) std::copy_n(few + m * kTerms, terms, to + m * terms);
  };
  write_numbers(files, name + "Bent",
                bent_table(kBentFilmGlass[falls], inside, falls, points * terms,
                           weights_of<points, terms>(inside), alike));
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
  Grid grid({kFurtherAlpha, kFurtherAspect, kFurtherIndex, kPoints * (1 + kTerms)});
  parallel(kFurtherAlpha * kFurtherAspect * kFurtherIndex, [&](int i) {
    const double alpha =
        glass_alpha_at(double(i / (kFurtherAspect * kFurtherIndex)) / (kFurtherAlpha - 1));
    const double place = double(i / kFurtherIndex % kFurtherAspect) / (kFurtherAspect - 1);
    const double wide = alpha * std::pow(10, place / 2);
    const double glass = glass_index_at(double(i % kFurtherIndex) / (kFurtherIndex - 1), falls);
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
