// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What single bounces off lossless facets lose, for the tables. Nothing here is used when
/// rendering.

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/quadrature.h"
#include "materials/energy.h"
#include "materials/facets.h"
#include "materials/tables/grid.h"
#include "materials/tables/slopes.h"

namespace mms::materials::tables {

inline constexpr double kLeast = 1e-7;  ///< an axis' first direction and width, instead of 0

/// Where in [0, 1] `f`, which rises, is `value`: by halving.
template <class F>
double inverse(const F& f, double value) {
  double lo = 0, hi = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (lo + hi) / 2;
    (f(middle) < value ? lo : hi) = middle;
  }
  return lo;
}

/// cos theta from its place along an axis that maps a cosine and a sine.
template <class Axis>
double cosine(double place, const Axis& axis) {
  const auto at = [&](double x) {
    const double angle = x * kPi<double> / 2;
    return axis(std::sin(angle), std::cos(angle));
  };
  return std::sin(inverse(at, place) * kPi<double> / 2);
}

/// The relative index of which axes::index is `x`; `rising`: above 1.
inline double index_of(double x, bool rising = true) {
  const double part = std::clamp(x * x * x * x, 1e-7, 1 - 1e-4);
  return rising ? (1 + part) / (1 - part) : (1 - part) / (1 + part);
}

/// The relative index of a place on the axis of stretched facets.
inline double bent_index_at(double place, bool rising) {
  using namespace axes;
  place = std::pow(place, 1 / kBentIndexPower[!rising]);
  return index_of(kLeastBentIndex + (kMostBentIndex - kLeastBentIndex) * place, rising);
}
/// That of tables of that `kink`.
inline double bent_index_at(double place, bool rising, double kink) {
  if (rising || kink == 0) return bent_index_at(place, rising);
  const auto at = [&](double x) { return axes::bent_index(bent_index_at(x, rising), kink); };
  return bent_index_at(inverse(at, place), rising);
}
/// The |cosine| of a place on their axis of directions.
inline double bent_cosine_at(double place, double like, double eta, double kink) {
  return cosine(std::min(place, 1 - kLeast), [&](double z, double s) {
    return axes::bent_direction(axes::interface_direction(z, s, like, eta), z, s, like, eta, kink);
  });
}
/// And the width of one on theirs.
inline double bent_width_at(double place) {
  return std::pow(axes::kLeastBentRoot + (1 - axes::kLeastBentRoot) * place, 2);
}

/// Where the losses of an interface have their ridge: the cosine of the critical angle, or 0.
inline double ridge_of(double eta) { return std::sqrt(std::max(0.0, (1 - eta) * (1 + eta))); }

/// Mean over the hemisphere of `f(z, s)`, a number or some, in units of mean_unit; s^2 = 1 - z^2.
/// By rules of eight points over the logarithm of z^2 + alpha^2: `panels` of them, or as many on
/// either side of z = `ridge`, where they are dense.
template <class F>
auto height_mean(const F& f, double alpha2, double ridge, int panels) {
  const double log = std::log1p(1 / alpha2), at = std::log1p(ridge * ridge / alpha2) / log;
  decltype(f(0.0, 0.0)) sum{};
  const auto add = [&](double u, double weight) {
    const double z2 = std::min(1.0, alpha2 * std::expm1(u * log));
    sum += f(std::sqrt(z2), std::sqrt(1 - z2)) * (weight * (z2 / alpha2 + 1));
  };
  for (int n = 0; n < 8 * panels; ++n) {
    const double t = (n / 8 + gauss<8>().x[n % 8]) / panels, weight = gauss<8>().w[n % 8] / panels;
    if (ridge == 0)
      add(t, weight);
    else
      for (const double reach : {-at, 1 - at})
        add(at + reach * t * t * t, weight * 3 * std::abs(reach) * t * t);
  }
  return sum;
}

/// Mean over a quarter of a turn of `f(x, y)`, a number or some, (x, y) of unit length and x along
/// the wider axis of facets of that quotient of both widths: by `n` directions that crowd a little
/// about the narrower one, where losses change fastest.
template <class F>
auto quarter_mean(double aspect, int n, const F& f) {
  const double crowding = std::pow(aspect, 0.2);
  decltype(f(0.0, 0.0)) sum{};
  for (int i = 0; i < n; ++i) {
    const double turn = (i + 0.5) / n * kPi<double> / 2;
    const double x = std::cos(turn), y = crowding * std::sin(turn), length = std::hypot(x, y);
    sum += f(x / length, y / length) * (crowding / (length * length));
  }
  return sum / n;
}

/// What `loss` says along one azimuth, of |cosine| and sine.
inline auto along_azimuth(const FacetLoss<double>& loss, double x, double y) {
  return [=](double z, double s) { return loss.at({s * x, s * y, z}); };
}
/// Of stretched facets of an interface the difference from round ones is a spline there, whose
/// coefficients are found once.
inline auto along_azimuth(const InterfaceLoss<double>& loss, double x, double y) {
  std::vector<double> spline;
  if (loss.ax != loss.ay) {
    const auto seen = loss.stretched({x, y, 0});
    const int count = coefficients(loss.grid().direction);
    for (int k = 0; k < count; ++k) {
      Stencil<double> one{std::min(k, count - 4)};
      one.weight[k - one.first] = 1;
      spline.push_back(loss.difference(seen, seen.like(), one));
    }
  }
  return [=](double z, double s) {
    const Vec3d w{s * x, s * y, z};
    if (spline.empty()) return loss.at(w);
    return loss.at(loss.stretched(w),
                   [&](double, const Stencil<double>& d) { return interpolate(spline.data(), d); });
  };
}

/// The loss of one bounce off lossless mirrors: what other facets take of all that goes up. Of
/// index 1, at which nothing else is to be cut for.
template <class Facets>
double loss(const Facets& facets, Vec3d wo, int points) {
  return interface_mean(facets, 1, wo, points, [](const Way& up, const Way&) { return up.taken; });
}

/// FacetTables::loss.
template <template <class> class Distribution>
std::vector<float> round_losses() {
  const Grid grid({axes::kAlpha, axes::kDirection}, [](const double* x) {
    const double alpha = std::max(x[0] * x[0], 1e-5);
    const auto axis = [&](double z, double s) { return axes::direction(z, s, axes::width(alpha)); };
    const double z = std::max(cosine(std::min(x[1], 1 - kLeast), axis), kLeast * alpha);
    return loss(Distribution<double>{{alpha, alpha}}, {std::sqrt(1 - z * z), 0, z}, 24);
  });
  const std::vector<double> spline = grid.spline();
  return {spline.begin(), spline.end()};
}

}  // namespace mms::materials::tables
