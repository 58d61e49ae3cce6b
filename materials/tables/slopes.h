// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What one bounce off an interface of facets does, by quadrature over their slopes: along the
/// direction, and for each of these across it. Nothing here is used when rendering.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/quadrature.h"
#include "materials/facets.h"
#include "materials/fresnel.h"

namespace mms::materials::tables {

/// How slopes t of a distribution of width 1 are laid out over m in (-1, 1), so that their density
/// times the slope's derivative is nearly flat; `density` is of t^2, `spread` how much wider the
/// slopes across are at a slope t along. `kPoints` keep what stretched facets lose within 2e-4, see
/// Cuts.
struct GgxSlopes {
  static constexpr int kPoints = 14;
  static double place(double t) { return std::atan(t) * (2 / kPi<double>); }
  static double slope(double m) { return std::tan(m * kPi<double> / 2); }
  static double derivative(double, double t) { return kPi<double> / 2 * (1 + t * t); }
  static double density(double t2) { return 1 / ((1 + t2) * (1 + t2)); }
  static double spread(double t) { return std::sqrt(1 + t * t); }
};
struct BeckmannSlopes {
  static constexpr int kPoints = 16;
  static double place(double t) { return std::tanh(t); }
  static double slope(double m) { return std::atanh(m); }
  static double derivative(double m, double) { return 1 / ((1 - m) * (1 + m)); }
  static double density(double t2) { return std::exp(-t2); }
  static double spread(double) { return 1; }
};
inline GgxSlopes slopes_of(const Ggx<double>&) { return {}; }
inline BeckmannSlopes slopes_of(const Beckmann<double>&) { return {}; }

/// Gauss's rules of 1 to `kMost` points, for numbers that are known late.
class Rules {
 public:
  static constexpr int kMost = 48;

  /// Integral of `f(x)` over [0, 1] by `n` points.
  template <class F>
  static auto integrate(const F& f, int n) {
    static const Rules rules;
    const Rule& rule = rules.of_[std::min(n, kMost) - 1];
    decltype(f(0.0)) sum{};
    for (int i = 0; i < rule.n; ++i) sum += f(rule.x[i]) * rule.w[i];
    return sum;
  }

 private:
  struct Rule {
    int n;
    const double *x, *w;
  };
  std::array<Rule, kMost> of_;

  Rules() { fill(std::make_integer_sequence<int, kMost>()); }
  template <int... N>
  void fill(std::integer_sequence<int, N...>) {
    of_ = {Rule{N + 1, gauss<N + 1>().x.data(), gauss<N + 1>().w.data()}...};
  }
};

/// Places between -1 and 1 where an integral is to be cut.
class Cuts {
 public:
  explicit Cuts(double from) : from_(from) {}

  void add(double place) {
    if (place > from_ + kLeast && place < 1 - kLeast) at_[size_++] = place;
  }
  bool empty() const { return size_ == 0; }

  /// Sum of f over the parts from the first place to 1, with points that crowd at both ends of
  /// each, where f may be as a square root: `points` in a part as long as all, and fewer the
  /// shorter.
  template <class F>
  auto integrate(const F& f, int points) {
    std::sort(at_.begin(), at_.begin() + size_);
    decltype(f(0.0)) sum{};
    double a = from_;
    for (int i = 0; i <= size_; ++i) {
      const double b = i < size_ ? at_[i] : 1;
      if (b - a > kLeast)
        sum +=
            Rules::integrate(
                [&](double s) { return f(a + (b - a) * s * s * (3 - 2 * s)) * (6 * s * (1 - s)); },
                kFew + int(points * std::sqrt((b - a) / 2))) *
            (b - a);
      a = b;
    }
    return sum;
  }

 private:
  static constexpr double kLeast = 1e-9;
  static constexpr int kFew = 4;
  double from_;
  std::array<double, 20> at_;
  int size_ = 0;
};

/// What a facet sends one way, up or down: its share of what meets it, the |cosine| that it leaves
/// the facet at, how much of it other facets then take, and the |cosine| of where it leaves the
/// surface. What leads to the wrong side is all taken.
struct Way {
  double share = 0, facet = 0, taken = 1, cosine = 0;
};

/// Some numbers that are integrated at once.
template <int N>
struct Numbers {
  std::array<double, N> of{};

  Numbers operator*(double x) const {
    Numbers product = *this;
    for (double& v : product.of) v *= x;
    return product;
  }
  Numbers operator/(double x) const { return *this * (1 / x); }
  Numbers& operator+=(const Numbers& b) {
    for (int k = 0; k < N; ++k) of[k] += b.of[k];
    return *this;
  }
};

/// Visits the roots of a x^2 - 2 b x = c. Those that are no numbers are left to Cuts.
template <class Visit>
void visit_roots(double a, double b, double c, const Visit& visit) {
  const double square = b * b + a * c;
  if (!(square >= 0)) return;
  const double q = b + std::copysign(std::sqrt(square), b);
  visit(q / a);
  visit(-c / q);
}

/// Mean over the facets that `wo` sees, each an interface of relative index `eta`, of `value(up,
/// down)`, a number or a sum of some. A facet's normal is (x, y, 1), not of unit length, with x
/// towards `wo` and y across; parts end where reflection or refraction leaves the surface grazing,
/// or is just total, all of which are conics in (x, y), and where those meet the line that the
/// slopes of stretched facets crowd about. What leaves across their wider axis is hidden least, and
/// much more beside that: rows are cut there too. `points`: see Cuts.
template <class Facets, class Value>
auto interface_mean(const Facets& facets, double eta, Vec3d wo, int points, const Value& value) {
  using Result = decltype(value(Way(), Way()));
  using Slopes = decltype(slopes_of(facets));
  const double z = wo.z, s = std::hypot(wo.x, wo.y), s2 = s * s;
  const double cx = s > 0 ? wo.x / s : 1, cy = s > 0 ? wo.y / s : 0;
  const double ax = facets.ax, ay = facets.ay, along = std::hypot(ax * cx, ay * cy);
  const double across = ax * ay / along;  // at one slope along, about a middle of
  const double shear = cx * cy * (ay - ax) * (ay + ax) / (along * along);  // times that slope
  const bool falls = eta < 1, round = ax == ay;
  const double wide_x = ax > ay ? cx : cy, wide_y = ax > ay ? -cy : cx;  // the wider axis
  const double e = (1 - eta) * (1 + eta);  // where the index falls, cos^2 of the critical angle
  const double hidden_wo = facets.shadow(wo);
  const auto hidden = [&](double x, double y, double wz) {  // G2 / G1 away from 1
    const double g = z * facets.shadow(Vec3d{x * cx - y * cy, x * cy + y * cx, wz});
    const double c = std::abs(wz);
    return g / (z * c + hidden_wo * c + g);
  };
  const auto both_ways = [&](double x, double y) {
    const double facing = z + s * x, length2 = 1 + x * x + y * y, inverse = 1 / std::sqrt(length2);
    const double c = std::min(1.0, facing * inverse), twice = 2 * facing / length2;
    const FresnelSplit<double> f = fresnel_split(c, eta);
    Way up{f.reflected, c}, down{f.transmitted};
    if (twice > z) {
      up.taken = hidden(twice * x - s, twice * y, twice - z);
      up.cosine = twice - z;
    }
    if (!(f.transmitted > 0)) return value(up, down);
    const double g = std::sqrt(std::max(0.0, refraction_g2(c, eta)));
    const double bend = e / (c + g) * inverse, fall = (bend - z) / eta;
    down.facet = g / eta;
    if (fall < 0) {
      down.taken = hidden((bend * x - s) / eta, bend * y / eta, fall);
      down.cosine = -fall;
    }
    return value(up, down);
  };
  const auto row = [&](double x) {
    const double t = x / along, width = across * Slopes::spread(t), middle = shear * x;
    const double facing = z + s * x;
    Cuts cuts(round ? 0 : -1);  // round facets are alike on both sides
    const auto cut = [&](double y) { cuts.add(Slopes::place((y - middle) / width)); };
    const auto edge = [&](double y2) {
      if (!(y2 > 0)) return;
      const double y = std::sqrt(y2);
      cut(y);
      if (!round) cut(-y);
    };
    const double d = z * x - s;
    edge((1 - d) * (1 + d) / (z * z));
    if (falls) {
      if (z * s * x <= s2 - eta * eta) edge((eta - d) * (eta + d) / (z * z));
      edge(facing * facing / e - 1 - x * x);
    }
    if (!round) {
      if (cuts.empty() || across > along) cuts.add(0);
      // Normals of the component p = px + y py along that axis, of which wo has `o`.
      const double length2 = 1 + x * x, o = s * wide_x, px = x * wide_x, py = wide_y;
      visit_roots(o, facing * py, 2 * facing * px - o * length2, cut);
      visit_roots(o * o + e * py * py, (o * facing - e * px) * py,
                  (2 * o * facing - e * px) * px - o * o * length2, [&](double y) {
                    if (facing >= o * (length2 + y * y) / (px + y * py)) cut(y);
                  });
    }
    const auto at = [&](double m) {
      const double u = Slopes::slope(m), v = u * width / across;
      const double weight = Slopes::derivative(m, u) * Slopes::density(t * t + v * v);
      return weight > 1e-30 ? both_ways(x, middle + width * u) * weight : Result{};
    };
    return cuts.integrate(at, points / 2) *  // rows are smoother than their sum
           (facing * width);
  };
  const double away = s > 0 ? Slopes::place(-z / s / along) : -1;  // where facets turn away
  Cuts cuts(away);
  if (away < -0.5) cuts.add(0);
  const auto edge = [&](double x) { cuts.add(Slopes::place(x / along)); };
  if (falls && s > eta) edge((s - eta) * (s + eta) / (z * s));
  for (const double k : {0.0, shear}) {  // along y = k x
    const double n = 1 + k * k;
    visit_roots(z * n, s, z, edge);
    if (falls) {
      visit_roots(z * z * n, z * s, (eta - s) * (eta + s), [&](double x) {
        if (z * s * x <= s2 - eta * eta) edge(x);
      });
      // Where light that meets facets along `wo` is just totally reflected.
      visit_roots(s2 - e * n, -z * s, e - z * z, [&](double x) {
        if (z + s * x > 0) edge(x);
      });
    }
    if (round) break;
  }
  const auto along_slopes = [&](double m) {
    const double t = Slopes::slope(m), x = along * t;
    return z + s * x > 0 ? row(x) * Slopes::derivative(m, t) : Result{};
  };
  return cuts.integrate(along_slopes, points) *
         ((round ? 2 : 1) * along / (kPi<double> * ax * ay * (z + hidden_wo)));
}

/// What one bounce loses: what other facets take.
template <class Facets>
double interface_loss(const Facets& facets, double eta, Vec3d wo, int points) {
  return interface_mean(facets, eta, wo, points, [](const Way& up, const Way& down) {
    return up.share * up.taken + down.share * down.taken;
  });
}

}  // namespace mms::materials::tables
