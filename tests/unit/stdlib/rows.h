// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Calls the kernels of library rows over plain arrays, for tests.

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "stdlib/isa.h"
#include "stdlib/stdlib.h"

namespace mms::stdlib::testing {

/// Slots of a flattened signature: 'r', 'i' or 'l' each.
struct Shape {
  std::string params, results;
};

/// The slots of one type: `real[3]` is "rrr", `complex` is "rr".
inline std::string slots(std::string_view type) {
  const std::size_t open = type.find('[');
  const std::string one = type.starts_with("complex")   ? "rr"
                          : type.starts_with("integer") ? "i"
                          : type.starts_with("logic")   ? "l"
                                                        : "r";
  const int n = open == type.npos ? 1 : std::atoi(type.data() + open + 1);
  std::string all;
  for (int k = 0; k < n; ++k) all += one;
  return all;
}

inline Shape shape_of(const vm::Builtin& row) {
  const std::string_view s = row.signature;
  Shape shape;
  shape.results = slots(s.substr(0, s.find(' ')));
  std::string_view formals = s.substr(s.find('(') + 1);
  formals.remove_suffix(1);
  std::string type;
  while (!formals.empty()) {
    const std::size_t comma = formals.find(',');
    std::string_view formal = formals.substr(0, comma);
    formals = comma == formals.npos ? std::string_view() : formals.substr(comma + 1);
    while (formal.starts_with(' ')) formal.remove_prefix(1);
    if (const std::size_t space = formal.find(' '); space != formal.npos)
      type = formal.substr(0, space);
    shape.params += slots(type);
  }
  return shape;
}

/// Row with that signature up to its formals' names: `find("real pow(real x, y)")`.
inline const vm::Builtin& find(std::string_view signature) {
  for (const vm::Builtin& row : builtins())
    if (row.signature == signature) return row;
  throw std::runtime_error("no row " + std::string(signature));
}

/// A value of a slot: real slots use `r`, the others `i`.
template <class R>
using Column = std::vector<R>;

/// Runs a kernel over columns (one for each parameter; integers as reals) of equal length; returns
/// the result columns. Lengths are padded to kLaneMultiple by repeating the last lane.
template <class R>
std::vector<Column<R>> run(const vm::Builtin& row, const std::vector<Column<R>>& in) {
  const Shape shape = shape_of(row);
  const std::size_t n = in[0].size();
  const std::size_t lanes = (n + vm::kLaneMultiple - 1) / vm::kLaneMultiple * vm::kLaneMultiple;
  std::vector<std::vector<R>> reals(in);
  std::vector<std::vector<std::int32_t>> integers(in.size());
  std::vector<const void*> in_pointers;
  for (std::size_t k = 0; k < in.size(); ++k) {
    reals[k].resize(lanes, in[k].back());
    if (shape.params[k] == 'r') {
      in_pointers.push_back(reals[k].data());
    } else {
      for (R x : reals[k]) integers[k].push_back(std::int32_t(x));
      in_pointers.push_back(integers[k].data());
    }
  }
  std::vector<Column<R>> out(shape.results.size(), Column<R>(lanes));
  std::vector<std::vector<std::int32_t>> out_integers(out.size(), std::vector<std::int32_t>(lanes));
  std::vector<void*> out_pointers;
  for (std::size_t k = 0; k < out.size(); ++k)
    out_pointers.push_back(shape.results[k] == 'r' ? static_cast<void*>(out[k].data())
                                                   : out_integers[k].data());
  const vm::Kernel kernel = std::is_same_v<R, double> ? row.f64 : row.f32;
  kernel(in_pointers.data(), out_pointers.data(), int(lanes));
  for (std::size_t k = 0; k < out.size(); ++k) {
    if (shape.results[k] != 'r')
      for (std::size_t i = 0; i < lanes; ++i) out[k][i] = R(out_integers[k][i]);
    out[k].resize(n);
  }
  return out;
}

/// One value of a row with one result.
template <class R, class... Args>
R call(const vm::Builtin& row, Args... args) {
  return run<R>(row, {Column<R>{R(args)}...})[0][0];
}

/// The floats at which functions go wrong.
inline std::vector<float> edges() {
  std::vector<float> positive = {
      0.0f,        0x1p-149f,  0x1p-140f,   0x1.fffffcp-127f, 0x1p-126f,   1e-30f,
      0x1p-24f,    1e-4f,      0.25f,       0.4142135f,       0.5f,        0.70710678f,
      0.99999994f, 1.0f,       1.0000001f,  1.4142135f,       1.5f,        2.0f,
      2.5f,        3.0f,       3.14159274f, 1.57079637f,      10.0f,       88.7228317f,
      88.72284f,   103.97f,    127.5f,      128.0f,           149.5f,      1e4f,
      1e5f,        8388607.5f, 8388608.0f,  16777215.0f,      16777216.0f, 1e9f,
      0x1p31f,     0x1p47f,    1e30f,       0x1.fffffep127f,  INFINITY,    NAN};
  std::vector<float> all;
  for (float x : positive) {
    all.push_back(x);
    all.push_back(-x);
  }
  return all;
}

/// Equal bits, where every NaN counts as the same.
template <class R>
bool same_bits(R a, R b) {
  return (a != a && b != b) || std::memcmp(&a, &b, sizeof a) == 0;
}

/// A float of any bits.
inline float any_float(std::mt19937& random) {
  return std::bit_cast<float>(std::uint32_t(random()));
}

/// `count` points in `n` dimensions, each coordinate in [-size, size): a column for each.
template <class R>
std::vector<Column<R>> random_points(int n, int count, double size, unsigned seed = 11) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-size, size);
  std::vector<Column<R>> p(n, Column<R>(count));
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < n; ++k) p[k][i] = R(any(random));
  return p;
}

/// Chi-square of `v` in [0, 1) over 256 equal bins: mean 255, standard deviation 22.6.
inline double chi_square(const Column<float>& v) {
  std::array<double, 256> bins{};
  for (float x : v) ++bins[std::size_t(x * 256)];
  const double expected = double(v.size()) / 256;
  double sum = 0;
  for (double b : bins) sum += (b - expected) * (b - expected) / expected;
  return sum;
}

}  // namespace mms::stdlib::testing
