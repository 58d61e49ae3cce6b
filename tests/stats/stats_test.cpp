// SPDX-License-Identifier: Apache-2.0
// The statistical library against published values, and that it rejects what is wrong.
#include <doctest/doctest.h>

#include "base/warp.h"
#include "tests/stats/chi_square.h"

using namespace mms;

TEST_CASE("tails of distributions") {
  // Standard tables: 5% and 1% points.
  CHECK(stats::chi_square_tail(3.841459, 1) == doctest::Approx(0.05).epsilon(1e-5));
  CHECK(stats::chi_square_tail(18.307038, 10) == doctest::Approx(0.05).epsilon(1e-5));
  CHECK(stats::chi_square_tail(135.806723, 100) == doctest::Approx(0.01).epsilon(1e-5));
  CHECK(stats::chi_square_tail(70.064895, 100) == doctest::Approx(0.99).epsilon(1e-5));
  CHECK(stats::normal_two_sided(1.959964) == doctest::Approx(0.05).epsilon(1e-5));
  CHECK(stats::sidak(0.05, 10) == doctest::Approx(1 - std::pow(0.95, 0.1)));
}

TEST_CASE("quadrature") {
  CHECK(integrate<8>([](double x) { return std::pow(x, 15); }, 0, 1) ==
        doctest::Approx(1.0 / 16).epsilon(1e-13));
  CHECK(integrate_adaptive([](double x) { return 1 / (1e-4 + x * x); }, -1, 1, 1e-9) ==
        doctest::Approx(200 * std::atan(100.0)).epsilon(1e-10));
  CHECK(integrate_adaptive([](double x, double y) { return std::exp(x + y); },
                           Rectangle{0, 1, 0, 1}, 1e-12) ==
        doctest::Approx(std::pow(std::exp(1.0) - 1, 2)).epsilon(1e-11));
}

TEST_CASE("the chi-square test tells right from wrong") {
  const auto cosine = [](stats::Random& r) -> std::optional<Vec3d> {
    const double u = r.next();
    return square_to_cosine_hemisphere(u, r.next());
  };
  const auto run = [&](auto sample, auto pdf) {
    return stats::chi_square({.sample = sample, .pdf = pdf, .count = 50'000});
  };
  const auto right = [](Vec3d w) { return w.z > 0 ? w.z / kPi<double> : 0.0; };
  CHECK(run(cosine, right).passed(0.01));
  // 15% too much of x (shifts chi2 by 50000 0.15^2 / 4 = 281, where its spread is 11); no cosine;
  // below the surface; a tenth of the samples lost.
  CHECK_FALSE(run(cosine, [&](Vec3d w) { return right(w) * (1 + 0.15 * w.x); }).passed(1e-4));
  CHECK_FALSE(run(cosine, [](Vec3d w) { return w.z > 0 ? 0.5 / kPi<double> : 0; }).passed(1e-4));
  CHECK_FALSE(run(cosine, [&](Vec3d w) { return right(-w); }).passed(1e-4));
  const auto lossy = [&](stats::Random& r) -> std::optional<Vec3d> {
    const auto w = cosine(r);
    return r.next() < 0.1 ? std::nullopt : w;
  };
  CHECK_FALSE(run(lossy, right).passed(1e-4));
  CHECK(run(lossy, [&](Vec3d w) { return 0.9 * right(w); }).passed(1e-4));
}

TEST_CASE("a density that jumps at a circle is integrated on both sides of it") {
  // 9/10 of all directions evenly in the cap to t, where 4 pi t^2 is the solid angle.
  const double t = 0.316, solid = 4 * kPi<double> * t * t;
  const auto sample = [&](stats::Random& r) -> std::optional<Vec3d> {
    const bool within = r.next() < 0.9;
    const double u = r.next(), z = 1 - 2 * (within ? u * t * t : t * t + u * (1 - t * t));
    const double s = std::sqrt(1 - z * z), phi = 2 * kPi<double> * r.next();
    return Vec3d{s * std::cos(phi), s * std::sin(phi), z};
  };
  const auto pdf = [&](Vec3d w) {
    return (1 - w.z) / 2 < t * t ? 0.9 / solid : 0.1 / (4 * kPi<double> - solid);
  };
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto r = stats::chi_square(
        {.sample = sample, .pdf = pdf, .jumps = {t}, .count = 50'000, .seed = seed});
    CHECK(std::abs(r.mass - 1) < 1e-9);
    CHECK(r.error < 1e-9);
    CHECK(r.passed(stats::sidak(0.01, 20)));
  }
}
