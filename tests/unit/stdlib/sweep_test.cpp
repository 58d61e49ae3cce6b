// SPDX-License-Identifier: Apache-2.0
// Functions of reals over very many floats: of one argument over every float there is, of two over
// random bits. MMS_SWEEP=1 does all of it (./run nightly: a minute a function), MMS_SWEEP=17 every
// 17th float; otherwise a small part.
#include <doctest/doctest.h>

#include <fmt/format.h>
#include <algorithm>
#include <cstdio>
#include <utility>

#include "tests/sanitized.h"
#include "tests/setting.h"
#include "tests/unit/stdlib/ulp.h"

namespace mms::stdlib::testing {
namespace {

/// What screens: libm's function in double, whose own error of an ulp is 2^-29 ulp of float. The
/// worst argument is judged by the long double one.
struct Unary {
  std::string_view signature;
  double (*screen)(double);
  L (*exact)(L);
};
const Unary kUnary[] = {
    {"real sin(real x)", std::sin, sinl},       {"real cos(real x)", std::cos, cosl},
    {"real tan(real x)", std::tan, tanl},       {"real asin(real x)", std::asin, asinl},
    {"real acos(real x)", std::acos, acosl},    {"real atan(real x)", std::atan, atanl},
    {"real sinh(real x)", std::sinh, sinhl},    {"real cosh(real x)", std::cosh, coshl},
    {"real tanh(real x)", std::tanh, tanhl},    {"real asinh(real x)", std::asinh, asinhl},
    {"real acosh(real x)", std::acosh, acoshl}, {"real atanh(real x)", std::atanh, atanhl},
    {"real exp(real x)", std::exp, expl},       {"real exp2(real x)", std::exp2, exp2l},
    {"real expm1(real x)", std::expm1, expm1l}, {"real log(real x)", std::log, logl},
    {"real log2(real x)", std::log2, log2l},    {"real log10(real x)", std::log10, log10l},
    {"real log1p(real x)", std::log1p, log1pl}, {"real sqrt(real x)", std::sqrt, sqrtl},
    {"real cbrt(real x)", std::cbrt, cbrtl},    {"real floor(real x)", std::floor, floorl},
};
struct Binary {
  std::string_view signature;
  double (*screen)(double, double);
  L (*exact)(L, L);
};
const Binary kBinary[] = {
    {"real pow(real x, y)", std::pow, powl},
    {"real atan2(real y, x)", std::atan2, atan2l},
    {"real hypot(real x, y)", std::hypot, hypotl},
    {"real fmod(real a, b)", std::fmod, fmodl},
};

/// 0 where it is not set.
std::uint64_t sweep_step() { return std::uint64_t(setting("MMS_SWEEP", 0)); }

/// `ulp_error` against a double; quick, for the screen.
double screened_error(float got, double exact) {
  if (double(got) == exact && got != 0) return 0;
  if (!(std::fabs(exact) > 0x1p-126 && std::fabs(exact) < 0x1.ffffffp127) || !std::isfinite(got))
    return ulp_error(got, L(exact));
  const auto bits = std::bit_cast<std::uint64_t>(exact) & 0x7ff0000000000000ULL;
  return std::fabs(double(got) - exact) / std::bit_cast<double>(bits) * 0x1p23;
}

constexpr std::size_t kBlock = 1 << 14;

/// The largest error and where it is; says so under MMS_SWEEP.
template <std::size_t N>
struct Worst {
  double error = -1;
  float at[N] = {};
  void see(double e, const std::vector<Column<float>>& in, std::size_t i) {
    if (e <= error) return;
    error = e;
    for (std::size_t k = 0; k < N; ++k) at[k] = in[k][i];
  }
};

/// Calls `fill` for blocks of arguments until it returns false; the worst error against `screen`.
template <std::size_t N, class Fill, class Screen>
Worst<N> sweep(const vm::Builtin& row, Fill fill, Screen screen) {
  Worst<N> worst;
  std::vector<Column<float>> in(N, Column<float>(kBlock));
  while (fill(in)) {
    const Column<float> out = run<float>(row, in)[0];
    for (std::size_t i = 0; i < kBlock; ++i)
      worst.see(screened_error(out[i], screen(in, i)), in, i);
  }
  return worst;
}

TEST_CASE("functions of one real over all floats") {
  // A prime step, so that a part has every kind of mantissa.
  const std::uint64_t step = sweep_step() ? sweep_step() : kSanitized ? 65521 : 4093;
  for (const Unary& f : kUnary) {
    const vm::Builtin& row = find(f.signature);
    std::uint64_t next = 0;
    const auto fill = [&](std::vector<Column<float>>& in) {
      if (next >> 32) return false;
      for (float& x : in[0]) {
        x = std::bit_cast<float>(std::uint32_t(next));
        next += step;
      }
      return true;
    };
    const Worst<1> worst =
        sweep<1>(row, fill, [&](const auto& in, std::size_t i) { return f.screen(in[0][i]); });
    const float got = call<float>(row, worst.at[0]);
    const double error = ulp_error(got, f.exact(worst.at[0]));
    CHECK_MESSAGE(error <= row.max_ulp, f.signature << ": " << error << " at " << worst.at[0]);
    if (sweep_step()) {
      fmt::print("{}: {:.6f} ulp at {:a}\n", f.signature, error, worst.at[0]);
      std::fflush(stdout);
    }
  }
}

// As MMS_SWEEP=1 has found them. Rows state little more than these.
TEST_CASE("functions of one real at the floats at which they err most") {
  const std::pair<std::string_view, float> worst[] = {
      {"real sin(real x)", 0x1.f0a58ap+91f}, {"real cos(real x)", 0x1.ebb01cp+105f},
      {"real exp(real x)", 0x1.4cba34p+2f},  {"real exp2(real x)", -0x1.fce5d6p-2f},
      {"real log(real x)", 0x1.65eaa2p-1f},  {"real log2(real x)", 0x1.6972a4p+0f}};
  for (const auto& [signature, x] : worst) {
    const vm::Builtin& row = find(signature);
    const auto f = std::find_if(std::begin(kUnary), std::end(kUnary),
                                [name = signature](const Unary& u) { return u.signature == name; });
    const double error = ulp_error(call<float>(row, x), f->exact(x));
    CHECK_MESSAGE(error <= row.max_ulp, signature, ": ", error);
    CHECK_MESSAGE(error > 0.95 * row.max_ulp, signature, ": ", error);
  }
}

TEST_CASE("functions of two reals over random bits") {
  const int blocks = sweep_step() ? (1 << 24) / int(kBlock) : kSanitized ? 2 : 32;
  for (const Binary& f : kBinary) {
    const vm::Builtin& row = find(f.signature);
    std::mt19937 random(11);
    std::uniform_real_distribution<float> near(-4.0f, 4.0f);
    int left = blocks;
    const auto fill = [&](std::vector<Column<float>>& in) {
      if (left-- == 0) return false;
      for (std::size_t i = 0; i < kBlock; ++i)
        for (Column<float>& column : in) column[i] = i % 2 ? any_float(random) : near(random);
      // Where pow does not overflow: the base as it came, the exponent what 127 / log2 allows.
      for (std::size_t i = 0; i < kBlock; i += 4)
        in[1][i] *= 32 / std::max(0.25f, std::fabs(std::log2(std::fabs(in[0][i]))));
      return true;
    };
    const Worst<2> worst = sweep<2>(
        row, fill, [&](const auto& in, std::size_t i) { return f.screen(in[0][i], in[1][i]); });
    const float got = call<float>(row, worst.at[0], worst.at[1]);
    const double error = ulp_error(got, f.exact(worst.at[0], worst.at[1]));
    CHECK_MESSAGE(error <= row.max_ulp,
                  f.signature << ": " << error << " at " << worst.at[0] << ", " << worst.at[1]);
    if (sweep_step())
      fmt::print("{}: {:.6f} ulp at {:a}, {:a}\n", f.signature, error, worst.at[0], worst.at[1]);
  }
}

}  // namespace
}  // namespace mms::stdlib::testing
