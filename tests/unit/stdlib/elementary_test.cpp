// SPDX-License-Identifier: Apache-2.0
// Elementary functions of reals against libm's long double functions, over all kinds of floats.
#include <doctest/doctest.h>

#include <cstdlib>
#include <functional>
#include <limits>
#include <numbers>

#include "tests/unit/stdlib/ulp.h"

namespace mms::stdlib::testing {
namespace {

/// What a row must compute.
struct Oracle {
  std::string_view signature;
  std::function<L(L, L, L)> exact;
};

L nan_max(L a, L b) { return a != a || b != b ? NAN : a > b ? a : b; }
L nan_min(L a, L b) { return a != a || b != b ? NAN : a < b ? a : b; }
L clamp_of(L x, L low, L high) {
  if (x < low) x = low;
  return x > high ? high : x;
}
L fract_of(L x) { return std::isinf(x) ? NAN : x - std::floor(x); }
L sign_of(L x) { return x == 0 || x != x ? x : std::copysign(L(1), x); }

const Oracle kOracles[] = {
    {"real sin(real x)", [](L x, L, L) { return sinl(x); }},
    {"real cos(real x)", [](L x, L, L) { return cosl(x); }},
    {"real tan(real x)", [](L x, L, L) { return tanl(x); }},
    {"real asin(real x)", [](L x, L, L) { return asinl(x); }},
    {"real acos(real x)", [](L x, L, L) { return acosl(x); }},
    {"real atan(real x)", [](L x, L, L) { return atanl(x); }},
    {"real atan2(real y, x)", [](L y, L x, L) { return atan2l(y, x); }},
    {"real sinh(real x)", [](L x, L, L) { return sinhl(x); }},
    {"real cosh(real x)", [](L x, L, L) { return coshl(x); }},
    {"real tanh(real x)", [](L x, L, L) { return tanhl(x); }},
    {"real asinh(real x)", [](L x, L, L) { return asinhl(x); }},
    {"real acosh(real x)", [](L x, L, L) { return acoshl(x); }},
    {"real atanh(real x)", [](L x, L, L) { return atanhl(x); }},
    {"real exp(real x)", [](L x, L, L) { return expl(x); }},
    {"real exp2(real x)", [](L x, L, L) { return exp2l(x); }},
    {"real expm1(real x)", [](L x, L, L) { return expm1l(x); }},
    {"real log(real x)", [](L x, L, L) { return logl(x); }},
    {"real log2(real x)", [](L x, L, L) { return log2l(x); }},
    {"real log10(real x)", [](L x, L, L) { return log10l(x); }},
    {"real log1p(real x)", [](L x, L, L) { return log1pl(x); }},
    {"real pow(real x, y)", [](L x, L y, L) { return powl(x, y); }},
    {"real sqrt(real x)", [](L x, L, L) { return sqrtl(x); }},
    {"real cbrt(real x)", [](L x, L, L) { return cbrtl(x); }},
    {"real hypot(real x, y)", [](L x, L y, L) { return hypotl(x, y); }},
    {"real fmod(real a, b)", [](L a, L b, L) { return fmodl(a, b); }},
    {"real floor(real x)", [](L x, L, L) { return floorl(x); }},
    {"real ceil(real x)", [](L x, L, L) { return ceill(x); }},
    {"real trunc(real x)", [](L x, L, L) { return truncl(x); }},
    {"real round(real x)", [](L x, L, L) { return roundl(x); }},
    {"real fract(real x)", [](L x, L, L) { return fract_of(x); }},
    {"real abs(real x)", [](L x, L, L) { return fabsl(x); }},
    {"real sign(real x)", [](L x, L, L) { return sign_of(x); }},
    {"real min(real a, b)", [](L a, L b, L) { return nan_min(a, b); }},
    {"real max(real a, b)", [](L a, L b, L) { return nan_max(a, b); }},
    {"real clamp(real x, low, high)", [](L x, L a, L b) { return clamp_of(x, a, b); }},
};

/// Sets of arguments: the edges in every combination, and floats of random bits and sizes.
std::vector<Column<float>> arguments(std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> near(-4.0f, 4.0f), wide(-120.0f, 120.0f);
  std::vector<Column<float>> in(count);
  const std::vector<float> edge = edges();
  const auto add = [&](auto next) {
    in[0].push_back(next(0));
    for (std::size_t k = 1; k < count; ++k) in[k].push_back(next(k));
  };
  if (count == 1) {
    for (float x : edge) add([&](std::size_t) { return x; });
    for (std::uint64_t b = 0; b < (1ULL << 32); b += 16381)  // a prime: every kind of mantissa
      add([&](std::size_t) { return std::bit_cast<float>(std::uint32_t(b)); });
    for (int i = 0; i <= 40000; ++i) add([&](std::size_t) { return float(i - 20000) / 10000.0f; });
  } else if (count == 2) {
    for (float x : edge)
      for (float y : edge) add([&](std::size_t k) { return k ? y : x; });
  } else {
    for (float x : edge)
      for (int i = 0; i < 400; ++i)
        add([&](std::size_t k) { return k ? edge[random() % edge.size()] : x; });
  }
  for (int i = 0; i < 60000; ++i) {
    add([&](std::size_t) { return near(random); });
    add([&](std::size_t) { return wide(random); });
    add([&](std::size_t) { return any_float(random); });
    add([&](std::size_t k) { return k ? wide(random) : std::fabs(near(random)); });
    add([&](std::size_t) { return float(int(random() % 41) - 20); });
  }
  return in;
}

template <class R>
double worst_error(const vm::Builtin& row, const Oracle& oracle,
                   const std::vector<Column<float>>& in, std::string& where) {
  std::vector<Column<R>> args;
  for (const Column<float>& column : in) args.emplace_back(column.begin(), column.end());
  const Column<R> out = run<R>(row, args)[0];
  double worst = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const L a = in[0][i], b = in.size() > 1 ? in[1][i] : 0, c = in.size() > 2 ? in[2][i] : 0;
    const L exact = oracle.exact(a, b, c);
    // The order of -0 and 0 is not part of the promise of min, max and clamp.
    const bool either_zero = row.max_ulp == 0 && row.signature != "real fmod(real a, b)" &&
                             in.size() > 1 && exact == 0 && out[i] == 0;
    const double error = either_zero ? 0 : ulp_error(out[i], exact);
    if (error > worst) {
      worst = error;
      where = std::to_string(double(a)) + ", " + std::to_string(double(b)) + ": " +
              std::to_string(double(out[i])) + " for " + std::to_string(double(exact));
    }
  }
  return worst;
}

TEST_CASE("elementary functions are within the error that their row states") {
  for (const Oracle& oracle : kOracles) {
    const vm::Builtin& row = find(oracle.signature);
    const auto in = arguments(shape_of(row).params.size());
    std::string where;
    const double error = worst_error<float>(row, oracle, in, where);
    CHECK_MESSAGE(error <= row.max_ulp, row.signature << ": " << error << " ulp at " << where);
    if (std::getenv("MMS_SHOW_ERRORS")) MESSAGE(row.signature << ": " << error << " ulp");
    // The double kernels are libm, for which glibc's manual states at most 4 ulp of double.
    const double error64 = worst_error<double>(row, oracle, in, where);
    CHECK_MESSAGE(error64 <= (row.max_ulp > 0 ? 4.0 : 0.0),
                  row.signature << " (double): " << error64 << " ulp at " << where);
  }
}

TEST_CASE("every real function of module math has an oracle here") {
  for (const vm::Builtin& row : builtins()) {
    if (row.module != "math" || !row.f32) continue;
    const Shape shape = shape_of(row);
    if (shape.results != "r" || shape.params.find('i') != std::string::npos) continue;
    if (row.signature.find("complex") != row.signature.npos) continue;
    if (row.signature.starts_with("complex")) continue;
    bool found = false;
    for (const Oracle& oracle : kOracles) found |= oracle.signature == row.signature;
    CHECK_MESSAGE(found, row.signature);
  }
}

TEST_CASE("angles of any size are reduced; infinite ones give NaN") {
  for (std::string_view name : {"real sin(real x)", "real cos(real x)", "real tan(real x)"}) {
    const vm::Builtin& row = find(name);
    // Every binade above 2^20, among them those where the way of reduction changes.
    Column<float> x;
    std::mt19937 random(4);
    for (int e = 20; e < 128; ++e)
      for (int i = 0; i < 500; ++i)
        x.push_back(std::ldexp(1.0f + float(random() >> 9) * 0x1p-23f, e) * (i % 2 ? 1.0f : -1.0f));
    // The floats nearest to a multiple of pi/2, and large ones near others (Kahan's program).
    for (float special : {0x1.6ac5b2p+109f, 16367173.0f * 0x1p72f, 0x1.ddebdep-1f * 0x1p77f,
                          0x1.3170f0p63f, 0x1.fffffep127f, 0x1p48f, 0x1.fffffep47f, 0x1p127f}) {
      x.push_back(special);
      x.push_back(-special);
    }
    const Column<float> got = run<float>(row, {x})[0];
    double worst = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const L exact = name[5] == 's' ? sinl(x[i]) : name[5] == 'c' ? cosl(x[i]) : tanl(x[i]);
      worst = std::max(worst, ulp_error(got[i], exact));
    }
    CHECK_MESSAGE(worst <= row.max_ulp, name << ": " << worst);
    CHECK(std::isnan(call<float>(row, INFINITY)));
    CHECK(std::isnan(call<float>(row, -INFINITY)));
  }
}

TEST_CASE("sine and cosine next to multiples of pi/2, where cancellation is worst") {
  const vm::Builtin& sine = find("real sin(real x)");
  const vm::Builtin& cosine = find("real cos(real x)");
  std::mt19937_64 random(2);
  Column<float> x;
  for (int i = 0; i < 200000; ++i) {
    const std::uint64_t k = random() >> (17 + random() % 46);
    x.push_back(float(L(k) * (std::numbers::pi_v<L> / 2)));
  }
  const Column<float> s = run<float>(sine, {x})[0], c = run<float>(cosine, {x})[0];
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    worst = std::max({worst, ulp_error(s[i], sinl(x[i])), ulp_error(c[i], cosl(x[i]))});
  CHECK(worst <= sine.max_ulp);
}

TEST_CASE("powi") {
  const vm::Builtin& row = find("real powi(real x, integer n)");
  CHECK(call<float>(row, 0.0f, 0) == 1);
  CHECK(call<float>(row, NAN, 0) == 1);
  CHECK(call<float>(row, -2.0f, 3) == -8);
  CHECK(call<float>(row, -2.0f, -3) == -0.125f);
  CHECK(call<float>(row, 0.0f, -1) == INFINITY);
  CHECK(call<float>(row, -0.0f, -1) == -INFINITY);
  CHECK(call<float>(row, 1.0f, INT32_MIN) == 1);
  CHECK(call<float>(row, 2.0f, INT32_MIN) == 0);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> any(-3.0f, 3.0f);
  double worst = 0;
  for (int n = -70; n <= 70; ++n) {
    Column<float> x(500), power(500, float(n));
    for (float& v : x) v = any(random);
    const Column<float> out = run<float>(row, {x, power})[0];
    for (std::size_t i = 0; i < x.size(); ++i)
      worst = std::max(worst, ulp_error(out[i], powl(x[i], n)));
  }
  CHECK(worst <= row.max_ulp);
}

TEST_CASE("integer functions") {
  CHECK(call<float>(find("integer abs(integer x)"), -7) == 7);
  // The extremes do not fit the float columns of `call`.
  const vm::Builtin& row = find("integer abs(integer x)");
  std::int32_t in[vm::kLaneMultiple] = {INT32_MIN, INT32_MAX, -INT32_MAX}, out[vm::kLaneMultiple];
  const void* args[] = {in};
  void* results[] = {out};
  row.f32(args, results, vm::kLaneMultiple);
  CHECK(out[0] == INT32_MIN);
  CHECK(out[1] == INT32_MAX);
  CHECK(out[2] == INT32_MAX);
  CHECK(call<float>(find("integer sign(integer x)"), -7) == -1);
  CHECK(call<float>(find("integer sign(integer x)"), 0) == 0);
  CHECK(call<float>(find("integer min(integer a, b)"), -7, 2) == -7);
  CHECK(call<float>(find("integer max(integer a, b)"), -7, 2) == 2);
  CHECK(call<float>(find("integer clamp(integer x, low, high)"), 9, 0, 3) == 3);
  CHECK(call<float>(find("integer clamp(integer x, low, high)"), 2, 5, 3) == 3);
}

}  // namespace
}  // namespace mms::stdlib::testing
