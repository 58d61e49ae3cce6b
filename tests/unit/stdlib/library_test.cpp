// SPDX-License-Identifier: Apache-2.0
// What holds for every row of the library, whatever it computes.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "lang/parser.h"
#include "tests/unit/stdlib/rows.h"
#include "tests/unit/stdlib/ulp.h"

namespace mms::stdlib::testing {
namespace {

/// Lanes of arguments of a row: edges and random floats; integers are small, or any.
template <class R>
std::vector<Column<R>> any_arguments(const vm::Builtin& row, std::size_t lanes) {
  const Shape shape = shape_of(row);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> near(-8.0f, 8.0f);
  const std::vector<float> edge = edges();
  std::vector<Column<R>> in(shape.params.size());
  for (std::size_t i = 0; i < lanes; ++i)
    for (std::size_t k = 0; k < in.size(); ++k) {
      const float choice[] = {edge[random() % edge.size()], any_float(random), near(random),
                              near(random)};
      const float integer = i % 16 ? float(int(random() % 41) - 20) : float(int(random()) / 2);
      in[k].push_back(shape.params[k] == 'i'   ? R(integer)
                      : shape.params[k] == 'l' ? R(random() % 2)
                                               : R(choice[random() % 4]));
    }
  return in;
}

template <class R>
std::size_t differing(const std::vector<Column<R>>& a, const std::vector<Column<R>>& b) {
  std::size_t count = a.size() == b.size() ? 0 : 1;
  for (std::size_t k = 0; k < a.size() && k < b.size(); ++k)
    for (std::size_t i = 0; i < a[k].size(); ++i) count += !same_bits(a[k][i], b[k][i]);
  return count;
}

TEST_CASE("every row says what it is") {
  std::set<std::string_view> seen;
  for (const vm::Builtin& row : builtins()) {
    INFO(row.signature);
    CHECK(!row.signature.empty());
    CHECK(!row.module.empty());
    CHECK(row.doc.ends_with('.'));
    CHECK(!row.example.empty());
    CHECK(row.cost >= 0);
    CHECK(seen.insert(row.signature).second);
    if (row.lobe < 0) {
      CHECK(bool(row.f32));
      CHECK(bool(row.f64));
    } else {
      CHECK(!row.f32);
    }
  }
}

TEST_CASE("signatures, examples, derivative rules and modules have no syntax errors") {
  const auto errors = [](std::string text, auto parse) {
    lang::Diagnostics diagnostics;
    parse(lang::make_source("test", std::move(text)), diagnostics);
    return diagnostics.has_errors();
  };
  for (const vm::Builtin& row : builtins()) {
    INFO(row.signature);
    CHECK(!errors(std::string(row.signature), lang::parse_signature));
    CHECK(!errors(std::string(row.example), lang::parse_expression));
    std::string_view rules = row.derivative;
    if (rules.starts_with('=')) rules.remove_prefix(1);
    while (!rules.empty()) {
      const std::size_t end = rules.find(';');
      CHECK(!errors(std::string(rules.substr(0, end)), lang::parse_expression));
      rules = end == rules.npos ? std::string_view() : rules.substr(end + 1);
    }
  }
  for (const vm::Library::Module& module : modules()) {
    INFO(module.name);
    CHECK(!errors(std::string(module.text), [](auto&&... a) { return lang::parse(a...); }));
  }
  REQUIRE(!modules().empty());
  CHECK(modules()[0].name == "prelude");
}

TEST_CASE("a derivative rule has one part for each formal; only integers and materials have none") {
  for (const vm::Builtin& row : builtins()) {
    const bool moves = row.lobe < 0 && !row.signature.starts_with("integer");
    CHECK_MESSAGE(row.derivative.empty() == !moves, row.signature);
    if (row.derivative.empty() || row.derivative.starts_with('=')) continue;
    INFO(row.signature);
    CHECK(std::count(row.derivative.begin(), row.derivative.end(), ';') ==
          std::count(row.signature.begin(), row.signature.end(), ','));
  }
}

TEST_CASE("both instruction sets give the same bits") {
  if (!has_avx2()) return;
  const auto a = baseline_rows(), b = avx2_rows();
  REQUIRE(a.size() == b.size());
  for (std::size_t r = 0; r < a.size(); ++r) {
    INFO(a[r].signature);
    REQUIRE(a[r].signature == b[r].signature);
    if (a[r].lobe >= 0) continue;  // a material: no kernel
    const std::size_t lanes = a[r].cost > 3000 ? 256 : 4096;
    const auto in32 = any_arguments<float>(a[r], lanes);
    CHECK(differing(run<float>(a[r], in32), run<float>(b[r], in32)) == 0);
    const auto in64 = any_arguments<double>(a[r], lanes);
    CHECK(differing(run<double>(a[r], in64), run<double>(b[r], in64)) == 0);
  }
}

/// Lanes of everyday arguments: reals in [-4, 4], or wavelengths in metres and what goes with them.
std::vector<Column<float>> everyday_arguments(const vm::Builtin& row, std::size_t lanes) {
  const Shape shape = shape_of(row);
  const bool optics = row.signature.find("(real wavelength") != row.signature.npos;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> near(-4.0f, 4.0f), unit(0.0f, 1.0f);
  std::vector<Column<float>> in(shape.params.size());
  for (std::size_t i = 0; i < lanes; ++i)
    for (std::size_t k = 0; k < in.size(); ++k)
      in[k].push_back(shape.params[k] != 'r'    ? float(random() % 5)
                      : !optics                 ? near(random)
                      : k == 0                  ? 1e-9f * (350.0f + 500.0f * unit(random))
                      : shape.params.size() > 2 ? unit(random)
                                                : 40.0f * unit(random));
  return in;
}

TEST_CASE("every row's floats are within its bound of its doubles") {
  // Noise is summed in float, of some hundred terms of the size of the whole; a seed that is as
  // near as another may be taken for it.
  constexpr double kNoise = 100 * 0x1p-24;
  for (const vm::Builtin& row : builtins()) {
    if (!row.f32) continue;
    INFO(row.signature);
    const auto in = everyday_arguments(row, 4096);
    std::vector<Column<double>> wide;
    for (const Column<float>& column : in) wide.emplace_back(column.begin(), column.end());
    const auto narrow = run<float>(row, in);
    const auto exact = run<double>(row, wide);
    for (std::size_t k = 0; k < exact.size(); ++k) {
      double worst = 0, largest = 0;
      for (const double x : exact[k]) largest = std::max(largest, std::fabs(x));
      int jumps = 0;
      for (std::size_t i = 0; i < exact[k].size(); ++i) {
        worst = std::max(worst, ulp_error(narrow[k][i], L(exact[k][i])));
        jumps += !(std::fabs(narrow[k][i] - exact[k][i]) <= kNoise * largest);
      }
      if (row.max_ulp == 0 && row.module != "math")
        CHECK(jumps <= 4);
      else
        // Both are off: the float kernel by its bound, the double one by less than 1e-3 of it.
        CHECK(worst <= row.max_ulp * 1.001);
    }
  }
}

TEST_CASE("a lane's result depends neither on its neighbours nor on its place") {
  for (const vm::Builtin& row : builtins()) {
    if (!row.f32) continue;
    INFO(row.signature);
    const auto in = any_arguments<float>(row, 256);
    const auto batch = run<float>(row, in);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < 256; i += 5) {
      std::vector<Column<float>> one;
      for (const Column<float>& column : in) one.push_back({column[i]});
      const auto alone = run<float>(row, one);
      for (std::size_t k = 0; k < alone.size(); ++k) wrong += !same_bits(alone[k][0], batch[k][i]);
    }
    CHECK(wrong == 0);
  }
}

}  // namespace
}  // namespace mms::stdlib::testing
