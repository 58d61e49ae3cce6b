// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/coated.h and writes them as C++ to the named file: run by the
// build, in three minutes of one core.
#include <cstdio>
#include <string>
#include <vector>

#include "base/quadrature.h"
#include "materials/tables/rough_coats.h"
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

/// G^2 - T, for every lobe and index. Returns the table.
std::vector<float> write_coated(std::FILE* to, const char* name, const std::vector<Spread>& lobes) {
  using namespace axes;
  const int count = int(lobes.size());
  std::vector<Values> table(std::size_t(count) * kCoatedIndex, Values(kNodes));
  parallel(int(table.size()), [&](int k) {
    const double eta = index_at(double(k % kCoatedIndex) / (kCoatedIndex - 1));
    Values through(kNodes);
    for (int o = 0; o < kNodes; ++o) through[o] = fresnel_split(directions().z[o], eta).transmitted;
    const Values mean = scaled_mean(lobes[k / kCoatedIndex], through);
    for (int o = 0; o < kNodes; ++o) table[k][o] = mean[o] * mean[o] - through[o];
  });
  const Grid grid({count, kCoatedIndex, kCoatDirection}, [&](const double* x) {
    const auto at = [](double u, int nodes) { return int(std::lround(u * (nodes - 1))); };
    const Values& line = table[at(x[0], count) * kCoatedIndex + at(x[1], kCoatedIndex)];
    return Place(x[2]).value(line);
  });
  const Values spline = grid.spline();
  const std::vector<float> numbers(spline.begin(), spline.end());
  write_numbers(to, name, numbers);
  return numbers;
}

void write_spline(std::FILE* to, const std::string& name, const Grid& grid, int kept) {
  const Values spline = grid.spline(kept);
  write_numbers(to, name, {spline.begin(), spline.end()});
}

/// Every so many of the lobes, so that `count` are left.
std::vector<Spread> some(const std::vector<Spread>& all, int count) {
  const std::size_t step = (all.size() - 1) / (count - 1);
  std::vector<Spread> few;
  for (std::size_t k = 0; k < all.size(); k += step) few.push_back(all[k]);
  return few;
}

/// G^2 - (1 - E) of every base under every coat, taken apart.
void write_under(std::FILE* to, const std::string& name, const std::vector<Spread>& bases,
                 const std::vector<Spread>& coats) {
  const RoughCoats all(bases, coats);
  constexpr int kShares = CoatedTables::kShares, kShapes = CoatedTables::kShapes;
  Grid shares({int(bases.size()), int(coats.size()), kShares}, [](const double*) { return 0.0; });
  for (std::size_t k = 0; k < shares.values.size(); ++k)
    shares.values[k] = all.pairs[k / kShares].share[k % kShares];
  write_spline(to, name + "Shares", shares, 1);
  Grid lines({Places::kIndices, Places::kDirections, kShapes}, [](const double*) { return 0.0; });
  for (std::size_t k = 0; k < lines.values.size(); ++k) {
    const int place = int(k) / kShapes;
    lines.values[k] = all.shapes[k % kShapes][place] / Places::weight(place / Places::kDirections);
  }
  write_spline(to, name + "Shapes", lines, 1);
}

}  // namespace
}  // namespace mms::materials::tables

int main(int argc, char** argv) {
  using namespace mms::materials;
  using namespace mms::materials::tables;
  return make_tables(argc, argv, [](std::FILE* to) {
    using namespace axes;
    const auto ggx = lobes(kCoatedAlpha, [](double x) { return facet_lobe<Ggx>(alpha_at(x)); });
    const auto beckmann =
        lobes(kCoatedAlpha, [](double x) { return facet_lobe<Beckmann>(alpha_at(x)); });
    const auto glossy = lobes(kCoatedGloss, [](double x) { return glossy_lobe(gloss_at(x)); });
    const auto matte = lobes(kCoatedMatte, [](double x) { return matte_lobe(x); });
    const auto facet_coats = some(ggx, kRoughCoat[0]), glossy_coats = some(glossy, kRoughCoat[1]);
    const auto write = [&](const std::string& name, const std::vector<Spread>& bases, int rough) {
      const auto round = write_coated(to, (name + "CoatedTable").c_str(), bases);
      const std::vector<Spread> few = some(bases, rough);
      write_under(to, name + "UnderFacets", few, facet_coats);
      write_under(to, name + "UnderGlossy", few, glossy_coats);
      return round;
    };
    const auto stretched = [&](const std::string& name, const std::vector<float>& table) {
      write_numbers(to, name + "StretchedCoatedTable", table, 4);
    };
    stretched("kGgx", stretched_coats<Ggx>(write("kGgx", ggx, kCoatedAlpha).data()));
    stretched("kBeckmann",
              stretched_coats<Beckmann>(write("kBeckmann", beckmann, kCoatedAlpha).data()));
    write("kGlossy", glossy, kRoughGloss);
    write("kMatte", matte, kCoatedMatte);
    write_product(to);
  });
}
