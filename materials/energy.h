// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What microfacets lose to further bounces, from tables that are computed when the project is
/// built (materials/tables/), and the lobes that give it back. Facets that are mirrors come first,
/// those of a dielectric, which also transmit, after them.
///
/// The share that single scattering by lossless facets loses is l(w) = 1 - E(w); its mean over the
/// hemisphere is m = 1/pi int l |w.z| dw. Given back as l(wo) l(wi) / (pi m) (Kulla and Conty
/// 2017), it makes the albedo 1, is symmetric and is smooth.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vec.h"
#include "materials/spline.h"

namespace mms::materials {

/// l over direction and width, for one distribution of normals.
struct FacetTables {
  const float* loss;       ///< [alpha][direction], isotropic
  const float* mean;       ///< [alpha], isotropic, over `mean_unit`
  const float* stretched;  ///< [width][direction][term of ShapeBasis], see FacetLoss::difference
  const float* stretched_mean;  ///< [alpha][aspect]
};
extern const FacetTables kGgxTables, kBeckmannTables;

/// How high polynomials over shapes of stretched facets go (ShapeBasis): to `around` with the
/// angle, to the `step`th part of that with the distance.
struct ShapeOrder {
  int around = 0, step = 3;

  constexpr int outwards() const { return around / step; }
};

/// Nodes of a table of stretched facets of an interface, and its polynomials.
struct BentGrid {
  int width, index, direction;
  ShapeOrder shapes;
};

/// The same of facets of a lossless dielectric, reflection and refraction together: [0] where the
/// index rises on the far side, [1] where it falls. What is said of stretched facets is how they
/// differ from round ones (InterfaceLoss), so that few nodes do.
struct InterfaceTables {
  const float* loss[2];            ///< its root, [alpha][index][direction], isotropic
  const float* mean[2];            ///< [alpha][index], isotropic, over `mean_unit`
  const BentGrid* bent;            ///< [2], of `stretched`
  const float* stretched[2];       ///< [width][index][direction][term of ShapeBasis]
  const float* stretched_mean[2];  ///< [alpha][aspect][index], over the mean of round facets
  float least_mean;                ///< over `mean_unit`: less than any mean is in truth
  float kink;                      ///< see axes::bent_direction
};
extern const InterfaceTables kGgxInterface, kBeckmannInterface;
/// `least_mean` of both; Beckmann's means have no logarithm, which `mean_unit` has.
inline constexpr float kGgxLeastMean = 0.1f, kBeckmannLeastMean = 0.003f;
/// `kink` of both.
inline constexpr float kGgxKink = 0.6f, kBeckmannKink = 0;
/// `bent` of both.
inline constexpr BentGrid kGgxBent[] = {{18, 14, 34, {18}}, {20, 40, 46, {24, 4}}};
inline constexpr BentGrid kBeckmannBent[] = {{22, 18, 38, {20}}, {30, 44, 54, {24, 4}}};

/// How directions and widths are laid out over [0, 1] along the axes of the tables.
namespace axes {

inline constexpr double kMinMeanAlpha = 1e-5;

inline constexpr int kAlpha = 65, kDirection = 65, kMean = 193;
inline constexpr int kStretchedWidth = 36, kStretchedDirection = 60;
inline constexpr ShapeOrder kStretchedShapes{24};
inline constexpr int kStretchedMean = 65, kMeanAspect = 12;
/// [1] where the index falls on the far side: the loss has a ridge along the critical angle there.
inline constexpr int kInterfaceAlpha[] = {23, 35}, kIndex[] = {33, 43};
inline constexpr int kInterfaceDirection[] = {55, 120};
inline constexpr int kInterfaceMean = 65;
/// Bent: of stretched facets of an interface; other nodes in BentGrid.
inline constexpr int kBentMeanAlpha = 25, kBentMeanAspect = 10, kBentMeanIndex = 32;
/// Roots of the least width; below, all is as there, but for its scale. The ends of the axis of
/// indices: 1.0002 and 4, or their inverses.
inline constexpr double kLeastBentRoot = 0.03, kLeastBentFourthRoot = 0.15;
inline constexpr double kLeastBentIndex = 0.1, kMostBentIndex = 0.8801117;
inline constexpr double kBentIndexPower[] = {0.75, 1.2};
/// Of a coat and of lobes below one. As many indices keep what the spline rings by next to
/// infinity, where what is let through changes fast, from those below 4.
inline constexpr int kCoatAlpha = 37, kGloss = 65, kCoatIndex = 49, kCoatDirection = 61;
inline constexpr double kLargestGloss = 5e4;

/// The angle of (x, y) from the x axis, of neither below 0, over a right one: within 2e-8
/// (Abramowitz and Stegun 4.4.49). What is laid out by it and read by it sees none of that.
template <class R>
inline R angle(R y, R x) {
  const R most = std::max(x, y), t = std::min(x, y) / most, u = t * t, u2 = u * u, u4 = u2 * u2;
  const R low = (1 - R(0.3333314528) * u) + u2 * (R(0.1999355085) - R(0.1420889944) * u),
          high = (R(0.1065626393) - R(0.0752896400) * u) +
                 u2 * (R(0.0429096138) - R(0.0161657367) * u) + u4 * R(0.0028662257);
  const R part = t * (low + u4 * high) * (2 / std::numbers::pi_v<R>);
  return most > 0 ? y > x ? 1 - part : part : R(0);
}

/// Of a direction of |cosine| `z` and tangential length `s`; fine where z is near 0 or `width` s.
template <class R>
inline R direction(R z, R s, R width) {
  const R tau = s * width;
  return angle(std::sqrt(z * (std::sqrt(z * z + tau * tau) + z)), tau);
}

/// The scale of directions where masking sets in.
template <class R>
inline R width(R alpha) {
  return alpha / (1 + alpha * alpha);
}

template <class R>
inline R alpha(R a) {
  return std::sqrt(a);
}

template <class R>
inline R interface_alpha(R a) {
  return std::cbrt(a);
}

/// Of a coat: finer where facets are all but flat.
template <class R>
inline R coat_alpha(R a) {
  return std::sqrt(std::sqrt(a));
}

/// For means, which fall as alpha^2 ln(1 / alpha).
template <class R>
inline R log_alpha(R a) {
  return 1 - std::log(a) / R(std::log(kMinMeanAlpha));
}

/// Of the quotient of the wider and the narrower alpha, from 1 to 10.
template <class R>
inline R aspect(R quotient) {
  return std::log(quotient) / std::numbers::ln10_v<R>;
}

/// Of the mean of stretched facets of an interface: finer where they are nearly round.
template <class R>
inline R bent_aspect(R quotient) {
  return std::pow(aspect(quotient), R(0.7));
}
/// Of the width `like` of stretched facets, along which what is sharp stays at one place.
template <class R>
inline R bent_width(R like) {
  return (std::sqrt(like) - R(kLeastBentRoot)) / R(1 - kLeastBentRoot);
}
template <class R>
inline R bent_mean_alpha(R a) {
  return (coat_alpha(a) - R(kLeastBentFourthRoot)) / R(1 - kLeastBentFourthRoot);
}

/// Of a tangent (x, y) that is stretched by the roots of both alphas, half way between the surface,
/// where directions are, and facets that look round.
template <class R>
inline R azimuth(R x, R y) {
  return angle(std::abs(x), std::abs(y));
}

/// Finer towards 0, where it is grazing: losses grow as z^0.8 there for indices near 1.
template <class R>
inline R towards_grazing(R x) {
  return (x + std::sqrt(x)) / 2;
}

/// The same for interfaces, and mirrors that are stretched: two parts `direction`, one angle.
template <class R>
inline R dense_direction(R z, R s, R width) {
  return towards_grazing((2 * direction(z, s, width) + angle(z, s)) / 3);
}

/// The same of one width and index, and where the index falls, `eta` < 1, another: a part of it
/// climbs within `width` of the critical angle, of cosine `zc`; less of it the rougher the facets
/// are, as they blur the ridge away. For indices next to 1 a part climbs where z is zc^2: below,
/// refraction leads to the wrong side. All that is moved by a quotient of linear functions that
/// puts the critical angle at one place for every index: nearly at 1/2, but for rough facets.
template <class R>
class InterfaceDirection {
 public:
  InterfaceDirection() = default;
  InterfaceDirection(R alpha, R eta) : width_(width(alpha)), eta_(eta) {
    if (!(eta < 1)) return;
    const R smooth = (1 - alpha) * (1 - alpha);
    zc_ = std::sqrt((1 - eta) * (1 + eta));
    share_ = R(1.3) * smooth;
    from_ = climb(-zc_);
    span_ = climb(eta) - from_;
    const R at = std::clamp(along_ridge(zc_, eta), R(0.1), R(0.9));
    critical_ = R(0.5) + (at - R(0.5)) * smooth;
  }

  R operator()(R z, R s) const {
    if (!(eta_ < 1)) return dense_direction(z, s, width_);
    const R u = along_ridge(z, s), c = critical_;
    return u * (1 - c) / (u * (1 - 2 * c) + c);
  }

 private:
  R width_ = 1, eta_ = 1, zc_ = 0, share_ = 0, from_ = 0, span_ = 1, critical_ = 0;

  R climb(R sine) const {
    const R scale = R(1.5) * width_;
    return sine / std::sqrt(sine * sine + scale * scale);
  }
  R along_ridge(R z, R s) const {
    const R ridge = (climb(z * eta_ - s * zc_) - from_) / span_, wrong = eta_ * eta_ / 2;
    return (towards_grazing(direction(z, s, width_)) + R(0.7) * towards_grazing(angle(z, s)) +
            share_ * ridge + wrong * direction(z, s, zc_ * zc_)) /
           (R(1.7) + share_ + wrong);
  }
};

template <class R>
inline R interface_direction(R z, R s, R alpha, R eta) {
  return InterfaceDirection<R>(alpha, eta)(z, s);
}

/// Finer towards 1, along the normal, the wider facets are: what steep facets lose there changes
/// within a tenth of a radian, if the index is next to 1.
template <class R>
inline R towards_normal(R x, R alpha) {
  return x - R(0.3) * alpha * (x - (1 - std::sqrt(std::max(1 - x, R(0)))));
}

/// `x` with `share` parts of what is as a cubic root about `at`, where y is that, over 1 + `share`:
/// all of these from 0 to 1.
template <class R>
inline R crowded(R x, R share, R y, R at) {
  const R from = std::cbrt(at), root = (std::cbrt(y - at) + from) / (std::cbrt(1 - at) + from);
  return (x + share * root) / (1 + share);
}

/// The same of stretched facets, from that of round ones, `x`. Steep ones of GGX are so many that
/// their loss has a kink where light along the direction is just not reflected totally by the
/// steepest of all, at the cosine `eta`: `kink` parts are crowded about it as a cubic root, over
/// which a kink is smooth.
template <class R>
inline R bent_direction(R x, R z, R s, R alpha, R eta, R kink) {
  if (!(eta < 1)) return towards_normal(towards_grazing(x), alpha);
  if (kink == 0) return towards_normal(x, alpha);
  const R at = angle(eta, std::sqrt((1 - eta) * (1 + eta)));
  return towards_grazing(crowded(x, kink, angle(z, s), at));
}

/// Of the relative index `eta`: 0 at 1, towards 1 for 0 and infinity. Next to 1, Fresnel's factor
/// changes over cosines of the size of sqrt |eta - 1|, which the fourth root keeps apart.
template <class R>
inline R index(R eta) {
  return std::sqrt(std::sqrt(std::abs(eta - 1) / (eta + 1)));
}

/// The same of stretched facets, where indices above 4 and below 1/4 count as these, and those next
/// to 1, which all but the widest facets take for 1, as nearly 1. Finer next to 1 where the index
/// rises, away from it where it falls.
template <class R>
inline R bent_index(R eta) {
  const R x = (index(eta) - R(kLeastBentIndex)) / R(kMostBentIndex - kLeastBentIndex);
  return x > 0 ? std::pow(x, R(kBentIndexPower[eta < 1])) : R(0);
}

/// That for tables of that `kink`. It is at the critical angle where the index is 1 / sqrt 2, and
/// what crowds about both there moves as a cubic root of the index: so indices crowd about it.
template <class R>
inline R bent_index(R eta, R kink) {
  constexpr R there = R(0.648247), share = R(0.5);
  const R x = bent_index(eta);
  return kink == 0 || !(eta < 1) ? x : crowded(x, share, x, there);
}

/// How much azimuths of stretched facets are widened next to the narrower axis (Shape), where
/// losses change fastest: of mirrors, and of interfaces, but for wide facets that light leaves a
/// high index through.
inline constexpr double kMirrorWidening = 0.25, kWidening = 0.15;
template <class R>
inline R widening(R eta, R like) {
  return eta < 1 ? R(kWidening) - R(0.2) * bent_index(eta) * like : R(kWidening);
}

template <class R>
inline R gloss(R n) {
  return std::log1p(n) / R(std::log1p(kLargestGloss));
}

/// The fourth root of the angle from grazing.
template <class R>
inline R grazing_direction(R z) {
  z = std::min(z, R(1));
  return std::sqrt(std::sqrt(angle(z, std::sqrt((1 - z) * (1 + z)))));
}
/// Of a coat: crowded towards grazing, and as the angle towards the normal.
template <class R>
inline R coat_direction(R z) {
  const R root = grazing_direction(z), root2 = root * root;
  return (3 * root + root2 * root2) / 4;
}

}  // namespace axes

/// What a mean loss of width alpha is measured in.
template <class R>
inline R mean_unit(R alpha2) {
  return alpha2 * std::log1p(1 / alpha2);
}

/// How stretched facets look along a direction: a point of the unit disc, whose centre is round
/// facets and whose rim those ten times as wide along one axis as along the other. Half the angle
/// there is the direction's azimuth from the narrower axis, a little widened next to it or away
/// from it (axes::widening).
template <class R>
struct Shape {
  R u = 0, v = 0;

  /// `x` along the wider axis.
  static Shape of(R wide, R narrow, R x, R y, R widening = R(axes::kWidening)) {
    const R radius = Shape::radius(wide, narrow);
    x *= widened(radius, widening);
    const R length2 = x * x + y * y;
    if (!(length2 > 0)) return {-radius, 0};
    return {radius * ((y - x) * (y + x) / length2), radius * (2 * std::abs(x * y) / length2)};
  }
  static R radius(R wide, R narrow) { return (wide - narrow) / (wide + narrow) * R(11.0 / 9); }
  /// How much tangents of azimuths are: this is smooth at the centre too.
  static R widened(R radius, R widening) {
    return (1 + widening * radius) / (1 - widening * radius);
  }
};

/// Polynomials over the disc of shapes, even in v and 0 at its centre: r^m cos(m angle), r and
/// angle polar coordinates of the disc, times Chebyshev's T_k(2 r^2 - 1), where m + step k <=
/// around: what facets do changes fastest with the angle, next to the rim. Those that do not change
/// with the angle come first, then all of the first `kTogether` angles, of the next, and so on, by
/// rising k: as r^m falls, those of many angles count for nothing where facets are nearly round.
template <class R>
class ShapeBasis {
 public:
  static constexpr int kTogether = 8;  ///< angles that are summed side by side
  static constexpr int kMostAround = 24, kMostOutwards = 8;

  /// Those of the first `groups` of angles.
  static constexpr int terms(ShapeOrder order, int groups) {
    int count = order.outwards();  // without T_0, which is 1
    for (int k = 0; k <= order.outwards(); ++k)
      count += std::min(order.around - order.step * k, groups * kTogether);
    return count;
  }
  static constexpr int terms(ShapeOrder order) {
    return terms(order, (order.around + kTogether - 1) / kTogether);
  }
  static constexpr int kMost = terms({kMostAround});

  int count;  ///< of terms

  ShapeBasis(const Shape<R>& shape, ShapeOrder order) : order_(order) {
    const R u = shape.u, v = shape.v, r2 = u * u + v * v, r8 = r2 * r2 * r2 * r2;
    // Coefficients are no larger than losses: of less, nothing is seen.
    R next = r8 * std::sqrt(r2);
    groups_ = 1;
    for (; groups_ * kTogether < order.around && next > R(1e-5); next *= r8) ++groups_;
    count = terms(order, groups_);
    // Of (u + iv)^m, four m at a time.
    const R u2 = u * u - v * v, v2 = 2 * u * v, u4 = u2 * u2 - v2 * v2, v4 = 2 * u2 * v2;
    R re[4] = {u, u2, u * u2 - v * v2, u4}, im[4] = {v, v2, u * v2 + v * u2, v4};
    std::copy_n(re, 4, around_);
    for (int m = 4; m < groups_ * kTogether; m += 4)
      for (int i = 0; i < 4; ++i) {
        const R x = re[i] * u4 - im[i] * v4, y = re[i] * v4 + im[i] * u4;
        re[i] = x, im[i] = y, around_[m + i] = x;
      }
    const R x = 2 * r2 - 1;
    outwards_[0] = 1, outwards_[1] = x;
    for (int k = 2; k <= order.outwards(); ++k)
      outwards_[k] = 2 * x * outwards_[k - 1] - outwards_[k - 2];
  }

  R sum(const R* coefficients) const {
    const R* c = coefficients;
    R sum = 0;
    for (int k = 1; k <= order_.outwards(); ++k) sum += *c++ * (outwards_[k] - R(k % 2 ? -1 : 1));
    for (int group = 0; group < groups_; ++group) {
      R parts[kTogether] = {};
      int k = 0, left = order_.around - group * kTogether;  // of the angles
      for (; left >= kTogether; ++k, left -= order_.step, c += kTogether)
        for (int i = 0; i < kTogether; ++i) parts[i] += outwards_[k] * c[i];
      for (; left > 0; ++k, c += left, left -= order_.step)
        for (int i = 0; i < left; ++i) parts[i] += outwards_[k] * c[i];
      for (int i = 0; i < kTogether; ++i) parts[i] *= around_[group * kTogether + i];
      sum += ((parts[0] + parts[4]) + (parts[1] + parts[5])) +
             ((parts[2] + parts[6]) + (parts[3] + parts[7]));
    }
    return sum;
  }

 private:
  ShapeOrder order_;
  int groups_;
  R around_[kMostAround];          ///< r^m cos(m angle), m from 1
  R outwards_[kMostOutwards + 1];  ///< T_k
};

/// Stretched facets as tables lay them out: x is along the wider axis.
template <class R>
struct StretchedFacets {
  R wide, narrow, x, y, z;

  /// Those `ax` and `ay` wide, along `w`.
  static StretchedFacets of(R ax, R ay, Vec3<R> w) {
    return ax < ay ? StretchedFacets{ay, ax, w.y, w.x, w.z}
                   : StretchedFacets{ax, ay, w.x, w.y, w.z};
  }
  R root() const { return std::sqrt(wide * narrow); }
  /// The width of round facets that are as wide along the direction; at most 1.
  R like() const {
    const R s2 = x * x + y * y, t2 = wide * wide * x * x + narrow * narrow * y * y;
    const R along = s2 > 0 ? std::sqrt(t2 / s2) : wide;
    return along / (1 + (along - root()));
  }
  /// What differences of losses are measured in: they fall with the area of a slope where facets
  /// are nearly flat, and so must what the table is off by, lest it be all of the mean.
  R scale() const {
    const R area = wide * narrow;
    return area / (area * (x * x + y * y) + z * z);
  }
  Shape<R> shape(R widening) const { return Shape<R>::of(wide, narrow, x, y, widening); }
};

/// The loss of one surface. `ax`, `ay` > 0.
template <class R>
struct FacetLoss {
  const FacetTables* tables;
  R ax, ay;

  bool isotropic() const { return ax == ay; }

  /// l(w) in [0, 1].
  R at(Vec3<R> w) const {
    const R z = std::abs(w.z), s = std::sqrt(w.x * w.x + w.y * w.y);
    if (isotropic()) return limited(round(ax, z, s));
    const auto f = StretchedFacets<R>::of(ax, ay, {w.x, w.y, z});
    const R like = f.like();
    return limited(round(like, z, s) + f.scale() * difference(f, like, s));
  }
  /// Of round facets.
  R round(R alpha, R z, R s) const {
    const auto d = Stencil<R>::at(axes::direction(z, s, axes::width(alpha)), axes::kDirection);
    const auto a = Stencil<R>::at(axes::alpha(alpha), axes::kAlpha);
    return interpolate(tables->loss, a, coefficients(axes::kDirection), d);
  }

  /// m in (0, 1).
  R mean() const {
    using namespace axes;
    const R unit = mean_unit(ax * ay);
    if (isotropic()) return unit * interpolate(tables->mean, Stencil<R>::at(log_alpha(ax), kMean));
    const auto a = Stencil<R>::at(log_alpha(std::sqrt(ax * ay)), kStretchedMean);
    const auto q = Stencil<R>::at(aspect(std::max(ax, ay) / std::min(ax, ay)), kMeanAspect);
    return unit * interpolate(tables->stretched_mean, a, coefficients(kMeanAspect), q);
  }

 private:
  static R limited(R l) { return l > 0 ? std::min(l, R(1)) : R(0); }

  /// What stretched facets `f` have above round ones of width `like`, over their scale.
  R difference(const StretchedFacets<R>& f, R like, R s) const {
    using namespace axes;
    using Basis = ShapeBasis<R>;
    constexpr int terms = Basis::terms(kStretchedShapes),
                  n0 = terms * coefficients(kStretchedDirection);
    const auto d = Stencil<R>::at(dense_direction(f.z, s, width(like)), kStretchedDirection);
    const Basis basis(f.shape(R(kMirrorWidening)), kStretchedShapes);
    R sums[terms] = {};
    add_terms(sums, basis.count, tables->stretched, R(1),
              Stencil<R>::at(bent_width(like), kStretchedWidth), n0, d, terms);
    return basis.sum(sums);
  }
};

/// The loss of a rough dielectric whose facets are `alpha` wide along both axes, as the table has
/// it: what of reading it does not depend on the direction is found once.
template <class R>
class RoundInterfaceLoss {
 public:
  RoundInterfaceLoss() = default;
  RoundInterfaceLoss(const InterfaceTables& tables, R alpha, R eta)
      : table_(tables.loss[eta < 1]),
        directions_(axes::kInterfaceDirection[eta < 1]),
        indices_(axes::kIndex[eta < 1]),
        alpha_(Stencil<R>::at(axes::interface_alpha(alpha), axes::kInterfaceAlpha[eta < 1])),
        index_(Stencil<R>::at(axes::index(eta), indices_)),
        direction_(alpha, eta) {}

  R direction(R z, R s) const { return direction_(z, s); }
  R at(R direction) const {
    const int n1 = coefficients(directions_), n0 = n1 * coefficients(indices_);
    const R root =
        interpolate(table_, alpha_, n0, index_, n1, Stencil<R>::at(direction, directions_));
    return root > 0 ? root * root : R(0);
  }
  R at(R z, R s) const { return at(direction(z, s)); }

 private:
  const float* table_ = nullptr;
  int directions_ = 2, indices_ = 2;
  Stencil<R> alpha_, index_;
  axes::InterfaceDirection<R> direction_;
};

/// The loss of a rough dielectric of relative index `eta` (far side over near side). `ax`, `ay` >
/// 0.
template <class R>
struct InterfaceLoss {
  const InterfaceTables* tables = nullptr;
  R ax = 1, ay = 1, eta = 1;
  RoundInterfaceLoss<R> same;  ///< where both widths are

  InterfaceLoss() = default;
  InterfaceLoss(const InterfaceTables& its_tables, R its_ax, R its_ay, R its_eta)
      : tables(&its_tables), ax(its_ax), ay(its_ay), eta(its_eta) {
    if (ax == ay) same = {its_tables, ax, eta};
  }

  /// l(w) in [0, 1].
  R at(Vec3<R> w) const {
    const R z = std::abs(w.z), s = std::sqrt(w.x * w.x + w.y * w.y);
    if (ax == ay) return limited(same.at(z, s));
    const StretchedFacets<R> f = stretched({w.x, w.y, z});
    return at(f, [&](R like, const Stencil<R>& d) { return difference(f, like, d); });
  }

  /// The same of stretched facets `f`: `difference(like, d)` is that of l from what it is of round
  /// ones of width `like`, over its scale, at `d` on the axis of directions.
  template <class Difference>
  R at(const StretchedFacets<R>& f, const Difference& difference) const {
    const R s = std::sqrt(f.x * f.x + f.y * f.y), like = f.like();
    const RoundInterfaceLoss<R> round(*tables, like, eta);
    const R direction = round.direction(f.z, s),
            place = axes::bent_direction(direction, f.z, s, like, eta, R(tables->kink));
    return limited(round.at(direction) +
                   f.scale() * difference(like, Stencil<R>::at(place, grid().direction)));
  }
  /// As the table has it.
  R difference(const StretchedFacets<R>& f, R like, const Stencil<R>& d) const {
    using namespace axes;
    using Basis = ShapeBasis<R>;
    const Basis basis(f.shape(widening(eta, like)), grid().shapes);
    const auto a = Stencil<R>::at(bent_width(like), grid().width);
    const auto n = Stencil<R>::at(bent_index(eta, R(tables->kink)), grid().index);
    const int n2 = Basis::terms(grid().shapes), n1 = n2 * coefficients(grid().direction),
              n0 = n1 * coefficients(grid().index);
    R sums[Basis::kMost] = {};
    add_terms(sums, basis.count, tables->stretched[falls()], R(1), a, n0, n, n1, d, n2);
    return basis.sum(sums);
  }
  /// Its axes.
  const BentGrid& grid() const { return tables->bent[falls()]; }

  /// m in (0, 1). Its table rings next to alpha = 0 for indices below 1/4: see `least_mean`.
  R mean() const {
    using namespace axes;
    const R alpha = ax == ay ? ax : std::sqrt(ax * ay);
    const auto a = Stencil<R>::at(log_alpha(alpha), kInterfaceMean);
    const auto n = Stencil<R>::at(index(eta), kIndex[falls()]);
    const R mean = mean_unit(alpha * alpha) *
                   std::max(R(tables->least_mean), interpolate(tables->mean[falls()], a,
                                                               coefficients(kIndex[falls()]), n));
    return ax == ay ? mean : mean * std::max(R(0.5), mean_ratio(alpha));  // in truth above 1
  }

  StretchedFacets<R> stretched(Vec3<R> w) const { return StretchedFacets<R>::of(ax, ay, w); }

 private:
  /// Less is all but noise in float, and Beckmann's falls as a normal distribution above alpha.
  R limited(R l) const {
    const R least = R(1e-4) * ax * ay;
    return l > least ? std::min(l, R(1)) : least;
  }
  int falls() const { return eta < 1; }

  R mean_ratio(R alpha) const {
    using namespace axes;
    const R quotient = std::max(ax, ay) / std::min(ax, ay);
    const auto a = Stencil<R>::at(bent_mean_alpha(alpha), kBentMeanAlpha);
    const auto q = Stencil<R>::at(bent_aspect(quotient), kBentMeanAspect);
    const auto n = Stencil<R>::at(bent_index(eta), kBentMeanIndex);
    const int n1 = coefficients(kBentMeanIndex), n0 = n1 * coefficients(kBentMeanAspect);
    return interpolate(tables->stretched_mean[falls()], a, n0, q, n1, n);
  }
};

/// How much of what is lost on this side is given back on the far one; the rest on this one. With
/// l_t(wi) / (pi m_t) as the shape there, the split that is reciprocal.
template <class R>
inline R transmitted_share(R mean_here, R mean_there, R eta) {
  const R there = eta * eta * mean_there;
  return there / (mean_here + there);
}

/// How directions of further bounces are drawn: much as they are distributed, in closed form.
/// The density over projected solid angle is proportional to 1 / (z^2 + alpha^2).
template <class R>
struct BounceSampling {
  R alpha2 = 1, log = 0;  ///< log(1 + 1 / alpha2)

  BounceSampling() = default;
  explicit BounceSampling(R area) : alpha2(area), log(std::log1p(1 / area)) {}

  R pdf(R z) const { return z / (std::numbers::pi_v<R> * log * (z * z + alpha2)); }

  Vec3<R> sample(R u1, R u2) const {
    const R z2 = std::min(R(1), alpha2 * std::expm1(u1 * log));
    const R s = std::sqrt(1 - z2), phi = 2 * std::numbers::pi_v<R> * u2;
    return {s * std::cos(phi), s * std::sin(phi), std::sqrt(z2)};
  }
};

}  // namespace mms::materials
