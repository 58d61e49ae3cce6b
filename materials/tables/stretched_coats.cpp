// SPDX-License-Identifier: Apache-2.0
// The tables of stretched facets as a coat and under one (materials/coated.h).
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <vector>

#include "materials/fresnel.h"
#include "materials/tables/coats.h"
#include "materials/tables/grid.h"
#include "materials/tables/losses.h"
#include "materials/tables/shapes.h"

namespace mms::materials::tables {
namespace {

constexpr int kHeights = 40, kTurns = 22, kNodes = kHeights * kTurns;

/// Directions of a quarter of the hemisphere, which facets see alike in all four: in the middles
/// of steps along a power of 3/8 of their angle from grazing, and along an axis of azimuths half
/// way between the surface and facets that look round.
class Directions {
 public:
  explicit Directions(double aspect) : stretch_(std::sqrt(aspect)) {
    for (int k = 0; k < kHeights; ++k) {
      z_[k] = height_at((k + 0.5) / kHeights);
      const double a = height_at(double(k) / kHeights), b = height_at((k + 1.0) / kHeights);
      height_[k] = (b - a) * (b + a);
    }
    for (int k = 0; k < kTurns; ++k) {
      turn_[k] = turn_at((k + 0.5) / kTurns);
      width_[k] = (turn_at((k + 1.0) / kTurns) - turn_at(double(k) / kTurns)) * 2 / kPi<double>;
    }
  }

  /// x along the wider axis.
  Vec3d at(int node) const {
    const double z = z_[node / kTurns], s = std::sqrt((1 - z) * (1 + z)),
                 turn = turn_[node % kTurns];
    return {s * std::sin(turn), s * std::cos(turn), z};
  }
  /// Of the mean over the hemisphere with the cosine.
  double weight(int node) const { return height_[node / kTurns] * width_[node % kTurns]; }

  /// Calls visit(node, weight) for the nodes that a value along `w` is interpolated from.
  template <class Visit>
  void spread(Vec3d w, const Visit& visit) const {
    const double root = axes::grazing_direction(w.z);
    const Cubic height(root * std::sqrt(root) * kHeights - 0.5, 0, kHeights - 4);
    const Cubic turn(axes::azimuth(stretch_ * w.x, w.y) * kTurns - 0.5, -2, kTurns - 2);
    for (int t = 0; t < 4; ++t) {
      const int k = turn.first + t, mirrored = k < 0 ? -1 - k : k < kTurns ? k : 2 * kTurns - 1 - k;
      for (int h = 0; h < 4; ++h)
        visit((height.first + h) * kTurns + mirrored, height.weight[h] * turn.weight[t]);
    }
  }

  double value(const Values& of, Vec3d w) const {
    double sum = 0;
    spread(w, [&](int node, double weight) { sum += weight * of[node]; });
    return sum;
  }

 private:
  static double height_at(double place) {
    return std::sin(std::pow(place, 8.0 / 3) * kPi<double> / 2);
  }
  /// The azimuth from the narrower axis: the inverse of axes::azimuth.
  double turn_at(double place) const {
    const double a = place * kPi<double> / 2;
    return std::atan2(std::sin(a), stretch_ * std::cos(a));
  }

  double stretch_;  ///< of azimuths: the root of the quotient of both widths
  double z_[kHeights], height_[kHeights], turn_[kTurns], width_[kTurns];
};

/// White stretched facets as a matrix: row o holds what light along o is spread to; rows sum to 1.
template <class Facets>
class Lobe {
 public:
  Lobe(double wide, double narrow)
      : facets_{{wide, narrow}}, directions_(wide / narrow), rows_(kNodes, Values(kNodes)) {
    const std::vector<Facet> all = all_facets(facets_, 10946, 6765);
    for (int o = 0; o < kNodes; ++o) add(o, all);
    give_back();
  }

  const Directions& directions() const { return directions_; }

  /// Of some functions at once, as rows take longer to fetch than to sum.
  std::vector<Values> means(const std::vector<Values>& of) const {
    std::vector<Values> all(of.size(), Values(kNodes));
    for (int o = 0; o < kNodes; ++o)
      for (std::size_t n = 0; n < of.size(); ++n) all[n][o] = product(rows_[o], of[n]);
    return all;
  }

 private:
  /// In parts that the compiler may sum side by side.
  static double product(const Values& a, const Values& b) {
    constexpr int kParts = 8;
    double part[kParts] = {};
    for (int i = 0; i < kNodes; i += kParts)
      for (int k = 0; k < kParts; ++k) part[k] += a[i + k] * b[i + k];
    double sum = 0;
    for (const double p : part) sum += p;
    return sum;
  }

  /// A row of single bounces.
  void add(int row, const std::vector<Facet>& all) {
    const double seen =
        single_bounces(facets_, all, directions_.at(row), [&](Vec3d wi, double share) {
          directions_.spread(wi, [&](int i, double part) { rows_[row][i] += share * part; });
        });
    for (double& x : rows_[row]) x /= seen;
  }

  /// What single bounces lose, as materials/energy.h does.
  void give_back() {
    Values lost(kNodes);
    double mean = 0;
    for (int o = 0; o < kNodes; ++o) {
      lost[o] = std::max(0.0, 1 - std::accumulate(rows_[o].begin(), rows_[o].end(), 0.0));
      mean += lost[o] * directions_.weight(o);
    }
    for (int o = 0; o < kNodes; ++o) {
      if (mean > 0)
        for (int i = 0; i < kNodes; ++i)
          rows_[o][i] += lost[o] * lost[i] * directions_.weight(i) / mean;
      const double sum = std::accumulate(rows_[o].begin(), rows_[o].end(), 0.0);
      for (double& x : rows_[o]) x /= sum;
    }
  }

  Facets facets_;
  Directions directions_;
  std::vector<Values> rows_;
};

/// The inverse of axes::stretched_coat_index.
double index_at(double place) {
  using namespace axes;
  return index_of(kLeastCoatIndex + (kMostCoatIndex - kLeastCoatIndex) * place);
}

/// Coats that a lobe lies below, by how broad they are.
constexpr int kUnder = std::size(axes::kStretchedHeld);

/// What the tables hold for a coat of index `eta`, along all directions of the lobe.
struct Coated {
  Values coat, under[kUnder];  ///< as a coat as broad as `broad`; below one of each breadth

  template <class Lobe>
  Coated(const Lobe& lobe, double eta, const Broadness<double>& broad) {
    const auto of = [&](const Broadness<double>& b) {
      return CoatShares(
          kNodes, [&](int o) { return lobe.directions().at(o).z; }, eta, b);
    };
    std::vector<Values> shares = {of(broad).reflected};
    for (const double held : axes::kStretchedHeld) shares.push_back(of({held, 0}).through);
    const auto squares = scaled(lobe, shares);
    coat = as_coat(squares[0], shares[0]);
    for (int b = 0; b < kUnder; ++b) under[b] = below_coat(squares[1 + b], shares[1 + b]);
  }
};

/// Of stretched facets less of round ones, for each index and direction, at all shapes.
struct Differences {
  std::vector<Values> coat, under[kUnder];

  explicit Differences(int shapes)
      : coat(axes::kStretchedCoatIndex * axes::kStretchedCoatDirection, Values(shapes)) {
    std::fill_n(under, kUnder, coat);
  }
};

template <template <class> class Distribution>
Differences differences(const ShapeFit& shapes, double root, const CoatedTables& round) {
  using namespace axes;
  Differences all(shapes.count());
  for (int first = 0, end = 0; first < shapes.count(); first = end) {
    // All shapes of one ring are the same facets, along other directions.
    const double aspect = shapes.facets(first).wide, wide = root * aspect, narrow = root / aspect;
    while (end < shapes.count() && std::abs(shapes.facets(end).wide - aspect) < 1e-6) ++end;
    const Lobe<Distribution<double>> lobe(wide, narrow);
    // Calls visit(d, i, w) for all directions.
    const auto for_each_direction = [&](const auto& visit) {
      for (int d = 0; d < kStretchedCoatDirection; ++d) {
        const double z = cosine_at(std::max(double(d) / (kStretchedCoatDirection - 1), 1e-3)),
                     s = std::sqrt((1 - z) * (1 + z));
        for (int i = first; i < end; ++i) {
          const auto seen = shapes.facets(i);
          visit(d, i, Vec3d{s * seen.x, s * seen.y, z});
        }
      }
    };
    // `stretched` is of the index `eta`, `like(width, place)` what tables of round facets hold.
    const auto fill = [&](std::vector<Values>& to, int n, const Values& stretched,
                          const auto& like) {
      for_each_direction([&](int d, int i, Vec3d w) {
        const auto width =
            CoatedLobe<double>::facet_width(FacetsAlong<double>(wide, narrow, w).like);
        to[n * kStretchedCoatDirection + d][i] =
            lobe.directions().value(stretched, w) - like(width, coat_direction(w.z));
      });
    };
    for (int n = 0; n < kStretchedCoatIndex; ++n) {
      const double eta = index_at(double(n) / (kStretchedCoatIndex - 1));
      const Coated coated(lobe, eta, Broadness<double>::facets(root));
      fill(all.coat, n, coated.coat, [&](const auto& width, double place) {
        return interpolate_coat(round.coat, width, eta, place);
      });
      for (int b = 0; b < kUnder; ++b) {
        const auto weights = lagrange<double>(kHeld, kStretchedHeld[b]);
        fill(all.under[b], n, coated.under[b], [&](const auto& width, double place) {
          return interpolate_coat(round.under, weights.data(), int(weights.size()), width, eta,
                                  place);
        });
      }
    }
  }
  return all;
}

}  // namespace

template <template <class> class Distribution>
StretchedTables stretched_coats(const CoatedTables& round) {
  using namespace axes;
  const ShapeFit shapes(kStretchedCoatShapes);
  const int steps = kStretchedCoatAlpha - 1, terms = shapes.terms();
  // As it is of mirrors: nothing.
  const Grid nothing({kStretchedCoatAlpha, kStretchedCoatIndex, kStretchedCoatDirection, terms},
                     [](const double*) { return 0.0; });
  std::vector<Grid> fitted(1 + kUnder, nothing);
  parallel(steps, [&](int k) {
    const double place = (k + 1.0) / steps;
    const auto all = differences<Distribution>(shapes, place * place * place, round);
    const auto fit = [&](const std::vector<Values>& values, Grid& to) {
      double* p = &to.values[(k + 1) * values.size() * terms];
      for (const Values& of_shapes : values)
        for (int t = 0; t < terms; ++t) *p++ = shapes.term(t, of_shapes.data());
    };
    fit(all.coat, fitted[0]);
    for (int b = 0; b < kUnder; ++b) fit(all.under[b], fitted[1 + b]);
  });
  std::vector<std::vector<float>> splines;
  for (const Grid& grid : fitted) {
    const Values coefficients = grid.spline(1);
    splines.emplace_back(coefficients.begin(), coefficients.end());
  }
  return {splines[0], {splines.begin() + 1, splines.end()}};
}

template StretchedTables stretched_coats<Ggx>(const CoatedTables&);
template StretchedTables stretched_coats<Beckmann>(const CoatedTables&);

}  // namespace mms::materials::tables
