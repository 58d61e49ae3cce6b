// SPDX-License-Identifier: Apache-2.0
// Complex functions against std::complex.
#include <doctest/doctest.h>

#include <complex>
#include <cstdlib>
#include <functional>
#include <limits>

#include "tests/unit/stdlib/rows.h"

namespace mms::stdlib::testing {
namespace {

using C = std::complex<double>;
using LC = std::complex<long double>;

struct Oracle {
  std::string_view name;
  std::function<LC(LC)> exact;
};

const Oracle kOracles[] = {
    {"exp", [](LC z) { return std::exp(z); }},   {"log", [](LC z) { return std::log(z); }},
    {"sqrt", [](LC z) { return std::sqrt(z); }}, {"sin", [](LC z) { return std::sin(z); }},
    {"cos", [](LC z) { return std::cos(z); }},   {"tan", [](LC z) { return std::tan(z); }},
    {"sinh", [](LC z) { return std::sinh(z); }}, {"cosh", [](LC z) { return std::cosh(z); }},
    {"tanh", [](LC z) { return std::tanh(z); }}, {"conj", [](LC z) { return std::conj(z); }},
};

const vm::Builtin& row_of(std::string_view name) {
  return find("complex " + std::string(name) + "(complex z)");
}

/// Units in the last place of a float at `exact`.
double ulp_error(float got, long double exact) {
  if (exact != exact || got != got) return (exact != exact) == (got != got) ? 0 : 1e9;
  const long double end = ldexpl(1, 128);
  if (exact == 0 || got == 0) {
    if (std::signbit(exact) != std::signbit(got)) return 1e9;
  }
  const long double g = std::isinf(got) ? std::copysign(end, (long double)got) : got;
  const long double e = fabsl(exact) > end ? std::copysign(end, exact) : exact;
  int exponent;
  frexpl(e, &exponent);
  if (fabsl(e) == end) --exponent;
  return double(fabsl(g - e) / ldexpl(1, std::max(exponent, -125) - 24));
}

TEST_CASE("both parts of every complex function are within the stated error") {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> near(-3, 3), wide(-80, 80);
  std::vector<Column<float>> z(2);
  for (int i = 0; i < 60000; ++i)
    for (Column<float>& part : z) {
      const float small = std::ldexp(near(random), -int(random() % 100));
      part.push_back(i % 4 == 0   ? near(random)
                     : i % 4 == 1 ? wide(random)
                     : i % 4 == 2 ? small
                                  : float(int(random() % 7) - 3) * 0.5f);
    }
  for (const Oracle& oracle : kOracles) {
    const auto out = run<float>(row_of(oracle.name), z);
    double worst = 0;
    std::string where;
    for (std::size_t i = 0; i < z[0].size(); ++i) {
      const LC exact = oracle.exact(LC(z[0][i], z[1][i]));
      const double error =
          std::max(ulp_error(out[0][i], exact.real()), ulp_error(out[1][i], exact.imag()));
      if (error > worst) {
        worst = error;
        where = std::to_string(z[0][i]) + " + i " + std::to_string(z[1][i]) + " -> " +
                std::to_string(out[0][i]) + ", " + std::to_string(out[1][i]) + " for " +
                std::to_string(double(exact.real())) + ", " + std::to_string(double(exact.imag()));
      }
    }
    CHECK_MESSAGE(worst <= 0.51, oracle.name << ": " << worst << " ulp at " << where);
    if (std::getenv("MMS_SHOW_ERRORS")) MESSAGE(oracle.name << ": " << worst << " ulp");
  }
}

TEST_CASE("infinities and signed zeros of exp, log and sqrt are those of C99") {
  const float inf = INFINITY;
  const float parts[] = {0.0f, -0.0f, 1.0f, -1.0f, inf, -inf, NAN};
  for (std::string_view name : {"log", "sqrt"})
    for (float re : parts)
      for (float im : parts) {
        INFO(name << " " << re << " " << im);
        const C exact = name == "log" ? std::log(C(re, im)) : std::sqrt(C(re, im));
        const auto got = run<float>(row_of(name), {{re}, {im}});
        CHECK(same_bits(got[0][0], float(exact.real())));
        CHECK(same_bits(got[1][0], float(exact.imag())));
      }
  for (float re : {inf, -inf})
    for (float im : {0.0f, -0.0f, 1.0f, -1.0f}) {
      INFO(re << " " << im);
      const C exact = std::exp(C(re, im));
      const auto got = run<float>(row_of("exp"), {{re}, {im}});
      CHECK(same_bits(got[0][0], float(exact.real())));
      CHECK(same_bits(got[1][0], float(exact.imag())));
    }
}

TEST_CASE("exp of an infinite real part where the angle is no number is that of C99") {
  for (float im : {INFINITY, -INFINITY, float(NAN)}) {
    INFO(im);
    const auto none = run<float>(row_of("exp"), {{-INFINITY}, {im}});
    CHECK(none[0][0] == 0.0f);  // of either sign
    CHECK(none[1][0] == 0.0f);
    const auto all = run<float>(row_of("exp"), {{INFINITY}, {im}});
    CHECK(std::fabs(all[0][0]) == INFINITY);
    CHECK(std::isnan(all[1][0]));
    const auto neither = run<float>(row_of("exp"), {{-800.0f}, {im}});
    CHECK(std::isnan(neither[0][0]));
    CHECK(std::isnan(neither[1][0]));
  }
}

TEST_CASE("complex pow, powi, polar, abs, arg") {
  const vm::Builtin& pow = find("complex pow(complex z, w)");
  const vm::Builtin& powi = find("complex powi(complex z, integer n)");
  std::mt19937 random(10);
  std::uniform_real_distribution<float> any(-2, 2);
  for (int i = 0; i < 5000; ++i) {
    const float a = any(random), b = any(random), c = any(random), d = any(random);
    const LC exact = std::exp(LC(c, d) * std::log(LC(a, b)));
    const auto got = run<float>(pow, {{a}, {b}, {c}, {d}});
    // Of the modulus: the phase is off by |w log z| roundings of double.
    CHECK(std::abs(LC(got[0][0], got[1][0]) - exact) <= 0x1p-24L * 1.01L * std::abs(exact));
    const int n = int(random() % 21) - 10;
    LC product = 1;
    for (int k = 0; k < std::abs(n); ++k) product *= LC(a, b);
    if (n < 0) product = 1.0L / product;
    const auto power = run<float>(powi, {{a}, {b}, {float(n)}});
    CHECK(std::abs(LC(power[0][0], power[1][0]) - product) <= 0x1p-24L * 1.01L * std::abs(product));
    const auto turned = run<float>(find("complex polar(real r, phi)"), {{a}, {b}});
    CHECK(ulp_error(turned[0][0], a * cosl(b)) <= 0.51);
    CHECK(ulp_error(turned[1][0], a * sinl(b)) <= 0.51);
    CHECK(ulp_error(call<float>(find("real abs(complex z)"), a, b), hypotl(a, b)) <= 0.51);
    CHECK(ulp_error(call<float>(find("real arg(complex z)"), a, b), atan2l(b, a)) <= 0.51);
  }
  const auto value = [&](float zr, float wr) {
    return run<float>(pow, {{zr}, {0}, {wr}, {0}})[0][0];
  };
  CHECK(value(0, 0) == 1);
  CHECK(value(0, 2) == 0);
  CHECK(value(0, -1) == INFINITY);
  CHECK(value(INFINITY, 0) == 1);
  CHECK(run<double>(pow, {{0}, {0}, {0}, {0}})[0][0] == 1);
  CHECK(call<float>(find("real re(complex z)"), 3.0f, 4.0f) == 3);
  CHECK(call<float>(find("real im(complex z)"), 3.0f, 4.0f) == 4);
}

}  // namespace
}  // namespace mms::stdlib::testing
