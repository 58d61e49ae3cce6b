// SPDX-License-Identifier: Apache-2.0
#include "tests/golden/corpus.h"

#include <algorithm>

#include <fmt/format.h>

#include "tests/source_dir.h"
#include "vm/limits.h"

namespace mms::golden {
namespace {

namespace fs = std::filesystem;
namespace limits = vm::limits;

const fs::path kFolder = mms::source_dir() / "tests" / "golden";

std::string brackets(int n) {
  return "const a = " + repeated("(", n) + "1" + repeated(")", n) + ";";
}

// Calls in tail position, one back edge each; the count is known at run time only.
std::string tail_calls(int n) {
  return fmt::format(
      "integer down(integer n) = select 0, if n == 0; down(n - 1) otherwise end;\n"
      "integer a() = down(integer({} + $time));",
      n);
}

std::string open_calls(int n) {
  return fmt::format(
      "integer sum(integer n) = select 0, if n == 0; 1 + sum(n - 1) otherwise end;\n"
      "integer a() = sum(integer({} + $time));",
      n);
}

// Each open call of `deep` holds an array of `n` numbers and its `sum`.
std::string large_frames(int n) {
  std::string text = fmt::format("real deep(real[{}] v, integer n) = select v[0], if n == 0;\n", n);
  text += "  v[1] + deep([";
  for (int i = 0; i < n; ++i) text += fmt::format("{}v[{}] + 1", i ? ", " : "", n - 1 - i);
  text += fmt::format("], n - 1) otherwise end;\nreal[{}] start() = [", n);
  for (int i = 0; i < n; ++i) text += fmt::format("{}$time + {}", i ? ", " : "", i);
  return text + "];\nreal a() = deep(start, integer(200 + $time));";
}

std::string lobes(int n) {  // n scattering models and n - 1 combiners
  return "surface s bsdf = matte(0.001)" + repeated(" + matte(0.001)", n - 1) + "; end";
}

std::string array(int n) {
  return fmt::format("real f(real[{0}] v) = v[{1}];\nreal[{0}] g() = [0.0{2}];\nreal a() = f(g);\n",
                     n, n - 1, repeated(", 1", n - 1));
}

std::string loops(int n) {
  std::string text;
  for (int i = 0; i < n; ++i)
    text += fmt::format("real f{0}(real x) = select x, if x > 1; f{0}(x + 1) otherwise end;\n", i);
  return text + "const a = 1;";
}

// Each function calls the one before twice: 2^n calls of the first one's few operations.
std::string doubling(int n) {
  std::string text = "real f0(real x) = sin(x * x);\n";
  for (int i = 1; i <= n; ++i)
    text += fmt::format("real f{0}(real x) = f{1}(x + {0}) + f{1}(x - {0});\n", i, i - 1);
  return text + fmt::format("real a() = f{}($position.z);\n", n);
}

std::string call_chain(int n) {
  std::string text = "real f1(real x) = x + 1;\n";
  for (int i = 2; i <= n; ++i) text += fmt::format("real f{0}(real x) = f{1}(x) + 1;\n", i, i - 1);
  return text + fmt::format("real a() = f{}(0);\n", n);
}

// One constant more is two expressions more: the sum and the name in it.
std::string constants(int n) {
  std::string text;
  for (int i = n; i > 1; --i) text += fmt::format("const k{} = k{} + 1;\n", i, i - 1);
  return text + "const k1 = 1;\n";
}

// `n` values that are all needed at the end, whatever the order.
std::string values(int n) {
  std::string text = "real f(real x)\n";
  for (int i = 0; i < n; ++i) text += fmt::format("  y{} = sqrt(x + {});\n", i, i);
  text += "  s0 = x;\n";
  for (int i = 0; i < n; ++i)
    text += fmt::format("  s{} = s{} + y{} * y{};\n", i + 1, i, i, n - 1 - i);
  return text + fmt::format("  return s{};\nreal a() = f($time);", n);
}

// Each choice is needed in one arm of the next only; the first two are so cheap that they are
// computed without one.
std::string choices(int n) {
  std::string text = "real f(real x)\n  y0 = x;\n";
  for (int i = 1; i <= n; ++i)
    text += fmt::format("  y{0} = select sqrt(y{1} + x), if x < {0}; 0 otherwise end;\n", i, i - 1);
  return text + fmt::format("  return y{};\nreal a() = f($time);", n);
}

// Each call of a function that is not expanded loads and takes 4002 numbers.
std::string wide_calls(int n) {
  std::string text =
      "real f(real[4000] v, real x, integer k)\n"
      "    = select v[0] + x, if k <= 0; f(v, x, k - 1) + v[1] otherwise end;\n"
      "real a()\n  v = array(4000, function(i) -> $time * i);\n  s0 = 0.0;\n";
  for (int i = 0; i < n; ++i)
    text += fmt::format("  s{} = s{} + f(v, $time + {}, integer($time));\n", i + 1, i, i);
  return text + fmt::format("  return s{};", n);
}

std::string derivatives(int n) {
  std::string text =
      "real f0(real x) = power(integer($time), x);\n"
      "real power(integer k, real x) = select x, if k == 0; x * power(k - 1, x) otherwise end;\n";
  for (int i = 1; i <= n; ++i)
    text += fmt::format("real f{0}(real x) = gradient(#f{1}, x);\n", i, i - 1);
  return text + fmt::format("real a() = f{}($position.x);\n", n);
}

std::string bytes(int n) {
  std::string text = "const a = 1;";
  text.resize(static_cast<std::size_t>(n), ' ');
  return text;
}

std::vector<Limit> make_limits() {
  return {
      {"kBackEdges", tail_calls(limits::kBackEdges), tail_calls(limits::kBackEdges + 1), "",
       "BackEdges"},
      {"kCallDepth", open_calls(limits::kCallDepth - 1), open_calls(limits::kCallDepth + 1), "",
       "CallDepth"},
      {"kLobes", lobes(limits::kLobes / 2), lobes(limits::kLobes / 2 + 1), "E0302", ""},
      {"kNesting", brackets(limits::kNesting - 1), brackets(limits::kNesting), "E0160", ""},
      {"kAggregate", array(limits::kAggregate), array(limits::kAggregate + 1), "E0223", ""},
      {"kInstances", loops(limits::kInstances), loops(limits::kInstances + 1), "E0307", ""},
      {"kNodes", doubling(14), doubling(17), "E0303", ""},
      {"kInlineDepth", call_chain(limits::kInlineDepth - 1), call_chain(limits::kInlineDepth + 1),
       "E0305", ""},
      {"kExpressionDepth", constants(limits::kExpressionDepth / 2),
       constants(limits::kExpressionDepth / 2 + 2), "E0316", ""},
      {"kDerivativeOrder", derivatives(limits::kDerivativeOrder),
       derivatives(limits::kDerivativeOrder + 1), "E0310", ""},
      {"kSlots", values(limits::kSlots / 2), values(limits::kSlots), "E0315", "", "too many"},
      {"kIfDepth", choices(limits::kIfDepth), choices(limits::kIfDepth + 3), "E0315", "", "If"},
      {"kMoves", wide_calls(limits::kMoves / 13000), wide_calls(limits::kMoves / 11900), "E0315",
       "", "too many values"},
      {"kStackBlocks", large_frames(100), large_frames(1400), "", "CallDepth"},
      {"kSourceBytes", bytes(limits::kSourceBytes), bytes(limits::kSourceBytes + 1), "E0162", ""},
  };
}

}  // namespace

std::string repeated(std::string_view what, int times) {
  std::string all;
  all.reserve(what.size() * static_cast<std::size_t>(times));
  for (int i = 0; i < times; ++i) all += what;
  return all;
}

const std::vector<fs::path>& scripts() {
  static const std::vector<fs::path> all = [] {
    std::vector<fs::path> found;
    for (const auto& e : fs::recursive_directory_iterator(kFolder)) {
      // `parts` folders hold what the scripts import.
      if (e.path().extension() == ".mms" && e.path().parent_path().filename() != "parts")
        found.push_back(e.path());
    }
    std::sort(found.begin(), found.end());
    return found;
  }();
  return all;
}

std::string name_of(const fs::path& script) {
  return script.lexically_relative(kFolder).generic_string();
}

const std::vector<Limit>& limit_scripts() {
  static const std::vector<Limit> all = make_limits();
  return all;
}

std::string deep_sum() { return "real a() = $time" + repeated(" + 1", 4 * limits::kNesting) + ";"; }

std::string flood() {
  std::string text;
  for (int i = 0; i < 150; ++i) text += fmt::format("const a{} = nope{};\n", i, i);
  return text;
}

}  // namespace mms::golden
