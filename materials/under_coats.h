// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Lobes below several coats, one right under the other, and the lobes of such coats: G of
/// materials/coated.h where what is to be reflected is a product, the T of all coats above, times E
/// of the coat that the lobe is a part of, if it is. That is no table's, and so is solved for, once
/// for all directions: at few of them, with K as a matrix and polynomials between. White round
/// facets, `glossy` and `rough_matte` keep their energy within 1e-4, for indices from 1.02 to 4. Of
/// stretched facets that is what round ones of the same mean width have; they have other than these
/// what tables say of bare coats, and of first order what films change (materials/combine.h).

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/spectrum.h"
#include "base/warp.h"
#include "materials/chebyshev.h"
#include "materials/coat.h"
#include "materials/coated.h"
#include "materials/lobe.h"
#include "materials/nodes.h"

namespace mms::materials {

/// Chebyshev's points on [0, 1], where polynomials over axes::spread_direction are known.
template <class R>
struct SpreadPoints {
  R place[axes::kSpread], weight[axes::kSpread];  ///< the weights are of the barycentric form

  SpreadPoints() {
    constexpr int last = axes::kSpread - 1;
    for (int k = 0; k <= last; ++k) {
      const R s = std::sin(kPi<R> / 2 * R(k) / R(last));
      place[k] = s * s;
      weight[k] = R(k % 2 ? -1 : 1) * (k == 0 || k == last ? R(0.5) : R(1));
    }
  }
  static const SpreadPoints& get() {
    static const SpreadPoints points;
    return points;
  }

  /// What a polynomial's values at the points are multiplied with for its value at `x`.
  std::array<R, axes::kSpread> weights_at(R x) const {
    std::array<R, axes::kSpread> to;
    R sum = 0;
    for (int k = 0; k < axes::kSpread; ++k) {
      const R d = x - place[k];
      to[k] = weight[k] / (d == 0 ? R(1e-20) : d);
      sum += to[k];
    }
    for (R& w : to) w /= sum;
    return to;
  }
};

/// What lies above a lobe, the nearest first, borrowed. All that is solved for depends on these.
template <class R>
struct Coats {
  static constexpr int kMost = kMaxNodes / 2;  ///< each is a node, with one for its own lobe

  std::optional<CoatNumbers<R>> part;  ///< the coat that the lobe is a part of, as that lobe alone
  std::array<const CoatNumbers<R>*, kMost> of, bare;  ///< `bare` without their films
  int count = 0;

  /// `without_films` is of stretched lobes alone.
  void add(const CoatNumbers<R>& coat, const CoatNumbers<R>* without_films) {
    of[count] = &coat;
    bare[count++] = without_films;
  }
  /// The same without their films. \pre a stretched lobe
  Coats without_films() const {
    Coats to = *this;
    to.of = bare;
    if (part) to.part = part->without_films();
    return to;
  }
  /// Whether a film is part of one at wavelength j.
  bool filmed(int j) const {
    const auto is = [j](const CoatNumbers<R>& coat) { return coat.films[j].there(); };
    return (part && is(*part)) ||
           std::any_of(of.begin(), of.begin() + count, [&](const auto* coat) { return is(*coat); });
  }
  /// Whether wavelength j is as the one before.
  bool repeated(int j) const {
    return (!part || part->repeated(j)) &&
           std::all_of(of.begin(), of.begin() + count,
                       [j](const CoatNumbers<R>* c) { return c->repeated(j); });
  }
  /// Whether there is something to solve for.
  bool known(int j) const { return (part ? *part : *of[0]).eta[j] > 1; }
  /// Of the faces that count.
  int parts(int j) const {
    int most = 0;
    for (int k = 0; k < count; ++k) most = std::max(most, of[k]->face(j).parts());
    return most;
  }
  bool several(int j) const { return count > 1 && of[0]->eta[j] > 1 && of[1]->eta[j] > 1; }
};

/// What a lobe below coats is to reflect along a direction of |cosine| `z`: T, of all coats up to
/// one whose index is not above 1, or T E.
template <class R>
class CoatsAlong {
 public:
  CoatsAlong(const Coats<R>& coats, R z) : coats_(coats), part_(z) {
    for (int k = 0; k < coats.count; ++k) of_[k].emplace(z);
  }

  R through(int j) {
    R t = 1;
    for (int k = 0; k < coats_.count && coats_.of[k]->eta[j] > 1; ++k)
      t *= coats_.of[k]->split(j, *of_[k]).transmitted;
    return t;
  }
  R reflected(int j) { return coats_.part ? coats_.part->split(j, part_).reflected : R(1); }
  R share(int j) { return through(j) * reflected(j); }

 private:
  const Coats<R>& coats_;
  CoatDirection<R> part_;
  std::array<std::optional<CoatDirection<R>>, Coats<R>::kMost> of_;
};

/// A copy, by which a solution is found again; of more than a few coats there is none.
template <class R>
class KeptCoats {
 public:
  void keep(const Coats<R>& coats) {
    count_ = coats.count <= kMost ? coats.count : -1;
    part_ = coats.part;
    for (int k = 0; k < count_; ++k) of_[k] = *coats.of[k];
  }
  bool are(const Coats<R>& coats) const {
    return coats.count == count_ && coats.part == part_ &&
           std::equal(of_.begin(), of_.begin() + count_, coats.of.begin(),
                      [](const CoatNumbers<R>& a, const CoatNumbers<R>* b) { return a == *b; });
  }

 private:
  static constexpr int kMost = 6;
  std::optional<CoatNumbers<R>> part_;
  std::array<CoatNumbers<R>, kMost> of_;
  int count_ = -1;
};

/// The mean over the hemisphere of what coats let through together.
template <class R>
class MeanThrough {
 public:
  void solve(const Coats<R>& coats) {
    kept_.keep(coats);
    std::bitset<kWavelengths> summed;
    int parts = 0;
    for (int j = 0; j < kWavelengths; ++j) {
      if (j > 0 && coats.repeated(j)) continue;
      summed[j] = coats.several(j) || coats.of[0]->films[j].there();
      if (summed[j])
        parts = std::max(parts, coats.parts(j));
      else
        mean_[j] = 1 - coats.of[0]->mean_reflected(j);
    }
    std::array<double, kWavelengths> sum{};
    for_each_on_hemisphere(parts, [&](double z, double weight) {
      CoatsAlong<R> along(coats, R(z));
      for (int j = 0; j < kWavelengths; ++j)
        if (summed[j]) sum[j] += weight * double(along.through(j));
    });
    for (int j = 0; j < kWavelengths; ++j) {
      if (summed[j]) mean_[j] = R(sum[j]);
      if (j > 0 && coats.repeated(j)) mean_[j] = mean_[j - 1];
    }
  }
  bool solves(const Coats<R>& coats) const { return kept_.are(coats); }
  const Spectrum<R>& mean() const { return mean_; }

 private:
  KeptCoats<R> kept_;
  Spectrum<R> mean_;
};

/// A lobe's matrix, of its width.
template <class R>
struct SpreadMatrix {
  static constexpr int kDirections = axes::kSpread;
  using Values = std::array<R, kDirections>;
  std::array<Values, CoatedTables::kColumns> rows{};  ///< as in CoatedTables::spread

  explicit SpreadMatrix(const CoatedLobe<R>& lobe) {
    constexpr int n0 = CoatedTables::kColumns * kDirections;
    for (int q = 0; q < 4; ++q) {
      const float* p = lobe.tables->spread + (lobe.width.first + q) * n0;
      for (int k = 0; k < CoatedTables::kColumns; ++k)
        for (int j = 0; j < kDirections; ++j)
          rows[k][j] += lobe.width.weight[q] * R(p[k * kDirections + j]);
    }
  }

  R cosine(int k) const { return limited(rows[kDirections][k], R(0), R(1)); }

  /// int K g |cos i| di along the direction of `lobe`, of whose width the matrix is, for `g` of the
  /// |cosine|.
  template <class G>
  R mean_along(const CoatedLobe<R>& lobe, const G& g) const {
    Values of;
    for (int k = 0; k < kDirections; ++k) of[k] = g(cosine(k));
    const Values all = mean(of), weights = SpreadPoints<R>::get().weights_at(
                                     axes::spread_direction(lobe.z, lobe.cosines));
    R sum = 0;
    for (int k = 0; k < kDirections; ++k) sum += weights[k] * all[k];
    return sum;
  }

  /// int K `of` |cos i| di along the directions.
  Values mean(const Values& of) const {
    Values sum{};
    for (int k = 0; k < kDirections; ++k)
      for (int j = 0; j < kDirections; ++j) sum[j] += rows[k][j] * of[k];
    return sum;
  }
};

/// By a power of what is still wrong, an eigenvalue l of K in [0, 1] leaves 1 - power (1 + l) of
/// its error. Two powers in turn are the best of two (Chebyshev), a seventeenth at most.
template <class R>
inline constexpr R kScalingPowers[] = {1 / (R(1.5) + std::numbers::sqrt2_v<R> / 4),
                                       1 / (R(1.5) - std::numbers::sqrt2_v<R> / 4)};

/// G of materials/coated.h for a lobe that is to reflect `share`, by powers of what is still wrong
/// (Knight, Ruiz and Ucar 2014), of first order. Four steps leave less than 1e-4 where T is to be
/// reflected, twelve of E.
template <class R>
inline typename SpreadMatrix<R>::Values scaled(const SpreadMatrix<R>& matrix,
                                               const typename SpreadMatrix<R>::Values& share,
                                               int steps) {
  using Values = typename SpreadMatrix<R>::Values;
  Values g = share, mean;
  const auto spread = [&] {
    mean = matrix.mean(g);
    for (R& m : mean) m = std::max(m, R(1e-6));
  };
  const int n = int(g.size());
  spread();
  for (int k = 0; k < n; ++k) g[k] = share[k] / std::sqrt(mean[k]);
  spread();
  for (int step = 0; step < steps; ++step) {
    for (int k = 0; k < n; ++k)  // along the surface nothing may pass
      if (g[k] > 0)
        g[k] *=
            std::max(1 + kScalingPowers<R>[step % 2] * (share[k] / (g[k] * mean[k]) - 1), R(0.2));
    spread();
  }
  return mean;
}

/// What G^2 under films is at least of what is to be reflected: more than rounding and polynomials
/// leave. Where a film keeps light from being reflected along all but grazing directions, it is so
/// little along these.
template <class R>
inline constexpr R kLeastSquared = R(1e-3);

/// G of a lobe, as of round ones of the same mean width; and what films change of what the lobe is
/// to reflect, where it is stretched.
template <class R>
class UnderCoats {
  using Values = typename SpreadMatrix<R>::Values;

 public:
  /// For the wavelengths at which the nearest index is above 1.
  void solve(const CoatedLobe<R>& lobe, const Coats<R>& coats) {
    lobe_ = lobe.round();
    stretched_ = lobe.stretched();
    kept_.keep(coats);
    reflects_ = coats.part.has_value();
    count_ = 0;
    filmed_.reset();
    const SpreadMatrix<R> matrix(lobe_);
    std::array<int, kWavelengths> wavelength;  // of a solution
    for (int j = 0; j < kWavelengths; ++j) {
      repeated_[j] = coats.repeated(j);
      at_[j] = std::max(count_ - 1, 0);
      if (!coats.known(j) || (count_ > 0 && repeated_[j])) continue;
      filmed_[count_] = coats.filmed(j);
      at_[j] = count_;
      wavelength[count_++] = j;
    }
    Values through[kWavelengths], reflected[kWavelengths];
    for (int k = 0; k < axes::kSpread; ++k) {
      CoatsAlong<R> along(coats, matrix.cosine(k));
      for (int n = 0; n < count_; ++n) {
        through[n][k] = along.through(wavelength[n]);
        if (reflects_) reflected[n][k] = along.reflected(wavelength[n]);
      }
    }
    for (int n = 0; n < count_; ++n) {
      const Values below = scaled(matrix, through[n], 4);
      for (int k = 0; k < axes::kSpread; ++k) above_[n][k] = below[k] * below[k] - through[n][k];
      if (!reflects_) continue;
      Values all;
      for (int k = 0; k < axes::kSpread; ++k) all[k] = through[n][k] * reflected[n][k];
      const Values part = scaled(matrix, all, 12);
      filmed_part_[n] = coats.part->films[wavelength[n]].there();
      for (int k = 0; k < axes::kSpread; ++k)
        rest_[n][k] = filmed_part_[n]
                          ? part[k] * part[k] - all[k]
                          : 2 * std::log(part[k] / below[k]) - std::log(reflected[n][k]);
    }
    if (!stretched_ || filmed_.none()) return;
    const Coats<R> bare = coats.without_films();
    for (int i = 0; i < axes::kChangePoints; ++i) {
      const R z = R(chebyshev_points<axes::kChangePoints>()[i]);
      CoatsAlong<R> along(coats, z), bare_along(bare, z);
      for (int n = 0; n < count_; ++n)
        if (filmed_[n])
          changed_[n][i] = along.share(wavelength[n]) - bare_along.share(wavelength[n]);
    }
  }
  bool solves(const CoatedLobe<R>& lobe, const Coats<R>& coats) const {
    return lobe.stretched() == stretched_ && lobe.round().is_like(lobe_) && kept_.are(coats);
  }

  /// What `squared` takes of the direction of a lobe.
  struct Along {
    std::array<R, kWavelengths> above{}, rest{}, changed{};
  };
  Along along(const CoatedLobe<R>& lobe) const {
    const Values weights =
        SpreadPoints<R>::get().weights_at(axes::spread_direction(lobe.z, lobe_.cosines));
    Along along;
    if (stretched_ && filmed_.any()) {
      const auto changes = lobe.changes();
      for (int n = 0; n < count_; ++n)
        if (filmed_[n])
          for (int i = 0; i < axes::kChangePoints; ++i)
            along.changed[n] += changes[i] * changed_[n][i];
    }
    for (int n = 0; n < count_; ++n)
      for (int k = 0; k < axes::kSpread; ++k) {
        along.above[n] += weights[k] * above_[n][k];
        if (reflects_) along.rest[n] += weights[k] * rest_[n][k];
      }
    return along;
  }

  /// Whether wavelength j is as the one before.
  bool repeated(int j) const { return repeated_[j]; }
  /// Whether one of the coats has a film at wavelength j.
  bool filmed(int j) const { return filmed_[at_[j]]; }
  /// How much more G^2 of wavelength j is by films than of round lobes.
  R changed(int j, const Along& along) const { return along.changed[at_[j]]; }

  /// G^2 of wavelength j of round lobes along the direction, for T = `through` and, of a part of a
  /// coat, E = `reflected`.
  R squared(int j, const Along& along, R through, R reflected = 1) const {
    const R below = std::max(through + along.above[at_[j]], through / 2);
    if (!reflects_) return below;
    const R rest = along.rest[at_[j]], all = through * reflected;
    if (filmed_part_[at_[j]]) return std::max(all + rest, all * kLeastSquared<R>);
    return below * reflected * std::exp(limited(rest, R(-20), R(40)));
  }

 private:
  CoatedLobe<R> lobe_;  ///< as a round one
  bool stretched_;
  KeptCoats<R> kept_;
  bool reflects_;                       ///< the lobe is a part of a coat
  std::bitset<kWavelengths> repeated_;  ///< wavelengths that are as the ones before
  int count_;                           ///< of solutions
  Values above_[kWavelengths];          ///< G^2 - T at the points
  /// Of a part of a coat: ln of G^2 / E over that without E, as E may be next to nothing along most
  /// directions; under a film, where it is so along few, G^2 - T E.
  Values rest_[kWavelengths];
  std::bitset<kWavelengths> filmed_part_;  ///< solutions of which the latter is true
  std::bitset<kWavelengths> filmed_;       ///< those of coats of which one has a film
  /// What is to be reflected less what bare coats leave, at the points, where that is so.
  std::array<R, axes::kChangePoints> changed_[kWavelengths];
  std::array<int, kWavelengths> at_{};  ///< the solution of a wavelength
};

}  // namespace mms::materials
