// SPDX-License-Identifier: Apache-2.0
#include "bench/scripts.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace mms::bench {
namespace {

using fmt::format_to;

/// The functions that the mixed script and the descriptors share.
constexpr std::string_view kShared =
    "real veins(real[3] p) = 0.5 + 0.5 * sin(3.0 * p[0] + 4.0 * perlin(p));\n"
    "real grain(real[3] p, real scale) = perlin(scale * p) * perlin(2 * scale * p);\n";

/// A surface of eight lines every forty, small functions between, each used by the next surface.
std::string mixed(int lines) {
  std::string text(kShared);
  auto out = std::back_inserter(text);
  constexpr int kFunctions = 8;  // for each surface, of four lines each
  for (int line = 2, surface = 0; line + 40 <= lines; line += 40, ++surface) {
    for (int k = 0; k < kFunctions; ++k)
      format_to(out,
                "// Number {1} of the functions of s{0}.\n"
                "real f{0}_{1}(real[3] p)\n"
                "  t = p[{2}] * {3}.25 + veins(p);\n"
                "  return select t * t, if t < 0.{4}; 1 - t otherwise end;\n",
                surface, k, k % 3, k, 1 + surface % 9);
    format_to(out,
              "surface s{0}\n"
              "  p = $object_position * {1}.5;\n"
              "  a = f{0}_0(p) + f{0}_1(p) * f{0}_2(p);\n"
              "  b = f{0}_3(p) - f{0}_4(p) / (1 + abs(f{0}_5(p)));\n"
              "  c = mix(rgb(0.9, 0.5, 0.1), rgb(0.1, 0.2, 0.{2}), a + f{0}_6(p));\n"
              "  bsdf = mix(matte(c), glossy(c, 10 + b * b), 0.25);\n"
              "  scattering = 0.5 + 0.25 * f{0}_7(p);\n"
              "end\n",
              surface, 1 + surface % 7, 1 + surface % 8);
  }
  for (auto n = std::count(text.begin(), text.end(), '\n'); n < lines; ++n) text += "// end\n";
  return text;
}

/// One descriptor whose body defines a value a line.
std::string body(int lines) {
  std::string text(
      "surface s\n  v0 = $object_position[0];\n  v1 = $object_position[1];\n"
      "  v2 = v0 * v1;\n");
  auto out = std::back_inserter(text);
  int k = 3;
  for (; k + 4 < lines; ++k)
    format_to(out, "  v{} = v{} * 0.{} + v{};\n", k, k - 1, 1 + k % 9, k % 2 ? k - 3 : k - 2);
  format_to(out, "  bsdf = matte(v{});\nend\n", k - 1);
  return text;
}

/// One-line functions, each of which calls the last; one descriptor uses the last.
std::string functions(int lines) {
  std::string text("real f0(real x) = x * 0.5 + 1;\n");
  auto out = std::back_inserter(text);
  for (int k = 1; k + 1 < lines; ++k)
    format_to(out, "real f{}(real x) = {}(x) * 0.{} + x;\n", k,
              k % 64 ? fmt::format("f{}", k - 1) : "f0", 1 + k % 9);
  format_to(out, "surface s bsdf = matte(f{}($object_position[0])); end\n", lines - 2);
  return text;
}

/// Choices of a hundred arms, an arm a line.
std::string choices(int lines) {
  std::string text;
  auto out = std::back_inserter(text);
  constexpr int kArms = 97;
  int n = 0;
  for (int line = 0; line + kArms + 4 < lines; line += kArms + 3, ++n) {
    format_to(out, "real c{}(real x) = select\n", n);
    for (int k = 0; k < kArms; ++k)
      format_to(out, "  sin(x * {}.5), if x < {}.25;\n", 1 + k, k + n % 10);
    text += "  x otherwise end;\n\n";
  }
  text += "surface s bsdf = matte(c0($object_position[0])); end\n";
  return text;
}

/// Tables of a thousand numbers, eight on a line, read at a place that is known only at the hit.
std::string tables(int lines) {
  std::string text;
  auto out = std::back_inserter(text);
  constexpr int kRows = 125;
  int n = 0;
  for (int line = 0; line + kRows + 4 < lines; line += kRows + 3, ++n) {
    format_to(out, "const table{} = [\n", n);
    for (int row = 0; row < kRows; ++row) {
      for (int k = 0; k < 8; ++k)
        format_to(out, "  {}.{}{}", row, k, row + k + 1 < kRows + 7 ? "," : "");
      text += '\n';
    }
    text += "];\n\n";
  }
  text += "surface s bsdf = matte(table0[integer($object_position[0])]); end\n";
  return text;
}

constexpr LargeScript kScripts[] = {
    {"mixed", "surfaces of eight lines among functions of four that they use", mixed},
    {"body", "one body that defines a value a line", body},
    {"functions", "functions of one line in chains of 64", functions},
    {"choices", "`select`s of 97 arms, an arm a line", choices},
    {"tables", "constant arrays of 1,000 numbers, eight a line", tables},
};

}  // namespace

std::span<const LargeScript> large_scripts() { return kScripts; }

std::string descriptors_script(int count) {
  std::string text(kShared);
  auto out = std::back_inserter(text);
  for (int k = 0; k < count; ++k)
    format_to(out,
              "surface s{} bsdf = matte(veins($object_position * {}.5) * grain($object_position, "
              "{})); end\n",
              k, k % 10, 1 + k % 7);
  return text;
}

}  // namespace mms::bench
