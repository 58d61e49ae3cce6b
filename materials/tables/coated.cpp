// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/coated.h and writes them as C++ to the named file: run by the
// build, in five minutes of one core.
#include <cstdio>
#include <string>
#include <vector>

#include "materials/tables/spread.h"

namespace mms::materials::tables {
namespace {

/// `value(lobe, eta)` over all directions, for every lobe, by its number, and index. Returns the
/// table.
template <class Value>
std::vector<float> write_lobes(const TableFiles& to, const std::string& name, int count,
                               const Value& value) {
  using namespace axes;
  std::vector<Values> table(std::size_t(count) * kCoatIndex);
  parallel(int(table.size()), [&](int k) {
    table[k] = value(k / kCoatIndex, index_of(double(k % kCoatIndex) / (kCoatIndex - 1)));
  });
  const Grid grid({count, kCoatIndex, kCoatDirection}, [&](const double* x) {
    const auto at = [](double u, int nodes) { return int(std::lround(u * (nodes - 1))); };
    return Place(x[2]).value(table[at(x[0], count) * kCoatIndex + at(x[1], kCoatIndex)]);
  });
  const Values spline = grid.spline();
  const std::vector<float> numbers(spline.begin(), spline.end());
  write_numbers(to, name, numbers);
  return numbers;
}

CoatShares shares(double eta, const Broadness<double>& broad) {
  return {kNodes, [](int o) { return directions().z[o]; }, eta, broad};
}

/// CoatedTables::coat; `broad(place)` along the axis of widths.
template <class Broad>
std::vector<float> write_coat(const TableFiles& to, const std::string& name,
                              const std::vector<Spread>& lobes, const Broad& broad) {
  const int count = int(lobes.size());
  return write_lobes(to, name + "CoatTable", count, [&](int k, double eta) {
    const Values reflected = shares(eta, broad(double(k) / (count - 1))).reflected;
    return as_coat(scaled(lobes[k], {reflected})[0], reflected);
  });
}

/// CoatedTables::under.
std::vector<std::vector<float>> write_under(const TableFiles& to, const std::string& name,
                                            const std::vector<Spread>& lobes) {
  std::vector<std::vector<float>> tables;
  for (const double s : axes::kHeld)
    tables.push_back(write_lobes(to, name + "UnderTable" + std::to_string(tables.size()),
                                 int(lobes.size()), [&](int k, double eta) {
                                   const Values through = shares(eta, {s, 0}).through;
                                   return below_coat(scaled(lobes[k], {through})[0], through);
                                 }));
  return tables;
}

/// The columns of a lobe's matrix.
Values spread_columns(const Spread& lobe) {
  constexpr int kDirections = axes::kSpread;
  const auto& points = SpreadPoints<double, kDirections>::get();
  Values columns(kDirections * kDirections);
  std::vector<Values> polynomials(kDirections, Values(kNodes));
  for (int i = 0; i < kNodes; ++i) {
    const auto weights = points.weights_at(directions().z[i]);
    for (int k = 0; k < kDirections; ++k) polynomials[k][i] = weights[k];
  }
  const auto means = lobe.means(polynomials);
  for (int k = 0; k < kDirections; ++k)
    for (int j = 0; j < kDirections; ++j)
      columns[k * kDirections + j] = Place::of(points.cosine[j]).value(means[k]);
  return columns;
}

/// All lobes of one kind as matrices.
void write_spread(const TableFiles& to, const std::string& name, const std::vector<Spread>& lobes) {
  const int count = int(lobes.size());
  constexpr int kNumbers = axes::kSpread * axes::kSpread;
  Grid grid({count, kNumbers}, [](const double*) { return 0.0; });
  parallel(count, [&](int k) {
    const Values columns = spread_columns(lobes[k]);
    std::copy(columns.begin(), columns.end(), grid.values.begin() + k * kNumbers);
  });
  const Values spline = grid.spline(1);
  write_numbers(to, name + "SpreadTable", {spline.begin(), spline.end()});
}

template <template <class> class Distribution>
std::vector<Spread> facet_lobes() {
  const std::vector<float> losses = round_losses<Distribution>();
  return lobes(axes::kCoatAlpha, [&](double x) {
    const double alpha = alpha_at(x);
    return facet_lobe(Distribution<double>{{alpha, alpha}}, losses);
  });
}

/// As a coat and under one.
template <template <class> class Distribution>
void write_facets(const TableFiles& to, const std::string& name, const std::vector<Spread>& lobes) {
  const auto coat = write_coat(
      to, name, lobes, [](double place) { return Broadness<double>::facets(alpha_at(place)); });
  const auto under = write_under(to, name, lobes);
  CoatedTables round{};
  round.coat = coat.data();
  for (std::size_t k = 0; k < under.size(); ++k) round.under[k] = under[k].data();
  const StretchedTables stretched = stretched_coats<Distribution>(round);
  write_numbers(to, name + "StretchedCoatTable", stretched.coat);
  for (std::size_t k = 0; k < stretched.under.size(); ++k)
    write_numbers(to, name + "StretchedUnderTable" + std::to_string(k), stretched.under[k]);
}

}  // namespace
}  // namespace mms::materials::tables

int main(int argc, char** argv) {
  using namespace mms::materials;
  using namespace mms::materials::tables;
  return make_tables(argc, argv, [](const TableFiles& to) {
    using namespace axes;
    const auto ggx = facet_lobes<Ggx>(), beckmann = facet_lobes<Beckmann>();
    const auto glossy = lobes(kGloss, [](double x) { return glossy_lobe(gloss_at(x)); });
    const auto matte = lobes(kCoatedMatte, [](double x) { return matte_lobe(x); });
    write_facets<Ggx>(to, "kGgx", ggx);
    write_facets<Beckmann>(to, "kBeckmann", beckmann);
    write_coat(to, "kGlossy", glossy,
               [](double x) { return Broadness<double>::facets(glossy_as_facets(gloss_at(x))); });
    write_under(to, "kGlossy", glossy);
    write_under(to, "kMatte", matte);
    // Steep GGX facets are so many that it takes more of them.
    write_numbers(to, "kGgxStretchedSpreadTable",
                  stretched_spread<Ggx>(kGgxSpreadAlpha, 10946, 6765));
    write_numbers(to, "kBeckmannStretchedSpreadTable",
                  stretched_spread<Beckmann>(kBeckmannSpreadAlpha, 4181, 2584));
    write_spread(to, "kGgx", ggx);
    write_spread(to, "kBeckmann", beckmann);
    write_spread(to, "kGlossy", glossy);
    write_spread(to, "kMatte", matte);
  });
}
