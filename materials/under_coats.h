// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Lobes below several coats, one right under the other, and the lobes of such coats: G of
/// materials/coated.h where what is to be reflected is a product, the T of all coats above, times E
/// of the coat that the lobe is a part of, if it is; and so under films. That is no table's, and so
/// is solved for, once for all directions: at few of them, with K as a matrix and polynomials
/// between (materials/spread.h). How exactly, says materials/combine.h.

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>

#include "base/spectrum.h"
#include "materials/coat.h"
#include "materials/coated.h"
#include "materials/lobe.h"
#include "materials/nodes.h"
#include "materials/spread.h"

namespace mms::materials {

/// What lies above a lobe, the nearest first, borrowed. All that is solved for depends on these.
template <class R>
struct Coats {
  static constexpr int kMost = kMaxNodes / 2;  ///< each is a node, with one for its own lobe

  std::optional<CoatNumbers<R>> part;  ///< the coat that the lobe is a part of, as that lobe alone
  std::array<const CoatNumbers<R>*, kMost> of;
  int count = 0;

  void add(const CoatNumbers<R>& coat) { of[count++] = &coat; }
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

/// G^2 of a lobe at the directions of its matrix, for each solution.
template <class R, class Matrix>
struct SolvedDirections {
  R above[kWavelengths][Matrix::kDirections];  ///< G^2 less as much of T as Matrix::shown
  /// Of a part of a coat: ln of G^2 / E over that without E, as E may be next to nothing along most
  /// directions; under a film, where it is so along few, G^2 less as much of T E.
  R rest[kWavelengths][Matrix::kDirections];
};

/// What stretched lobes are solved with, the matrices of the last two, and what is solved: a
/// megabyte that few materials need.
template <class R>
class StretchedSolutions {
 public:
  using Matrix = StretchedMatrix<R>;
  PerNode<SolvedDirections<R, Matrix>> solved;

  StretchedSolutions() {}  // not zeroed

  /// That of a lobe, until two others are asked for.
  const Matrix& matrix(const CoatedLobe<R>& lobe) {
    if (!matrices_[last_].is_of(lobe)) last_ = 1 - last_;
    if (!matrices_[last_].is_of(lobe)) matrices_[last_].read(lobe);
    return matrices_[last_];
  }

 private:
  Matrix matrices_[2];
  int last_ = 0;
};

/// G of a lobe, for the wavelengths at which the nearest index is above 1.
template <class R>
class UnderCoats {
 public:
  /// Of the lobe of `node`. `stretched` is there where a lobe is, and stays; of each node it holds
  /// what is asked for.
  void solve(const CoatedLobe<R>& lobe, const Coats<R>& coats,
             const std::unique_ptr<StretchedSolutions<R>>& stretched, int node) {
    lobe_ = lobe;
    kept_.keep(coats);
    reflects_ = coats.part.has_value();
    count_ = 0;
    std::array<int, kWavelengths> wavelength;  // of a solution
    for (int j = 0; j < kWavelengths; ++j) {
      repeated_[j] = coats.repeated(j);
      at_[j] = std::max(count_ - 1, 0);
      if (!coats.known(j) || (count_ > 0 && repeated_[j])) continue;
      at_[j] = count_;
      wavelength[count_++] = j;
    }
    stretched_ = lobe.stretched() ? &stretched->solved.of[node] : nullptr;
    if (!stretched_) return solve_by(SpreadMatrix<R>(lobe), coats, wavelength, round_);
    solve_by(stretched->matrix(lobe), coats, wavelength, *stretched_);
  }
  bool solves(const CoatedLobe<R>& lobe, const Coats<R>& coats,
              const std::unique_ptr<StretchedSolutions<R>>&, int) const {
    return lobe.is_like(lobe_) && kept_.are(coats);
  }

  /// What `squared` takes of the direction of a lobe.
  struct Along {
    std::array<R, kWavelengths> above{}, rest{};
  };
  Along along(const CoatedLobe<R>& lobe) const {
    return stretched_ ? at(*stretched_, StretchedMatrix<R>::weights_at(lobe))
                      : at(round_, SpreadMatrix<R>::weights_at(lobe));
  }

  /// Whether wavelength j is as the one before.
  bool repeated(int j) const { return repeated_[j]; }

  /// G^2 of wavelength j along the direction, for T = `through` and, of a part of a coat, E =
  /// `reflected`.
  R squared(int j, const Along& along, R through, R reflected = 1) const {
    const R below = std::max(shown_ * through + along.above[at_[j]], through / 2);
    if (!reflects_) return below;
    const R rest = along.rest[at_[j]], all = through * reflected;
    if (filmed_[at_[j]]) return std::max(shown_ * all + rest, all * least_[at_[j]]);
    return below * reflected * std::exp(limited(rest, R(-20), R(40)));
  }

 private:
  template <class Matrix>
  void solve_by(const Matrix& matrix, const Coats<R>& coats,
                const std::array<int, kWavelengths>& wavelength,
                SolvedDirections<R, Matrix>& solved) {
    constexpr int kDirections = Matrix::kDirections;
    using Values = typename Matrix::Values;
    Values through[kWavelengths], reflected[kWavelengths];
    for_each_height<Matrix, R>([&](int first, int turns, R z) {
      CoatsAlong<R> along(coats, z);
      for (int n = 0; n < count_; ++n) {
        std::fill_n(&through[n][first], turns, along.through(wavelength[n]));
        if (reflects_) std::fill_n(&reflected[n][first], turns, along.reflected(wavelength[n]));
      }
    });
    shown_ = matrix.shown();
    Values below[kWavelengths];
    if (coats.count > 0)
      scaled(matrix, through, count_, 4, below);
    else  // all is let through
      std::copy_n(through, count_, below);
    for (int n = 0; n < count_; ++n)
      for (int k = 0; k < kDirections; ++k)
        solved.above[n][k] = below[n][k] * below[n][k] - shown_ * through[n][k];
    if (!reflects_) return;
    Values shares[kWavelengths], parts[kWavelengths];
    for (int n = 0; n < count_; ++n)
      for (int k = 0; k < kDirections; ++k) shares[n][k] = through[n][k] * reflected[n][k];
    scaled(matrix, shares, count_, Matrix::kCoatSteps, parts);
    for (int n = 0; n < count_; ++n) {
      const Values &all = shares[n], &part = parts[n];
      filmed_[n] = coats.part->films[wavelength[n]].there();
      least_[n] = 1;
      for (int k = 0; k < kDirections; ++k)
        if (all[k] > 0) least_[n] = std::min(least_[n], part[k] * part[k] / all[k] / 2);
      for (int k = 0; k < kDirections; ++k)
        solved.rest[n][k] = filmed_[n]
                                ? part[k] * part[k] - shown_ * all[k]
                                : 2 * std::log(part[k] / below[n][k]) - std::log(reflected[n][k]);
    }
  }

  /// By `weights`, what values at the directions are multiplied with.
  template <class Solved, class Values>
  Along at(const Solved& solved, const Values& weights) const {
    Along along;
    for (int n = 0; n < count_; ++n)
      for (std::size_t k = 0; k < weights.size(); ++k) {
        along.above[n] += weights[k] * solved.above[n][k];
        if (reflects_) along.rest[n] += weights[k] * solved.rest[n][k];
      }
    return along;
  }

  CoatedLobe<R> lobe_;
  KeptCoats<R> kept_;
  bool reflects_;                       ///< the lobe is a part of a coat
  std::bitset<kWavelengths> repeated_;  ///< wavelengths that are as the ones before
  int count_;                           ///< of solutions
  R shown_;                             ///< Matrix::shown
  SolvedDirections<R, SpreadMatrix<R>> round_;
  SolvedDirections<R, StretchedMatrix<R>>* stretched_ = nullptr;  ///< null: of a round lobe
  std::bitset<kWavelengths> filmed_;  ///< solutions of parts of a filmed coat
  /// What G^2 / (T E) is at least, and half of what it is at each point: where a film keeps next to
  /// all light from being reflected, less is what polynomials leave.
  R least_[kWavelengths];
  std::array<int, kWavelengths> at_{};  ///< the solution of a wavelength
};

}  // namespace mms::materials
