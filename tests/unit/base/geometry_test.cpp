// SPDX-License-Identifier: Apache-2.0
// Vectors, frames, warps and hashes.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <set>

#include "base/hash.h"
#include "base/vec.h"
#include "base/warp.h"

namespace mms {
namespace {

/// The unit vector of a seed, uniform over the sphere.
template <class R>
Vec3<R> direction(std::uint64_t seed) {
  const double z = 1 - 2 * to_unit(mix64(2 * seed)),
               phi = 2 * kPi<double> * to_unit(mix64(2 * seed + 1));
  const double r = std::sqrt(1 - z * z);
  return normalize(Vec3<R>(Vec3d(r * std::cos(phi), r * std::sin(phi), z)));
}

/// Each entry of the Gram matrix is a sum of three products of numbers below one that are off by
/// a few roundings each: 16 of them is room enough.
template <class R>
void check_orthonormal(const Frame<R>& f) {
  constexpr double tolerance = 16 * std::numeric_limits<R>::epsilon();
  const Vec3d s(f.s), t(f.t), n(f.n);
  for (const Vec3d& v : {s, t, n}) CHECK(std::abs(dot(v, v) - 1) < tolerance);
  CHECK(std::abs(dot(s, t)) < tolerance);
  CHECK(std::abs(dot(t, n)) < tolerance);
  CHECK(std::abs(dot(n, s)) < tolerance);
  CHECK(dot(cross(s, t), n) > 0.9);  // right-handed
}

TEST_CASE_TEMPLATE("a frame around any normal is orthonormal and right-handed", R, float, double) {
  for (std::uint64_t k = 0; k < 2000; ++k) check_orthonormal(Frame<R>::around(direction<R>(k)));
  for (const R z : {R(1), R(-1)}) {
    check_orthonormal(Frame<R>::around({0, 0, z}));
    for (const R x : {R(1e-4), R(-1e-8), R(1e-20)})
      check_orthonormal(Frame<R>::around(normalize(Vec3<R>{x, x, z})));
  }
  for (const R x : {R(1), R(-1)}) {
    check_orthonormal(Frame<R>::around({x, 0, 0}));
    check_orthonormal(Frame<R>::around({0, x, R(-0.0)}));
  }
}

TEST_CASE("a frame with a tangent keeps the tangent's side and survives a parallel one") {
  for (std::uint64_t k = 0; k < 500; ++k) {
    const Vec3d n = direction<double>(k), tangent = direction<double>(k + 5000);
    const Frame<double> f = Frame<double>::with_tangent(n, tangent);
    CHECK(dot(f.s, tangent) > 0);
    CHECK(std::abs(dot(f.t, tangent)) < 1e-14);
    CHECK(f.n == n);
    const Frame<double> parallel = Frame<double>::with_tangent(n, n * 3.0);
    check_orthonormal(parallel);
    const Vec3d v = direction<double>(k + 9000);
    CHECK(length(f.to_world(f.to_local(v)) - v) < 1e-14);
  }
}

TEST_CASE("the cross product keeps its digits where its products cancel") {
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const Vec3f a = direction<float>(k);
    const Vec3f b = a + direction<float>(k + 3000) * 1e-4f;
    const Vec3f c = cross(a, b);
    const Vec3d exact{double(a.y) * b.z - double(a.z) * b.y, double(a.z) * b.x - double(a.x) * b.z,
                      double(a.x) * b.y - double(a.y) * b.x};
    // Kahan's form is within 1.5 ulp; the oracle rounds products of 48 bits that are below one.
    for (int i = 0; i < 3; ++i)
      CHECK(std::abs(c[i] - exact[i]) <= 1.5 * 0x1p-23 * std::abs(exact[i]) + 0x1p-51);
  }
}

/// Mean of f over an n by n grid of cell centres.
template <class F>
double grid_mean(F f, int n = 400) {
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) sum += f((i + 0.5) / n, (j + 0.5) / n);
  return sum / (double(n) * n);
}

// The midpoint rule over a map with bounded derivatives is off by less than one cell's width times
// the largest slope: 1e-2 is room for slopes up to 4. Moments that are zero by symmetry come out
// at rounding.

TEST_CASE("the disc map stays inside and preserves area") {
  CHECK(grid_mean([](double u, double v) {
          const Vec3d d = square_to_disc(u, v);
          CHECK(dot(d, d) < 1);
          return dot(d, d);
        }) == doctest::Approx(0.5).epsilon(1e-2));
  for (const double r : {0.2, 0.5, 0.9})  // the share within a radius is its square
    CHECK(grid_mean([=](double u, double v) { return length(square_to_disc(u, v)) < r; }) ==
          doctest::Approx(r * r).epsilon(2e-2));
  CHECK(square_to_disc(0.5, 0.5) == Vec3d(0, 0, 0));
  CHECK(length(square_to_disc(1.0, 0.3)) == doctest::Approx(1));
}

TEST_CASE("cosine-weighted directions are unit and have the moments of z / pi") {
  // E[z^k] = 2 / (k + 2)
  for (int k = 1; k <= 4; ++k)
    CHECK(grid_mean([=](double u, double v) {
            const Vec3d d = square_to_cosine_hemisphere(u, v);
            return std::pow(d.z, k);
          }) == doctest::Approx(2.0 / (k + 2)).epsilon(1e-2));
  CHECK(grid_mean([](double u, double v) {
          return std::abs(length(square_to_cosine_hemisphere(u, v)) - 1);
        }) < 1e-15);
  CHECK(std::abs(grid_mean(
            [](double u, double v) { return square_to_cosine_hemisphere(u, v).x; })) < 1e-9);
}

TEST_CASE("uniform directions are unit and have the moments of the sphere") {
  const auto moment = [](auto f) {
    return grid_mean([=](double u, double v) { return f(square_to_sphere(u, v)); });
  };
  CHECK(moment([](Vec3d d) { return std::abs(length(d) - 1); }) < 1e-15);
  for (int i = 0; i < 3; ++i) {
    CHECK(std::abs(moment([=](Vec3d d) { return d[i]; })) < 1e-9);
    CHECK(moment([=](Vec3d d) { return d[i] * d[i]; }) == doctest::Approx(1.0 / 3).epsilon(1e-2));
    CHECK(moment([=](Vec3d d) { return std::pow(d[i], 4); }) ==
          doctest::Approx(1.0 / 5).epsilon(1e-2));
  }
}

TEST_CASE("mixing is SplitMix64, loses nothing, and flips half the bits") {
  // The first outputs of the published generator from state 0 (its k-th is mix64(k gamma)).
  CHECK(mix64(0) == 0xe220a8397b1dcdafULL);
  CHECK(mix64(0x9e3779b97f4a7c15ULL) == 0x6e789e6aa1b965f4ULL);
  std::set<std::uint64_t> seen;
  for (std::uint64_t k = 0; k < 20000; ++k) seen.insert(mix64(k));
  CHECK(seen.size() == 20000);
  for (int bit = 0; bit < 64; ++bit) {  // avalanche: the mean of 1000 is 32 within 6 sigma
    double flipped = 0;
    for (std::uint64_t k = 0; k < 1000; ++k)
      flipped += std::popcount(mix64(k) ^ mix64(k ^ std::uint64_t(1) << bit));
    CHECK(std::abs(flipped / 1000 - 32) < 6 * 4 / std::sqrt(1000.0));
  }
}

TEST_CASE("combining depends on the order, and the unit interval is half open and even") {
  CHECK(hash_combine(1, 2) != hash_combine(2, 1));
  CHECK(to_unit(0) == 0);
  CHECK(to_unit(~std::uint64_t(0)) < 1);
  double sum = 0, squares = 0;
  constexpr int n = 100000;
  for (std::uint64_t k = 0; k < n; ++k) {
    const double u = to_unit(mix64(k));
    sum += u;
    squares += u * u;
  }
  // Standard deviations: sqrt(1/12 / n) and sqrt(4/45 / n); six of each.
  CHECK(std::abs(sum / n - 0.5) < 6 * std::sqrt(1 / 12.0 / n));
  CHECK(std::abs(squares / n - 1 / 3.0) < 6 * std::sqrt(4 / 45.0 / n));
}

TEST_CASE("a vector of floats has floats in it") {
  volatile double third = 1.0 / 3;  // no float, and nothing the compiler knows
  const Vec3d exact(third, -third, 1 + third);
  const Vec3d back{Vec3f(exact)};
  volatile float x = float(third), z = float(1 + third);
  CHECK(back == Vec3d(double(x), -double(x), double(z)));
}

}  // namespace
}  // namespace mms
