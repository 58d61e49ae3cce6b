// SPDX-License-Identifier: Apache-2.0
// Random scripts: every level, lane count and build of the machine gives the same bits, and so do
// the program that is stored and loaded again, and a script whose variables are constants and which
// is therefore folded by the linker. MMS_PROPERTY_PROGRAMS in the environment says how many
// (default 300).
#include <doctest/doctest.h>

#include <cstdlib>

#include "generator.h"
#include "tests/golden/expectations.h"

namespace mms::property {
namespace {

using namespace golden;

int programs() {
  const char* text = std::getenv("MMS_PROPERTY_PROGRAMS");
  return text ? std::max(1, std::atoi(text)) : 300;
}

/// The definitions of v0 to v7: components of two variables, or numbers.
std::string variables(const std::vector<float>& numbers) {
  std::string text;
  for (int k = 0; k < kVariables; ++k)
    text += numbers.empty()
                ? fmt::format("real v{}() = {}[{}];\n", k,
                              k < 3   ? "$position"
                              : k < 6 ? "$object_position"
                                      : "$uv",
                              k % 3)
                : fmt::format("real v{}() = {:.9f};\n", k, numbers[static_cast<std::size_t>(k)]);
  return text;
}

TEST_CASE("random programs: all ways to run one agree") {
  const double no_double = std::numeric_limits<double>::infinity();  // chaotic, so not near
  const int count = programs();
  int folded_values = 0;
  for (int seed = 1; seed <= count; ++seed) {
    const std::string body = Generator(static_cast<std::uint32_t>(seed)).script();
    const std::string text = variables({}) + body;
    const Compiled c = compile(text);
    CAPTURE(seed);
    INFO(c.text_of_errors());
    if (!c.linked) INFO(text);
    REQUIRE(c.linked);
    std::vector<std::string> failures;
    check_agreement(lang::make_source("random.mms", text), {}, no_double, failures);
    std::string all;
    for (const std::string& f : failures) all += f + "\n";
    CHECK_MESSAGE(failures.empty(), all, failures.empty() ? "" : text);

    // The same point as numbers: eighths, which are the same in text, float and double.
    std::mt19937 random(static_cast<std::uint32_t>(seed));
    std::vector<float> numbers;
    for (int k = 0; k < kVariables; ++k) numbers.push_back((float(random() % 33) - 16) / 8);
    const Compiled constant = compile(variables(numbers) + body);
    INFO(constant.text_of_errors());
    REQUIRE(constant.linked);
    auto in = points<float>(vm::kLaneMultiple);
    for (int k = 0; k < kVariables; ++k)
      in.lanes(k < 3   ? vm::Variable::Position
               : k < 6 ? vm::Variable::ObjectPosition
                       : vm::Variable::Uv,
               k % 3)[0] = numbers[static_cast<std::size_t>(k)];
    const vm::Program &p = c.linked->program, &q = constant.linked->program;
    const vm::Executable machine(p), folded(q);
    const std::vector<Point> points_p = points_of(p), points_q = points_of(q);
    for (std::size_t k = 0; k < points_p.size(); ++k) {
      const Run a = evaluate(p, machine, points_p[k], in, 1),
                b = evaluate(q, folded, points_q[k], in, 1);
      // Folded materials have other numbers: those of an arm that is not taken are 0, or not there.
      const bool materials =
          points_p[k].name.ends_with(".shade") || points_p[k].name.ends_with(".emit");
      const std::size_t slots = materials ? 2 * kWavelengths : a.values.size();
      for (std::size_t s = 0; s < std::min(slots, a.values.size()); ++s) {
        ++folded_values;
        CHECK_MESSAGE(same_bits(a.values[s][0], b.values[s][0]), "seed ", seed, " ",
                      points_p[k].name, " slot ", s, ": ", a.values[s][0], " or, folded, ",
                      b.values[s][0]);
      }
    }
  }
  CHECK(folded_values > 20 * count);
}

}  // namespace
}  // namespace mms::property
