// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// How texels are weighed: the place of a point among them, the filters between them, and what a
/// pixel covers. Written once over R, float or double, for both machines. Pure. Internal to the
/// textures.
///
/// Everything is continuous in the place and in the pixel but for the `nearest` filter and for
/// slopes, so that rounding moves no result by more than texels nearby differ.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mms::renderer {

enum class TexelFilter { Nearest, Bilinear, Bicubic, Smart };
enum class TexelWrap { Repeat, Mirror, Clamp, Black };

/// Column or row `k` where there are `n`, from 0; -1: black.
inline int wrapped_texel(int k, int n, TexelWrap wrap) {
  if (k >= 0 && k < n) return k;
  if (wrap == TexelWrap::Black) return -1;
  if (wrap == TexelWrap::Clamp) return k < 0 ? 0 : n - 1;
  const int round = k >= 0 ? k / n : -1 - (-1 - k) / n;
  const int rest = k - round * n;
  return wrap == TexelWrap::Repeat || round % 2 == 0 ? rest : n - 1 - rest;
}

/// A place along an axis: past the `whole`-th texel by a `part` of the way to the next, in [0, 1].
template <class R>
struct TexelPlace {
  int whole;
  R part;
};

template <class R>
TexelPlace<R> texel_place(int whole, R part) {
  const R floor = std::floor(part);
  return {whole + static_cast<int>(floor), part - floor};
}

/// Where u, in pictures, falls among n texels that count from their middles (`middle` = 0.5) or
/// from their borders (0). Whole periods are left out first, which is exact, and the product is
/// carried in two parts: `part` is right to the last digit or two, however far u is and however
/// large n.
template <class R>
TexelPlace<R> texel_place(R u, int n, R middle, TexelWrap wrap) {
  constexpr R kFar = 256;  // pictures; beyond, there is nothing but the border
  if (wrap == TexelWrap::Repeat)
    u -= std::trunc(u);
  else if (wrap == TexelWrap::Mirror)
    u -= 2 * std::trunc(u / 2);
  else
    u = std::clamp(u, -kFar, kFar);
  // What is left of `high` is exact but where it is below 1 anyway: there it may not become that.
  constexpr R kMost = 1 - std::numeric_limits<R>::epsilon() / 2;
  const R high = u * R(n), low = std::fma(u, R(n), -high), whole = std::floor(high);
  return texel_place(static_cast<int>(whole), std::min(high - (whole + middle) + low, kMost));
}

/// The texels from `first` on that a place sees, their weights, and those of the differences from
/// each to the next, which make the slope. Weights are positive and sum to 1.
template <class R>
struct TexelWeights {
  static constexpr int kMost = 4;
  int first, count;
  std::array<R, kMost> value;
  std::array<R, kMost - 1> step;
};

/// `smooth`: how much of a mean between bicubic (1) and bilinear (0), for the smart filter.
template <class R>
TexelWeights<R> texel_weights(TexelFilter filter, R smooth, TexelPlace<R> p) {
  const R f = p.part, g = 1 - f;
  if (filter == TexelFilter::Nearest) return {p.whole, 1, {1}, {}};
  if (filter == TexelFilter::Bilinear || smooth == 0) return {p.whole, 2, {g, f}, {1}};
  const R sixth = R(1) / 6;  // the uniform cubic B-spline, its slope the quadratic one
  TexelWeights<R> w{p.whole - 1,
                    4,
                    {sixth * g * g * g, sixth * (4 - 3 * f * f * (2 - f)),
                     sixth * (4 - 3 * g * g * (2 - g)), sixth * f * f * f},
                    {g * g / 2, R(0.5) + f * g, f * f / 2}};
  if (smooth < 1) {
    const R rough = 1 - smooth;
    for (R& v : w.value) v *= smooth;
    for (R& v : w.step) v *= smooth;
    w.value[1] += rough * g;
    w.value[2] += rough * f;
    w.step[1] += rough;
  }
  return w;
}

/// What a pixel covers: an ellipse, seen through a row of probes along its long axis (after
/// McCormack et al. 1999, Feline), each as wide as the short one. Lengths in texels.
template <class R>
struct TexelFootprint {
  static constexpr int kMostAspect = 16;
  R width;     ///< of a probe, 1 at least
  R u, v;      ///< from one probe to the next
  int beside;  ///< probes on either side of the one in the middle
  R far;       ///< how many probes away the weight is 0
  R smooth;    ///< how much of the smart filter is bicubic
  R weight(int k) const {
    const R x = R(k) / far, w = 1 - x * x;
    return w * w;
  }
};

/// `across`: how the place changes across the pixel, in pictures: u and v along its one axis, then
/// along its other. The blurs are the widths of a mean that is taken besides, so squares add.
///
/// The square of the matrix of all four has the lengths of the axes as the roots of its
/// eigenvalues, and its determinant is the sum of the squares of all its minors (Cauchy and Binet),
/// in which nothing cancels.
template <class R>
TexelFootprint<R> texel_footprint(const R* across, R blur_u, R blur_v, int columns, int rows) {
  constexpr R kMost = 256;  // pictures: then no square overflows, and no place an int
  constexpr int kAspect = TexelFootprint<R>::kMostAspect;
  const auto texels = [&](R x, int n) { return std::clamp(x, -kMost, kMost) * R(n); };
  const R u1 = texels(across[0], columns), v1 = texels(across[1], rows);
  const R u2 = texels(across[2], columns), v2 = texels(across[3], rows);
  const R bu = texels(blur_u, columns), bv = texels(blur_v, rows);
  const R uu = u1 * u1 + u2 * u2, vv = v1 * v1 + v2 * v2, uv = u1 * v1 + u2 * v2;
  const R a = uu + bu * bu, c = vv + bv * bv;
  const R root = std::hypot(a - c, 2 * uv), length = std::sqrt((a + c + root) / 2);
  const R minor = u1 * v2 - u2 * v1;
  const R area = std::sqrt(minor * minor + bu * bu * vv + bv * bv * uu + bu * bu * bv * bv);
  const R thin = length > 0 ? area / length : R(0);
  const R width = std::max({R(1), thin, length / kAspect});
  TexelFootprint<R> r{width,
                      0,
                      0,
                      0,
                      std::max(R(1), length / width),
                      std::clamp(2 - 2 * std::max(thin, length / kAspect), R(0), R(1))};
  r.beside = static_cast<int>(std::ceil(r.far)) - 1;
  if (r.beside == 0) return r;
  // The long axis, from the row of the matrix in which nothing cancels.
  R u = a >= c ? (a - c + root) / 2 : uv, v = a >= c ? uv : (c - a + root) / 2;
  const R norm = std::hypot(u, v);
  r.u = norm > 0 ? u / norm * width : width;
  r.v = norm > 0 ? v / norm * width : R(0);
  return r;
}

}  // namespace mms::renderer
