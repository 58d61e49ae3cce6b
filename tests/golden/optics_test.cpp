// SPDX-License-Identifier: Apache-2.0
// What the library calls by name is the measured curve of that name: tables by their number,
// glasses by the formula that its catalogue fits to its figures.
#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "materials/optical_tables.h"
#include "tests/golden/evaluate.h"

namespace mms::golden {
namespace {

/// `expression` of the wavelength l, in metres, at wavelengths in nanometres, by the double
/// machine.
std::vector<double> curve(const std::string& expression, const std::vector<double>& nm) {
  const Compiled c = compile(fmt::format("real value()\n l = $time;\n return {};\n", expression));
  REQUIRE_MESSAGE(c.linked, expression, "\n", c.text_of_errors());
  const vm::Program& program = c.linked->program;
  const vm::Executable executable(program);
  std::vector<double> all;
  constexpr int kBatch = 16;
  for (std::size_t first = 0; first < nm.size(); first += kBatch) {
    vm::InputBatch<double> in(kBatch);
    api::fill_defaults(in);
    const int lanes = int(std::min<std::size_t>(kBatch, nm.size() - first));
    for (int i = 0; i < lanes; ++i)
      in.lanes(vm::Variable::Time)[i] = nm[first + std::size_t(i)] * 1e-9;
    const Run r = run(program, executable, program.exports[0].function, in, lanes);
    all.insert(all.end(), r.values[0].begin(), r.values[0].end());
  }
  return all;
}

TEST_CASE("every table has the function of its name") {
  int named = 0;
  for (const materials::OpticalTable& table : materials::optical_tables) {
    const std::string name(table.name);
    INFO(name);
    // The components of daylight are only ever seen together.
    if (name.starts_with("daylight_s")) continue;
    const bool lamp = name.starts_with("illuminant_f");
    const std::string call =
        lamp ? fmt::format("illuminant_f(l, {})", name.substr(12)) : name + "(l)";
    const std::vector<double> at(table.nm, table.nm + table.rows), got = curve(call, at);
    const double unit = lamp ? table.at(560) : 1;
    for (std::size_t k = 0; k < at.size(); ++k)
      CHECK(got[k] * unit == doctest::Approx(table.value[k]).epsilon(1e-9));
    ++named;
  }
  CHECK(named == materials::kOpticalTables - 3);
}

TEST_CASE("glasses by name have the indices of the maker's table") {
  struct Row {
    double nm, n;
  };
  const auto check = [](std::string name, const std::vector<Row>& rows) {
    for (char& c : name) c = char(std::tolower(c));
    INFO(name);
    std::vector<double> at, below, above;
    for (const Row& r : rows) {
      at.push_back(r.nm);
      below.push_back(r.nm - 1);
      above.push_back(r.nm + 1);
    }

    const std::string call = name + "(l)";
    const auto n = curve(call, at), high = curve(call, below), low = curve(call, above);
    // The table tells wavelengths to a whole nanometre, and cuts off what is more.
    for (std::size_t k = 0; k < rows.size(); ++k)
      CHECK(std::abs(n[k] - rows[k].n) <= high[k] - low[k] + 1e-8);
  };
#define MATERIAL(name, ...) check(#name, {__VA_ARGS__});
#include "tests/golden/glasses.inc"
#undef MATERIAL
}

}  // namespace
}  // namespace mms::golden
