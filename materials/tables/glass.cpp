// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/glass_coat.h and writes them as C++ to the named file: run by
// the build, in five minutes of one core.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "materials/glass_coat.h"
#include "materials/tables/glass.h"

namespace mms::materials {
namespace tables {
namespace {

/// Light from inside the glass or from outside, that meets a lower index or a higher one.
struct Side {
  bool inside, falls;

  std::string name() const {
    return std::string(inside ? "Inside" : "Outside") + (falls ? "Rare" : "Dense");
  }
};

/// What writes those of facets of the given widths.
template <int Points, template <class> class Distribution>
auto weights_of(bool inside) {
  return [inside](double ax, double ay, double eta) {
    const Distribution<double> facets{{ax, ay}};
    const auto further_bounces = further_moments<Points>(facets, eta, inside);
    return [=](Vec3d w, double* to) {
      const auto all = glass_weights<Points>(facets, eta, inside, w, further_bounces);
      std::copy(all.begin(), all.end(), to);
    };
  };
}

template <template <class> class Distribution>
void write_side(const TableFiles& files, const std::string& name, Side side) {
  const auto [inside, falls] = side;
  const auto round = round_table(axes::kRoundGlass[falls], inside, falls, kGlassPoints,
                                 weights_of<kGlassPoints, Distribution>(inside));
  write_numbers(files, name + "Round" + side.name(), round);
  GlassTables tables{};
  tables.round[inside][falls] = round.data();
  constexpr int few = kFewGlassPoints;
  const auto alike = [&tables, inside = side.inside](const StretchedFacets<double>& seen,
                                                     double eta, double* to) {
    fewer_points<kGlassPoints, few>(round_weights(tables, seen, inside, eta).data(), 1, to);
  };
  write_numbers(files, name + "Bent" + side.name(),
                bent_table(axes::kBentGlass[falls], inside, falls, few,
                           weights_of<few, Distribution>(inside), alike));
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
