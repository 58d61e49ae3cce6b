// SPDX-License-Identifier: Apache-2.0
// The matrices of stretched facets (CoatedTables::spread_stretched).
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "materials/tables/coats.h"
#include "materials/tables/grid.h"
#include "materials/tables/losses.h"

namespace mms::materials::tables {
namespace {

using Matrix = StretchedMatrix<double>;
constexpr int kDirections = Matrix::kDirections;
constexpr int kHeights = Matrix::kHeights, kTurns = axes::kSpreadTurns;

/// A number for each product of Chebyshev's polynomials of a height's and an azimuth's places.
using Terms = std::array<std::array<double, kTurns>, kHeights>;

double product(const Terms& a, const Terms& b) {
  double sum = 0;
  for (int j = 0; j < kHeights; ++j)
    for (int k = 0; k < kTurns; ++k) sum += a[j][k] * b[j][k];
  return sum;
}

/// `share` times these polynomials along the direction of these places in [0, 1].
void add(Terms& to, double height, double turn, double share) {
  const auto heights = chebyshev_terms<kHeights>(height);
  auto turns = chebyshev_terms<kTurns>((1 + std::cos(kPi<double> * turn)) / 2);
  for (double& t : turns) t *= share;
  for (int j = 0; j < kHeights; ++j)
    for (int k = 0; k < kTurns; ++k) to[j][k] += heights[j] * turns[k];
}

/// The places of all directions, and the polynomials that are 1 at one and 0 at the others.
struct Directions {
  double height[kDirections], turn[kDirections];
  std::vector<Terms> polynomials = std::vector<Terms>(kDirections);

  Directions() {
    const auto& points = SpreadPoints<double, kHeights>::get();
    int d = 0;
    for (int h = 0; h < kHeights; ++h) {
      const auto heights = chebyshev_terms<kHeights>(points.place[h]);
      const auto at_end = [](int k) { return k == 0 || k == kHeights - 1 ? 0.5 : 1.0; };
      const int turns = Matrix::turns(h);
      for (int t = 0; t < turns; ++t, ++d) {
        height[d] = points.place[h];
        turn[d] = (t + 0.5) / turns;
        for (int j = 0; j < kHeights; ++j) {
          const double part = at_end(h) * at_end(j) * heights[j] * 2 / (kHeights - 1);
          for (int k = 0; k < turns; ++k)
            polynomials[d][j][k] =
                part * (k == 0 ? 1 : 2) * std::cos(kPi<double> * k * turn[d]) / turns;
        }
      }
    }
  }
};
const Directions& directions() {
  static const Directions d;
  return d;
}

/// The azimuth from the narrower axis, over a right angle: the inverse of axes::spread_turn.
double azimuth_at(double turn, double aspect) {
  const auto at = [aspect](double x) {
    const double a = x * kPi<double> / 2;
    return axes::spread_turn(std::sin(a), std::cos(a), aspect);
  };
  return inverse(at, turn);
}

/// The mean over the hemisphere, with the cosine, of a function that is known at all directions,
/// and at the same time of its products with each of the polynomials.
struct Means {
  double all = 0;
  Terms of{};

  Means(const Values& values, double aspect) {
    constexpr int kRows = 300, kColumns = 48;
    Terms function{};
    for (int d = 0; d < kDirections; ++d)
      for (int j = 0; j < kHeights; ++j)
        for (int k = 0; k < kTurns; ++k)
          function[j][k] += values[d] * directions().polynomials[d][j][k];
    double from = 0;
    for (int column = 0; column < kColumns; ++column) {
      const double to = azimuth_at((column + 1.0) / kColumns, aspect);
      for (int row = 0; row < kRows; ++row) {
        const double below = axes::spread_cosine(double(row) / kRows),
                     above = axes::spread_cosine((row + 1.0) / kRows);
        Terms here{};
        add(here, (row + 0.5) / kRows, (column + 0.5) / kColumns, 1);
        const double part = std::max(product(function, here), 0.0) * (to - from) * (above - below) *
                            (above + below);
        all += part;
        for (int j = 0; j < kHeights; ++j)
          for (int k = 0; k < kTurns; ++k) of[j][k] += part * here[j][k];
      }
      from = to;
    }
  }
};

/// [column][direction o] of white facets: what single bounces send to each of the polynomials, and
/// what these lose, given back as materials/energy.h does.
template <class Facets>
Values columns(const Facets& facets, const std::vector<Facet>& all) {
  const double aspect = facets.ax / facets.ay;
  std::vector<Terms> sent(kDirections);
  Values lost(kDirections);
  for (int o = 0; o < kDirections; ++o) {
    const double z = axes::spread_cosine(directions().height[o]), s = std::sqrt((1 - z) * (1 + z)),
                 turn = azimuth_at(directions().turn[o], aspect) * kPi<double> / 2;
    double kept = 0;
    const double seen = single_bounces(
        facets, all, {s * std::sin(turn), s * std::cos(turn), z}, [&](Vec3d wi, double share) {
          kept += share;
          add(sent[o], axes::spread_direction(wi.z), axes::spread_turn(wi.x, wi.y, aspect), share);
        });
    for (auto& row : sent[o])
      for (double& x : row) x /= seen;
    lost[o] = std::max(0.0, 1 - kept / seen);
  }
  const Means means(lost, aspect);
  Values back(kDirections);
  if (means.all > 0)
    for (int k = 0; k < kDirections; ++k)
      back[k] = product(means.of, directions().polynomials[k]) / means.all;
  Values to(kDirections * kDirections);
  for (int o = 0; o < kDirections; ++o) {
    Values row(kDirections);
    for (int k = 0; k < kDirections; ++k)
      row[k] = product(sent[o], directions().polynomials[k]) + lost[o] * back[k];
    const double sum = std::accumulate(row.begin(), row.end(), 0.0);
    for (int k = 0; k < kDirections; ++k) to[k * kDirections + o] = row[k] / sum;
  }
  return to;
}

}  // namespace

template <template <class> class Distribution>
std::vector<float> stretched_spread(int roots, int facets, int step) {
  constexpr int rings = axes::kSpreadRings, numbers = kDirections * kDirections;
  Grid spread({roots, rings, numbers});
  parallel((roots - 1) * rings, [&](int k) {
    const int width = k / rings + 1, ring = k % rings;
    const double place = double(width) / (roots - 1), root = place * place * place;
    // The inverse of axes::ring.
    const double radius = std::sin(kPi<double> / 2 * ring / (rings - 1)) * 9 / 11;
    const double stretch = std::sqrt((1 + radius) / (1 - radius));
    const Distribution<double> lobe{{root * stretch, root / stretch}};
    const Values of = columns(lobe, all_facets(lobe, facets, step));
    // Mirrors as the narrowest of all.
    for (int at = width == 1 ? 0 : width; at <= width; ++at)
      std::copy(of.begin(), of.end(), &spread.values[(at * rings + ring) * numbers]);
  });
  const Values coefficients = spread.spline(1);
  return {coefficients.begin(), coefficients.end()};
}

template std::vector<float> stretched_spread<Ggx>(int, int, int);
template std::vector<float> stretched_spread<Beckmann>(int, int, int);

}  // namespace mms::materials::tables
