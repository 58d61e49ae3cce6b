// SPDX-License-Identifier: Apache-2.0
// Complex functions against std::complex.
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <complex>
#include <cstdlib>
#include <functional>
#include <limits>

#include "stdlib/bounds.h"
#include "tests/unit/stdlib/ulp.h"
#include "vm/interval.h"

namespace mms::stdlib::testing {
namespace {

using C = std::complex<double>;
using LC = std::complex<long double>;

/// glibc's complex functions in double, which are the double kernels: what they are within here.
/// Its manual states from 1 to 7 ulp for them on x86-64.
constexpr double kDoubleUlp = 7;

struct Oracle {
  std::string_view name;
  std::function<LC(LC)> exact;
};

const Oracle kOracles[] = {
    {"exp", [](LC z) { return std::exp(z); }},     {"log", [](LC z) { return std::log(z); }},
    {"sqrt", [](LC z) { return std::sqrt(z); }},   {"sin", [](LC z) { return std::sin(z); }},
    {"cos", [](LC z) { return std::cos(z); }},     {"tan", [](LC z) { return std::tan(z); }},
    {"sinh", [](LC z) { return std::sinh(z); }},   {"cosh", [](LC z) { return std::cosh(z); }},
    {"tanh", [](LC z) { return std::tanh(z); }},   {"asin", [](LC z) { return std::asin(z); }},
    {"acos", [](LC z) { return std::acos(z); }},   {"atan", [](LC z) { return std::atan(z); }},
    {"asinh", [](LC z) { return std::asinh(z); }}, {"acosh", [](LC z) { return std::acosh(z); }},
    {"atanh", [](LC z) { return std::atanh(z); }},
};

const vm::Builtin& row_of(std::string_view name) {
  return find("complex " + std::string(name) + "(complex z)");
}

/// Parts of complex numbers of all kinds.
std::vector<Column<float>> arguments() {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> near(-3, 3), wide(-80, 80);
  std::vector<Column<float>> z(2);
  const auto finite = [&] {
    for (;;)
      if (const float x = any_float(random); std::isfinite(x)) return x;
  };
  for (int i = 0; i < 90000; ++i)
    for (Column<float>& part : z) {
      const float small = std::ldexp(near(random), -int(random() % 100));
      const float half = float(int(random() % 7) - 3) * 0.5f;
      const float choice[] = {near(random), wide(random), small,
                              half,         finite(),     random() % 2 ? finite() : near(random)};
      part.push_back(choice[i % 6]);
    }
  return z;
}

template <class R>
double worst_error(const Oracle& oracle, const std::vector<Column<float>>& z, std::string& where) {
  std::vector<Column<R>> in;
  for (const Column<float>& part : z) in.emplace_back(part.begin(), part.end());
  const auto out = run<R>(row_of(oracle.name), in);
  double worst = 0;
  for (std::size_t i = 0; i < z[0].size(); ++i) {
    const LC exact = oracle.exact(LC(z[0][i], z[1][i]));
    const double error =
        std::max(ulp_error(out[0][i], exact.real()), ulp_error(out[1][i], exact.imag()));
    if (error <= worst) continue;
    worst = error;
    where = fmt::format("{} + {}i -> {} + {}i for {} + {}i", z[0][i], z[1][i], out[0][i], out[1][i],
                        double(exact.real()), double(exact.imag()));
  }
  return worst;
}

TEST_CASE("both parts of every complex function are within the stated error") {
  const auto z = arguments();
  for (const Oracle& oracle : kOracles) {
    std::string where;
    const double error = worst_error<float>(oracle, z, where);
    CHECK_MESSAGE(error <= row_of(oracle.name).max_ulp,
                  oracle.name << ": " << error << " ulp at " << where);
    const double error64 = worst_error<double>(oracle, z, where);
    CHECK_MESSAGE(error64 <= kDoubleUlp,
                  oracle.name << " (double): " << error64 << " ulp at " << where);
    if (std::getenv("MMS_SHOW_ERRORS"))
      MESSAGE(oracle.name << ": " << error << " ulp, in double " << error64);
  }
}

TEST_CASE("every complex function of one argument has an oracle here") {
  for (const vm::Builtin& row : builtins()) {
    if (!row.signature.ends_with("(complex z)") || !row.signature.starts_with("complex")) continue;
    bool found = false;
    for (const Oracle& oracle : kOracles) found |= &row_of(oracle.name) == &row;
    CHECK_MESSAGE(found, row.signature);
  }
}

TEST_CASE("zeros, infinities and NaN of every complex function are those of C99 Annex G") {
  const float inf = INFINITY;
  const float parts[] = {0.0f, 0.5f, 1.0f, 2.0f, 800.0f, inf, NAN};
  for (const Oracle& oracle : kOracles)
    for (int i = 0; i < 14 * 14; ++i) {
      const float re = parts[i % 7] * (i / 7 % 2 ? -1.0f : 1.0f);
      const float im = parts[i / 14 % 7] * (i / 98 ? -1.0f : 1.0f);
      const bool unknown = std::isnan(re) || std::isnan(im);
      INFO(oracle.name << " " << re << " " << im);
      const LC exact = oracle.exact(LC(re, im));
      const auto got = run<float>(row_of(oracle.name), {{re}, {im}});
      const auto got64 = run<double>(row_of(oracle.name), {{re}, {im}});
      if (unknown && oracle.name.starts_with("a")) {  // less than C99 asks: no number at all
        for (std::size_t part : {0u, 1u})
          CHECK((std::isnan(got[part][0]) && std::isnan(got64[part][0])));
        continue;
      }
      const float expected[] = {float(exact.real()), float(exact.imag())};
      // The standard leaves signs open where no angle tells them.
      const bool turns =
          !oracle.name.starts_with("a") && oracle.name != "log" && oracle.name != "sqrt";
      const bool sideways = oracle.name == "sin" || oracle.name == "cos" || oracle.name == "tan";
      const bool open = turns && (unknown || std::isinf(sideways ? re : im));
      for (std::size_t part : {0u, 1u}) {
        const float x = got[part][0], y = expected[part];
        const bool edge = y == 0 || !std::isfinite(y);
        if (!edge)
          CHECK(ulp_error(x, part ? exact.imag() : exact.real()) <= row_of(oracle.name).max_ulp);
        else if (open)
          CHECK((std::isnan(y) ? std::isnan(x) : std::fabs(x) == std::fabs(y)));
        else
          CHECK(same_bits(x, y));
        if (std::isinf(x)) CHECK(double(x) == got64[part][0]);  // both machines take one sign
      }
    }
}

TEST_CASE("complex pow and powi") {
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
  }
  const auto value = [&](float zr, float wr) {
    return run<float>(pow, {{zr}, {0}, {wr}, {0}})[0][0];
  };
  CHECK(value(0, 0) == 1);
  CHECK(value(0, 2) == 0);
  CHECK(value(0, -1) == INFINITY);
  CHECK(value(INFINITY, 0) == 1);
  CHECK(run<double>(pow, {{0}, {0}, {0}, {0}})[0][0] == 1);
}

TEST_CASE("the enclosure of atanh holds far out, where the real part is next to nothing") {
  for (const double x : {-795077836275712.0, -3e3, 1.0, 2.0, 1e7, 8e14, 1e30})
    for (const double y : {-4.0, 1e-3, 1e9}) {
      const vm::Interval in[] = {vm::Interval::point(x), vm::Interval::point(y)};
      vm::Interval out[2];
      bounds::complex_atanh(in, out);
      const L across = L(y) * y, exact = log1pl(4 * L(x) / ((1 - L(x)) * (1 - L(x)) + across)) / 4;
      CHECK_MESSAGE(out[0].lo <= exact, x, " ", y);
      CHECK_MESSAGE(out[0].hi >= exact, x, " ", y);
      CHECK_MESSAGE(out[0].hi - out[0].lo < 1e-14, x, " ", y);
    }
}

}  // namespace
}  // namespace mms::stdlib::testing
