// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/coated.h and writes them as C++ to the named file: run by the
// build, in two minutes of one core.
#include <cstdio>
#include <string>
#include <vector>

#include "base/quadrature.h"
#include "materials/rough_coat.h"
#include "materials/tables/spread.h"

namespace mms::materials::tables {
namespace {

void write_product(std::FILE* to) {
  const Grid grid({axes::kCoatIndex, axes::kCoatIndex}, [](const double* x) {
    const double a = index_at(x[0]), b = index_at(x[1]);
    const auto product = [&](double u) {  // z = u^3: dense towards grazing
      const double z = u * u * u;
      return 6 * u * u * z * fresnel_dielectric(z, a) * fresnel_dielectric(z, b);
    };
    double sum = 0;
    constexpr int kPanels = 64;
    for (int k = 0; k < kPanels; ++k)
      sum += integrate<8>(product, double(k) / kPanels, (k + 1.0) / kPanels);
    return sum;
  });
  const Values spline = grid.spline();
  write_numbers(to, "kFresnelProductTable", {spline.begin(), spline.end()});
}

/// `value(lobe, eta)` over all directions, for every lobe and index. Returns the table.
template <class Value>
std::vector<float> write_lobes(std::FILE* to, const std::string& name,
                               const std::vector<Spread>& lobes, const Value& value) {
  using namespace axes;
  const int count = int(lobes.size());
  std::vector<Values> table(std::size_t(count) * kCoatIndex);
  parallel(int(table.size()), [&](int k) {
    table[k] = value(lobes[k / kCoatIndex], index_at(double(k % kCoatIndex) / (kCoatIndex - 1)));
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

Values fresnel_along_all(double eta) {
  Values f(kNodes);
  for (int o = 0; o < kNodes; ++o) f[o] = fresnel_dielectric(directions().z[o], eta);
  return f;
}

/// Fresnel's mean over what the lobe scatters, less what it is at the direction itself.
std::vector<float> write_coat(std::FILE* to, const std::string& name,
                              const std::vector<Spread>& lobes) {
  return write_lobes(to, name + "CoatTable", lobes, [](const Spread& lobe, double eta) {
    const Values f = fresnel_along_all(eta);
    Values mean = lobe.mean(f);
    for (int o = 0; o < kNodes; ++o) mean[o] -= f[o];
    return mean;
  });
}

/// G^2 - T.
std::vector<float> write_coated(std::FILE* to, const std::string& name,
                                const std::vector<Spread>& lobes) {
  return write_lobes(to, name + "CoatedTable", lobes, [](const Spread& lobe, double eta) {
    Values through(kNodes);
    for (int o = 0; o < kNodes; ++o) through[o] = fresnel_split(directions().z[o], eta).transmitted;
    Values above = scaled_mean(lobe, through);
    for (int o = 0; o < kNodes; ++o) above[o] = above[o] * above[o] - through[o];
    return above;
  });
}

/// The columns of a lobe's matrix, of cosines, of places and of means.
Values spread_columns(const Spread& lobe, double width) {
  constexpr int kDirections = axes::kSpread;
  const auto& points = SpreadPoints<double>::get();
  Values columns(CoatedTables::kColumns * kDirections);
  std::vector<Values> polynomial(kDirections, Values(kNodes));
  for (int i = 0; i < kNodes; ++i) {
    const auto weights = points.weights_at(axes::spread_direction(directions().z[i], width));
    for (int k = 0; k < kDirections; ++k) polynomial[k][i] = weights[k];
  }
  const auto axis = [&](double z, double) { return axes::spread_direction(z, width); };
  double* cosines = &columns[kDirections * kDirections];
  double *places = cosines + kDirections, *means = places + kDirections;
  for (int k = 0; k < kDirections; ++k) {
    cosines[k] = cosine(points.place[k], axis);
    places[k] = axes::coat_direction(cosines[k]);
  }
  for (int k = 0; k < kDirections; ++k) {
    const Values mean = lobe.mean(polynomial[k]);
    for (int j = 0; j < kDirections; ++j)
      columns[k * kDirections + j] = Place(places[j]).value(mean);
  }
  const auto& rule = gauss<8>();
  for (int n = 0; n < 8 * kNodes; ++n) {  // z = u^4: dense towards grazing
    const double u = (n / 8 + rule.x[n % 8]) / kNodes, z = u * u * u * u;
    const auto weights = points.weights_at(axes::spread_direction(z, width));
    for (int k = 0; k < kDirections; ++k)
      means[k] += weights[k] * 8 * std::pow(u, 7) * rule.w[n % 8] / kNodes;
  }
  return columns;
}

/// All lobes of one kind as matrices; `width(place)` along the axis of widths.
template <class Width>
void write_spread(std::FILE* to, const std::string& name, const std::vector<Spread>& lobes,
                  const Width& width) {
  const int count = int(lobes.size());
  constexpr int kNumbers = CoatedTables::kColumns * axes::kSpread;
  Grid grid({count, kNumbers}, [](const double*) { return 0.0; });
  parallel(count, [&](int k) {
    const Values columns = spread_columns(lobes[k], width(double(k) / (count - 1)));
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
void write_facets(std::FILE* to, const std::string& name, const std::vector<Spread>& lobes) {
  const auto coat = write_coat(to, name, lobes), coated = write_coated(to, name, lobes);
  const StretchedTables stretched = stretched_coats<Distribution>(coat.data(), coated.data());
  write_numbers(to, name + "StretchedCoatTable", stretched.coat, 4);
  write_numbers(to, name + "StretchedCoatedTable", stretched.coated, 4);
}

}  // namespace
}  // namespace mms::materials::tables

int main(int argc, char** argv) {
  using namespace mms::materials;
  using namespace mms::materials::tables;
  return make_tables(argc, argv, [](std::FILE* to) {
    using namespace axes;
    const auto ggx = facet_lobes<Ggx>(), beckmann = facet_lobes<Beckmann>();
    const auto glossy = lobes(kGloss, [](double x) { return glossy_lobe(gloss_at(x)); });
    const auto matte = lobes(kCoatedMatte, [](double x) { return matte_lobe(x); });
    write_facets<Ggx>(to, "kGgx", ggx);
    write_facets<Beckmann>(to, "kBeckmann", beckmann);
    write_coat(to, "kGlossy", glossy);
    write_coated(to, "kGlossy", glossy);
    write_coated(to, "kMatte", matte);
    const auto facet_width = [](double place) { return width(alpha_at(place)); };
    write_spread(to, "kGgx", ggx, facet_width);
    write_spread(to, "kBeckmann", beckmann, facet_width);
    write_spread(to, "kGlossy", glossy, [](double place) { return gloss_width(gloss_at(place)); });
    write_spread(to, "kMatte", matte, [](double) { return 1.0; });
    write_product(to);
  });
}
