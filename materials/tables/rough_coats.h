// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the tables of lobes under rough coats are made from: for each kind of base and of coat, and
/// each of their widths, how G^2 - T of materials/coated.h is put together of what is known of base
/// and coat alone and of a few shapes over index and direction. Nothing here is used when
/// rendering.

#include <array>

#include "materials/coated.h"
#include "materials/fresnel.h"
#include "materials/tables/spread.h"

namespace mms::materials::tables {

inline double product(const Values& a, const Values& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}
inline void subtract(Values& a, double times, const Values& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= times * b[i];
}

/// Functions of index and direction, at the nodes of their table; `Lines` at all of directions().
using Lines = std::vector<Values>;  ///< [index][direction]
struct Places {
  static constexpr int kIndices = axes::kRoughIndex, kDirections = axes::kCoatDirection;
  static constexpr int kCount = kIndices * kDirections;

  static double eta(int n) { return index_at(double(n) / (kIndices - 1)); }
  /// Of those that are in use; others count less.
  static bool common(int n) { return eta(n) > 1.015 && eta(n) < 4.3; }
  static double weight(int n) { return common(n) ? 1 : 0.2; }
  /// At nodes, weighed.
  static Values of(const Lines& lines) {
    Values all(kCount);
    for (int k = 0; k < kCount; ++k)
      all[k] = weight(k / kDirections) *
               Place(double(k % kDirections) / (kDirections - 1)).value(lines[k / kDirections]);
    return all;
  }
  /// The inverse, linear between nodes.
  static Values line(const Values& all, int n) {
    Values to(kNodes);
    for (int o = 0; o < kNodes; ++o) {
      const double x = (o + 0.5) / kNodes * (kDirections - 1);
      const double* p = &all[n * kDirections + int(x)];
      to[o] = (p[0] + (p[1] - p[0]) * (x - int(x))) / weight(n);
    }
    return to;
  }
};

/// How one base under one coat is put together.
struct RoughCoat {
  Values rest;  ///< what the two known shapes leave of G^2 - (1 - E)
  std::array<double, CoatedTables::kShares> share{0, 0, 1};
};

/// All bases of one kind under all coats of one kind.
class RoughCoats {
 public:
  std::vector<RoughCoat> pairs;  ///< [base][coat]
  std::vector<Values> shapes;    ///< that all share, at Places

  RoughCoats(const std::vector<Spread>& bases, const std::vector<Spread>& coats)
      : bases_(&bases),
        coats_(int(coats.size())),
        polished_(bases.size()),
        moved_(coats.size()),
        through_(coats.size()) {
    Lines mirror(Places::kIndices, Values(kNodes));  // T
    for (int n = 0; n < Places::kIndices; ++n)
      for (int o = 0; o < kNodes; ++o)
        mirror[n][o] = fresnel_split(directions().z[o], Places::eta(n)).transmitted;
    parallel(coats_, [&](int c) {
      through_[c] = moved_[c] = mirror;
      for (int n = 0; n < Places::kIndices; ++n) {
        moved_[c][n] = coats[c].mean(mirror[n]);
        for (int o = 0; o < kNodes; ++o) {
          moved_[c][n][o] = (moved_[c][n][o] - mirror[n][o]) / 2;
          through_[c][n][o] += moved_[c][n][o];
        }
      }
    });
    parallel(int(bases.size()), [&](int b) { polished_[b] = above(bases[b], mirror); });
    pairs.resize(bases.size() * coats.size());
    each_pair([&](RoughCoat& pair, int b, int c) {
      pair.rest = Places::of(above(bases[b], through_[c]));
    });
    take_known();
    find_shapes();
    each_pair([&](RoughCoat& pair, int b, int c) {
      for (int s = 0; s < CoatedTables::kShapes; ++s)
        pair.share[3 + s] = product(pair.rest, shapes[s]);
      pair.share[2] = lowered(pair, b, c);
    });
  }

 private:
  const std::vector<Spread>* bases_;
  int coats_;
  std::vector<Lines> polished_, moved_, through_;  // G^2 - T, 1 - E - T, 1 - E

  template <class F>
  void each_pair(const F& f) {
    parallel(int(pairs.size()), [&](int k) { f(pairs[k], k / coats_, k % coats_); });
  }

  /// G^2 less what is let through.
  static Lines above(const Spread& base, const Lines& through) {
    Lines all;
    for (const Values& t : through) {
      Values g2 = scaled_mean(base, t);
      for (int o = 0; o < kNodes; ++o) g2[o] = g2[o] * g2[o] - t[o];
      all.push_back(std::move(g2));
    }
    return all;
  }

  /// Takes polished / 2 + t (polished / 2 - moved) from each: t is 1 for a narrow coat and 0 for a
  /// broad one. Where base and coat are alike its term is nearly 0, and t what it is next to there.
  void take_known() {
    Values t(pairs.size(), 0.5), length2(pairs.size()), asked(pairs.size()), stiff(pairs.size());
    std::vector<Values> between(pairs.size());
    each_pair([&](RoughCoat& pair, int b, int c) {
      const std::size_t k = b * coats_ + c;
      const Values polished = Places::of(polished_[b]);
      subtract(pair.rest, 0.5, polished);
      between[k] = Places::of(moved_[c]);
      stiff[k] = 1e-9 + 0.1 * (product(polished, polished) / 4 + product(between[k], between[k]));
      for (int i = 0; i < Places::kCount; ++i) between[k][i] = polished[i] / 2 - between[k][i];
      length2[k] = product(between[k], between[k]);
      asked[k] = product(between[k], pair.rest);
    });
    const int bases = int(bases_->size());
    for (int n = 0; n < 1000; ++n)
      for (int b = 0; b < bases; ++b)
        for (int c = 0; c < coats_; ++c) {
          const int k = b * coats_ + c;
          double sum = asked[k], weight = length2[k];
          const auto add = [&](bool inside, int other) {
            if (inside) sum += stiff[k] * t[other], weight += stiff[k];
          };
          add(b > 0, k - coats_);
          add(b + 1 < bases, k + coats_);
          add(c > 0, k - 1);
          add(c + 1 < coats_, k + 1);
          t[k] = sum / weight;
        }
    each_pair([&](RoughCoat& pair, int b, int c) {
      const std::size_t k = b * coats_ + c;
      subtract(pair.rest, t[k], between[k]);
      pair.share[0] = (1 + t[k]) / 2;
      pair.share[1] = -t[k];
    });
  }

  /// The best of so few in the mean square: the first singular vectors, by orthogonal iteration.
  void find_shapes() {
    shapes.assign(CoatedTables::kShapes, Values(Places::kCount));
    for (std::size_t s = 0; s < shapes.size(); ++s)
      for (int i = 0; i < Places::kCount; ++i) shapes[s][i] = std::cos(double(i) * double(s + 1));
    for (int n = 0;; ++n) {
      for (std::size_t s = 0; s < shapes.size(); ++s) {
        for (std::size_t t = 0; t < s; ++t)
          subtract(shapes[s], product(shapes[s], shapes[t]), shapes[t]);
        const double length = std::sqrt(product(shapes[s], shapes[s]));
        for (double& x : shapes[s]) x /= length;
      }
      if (n == 12) return;
      std::vector<Values> next(shapes.size(), Values(Places::kCount));
      parallel(int(shapes.size()), [&](int s) {
        for (const RoughCoat& pair : pairs)
          subtract(next[s], -product(pair.rest, shapes[s]), pair.rest);
      });
      shapes = std::move(next);
    }
  }

  /// The factor that keeps what is put together from gaining.
  double lowered(const RoughCoat& pair, int b, int c) const {
    double factor = 1;
    for (int n = 0; n < Places::kIndices; ++n) {
      if (!Places::common(n)) continue;
      const Values& through = through_[c][n];
      Values g = through;
      for (int o = 0; o < kNodes; ++o)
        g[o] += pair.share[0] * polished_[b][n][o] + pair.share[1] * moved_[c][n][o];
      for (std::size_t s = 0; s < shapes.size(); ++s)
        subtract(g, -pair.share[3 + s], Places::line(shapes[s], n));
      for (int o = 0; o < kNodes; ++o)
        g[o] = through[o] / std::sqrt(std::max(g[o], through[o] / 2));
      const Values mean = (*bases_)[b].mean(g);
      for (int o = 0; o < kNodes; ++o)
        if (directions().z[o] > 1e-4)
          factor = std::min(factor, (through[o] + 5e-5) / (g[o] * mean[o]));
    }
    return factor * (1 - 8e-5);  // tables of coats are off by about as much
  }
};

}  // namespace mms::materials::tables
