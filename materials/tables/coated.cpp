// SPDX-License-Identifier: Apache-2.0
// Computes the tables of materials/coated.h and writes them as C++ to the named file: run by the
// build, in three minutes of one core.
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "base/quadrature.h"
#include "materials/facets.h"
#include "materials/fresnel.h"
#include "materials/glossy.h"
#include "materials/tables/coats.h"
#include "materials/tables/grid.h"

namespace mms::materials::tables {
namespace {

constexpr int kNodes = 200;

/// Directions in the middles of as many steps along the axis of the tables.
struct Directions {
  Values z = Values(kNodes), weight = Values(kNodes);  ///< of int 2 z dz

  Directions() {
    for (int k = 0; k < kNodes; ++k) {
      z[k] = cosine_at((k + 0.5) / kNodes);
      const double a = cosine_at(double(k) / kNodes), b = cosine_at((k + 1.0) / kNodes);
      weight[k] = b * b - a * a;
    }
  }
};
const Directions& directions() {
  static const Directions d;
  return d;
}

/// Of four nodes, for Lagrange's cubic: what is linear widens a lobe by a step, which near grazing
/// is 1e-3 of the mean of T.
struct Place : Cubic {
  explicit Place(double place)
      : Cubic(std::clamp(place * kNodes - 0.5, -0.5, kNodes - 0.5), 0, kNodes - 4) {}
  static Place of(double z) { return Place(axes::coat_direction(z)); }

  double value(const Values& of) const {
    double sum = 0;
    for (int k = 0; k < 4; ++k) sum += weight[k] * of[first + k];
    return sum;
  }
};

/// The lobe as a matrix: row o holds what light along o is spread to; rows sum to 1.
struct Spread {
  std::vector<Values> rows = std::vector<Values>(kNodes, Values(kNodes));

  void add(int row, double z, double share) {
    const Place p = Place::of(z);
    for (int k = 0; k < 4; ++k) rows[row][p.first + k] += share * p.weight[k];
  }

  Values mean(const Values& of) const {
    Values m(kNodes);
    for (int o = 0; o < kNodes; ++o)
      for (int i = 0; i < kNodes; ++i) m[o] += rows[o][i] * of[i];
    return m;
  }
};

/// One row of round facets, over slopes as polar coordinates: of a facet that `wo` sees a share of
/// the area, masked; then what single bounces lose, as materials/energy.h gives it back.
template <class Facets>
void add_facets(const Facets& facets, int row, Spread& lobe) {
  const double z = directions().z[row], s = std::sqrt(1 - z * z), alpha = facets.ax;
  const double shadow = facets.shadow({s, 0, z});
  double seen = 0;
  std::vector<std::pair<double, double>> single;  // cosine and share
  constexpr int kSlopes = 256, kTurn = 128;
  for (int k = 0; k < kTurn; ++k) {
    // A lattice: slopes of one radius for all turns would jump over the horizon as one.
    const double phi = kPi<double> * (k + 0.5) / kTurn;
    const double offset = std::fmod((k + 0.5) * std::numbers::phi, 1.0);
    crowded(kSlopes, offset, [&](double u, double weight) {
      const double r = alpha * slope(facets, u);
      const double area = (z + s * r * std::cos(phi)) * weight;  // over the surface
      if (!(area > 0)) return;
      seen += area;
      const Vec3d h = normalize(Vec3d{r * std::cos(phi), r * std::sin(phi), 1});
      const Vec3d wi = h * (2 * (s * h.x + z * h.z)) - Vec3d{s, 0, z};
      if (!(wi.z > 0)) return;
      const double c = std::min(wi.z, 1.0);
      const double masked = (z + shadow) * c / (z * c + shadow * c + z * facets.shadow(wi));
      single.emplace_back(c, area * masked);
    });
  }
  for (const auto& [c, share] : single) lobe.add(row, c, share / seen);
}

void give_back(Spread& lobe) {
  const Values& weight = directions().weight;
  Values lost(kNodes);
  double mean = 0;
  for (int o = 0; o < kNodes; ++o) {
    double sum = 0;
    for (const double x : lobe.rows[o]) sum += x;
    lost[o] = std::max(0.0, 1 - sum);
    mean += lost[o] * weight[o];
  }
  for (int o = 0; o < kNodes; ++o) {
    double sum = 0;
    for (int i = 0; i < kNodes; ++i) {
      if (mean > 0) lobe.rows[o][i] += lost[o] * lost[i] * weight[i] / mean;
      sum += lobe.rows[o][i];
    }
    for (double& x : lobe.rows[o]) x /= sum;
  }
}

template <template <class> class Distribution>
Spread facet_lobe(double alpha) {
  Spread lobe;
  for (int o = 0; o < kNodes; ++o) add_facets(Distribution<double>{{alpha, alpha}}, o, lobe);
  give_back(lobe);
  return lobe;
}

Spread glossy_lobe(double gloss) {
  const Latitude<double> latitude(gloss);
  Spread lobe;
  for (int o = 0; o < kNodes; ++o) {
    const double z = directions().z[o], y = z * z;
    crowded(512, 0.5, [&](double u, double weight) {
      const double x = latitude.inverse(u, 1 - u, y, 1 - y);
      lobe.add(o, std::sqrt(std::clamp(x, 0.0, 1.0)), weight);
    });
  }
  return lobe;
}

/// The inverse of axes::index.
double index_at(double place) {
  const double x = std::clamp(place * place * place * place, 1e-7, 1 - 1e-4);
  return (1 + x) / (1 - x);
}

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

/// `make(place)` for places along the axis of widths.
template <class Make>
std::vector<Spread> lobes(int count, const Make& make) {
  std::vector<Spread> all(count);
  parallel(count, [&](int k) { all[k] = make(double(k) / (count - 1)); });
  return all;
}

/// The inverse of axes::coat_alpha.
double alpha_at(double place) { return std::max(place * place * place * place, 1e-6); }

/// Facets, round and stretched.
template <template <class> class Distribution>
void write_facets(std::FILE* to, const std::string& name) {
  const auto round = write_coated(
      to, (name + "CoatedTable").c_str(),
      lobes(axes::kCoatedAlpha, [](double x) { return facet_lobe<Distribution>(alpha_at(x)); }));
  write_numbers(to, name + "StretchedCoatedTable", stretched_coats<Distribution>(round.data()), 4);
}

}  // namespace
}  // namespace mms::materials::tables

int main(int argc, char** argv) {
  using namespace mms::materials;
  using namespace mms::materials::tables;
  return make_tables(argc, argv, [](std::FILE* to) {
    write_facets<Ggx>(to, "kGgx");
    write_facets<Beckmann>(to, "kBeckmann");
    write_coated(to, "kGlossyCoatedTable", lobes(axes::kCoatedGloss, [](double x) {
                   return glossy_lobe(std::expm1(x * std::log1p(axes::kLargestGloss)));
                 }));
    write_product(to);
  });
}
