// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What one bounce off an interface of facets does, by quadrature over their slopes: along the
/// direction, and for each of these across it. Nothing here is used when rendering.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/exponential.h"
#include "base/quadrature.h"
#include "materials/facets.h"
#include "materials/fresnel.h"

namespace mms::materials::tables {

/// e^x, x <= 0, and the natural logarithm of a positive number: those of base/exponential.h in
/// float. Relative errors of the polynomials 1e-8 and 3e-9.
MMS_INLINE float exp_down(float x) {
  constexpr float kRound = 0x1.8p23f, kHigh = 0x1.62e4p-1f, kLow = 0x1.7f7d1cp-20f;
  const float known = x > -87 ? x : -87.0f, t = core::fused(known, 0x1.715476p+0f, kRound);
  const float k = t - kRound, r = core::fused(-k, kLow, core::fused(-k, kHigh, known));
  const float small = core::fused(
      r * r,
      core::polynomial(r, 0x1p-1f, 0x1.5554dcp-3f, 0x1.55551ap-5f, 0x1.120b6ep-7f, 0x1.6d110ap-10f),
      r);
  const float scale = core::bits<float>((core::bits<std::uint32_t>(t) << 23) + 0x3f800000u);
  return core::fused(scale, small, scale);
}
MMS_INLINE float log_in_range(float x) {
  constexpr std::uint32_t root_half = 0x3f3504f3u;
  const std::uint32_t b = core::bits<std::uint32_t>(x) - root_half;
  const float k = float(std::int32_t(b) >> 23);
  const float m = core::bits<float>((b & 0x007fffffu) + root_half);
  const float s = (m - 1) / (m + 1), t = s * s;
  const float log_m = core::fused(
      s * t, core::polynomial(t, 0x1.55555cp-1f, 0x1.997c2ep-2f, 0x1.2ee656p-2f), 2 * s);
  return core::fused(k, 0x1.62e43p-1f, log_m);
}
MMS_INLINE double exp_down(double x) { return core::exp_core(x); }
MMS_INLINE double log_in_range(double x) { return core::log_in_range(x); }

/// How slopes t of a distribution of width 1 are laid out over m in (-1, 1), so that their density
/// times the slope's derivative is nearly flat; `density` is of t^2, `spread` how much wider the
/// slopes across are at a slope t along. `kPoints` keep what stretched facets lose within 2e-4, see
/// Cuts. But for `place`, all only select, without libm: loops over them are computed side by side.
struct GgxSlopes {
  static constexpr int kPoints = 14;
  static double place(double t) { return std::atan(t) * (2 / kPi<double>); }
  /// tan(m pi / 2). Polynomial, of its product with 1 - m^2: relative error 3e-11.
  template <class R>
  MMS_INLINE static R slope(R m) {
    const R a = std::abs(m), b = a > R(0.5) ? 1 - a : a, b2 = b * b;
    const R p = b * core::polynomial(b2, R(0x1.921fb544176bfp+0), R(-0x1.1d8f9b00115efp-2),
                                     R(-0x1.1403090b67d0ep-6), R(-0x1.ae770d29fddccp-10),
                                     R(-0x1.8b53360ac9a8fp-13));
    return std::copysign((a > R(0.5) ? 1 - b2 : p) / (a > R(0.5) ? p : 1 - b2), m);
  }
  template <class R>
  MMS_INLINE static R derivative(R, R t) {
    return kPi<R> / 2 * (1 + t * t);
  }
  MMS_INLINE static float density(float t2) { return 1 / ((1 + t2) * (1 + t2)); }
  template <class R>
  MMS_INLINE static R spread(R t) {
    return std::sqrt(1 + t * t);
  }
  MMS_INLINE static float shadow(const Ggx<float>& facets, Vec3<float> w) {
    return facets.shadow(w);
  }
};
struct BeckmannSlopes {
  static constexpr int kPoints = 16;
  static double place(double t) { return std::tanh(t); }
  template <class R>
  MMS_INLINE static R slope(R m) {
    return log_in_range((1 + m) / (1 - m)) / 2;
  }
  template <class R>
  MMS_INLINE static R derivative(R m, R) {
    return 1 / ((1 - m) * (1 + m));
  }
  MMS_INLINE static float density(float t2) { return exp_down(-t2); }
  template <class R>
  MMS_INLINE static R spread(R) {
    return 1;
  }
  /// Beckmann::shadow. Polynomial, of exp(a^2) s(a) / v^2 over v: relative error 7e-9.
  template <class R>
  MMS_INLINE static R shadow(const Beckmann<R>& facets, Vec3<R> w) {
    const R t = facets.tangent(w), z = std::abs(w.z);
    const bool far = z > 6 * t;
    const R a = far ? R(6) : z / t, v = 1 / (1 + R(0.4) * a);
    const R s = exp_down(-a * a) * (v * v) *
                core::polynomial(v, R(0x1.723a129e424c7p-5), R(0x1.6c31ebbf89706p-4),
                                 R(0x1.1b1747f2eedb7p-3), R(0x1.de7c323e57093p-5),
                                 R(0x1.a340836f5465cp-2), R(-0x1.37f7d463250b3p-1),
                                 R(0x1.1aa209222a762p+0), R(-0x1.102f56c506a31p+0),
                                 R(0x1.e5d2c30e64c19p-2), R(-0x1.4f8993380809dp-4));
    return far ? R(0) : t * s / 2;
  }
};
inline GgxSlopes slopes_of(const Ggx<double>&) { return {}; }
inline BeckmannSlopes slopes_of(const Beckmann<double>&) { return {}; }
template <template <class> class Distribution>
using SlopesOf = decltype(slopes_of(std::declval<Distribution<double>>()));

/// Gauss's rules of 1 to `kMost` points over [0, 1], for numbers that are known late, with points
/// that crowd at both ends.
class Rules {
 public:
  static constexpr int kMost = 48;

  /// Calls visit(x, weight) for the points of the rule of `n`.
  template <class Visit>
  static void visit(int n, const Visit& visit) {
    static const Rules rules;
    const Rule& rule = rules.of_[std::min(n, kMost) - 1];
    for (int i = 0; i < rule.n; ++i) visit(rule.x[i], rule.w[i]);
  }

 private:
  struct Rule {
    int n;
    std::array<double, kMost> x, w;
  };
  std::array<Rule, kMost> of_;

  Rules() { fill(std::make_integer_sequence<int, kMost>()); }
  template <int... N>
  void fill(std::integer_sequence<int, N...>) {
    of_ = {crowded(gauss<N + 1>())...};
  }
  template <int N>
  static Rule crowded(const GaussRule<N>& gauss) {
    Rule rule{N, {}, {}};
    for (int i = 0; i < N; ++i) {
      const double s = gauss.x[i];
      rule.x[i] = s * s * (3 - 2 * s);
      rule.w[i] = gauss.w[i] * (6 * s * (1 - s));
    }
    return rule;
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

  /// Calls visit(place, weight) for points of the parts from the first place to 1, that crowd at
  /// both ends of each, where what is integrated may be as a square root: `points` in a part as
  /// long as all, and fewer the shorter.
  template <class Visit>
  void visit(int points, const Visit& visit) {
    std::sort(at_.begin(), at_.begin() + size_);
    double a = from_;
    for (int i = 0; i <= size_; ++i) {
      const double b = i < size_ ? at_[i] : 1, length = b - a;
      if (length > kLeast)
        Rules::visit(kFew + int(points * std::sqrt(length / 2)),
                     [&](double x, double weight) { visit(a + length * x, length * weight); });
      a = b;
    }
  }

  static constexpr int kMost = 20;  ///< of them, at most

 private:
  static constexpr double kLeast = 1e-9;
  static constexpr int kFew = 4;
  double from_;
  std::array<double, kMost> at_;
  int size_ = 0;
};

/// What a facet sends one way, up or down: its share of what meets it, the |cosine| that it leaves
/// the facet at, how much of it other facets then take, and the |cosine| of where it leaves the
/// surface. What leads to the wrong side is all taken.
struct Way {
  double share = 0, facet = 0, taken = 1, cosine = 0;
};

/// What facets of a row send both ways, side by side, so that it is computed so, and in float: by
/// their `place` along the row; each counts with `weight`.
struct Bounces {
  static constexpr int kTogether = 8, kMost = (Cuts::kMost + 1) * Rules::kMost;
  using Values = std::array<float, kMost>;
  struct Ways {
    Values share, facet, taken, cosine;
    Way at(int i) const { return {share[i], facet[i], taken[i], cosine[i]}; }
  };

  Values place, weight;
  Ways up, down;
  int size = 0;

  void add(double at, double w) {
    constexpr float kEnd = 1 - 0x1p-24f;
    place[size] = std::clamp(float(at), -kEnd, kEnd), weight[size++] = float(w);
  }
  /// To a multiple of kTogether, with what does not count.
  void fill_up() {
    while (size % kTogether) add(0, 0);
  }
};
static_assert(Bounces::kMost % Bounces::kTogether == 0);

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

/// What facets do to light along a direction that sees them, in rows of one x of normals (x, y, 1).
/// In float, which moves losses by up to 2e-7: where rows end and their sums are in double.
template <template <class> class Distribution>
struct RowsOfFacets {
  using Slopes = SlopesOf<Distribution>;
  /// x, that as a slope of width 1, what the normals have along the direction, and the middle and
  /// the width of y.
  struct Row {
    float x, slope, facing, middle, width;
  };

  Distribution<float> facets;
  float eta, inverse_eta, e;   ///< relative index; eta^2 - 1
  float z, s, cx, cy, shadow;  ///< of the direction

  /// Copies, by which the compiler knows that nothing of them changes.
  [[gnu::noinline]] static void bounce(const RowsOfFacets seen, const Row row, Bounces& to) {
    const float spread = Slopes::spread(row.slope);
    const int size = to.size / Bounces::kTogether * Bounces::kTogether;
    for (int i = 0; i < size; ++i) {
      const float m = to.place[i], u = Slopes::slope(m), v = u * spread;
      to.weight[i] *= Slopes::derivative(m, u) * Slopes::density(row.slope * row.slope + v * v);
      seen.bounce(row.x, row.middle + row.width * v, row.facing, i, to);
    }
  }

 private:
  MMS_INLINE void bounce(float x, float y, float facing, int i, Bounces& to) const {
    const float length2 = 1 + x * x + y * y, inverse = 1 / std::sqrt(length2);
    const float cosine = facing * inverse, c = cosine < 1 ? cosine : 1.0f;
    const FresnelSplit<float> f = fresnel_split(c, eta, e);
    const float twice = 2 * cosine * inverse, rise = twice - z;
    const bool rises = rise > 0;
    const float out = rises ? rise : 0.0f, taken = hidden(twice * x - s, twice * y, out);
    to.up.share[i] = f.reflected;
    to.up.facet[i] = c;
    to.up.taken[i] = rises ? taken : 1.0f;
    to.up.cosine[i] = out;
    const float g2 = refraction_g2(c, eta, e), g = std::sqrt(g2 > 0 ? g2 : 0.0f);
    const float bend = -e / (c + g) * inverse, fall = (z - bend) * inverse_eta;
    const bool falls = fall > 0;  // in total reflection, of which the share is 0, no matter
    const float through = falls ? fall : 0.0f;
    const float kept = hidden((bend * x - s) * inverse_eta, bend * y * inverse_eta, through);
    to.down.share[i] = f.transmitted;
    to.down.facet[i] = g * inverse_eta;
    to.down.taken[i] = falls ? kept : 1.0f;
    to.down.cosine[i] = through;
  }

  /// G2 / G1 away from 1, of light that leaves along (x, y) at the |cosine| `c`.
  MMS_INLINE float hidden(float x, float y, float c) const {
    const float g = z * Slopes::shadow(facets, {x * cx - y * cy, x * cy + y * cx, c});
    return g / (z * c + shadow * c + g);
  }
};

/// The facets that `wo` sees, each an interface of relative index `eta`. A facet's normal is (x, y,
/// 1), not of unit length, with x towards `wo` and y across, in rows of one x.
template <template <class> class Distribution>
class SeenFacets {
 public:
  using Facets = Distribution<double>;

  SeenFacets(const Facets& facets, double eta, Vec3d wo)
      : facets_(facets), eta_(eta), z_(wo.z), s_(std::hypot(wo.x, wo.y)) {
    if (s_ > 0) cx_ = wo.x / s_, cy_ = wo.y / s_;
    const double ax = facets.ax, ay = facets.ay;
    along_ = std::hypot(ax * cx_, ay * cy_);
    across_ = ax * ay / along_;
    shear_ = cx_ * cy_ * (ay - ax) * (ay + ax) / (along_ * along_);
    round_ = ax == ay;
    e_ = (1 - eta) * (1 + eta);
    shadow_ = facets.shadow(wo);
    rows_.facets = {{float(ax), float(ay)}};
    rows_.eta = float(eta), rows_.inverse_eta = float(1 / eta), rows_.e = float(-e_);
    rows_.z = float(z_), rows_.s = float(s_), rows_.shadow = float(shadow_);
    rows_.cx = float(cx_), rows_.cy = float(cy_);
  }

  /// Mean of `value(up, down)`, a number or a sum of some. `points`: see Cuts.
  template <class Value>
  auto mean(int points, const Value& value) const {
    decltype(value(Way(), Way())) sum{};
    Bounces row;
    cuts_along().visit(points, [&](double m, double weight) {
      const double t = Slopes::slope(m), x = along_ * t, facing = z_ + s_ * x;
      if (!(facing > 0)) return;
      row.size = 0;
      cuts_across(x).visit(points / 2,  // rows are smoother than their sum
                           [&](double place, double w) { row.add(place, w); });
      row.fill_up();
      Rows::bounce(rows_, {float(x), float(t), float(facing), float(shear_ * x), float(across_)},
                   row);
      const double scale = weight * Slopes::derivative(m, t) * facing * across_ * Slopes::spread(t);
      decltype(sum) of_row{};
      for (int i = 0; i < row.size; ++i)
        if (row.weight[i] > 1e-30f)
          of_row += value(row.up.at(i), row.down.at(i)) * double(row.weight[i]);
      sum += of_row * scale;
    });
    return sum *
           ((round_ ? 2 : 1) * along_ / (kPi<double> * facets_.ax * facets_.ay * (z_ + shadow_)));
  }

 private:
  using Slopes = SlopesOf<Distribution>;
  using Rows = RowsOfFacets<Distribution>;

  /// Where parts of the rows' sum end: where reflection or refraction leaves the surface grazing,
  /// or is just total, all of which are conics in (x, y), and where those meet the line that the
  /// slopes of stretched facets crowd about.
  Cuts cuts_along() const {
    const double away = s_ > 0 ? Slopes::place(-z_ / s_ / along_) : -1;  // where facets turn away
    const double s2 = s_ * s_;
    Cuts cuts(away);
    if (away < -0.5) cuts.add(0);
    const auto edge = [&](double x) { cuts.add(Slopes::place(x / along_)); };
    if (falls() && s_ > eta_) edge((s_ - eta_) * (s_ + eta_) / (z_ * s_));
    for (const double k : {0.0, shear_}) {  // along y = k x
      const double n = 1 + k * k;
      visit_roots(z_ * n, s_, z_, edge);
      if (falls()) {
        visit_roots(z_ * z_ * n, z_ * s_, (eta_ - s_) * (eta_ + s_), [&](double x) {
          if (z_ * s_ * x <= s2 - eta_ * eta_) edge(x);
        });
        // Where light that meets facets along `wo` is just totally reflected.
        visit_roots(s2 - e_ * n, -z_ * s_, e_ - z_ * z_, [&](double x) {
          if (z_ + s_ * x > 0) edge(x);
        });
      }
      if (round_) break;
    }
    return cuts;
  }

  /// The same of the row at `x`. What leaves across the wider axis is hidden least, and much more
  /// beside that: rows are cut there too.
  Cuts cuts_across(double x) const {
    const double middle = shear_ * x, width = across_ * Slopes::spread(x / along_);
    const double facing = z_ + s_ * x;
    Cuts cuts(round_ ? 0 : -1);  // round facets are alike on both sides
    const auto cut = [&](double y) { cuts.add(Slopes::place((y - middle) / width)); };
    const auto edge = [&](double y2) {
      if (!(y2 > 0)) return;
      const double y = std::sqrt(y2);
      cut(y);
      if (!round_) cut(-y);
    };
    const double d = z_ * x - s_;
    edge((1 - d) * (1 + d) / (z_ * z_));
    if (falls()) {
      if (z_ * s_ * x <= s_ * s_ - eta_ * eta_) edge((eta_ - d) * (eta_ + d) / (z_ * z_));
      edge(facing * facing / e_ - 1 - x * x);
    }
    if (!round_) {
      if (cuts.empty() || across_ > along_) cuts.add(0);
      // Normals of the component p = px + y py along the wider axis, of which wo has `o`.
      const bool turned = facets_.ax <= facets_.ay;
      const double wide_x = turned ? cy_ : cx_, wide_y = turned ? cx_ : -cy_;
      const double length2 = 1 + x * x, o = s_ * wide_x, px = x * wide_x, py = wide_y;
      visit_roots(o, facing * py, 2 * facing * px - o * length2, cut);
      visit_roots(o * o + e_ * py * py, (o * facing - e_ * px) * py,
                  (2 * o * facing - e_ * px) * px - o * o * length2, [&](double y) {
                    if (facing >= o * (length2 + y * y) / (px + y * py)) cut(y);
                  });
    }
    return cuts;
  }

  bool falls() const { return eta_ < 1; }

  Facets facets_;
  double eta_;
  double z_, s_, cx_ = 1, cy_ = 0;  ///< of `wo`
  double along_, across_;           ///< widths: across at one slope along, about a middle of
  double shear_;                    ///< times that slope
  bool round_;
  double e_;       ///< where the index falls, cos^2 of the critical angle
  double shadow_;  ///< of `wo`
  Rows rows_;
};

/// Mean over the facets that `wo` sees of `value(up, down)`, a number or a sum of some.
template <template <class> class Distribution, class Value>
auto interface_mean(const Distribution<double>& facets, double eta, Vec3d wo, int points,
                    const Value& value) {
  return SeenFacets<Distribution>(facets, eta, wo).mean(points, value);
}

/// What one bounce loses: what other facets take.
template <class Facets>
double interface_loss(const Facets& facets, double eta, Vec3d wo, int points) {
  return interface_mean(facets, eta, wo, points, [](const Way& up, const Way& down) {
    return up.share * up.taken + down.share * down.taken;
  });
}

}  // namespace mms::materials::tables
