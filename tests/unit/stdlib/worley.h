// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The rows of cellular noise in its general form, and a search over all cells within three.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/stdlib/rows.h"

namespace mms::stdlib::testing {

using Vector = std::vector<double>;

/// What the rows are asked for.
struct Setting {
  int n;
  double exponent = 2;
  int seed = 0;
  double period = 0, jitter = 1;
};

inline std::string formals(int n) {
  const std::string vector = "real[" + std::to_string(n) + "]";
  return "(" + vector + " p, integer seed, " + vector + " period, real jitter";
}
inline const vm::Builtin& ways_row(int n) {
  return find("real[" + std::to_string(3 * n) + "] worley_ways" + formals(n) + ", exponent)");
}
inline const vm::Builtin& cell_row(int n) {
  return find("real worley_cell" + formals(n) + ", exponent)");
}
inline const vm::Builtin& border_row(int n) {
  return find("real[" + std::to_string(2 * n) + "] worley_border" + formals(n) + ")");
}

inline const vm::Builtin& nearest_row(int n) {
  return find("real[3] worley_nearest" + formals(n) + ", exponent)");
}
inline const vm::Builtin& squares_row(int n) {
  return find("real[3] worley_nearest_squared" + formals(n) + ", exponent)");
}
inline const vm::Builtin& edge_row(int n) {
  return find("real worley_border_distance" + formals(n) + ")");
}

template <class R>
std::vector<Column<R>> arguments(const std::vector<Column<R>>& p, const Setting& s,
                                 bool exponent = true) {
  auto in = p;
  const std::size_t count = p[0].size();
  in.emplace_back(count, R(s.seed));
  for (int k = 0; k < s.n; ++k) in.emplace_back(count, R(s.period));
  in.emplace_back(count, R(s.jitter));
  if (exponent) in.emplace_back(count, R(s.exponent));
  return in;
}

inline double distance(const Vector& v, double exponent) {
  double sum = 0, largest = 0;
  for (double x : v) {
    largest = std::max(largest, std::fabs(x));
    sum += std::pow(std::fabs(x), exponent);
  }
  return exponent > 64 ? largest : std::pow(sum, 1 / exponent);
}

/// Way j of n parts in the columns of a result, at lane i.
template <class R>
Vector way(const std::vector<Column<R>>& out, int n, int j, std::size_t i) {
  Vector v;
  for (int k = 0; k < n; ++k) v.push_back(out[std::size_t(j * n + k)][i]);
  return v;
}

// The points, from what lattice.h says of hashes.

inline std::uint32_t taken(std::uint32_t h, std::int64_t i) {
  h = (h ^ std::uint32_t(i)) * 0x9e3779b1u;
  return h ^ h >> 15;
}
inline std::uint32_t start(int seed) {
  std::uint32_t h = std::uint32_t(seed) * 0x9e3779b1u;
  h = (h ^ h >> 15) * 0x85ebca77u;
  return 0x6d6d7331u ^ h ^ h >> 13;
}

/// The three smallest distances to points of cells within three.
inline std::array<double, 3> nearest_three(const Vector& p, const Setting& s) {
  std::array<double, 3> best{1e9, 1e9, 1e9};
  int cells = 1;
  for (int k = 0; k < s.n; ++k) cells *= 7;
  for (int c = 0; c < cells; ++c) {
    std::uint32_t h = start(s.seed);
    Vector cell, v;
    for (int k = 0, rest = c; k < s.n; ++k, rest /= 7) {
      cell.push_back(std::floor(p[k]) + rest % 7 - 3);
      const double size = s.period, at = cell.back();
      h = taken(h, std::int64_t(size > 0 ? at - size * std::floor(at / size) : at));
    }
    h *= 0x85ebca77u;
    h ^= h >> 16;
    for (int k = 0; k < s.n; ++k) {
      v.push_back(p[k] - cell[k] - 0.5 - s.jitter * (double(h >> 8) * 0x1p-24 - 0.5));
      h *= 0xc2b2ae3du;
      h ^= h >> 15;
    }
    const double d = distance(v, s.exponent);
    for (double& b : best)
      if (d < b) {
        std::copy_backward(&b, best.data() + 2, best.data() + 3);
        b = d;
        break;
      }
  }
  return best;
}

/// How far the nearest cell is that is not searched.
inline double searched(const Setting& s) { return s.n < 4 ? 2 : distance({1, 1}, s.exponent); }

}  // namespace mms::stdlib::testing
