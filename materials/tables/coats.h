// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the programs that make the tables of coats share. Nothing here is used when rendering.

#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/coat.h"
#include "materials/facets.h"
#include "materials/spread.h"
#include "materials/tables/losses.h"

namespace mms::materials::tables {

using Values = std::vector<double>;

/// |Cosine| at a place on the axis of directions.
inline double cosine_at(double place) {
  return cosine(place, [](double z, double) { return axes::coat_direction(z); });
}

/// The slope that a share `u` of facets of width 1 does not exceed.
inline double slope(const Ggx<double>&, double u) { return std::sqrt(u / (1 - u)); }
inline double slope(const Beckmann<double>&, double u) { return std::sqrt(-std::log1p(-u)); }

/// A facet's normal, not of unit length, and the share of the surface below such ones.
struct Facet {
  double x, y, share;
};

/// `count` facets over slopes as polar coordinates, by a lattice: of Fibonacci's numbers, `step`
/// the one before. Slopes crowd at both ends so much that what is summed falls to 0 there, also
/// what grows as a slope of GGX.
template <class Facets>
std::vector<Facet> all_facets(const Facets& facets, int count, int step) {
  std::vector<Facet> all;
  for (int k = 0; k < count; ++k) {
    const double t = (k + 0.5) / count, u = t * t * t * (10 - t * (15 - 6 * t));
    const double phi = 2 * kPi<double> * (k * step % count) / count;
    const double r = slope(facets, u), weight = 30 * (t * (1 - t)) * (t * (1 - t)) / count;
    all.push_back({r * facets.ax * std::cos(phi), r * facets.ay * std::sin(phi), weight});
  }
  return all;
}

/// Calls visit(wi, share) for all single bounces of light along `wo` off `all` of them, masked.
/// Returns the area that `wo` sees, which shares are of.
template <class Facets, class Visit>
double single_bounces(const Facets& facets, const std::vector<Facet>& all, Vec3d wo,
                      const Visit& visit) {
  const double z = wo.z, shadow = facets.shadow(wo);
  double seen = 0;
  for (const Facet& f : all) {
    const double facing = z + wo.x * f.x + wo.y * f.y;
    if (!(facing > 0)) continue;
    const double area = facing * f.share, twice = 2 * facing / (1 + f.x * f.x + f.y * f.y);
    seen += area;
    const double c = std::min(twice - z, 1.0);
    if (!(c > 0)) continue;
    const Vec3d wi{twice * f.x - wo.x, twice * f.y - wo.y, c};
    visit(wi, area * (z + shadow) * c / (z * c + shadow * c + z * facets.shadow(wi)));
  }
  return seen;
}

/// Lagrange's cubic through the four nodes from the second below `x` on, a step apart.
struct Cubic {
  int first;
  double weight[4];

  /// `first` stays within [least, most].
  Cubic(double x, int least, int most) : first(std::clamp(int(std::floor(x)) - 1, least, most)) {
    const double a = x - first, b = a - 1, c = a - 2, d = a - 3;
    weight[0] = -b * c * d / 6;
    weight[1] = a * c * d / 2;
    weight[2] = -a * b * d / 2;
    weight[3] = a * b * c / 6;
  }
};

/// G^2 of materials/coated.h of a lobe that is to reflect each of some shares A, from g = A /
/// sqrt(K A), which is nearly right, by powers of what is still wrong (Knight, Ruiz and Ucar 2014:
/// the symmetric form of Sinkhorn's iteration), four in turn as in materials/spread.h.
template <class Lobe>
std::vector<Values> scaled(const Lobe& lobe, const std::vector<Values>& shares) {
  std::vector<Values> all = shares, means;
  const auto spread = [&] {
    means = lobe.means(all);
    for (Values& mean : means)
      for (double& m : mean) m = std::max(m, 1e-9);  // cubics between nodes may swing below 0
  };
  spread();
  double worst = 1;
  for (int step = 0; step < 100 && worst > 1e-7; ++step) {
    worst = 0;
    for (std::size_t n = 0; n < all.size(); ++n)
      for (std::size_t o = 0; o < all[n].size(); ++o) {
        double& g = all[n][o];
        const double share = shares[n][o], mean = means[n][o];
        worst = std::max(worst, std::abs(g * mean - share));
        g *= std::pow(share / (g * mean), scaling_power<double>(step % 4, 4));
      }
    spread();
  }
  for (Values& mean : means)
    for (double& m : mean) m *= m;
  return means;
}

/// What CoatedTables hold of `squares`, these G^2: below a coat and as one.
inline Values below_coat(Values squares, const Values& through) {
  for (std::size_t o = 0; o < squares.size(); ++o) squares[o] -= through[o];
  return squares;
}
inline Values as_coat(Values squares, const Values& reflected) {
  for (std::size_t o = 0; o < squares.size(); ++o) squares[o] = std::log(squares[o] / reflected[o]);
  return squares;
}

/// E and T of a coat along directions of the |cosines| `z`.
struct CoatShares {
  Values reflected, through;

  template <class Cosine>
  CoatShares(int count, const Cosine& z, double eta, const Broadness<double>& broad)
      : reflected(count), through(count) {
    const CoatShape<double> coat(broad, std::max(fresnel_dielectric_diffuse(eta), 0.0));
    for (int o = 0; o < count; ++o) {
      const auto e = coat.split(z(o), eta);
      reflected[o] = e.reflected;
      through[o] = e.transmitted;
    }
  }
};

/// What stretched facets of a distribution have other than round ones: coefficients of
/// [width][index][direction][term of ShapeBasis].
struct StretchedTables {
  std::vector<float> coat;                ///< CoatedTables::coat_stretched
  std::vector<std::vector<float>> under;  ///< CoatedTables::under_stretched
};
/// From the tables of round ones.
template <template <class> class Distribution>
StretchedTables stretched_coats(const CoatedTables& round);

/// CoatedTables::spread_stretched, of `roots` of widths, by a lattice of facets as in all_facets.
template <template <class> class Distribution>
std::vector<float> stretched_spread(int roots, int facets, int step);

}  // namespace mms::materials::tables
