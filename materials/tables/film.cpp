// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/film_energy.h and writes them as C++ to the named file: run by
// the build, in about four minutes of one core.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "base/quadrature.h"
#include "materials/facets.h"
#include "materials/tables/films.h"
#include "materials/tables/grid.h"
#include "materials/tables/losses.h"
#include "materials/tables/shapes.h"
#include "materials/tables/slopes.h"

namespace mms::materials::tables {
namespace {

using Changes = Numbers<axes::kFilmTerms>;

double alpha_at(double place) { return std::max(place * place * place, 1e-5); }

/// The relative index of a place on its axis; `rising`: above 1.
double index_at(double place, bool rising) {
  using namespace axes;
  return index_of(kLeastBentIndex + (kMostBentIndex - kLeastBentIndex) * place, rising);
}

/// D_k along `w`, and what it is measured in, the last.
auto changes(const Ggx<double>& facets, double eta, Vec3d w) {
  const int points = facets.ax == facets.ay ? 24 : 16;  // of what is added to the others, fewer
  return interface_mean(facets, eta, w, points, [eta](const Way& up, const Way& down) {
    Numbers<axes::kFilmTerms + 1> to;
    const Changes each = changes_at(eta, up, down);
    std::copy(each.of.begin(), each.of.end(), to.of.begin());
    to.of.back() = up.taken + up.share * up.taken + down.share * down.taken;
    return to;
  });
}

/// Over that.
Changes quotients(const Numbers<axes::kFilmTerms + 1>& changes) {
  Changes to;
  for (int k = 0; k < axes::kFilmTerms; ++k)
    to.of[k] = changes.of[k] / std::max(changes.of[axes::kFilmTerms], 1e-300);
  return to;
}
Changes quotients(const Ggx<double>& facets, double eta, Vec3d w) {
  return quotients(changes(facets, eta, w));
}

/// |Cosine| at a place along an axis of directions.
double cosine_at(double place, double alpha, double eta) {
  const double c = cosine(std::min(place, 1 - kLeast), [&](double z, double s) {
    return axes::interface_direction(z, s, alpha, eta);
  });
  return std::max(c, kLeast * alpha);
}

std::vector<float> write(const TableFiles& to, const std::string& name, const Grid& grid) {
  const std::vector<double> spline = grid.spline(1);
  const std::vector<float> numbers(spline.begin(), spline.end());
  write_numbers(to, name, numbers);
  return numbers;
}

/// Of round facets.
Grid round_quotients(bool rising) {
  using namespace axes;
  const int directions = kFilmDirection[!rising];
  Grid grid({kFilmAlpha, kFilmIndex, directions, kFilmTerms});
  parallel(kFilmAlpha * kFilmIndex, [&](int i) {
    const double alpha = alpha_at(double(i / kFilmIndex) / (kFilmAlpha - 1));
    const double eta = index_at(double(i % kFilmIndex) / (kFilmIndex - 1), rising);
    for (int d = 0; d < directions; ++d) {
      const double z = cosine_at(double(d) / (directions - 1), alpha, eta);
      const Changes of = quotients({{alpha, alpha}}, eta, {std::sqrt(1 - z * z), 0, z});
      std::copy(of.of.begin(), of.of.end(), &grid.values[(i * directions + d) * kFilmTerms]);
    }
  });
  return grid;
}

/// What stretched ones have above those.
Grid stretched_quotients(bool rising, const FilmTables& round) {
  using namespace axes;
  const BentGrid& nodes = kFilmBent[!rising];
  const int widths = nodes.width, indices = nodes.index, directions = nodes.direction;
  const ShapeFit shapes(nodes.shapes);
  const int terms = shapes.terms();
  Grid grid({widths, indices, directions, terms * kFilmTerms});
  parallel(widths * indices, [&](int i) {
    const double like = bent_width_at(double(i / indices) / (widths - 1));
    const double eta = bent_index_at(double(i % indices) / (indices - 1), rising, kGgxKink);
    for (int d = 0; d < directions; ++d) {
      const double c = bent_cosine_at(double(d) / (directions - 1), like, eta, kGgxKink);
      const double z = std::max(c, kLeast * like), s = std::sqrt(1 - z * z);
      double same[kFilmTerms] = {};
      FilmedLoss<double>::quotients(round, {kGgxInterface, like, like, eta}, {s, 0, z}, same,
                                    kFilmTerms);
      std::vector<double> values[kFilmTerms];
      for (int shape = 0; shape < shapes.count(); ++shape) {
        const auto seen = shapes.facets_like(shape, like, widening(eta, like));
        const Changes of = quotients({{seen.wide, seen.narrow}}, eta, {s * seen.x, s * seen.y, z});
        for (int k = 0; k < kFilmTerms; ++k) values[k].push_back(of.of[k] - same[k]);
      }
      for (int k = 0; k < kFilmTerms; ++k)
        for (int t = 0; t < terms; ++t)
          grid.values[((i * directions + d) * kFilmTerms + k) * terms + t] =
              shapes.term(t, values[k].data());
    }
  });
  return grid;
}

/// Of what the tables say, the mean over the hemisphere of D_k and of what it is measured in.
Changes mean_quotients(const FilmTables& tables, const Ggx<double>& facets, double eta) {
  const InterfaceLoss<double> loss{facets.interface(), facets.ax, facets.ay, eta};
  const FacetLoss<double> mirrors{&facets.tables(), facets.ax, facets.ay};
  const auto changes = [&](Vec3d w) {
    const auto along = FilmedLoss<double>::at(tables, loss, mirrors, w, axes::kFilmTerms);
    Numbers<axes::kFilmTerms + 1> to;
    std::copy(std::begin(along.terms), std::end(along.terms), to.of.begin());
    to.of.back() = along.bare + mirrors.at(w);
    return to;
  };
  const double aspect = facets.ax / facets.ay;
  return quotients(height_mean(
      [&](double z, double s) {
        return quarter_mean(aspect, aspect > 1 ? 12 : 1, [&](double x, double y) {
          return changes({s * x, s * y, z});
        });
      },
      facets.ax * facets.ay, ridge_of(eta), 6));
}

Grid means(bool rising, const FilmTables& tables) {
  using namespace axes;
  Grid grid({kFilmMeanAlpha, kFilmMeanAspect, kFilmIndex, kFilmTerms});
  parallel(kFilmMeanAlpha * kFilmMeanAspect * kFilmIndex, [&](int i) {
    const double alpha =
        alpha_at(double(i / (kFilmMeanAspect * kFilmIndex)) / (kFilmMeanAlpha - 1));
    const double wide =
        alpha * std::pow(10, double(i / kFilmIndex % kFilmMeanAspect) / (kFilmMeanAspect - 1) / 2);
    const double eta = index_at(double(i % kFilmIndex) / (kFilmIndex - 1), rising);
    const Changes of = mean_quotients(tables, {{wide, alpha * alpha / wide}}, eta);
    std::copy(of.of.begin(), of.of.end(), &grid.values[i * kFilmTerms]);
  });
  return grid;
}

void write_side(const TableFiles& to, const std::string& name, bool rising) {
  FilmTables tables{};
  const auto round = write(to, name, round_quotients(rising));
  tables.loss[!rising] = round.data();
  const auto stretched = write(to, name + "Stretched", stretched_quotients(rising, tables));
  tables.stretched[!rising] = stretched.data();
  write(to, name + "Mean", means(rising, tables));
}

}  // namespace
}  // namespace mms::materials::tables

int main(int argc, char** argv) {
  using namespace mms::materials;
  return tables::make_tables(argc, argv, [](const tables::TableFiles& to) {
    tables::write_side(to, "kGgxFilmDense", true);
    tables::write_side(to, "kGgxFilmRare", false);
  });
}
