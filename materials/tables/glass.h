// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the programs that make tables of glass below coats share. Nothing here is used when
/// rendering.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "materials/glass_coat.h"
#include "materials/tables/grid.h"
#include "materials/tables/losses.h"
#include "materials/tables/points.h"
#include "materials/tables/shapes.h"
#include "materials/tables/slopes.h"

namespace mms::materials::tables {

/// The index and the width of places along their axes.
inline double glass_index_at(double place, bool falls = false) {
  return index_of(axes::kLeastGlassIndex + (axes::kMostGlassIndex - axes::kLeastGlassIndex) * place,
                  !falls);
}
inline double glass_alpha_at(double place) {
  return std::pow(axes::kLeastGlassAlpha + (1 - axes::kLeastGlassAlpha) * place, 3);
}
/// The |cosine| at a place on the axis of directions, from which light meets the index `eta`; above
/// 0.
inline double glass_cosine_at(bool inside, double place, double alpha, double eta, double root) {
  const double z = cosine(std::min(place, 1 - kLeast), [&](double c, double s) {
    return axes::glass_direction(inside, c, s, alpha, eta);
  });
  return std::max(z, kLeast * root);
}

/// Integrals of t_k of the |cosine| outside.
template <int Points>
using Moments = Numbers<Points>;

template <int Points>
Moments<Points> terms_at(double z) {
  Moments<Points> to;
  const auto t = chebyshev_terms<Points>(z);
  std::copy(t.begin(), t.end(), to.of.begin());
  return to;
}

/// Those of what further bounces send outside, as a share of that: their means over l there
/// (materials/energy.h).
template <int Points, class Facets>
Moments<Points> further_outside(const Facets& facets, double glass) {
  const InterfaceLoss<double> outside{facets.interface(), facets.ax, facets.ay, glass};
  const bool round = facets.ax == facets.ay;
  const auto azimuth_mean = [&](const auto& f) {
    return quarter_mean(facets.ax / facets.ay, round ? 1 : 6, f);
  };
  std::vector<decltype(along_azimuth(outside, 0, 0))> along;
  azimuth_mean([&](double x, double y) {
    along.push_back(along_azimuth(outside, x, y));
    return 0.0;
  });
  const auto sum = height_mean(
      [&](double z, double s) {
        auto next = along.begin();
        const double l = azimuth_mean([&](double, double) { return (*next++)(z, s); });
        return terms_at<Points>(z) * l;
      },
      facets.ax * facets.ay, ridge_of(glass), round ? 24 : 12);
  return sum / sum.of[0];  // t_0 is 1
}

/// The same of light that meets the index `eta`, of all that further bounces send on.
template <int Points, class Facets>
Moments<Points> further_moments(const Facets& facets, double eta, bool inside) {
  const auto mean = [&](double index) {
    return InterfaceLoss<double>{facets.interface(), facets.ax, facets.ay, index}.mean();
  };
  const double across = transmitted_share(mean(eta), mean(1 / eta), eta);
  return further_outside<Points>(facets, inside ? 1 / eta : eta) * (inside ? across : 1 - across);
}

/// The weights of the points for light along `w`, z > 0, from inside the glass or from outside;
/// `further` as further_moments has them.
template <int Points, class Facets>
std::array<double, Points> glass_weights(const Facets& facets, double eta, bool inside, Vec3d w,
                                         const Moments<Points>& further) {
  Moments<Points> sum =
      interface_mean(facets, eta, w, eta < 1 ? 14 : 24, [inside](const Way& up, const Way& down) {
        const Way& out = inside ? down : up;
        const double leaves = out.share * (1 - out.taken);
        return leaves > 0 ? terms_at<Points>(out.cosine) * leaves : Moments<Points>();
      });
  sum += further * InterfaceLoss<double>{facets.interface(), facets.ax, facets.ay, eta}.at(w);
  return point_weights(sum.of);
}

/// Coefficients along every axis but the last.
inline std::vector<float> spline_of(const Grid& grid) {
  const std::vector<double> of = grid.spline(1);
  return {of.begin(), of.end()};
}

/// The table of round facets for light on one side that meets a lower index, where it `falls`, or a
/// higher one. `of(ax, ay, eta)` is, of facets of these widths, what writes the `count` numbers of
/// a direction: called as (w, to).
template <class Of>
std::vector<float> round_table(const axes::GlassGrid& nodes, bool inside, bool falls, int count,
                               const Of& of) {
  Grid grid({nodes.width, nodes.index, nodes.direction, count});
  parallel(nodes.width * nodes.index, [&](int i) {
    const double alpha = glass_alpha_at(double(i / nodes.index) / (nodes.width - 1));
    const double eta = glass_index_at(double(i % nodes.index) / (nodes.index - 1), falls);
    const auto write = of(alpha, alpha, eta);
    for (int d = 0; d < nodes.direction; ++d) {
      const double z =
          glass_cosine_at(inside, double(d) / (nodes.direction - 1), alpha, eta, alpha);
      write(Vec3d{std::sqrt(1 - z * z), 0, z}, &grid.values[(i * nodes.direction + d) * count]);
    }
  });
  return spline_of(grid);
}

/// That of stretched facets, as polynomials over their shapes, of what they have above what
/// `alike(seen, eta, to)` says of the round ones.
template <class Of, class Alike>
std::vector<float> bent_table(const axes::GlassGrid& nodes, bool inside, bool falls, int count,
                              const Of& of, const Alike& alike) {
  const ShapeFit shapes(nodes.shapes);
  const int terms = shapes.terms();
  Grid grid({nodes.width, nodes.index, nodes.direction, count * terms});
  const auto place = [](int i, int n) {
    return inverse([](double x) { return axes::bent_glass(x); }, double(i) / (n - 1));
  };
  parallel(nodes.width * nodes.index, [&](int i) {
    const double like = glass_alpha_at(place(i / nodes.index, nodes.width));
    const double eta = glass_index_at(place(i % nodes.index, nodes.index), falls);
    std::vector<std::vector<double>> values(nodes.direction * count);
    std::vector<double> all(count), round(count);
    for (int shape = 0; shape < shapes.count(); ++shape) {
      auto seen = shapes.facets_like(shape, like, axes::widening(eta, like));
      const double x = seen.x, y = seen.y;
      const auto write = of(seen.wide, seen.narrow, eta);
      for (int d = 0; d < nodes.direction; ++d) {
        const double z = glass_cosine_at(inside, place(d, nodes.direction), like, eta, seen.root());
        const double s = std::sqrt(1 - z * z);
        seen.x = x * s, seen.y = y * s, seen.z = z;
        write(Vec3d{seen.x, seen.y, z}, all.data());
        alike(seen, eta, round.data());
        for (int m = 0; m < count; ++m) values[d * count + m].push_back(all[m] - round[m]);
      }
    }
    for (std::size_t k = 0; k < values.size(); ++k)
      for (int t = 0; t < terms; ++t)
        grid.values[(i * values.size() + k) * terms + t] = shapes.term(t, values[k].data());
  });
  return spline_of(grid);
}

/// Of weights of `From` points those of `To`, for each of `count` functions: [point][function].
template <std::size_t From, std::size_t To>
void fewer_points(const double* weights, int count, double* to) {
  const auto& matrix = chebyshev_transfer<From, To>();
  for (std::size_t m = 0; m < To; ++m)
    for (int k = 0; k < count; ++k) {
      double& sum = to[m * count + k] = 0;
      for (std::size_t n = 0; n < From; ++n) sum += weights[n * count + k] * matrix[n][m];
    }
}

}  // namespace mms::materials::tables
