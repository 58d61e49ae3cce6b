// SPDX-License-Identifier: Apache-2.0
// What the linker makes of every row of the library: examples, and derivative rules against
// central differences of the same row in double.
#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "materials/table.h"
#include "stdlib/stdlib.h"
#include "tests/golden/evaluate.h"
#include "vm/signature.h"

namespace mms::golden {
namespace {

TEST_CASE("the example of every row links and runs") {
  for (const vm::Builtin& row : stdlib::builtins()) {
    CAPTURE(row.signature);
    const std::string example(row.example);
    const bool material = row.lobe >= 0;
    const bool phase =
        material && (materials::kTraits[row.lobe] & materials::Trait::PhaseFunction) != 0;
    const Compiled c = compile(phase      ? "volume v phase = " + example + "; end"
                               : material ? "surface s bsdf = " + example + "; end"
                                          : "const value = " + example + ";");
    INFO(c.text_of_errors());
    REQUIRE(c.linked);
    CHECK(c.diagnostics.all().empty());
    CHECK(!vm::verify(c.linked->program));
    if (material) continue;
    REQUIRE(c.linked->program.exports.size() == 1);
    const vm::Executable executable(c.linked->program);
    auto in = points<float>(vm::kLaneMultiple);
    const Run r = run(c.linked->program, executable, c.linked->program.exports[0].function, in, 1);
    REQUIRE(!r.values.empty());
    for (const auto& slot : r.values) CHECK(std::isfinite(slot[0]));
  }
}

TEST_CASE("the machine reads every row's signature, and no two rows are called the same") {
  std::set<std::string> keys;
  for (const vm::Builtin& row : stdlib::builtins()) {
    CAPTURE(row.signature);
    const auto signature = vm::read_signature(row.signature);
    REQUIRE(signature);
    CHECK(keys.insert(signature->key).second);
    if (row.lobe < 0) continue;
    const materials::Formals& formals = materials::formals(static_cast<materials::Lobe>(row.lobe));
    CHECK(formals.count == static_cast<int>(signature->params.size()) + signature->materials);
  }
}

/// One scalar that moves: a component of a variable, and the variable with its derivative.
struct Source {
  std::string text;
  vm::Variable variable, tangent;
  int component;
};

std::vector<Source> moving_scalars() {
  std::vector<Source> all;
  for (const vm::VariableInfo& v : vm::kVariables) {
    if (v.visibility == vm::Visibility::Hidden) continue;
    for (const vm::VariableInfo& along : vm::kVariables)
      if (!v.along_tangent.empty() && along.name == v.along_tangent)
        for (int c = 0; c < v.components(); ++c)
          all.push_back({fmt::format("${}[{}]", v.name, c), v.variable, along.variable, c});
  }
  return all;
}

struct Formal {
  enum class Form { Real, RealArray, Integer, Complex } form = Form::Real;
  int scalars = 1;  ///< that move
};

/// What a row of numbers takes, and how its parts are written: `{}`, `{}[0]`, `re({})`.
struct NumberRow {
  std::vector<Formal> formals;
  std::vector<std::string> parts;
};

/// Nothing if the row gives no reals.
std::optional<NumberRow> number_row(const vm::Builtin& row) {
  using Form = Formal::Form;
  lang::Diagnostics diagnostics;
  const lang::Graph g =
      lang::parse_signature(lang::make_source("row", std::string(row.signature)), diagnostics);
  auto one = [&](lang::TypeHandle h) -> std::optional<Formal> {
    const lang::TypeExpr& t = g[h];
    if (t.form == lang::TypeExpr::Form::Array && t.dims.size() == 1 &&
        g[t.element].basic == lang::BasicType::Real)
      return Formal{Form::RealArray, static_cast<int>(t.dims[0].value)};
    if (t.form != lang::TypeExpr::Form::Basic) return std::nullopt;
    if (t.basic == lang::BasicType::Real) return Formal{Form::Real, 1};
    if (t.basic == lang::BasicType::Integer) return Formal{Form::Integer, 0};
    if (t.basic == lang::BasicType::Complex) return Formal{Form::Complex, 2};
    return std::nullopt;
  };
  const lang::Function& f = g.functions[0];
  const auto result = one(f.result);
  if (!result || result->form == Form::Integer) return std::nullopt;
  NumberRow all;
  if (result->form == Form::Real) all.parts = {"{}"};
  if (result->form == Form::Complex) all.parts = {"re({})", "im({})"};
  if (result->form == Form::RealArray)
    for (int k = 0; k < result->scalars; ++k) all.parts.push_back(fmt::format("{{}}[{}]", k));
  for (const lang::Formal& formal : f.formals) {
    const auto k = one(formal.type);
    if (!k) return std::nullopt;
    all.formals.push_back(*k);
  }
  return all;
}

/// A call of `name` whose arguments are scalars that move, which it lists in `used`.
std::string call_of(std::string_view name, const std::vector<Formal>& formals,
                    std::vector<Source>& used) {
  const std::vector<Source> sources = moving_scalars();
  // Orders of derivatives of noise: where there are several, high ones are sums of large numbers
  // that cancel, of which differences find only the rounding.
  const auto integers = std::count_if(formals.begin(), formals.end(), [](const Formal& f) {
    return f.form == Formal::Form::Integer;
  });
  std::string call = std::string(name) + "(";
  for (std::size_t k = 0; k < formals.size(); ++k) {
    std::string parts;
    for (int c = 0; c < formals[k].scalars; ++c) {
      used.push_back(sources.at(used.size()));
      parts += (c ? ", " : "") + used.back().text;
    }
    const std::string integer =
        integers > 2 ? fmt::format("integer({} + $time)", 1 + k % 2) : "integer(1 + 3 * $time)";
    const std::string argument = formals[k].form == Formal::Form::Integer ? integer
                                 : formals[k].form == Formal::Form::Complex
                                     ? "complex(" + parts + ")"
                                 : formals[k].form == Formal::Form::RealArray ? "[" + parts + "]"
                                                                              : parts;
    call += (k ? ", " : "") + argument;
  }
  return call + ")";
}

/// The value of an entry's real at `lane`.
double value_of(const vm::Program& p, const vm::ValueSource& s, const Run& r, std::size_t lane,
                const vm::Entry& entry) {
  if (s.constant) return p.constants[s.index].f64;
  std::size_t slot = 0;
  const auto& types = p.functions[*entry.function].results;
  for (std::uint32_t k = 0; k < s.index; ++k)
    slot += static_cast<std::size_t>(vm::block_count(types[k]));
  return r.values[slot][lane];
}

/// What is compared, and how it came out.
struct Tally {
  int compared = 0, wrong = 0;
  std::string first;
};

/// Rules of a row, one partial derivative at a time, at random points. A point counts where the
/// central differences of two steps agree, so that jumps, kinks and poles are left out; their
/// error is about h^2 f''' / 6 + 2^-53 |f| / h, and h = 2^-14 of the argument's size makes both
/// small against 1e-5 of the function's size.
Tally check_height(const std::string& height_text, const std::vector<Source>& used, bool optics,
                   const std::string& functions = "", int rounds = 6) {
  constexpr int kLanes = 64;
  constexpr double kTolerance = 1e-5;
  const std::vector<Source> sources = moving_scalars();
  const Compiled c = compile(functions + "surface s\n height = " + height_text + ";\nend\n");
  INFO(c.text_of_errors());
  REQUIRE(c.linked);
  const vm::Program& p = c.linked->program;
  const vm::Descriptor& d = p.descriptors.at(0);
  const vm::Executable executable(p);
  Tally tally;
  std::mt19937 random(5);
  // Wavelengths are metres: rows of optics want arguments of that size first.
  for (int round = 0; round < rounds; ++round) {
    const double scale[] = {1, 0.3, 3, 1, 8, 0.9}, shift[] = {0, 0.5, 0, 2, 0, 0};
    for (std::size_t k = 0; k < used.size(); ++k) {
      auto in = points<double>(kLanes, static_cast<std::uint32_t>(random()));
      std::uniform_real_distribution<double> unit(-1.0, 1.0);
      for (std::size_t m = 0; m < used.size(); ++m)
        for (int i = 0; i < kLanes; ++i) {
          double x = scale[round] * unit(random) + shift[round];
          if (optics && m == 0) x = 400e-9 + 150e-9 * (1 + unit(random));
          if (optics && m == 1 && used.size() == 2) x = 3000 + 2000 * unit(random);
          in.lanes(used[m].variable, used[m].component)[i] = x;
        }
      for (int i = 0; i < kLanes; ++i) in.lanes(vm::Variable::Time)[i] = unit(random);
      for (const Source& s : sources)
        for (int i = 0; i < kLanes; ++i) in.lanes(s.tangent, s.component)[i] = 0;
      for (int i = 0; i < kLanes; ++i) in.lanes(used[k].tangent, used[k].component)[i] = 1;
      auto height = [&](double step, int lane_sign) {
        auto moved = in;
        for (int i = 0; i < kLanes; ++i) {
          const double x = in.lanes(used[k].variable, used[k].component)[i];
          const double h = step * std::max(std::fabs(x), optics ? 1e-9 : 0.25);
          moved.lanes(used[k].variable, used[k].component)[i] = x + lane_sign * h;
        }
        if (!d.displace.function) {
          Run constant;
          return constant;
        }
        return run(p, executable, *d.displace.function, moved, kLanes);
      };
      Run exact;
      if (d.shade.function) exact = run(p, executable, *d.shade.function, in, kLanes);
      const double step = 1.0 / (1 << 14);
      const Run here = height(0, 0), up = height(step, 1), down = height(step, -1),
                up2 = height(step / 2, 1), down2 = height(step / 2, -1);
      for (int i = 0; i < kLanes; ++i) {
        const std::size_t lane = static_cast<std::size_t>(i);
        auto at = [&](const Run& r) { return value_of(p, d.displace.height, r, lane, d.displace); };
        const double x = in.lanes(used[k].variable, used[k].component)[i];
        const double size = std::max(std::fabs(x), optics ? 1e-9 : 0.25), h = step * size;
        const double coarse = (at(up) - at(down)) / (2 * h), fine = (at(up2) - at(down2)) / h;
        const double found = value_of(p, d.shade.gradient[0], exact, lane, d.shade);
        // In the units of the function: what the derivative makes of a step of the argument's size.
        // Below 1e-6 of what is left of sums of order 1000, rounding is all there is; of
        // derivatives of noise nothing may be left but that, 2^-53 * 1000 / h, which is 1e-8.
        const bool sums = height_text.find("_derivative(") != height_text.npos;
        const double least = optics ? 1e-30 : sums ? 1e-3 : 1e-6;
        const double unit_of = std::fabs(at(here)) + std::fabs(fine) * size + least;
        if (!std::isfinite(coarse) || !std::isfinite(fine)) continue;
        if (std::fabs(coarse - fine) * size > 0.5 * kTolerance * unit_of) continue;
        ++tally.compared;
        if (std::fabs(found - fine) * size <= kTolerance * unit_of) continue;
        if (tally.wrong++ == 0)
          tally.first = fmt::format("{}: partial {} at {} is {}, differences give {}", height_text,
                                    k, x, found, fine);
      }
    }
  }
  return tally;
}

/// Every part of a row's result.
Tally check_rules(const vm::Builtin& row, const NumberRow& numbers) {
  const std::string name(row.signature.substr(0, row.signature.find('(')));
  std::vector<Source> used;
  const std::string call = call_of(name.substr(name.rfind(' ') + 1), numbers.formals, used);
  const bool optics = row.signature.find("wavelength") != row.signature.npos;
  Tally all;
  // Of rows that search hundreds of cells a few parts, once.
  const bool slow = row.cost > 3000;
  for (std::size_t k = 0; k < numbers.parts.size(); k += slow ? 5 : 1) {
    const Tally t = check_height(fmt::format(fmt::runtime(numbers.parts[k]), call), used, optics,
                                 "", slow ? 1 : 6);
    all.compared += t.compared;
    if (all.wrong == 0) all.first = t.first;
    all.wrong += t.wrong;
  }
  return all;
}

TEST_CASE("every row that gives reals has a derivative rule, which agrees with differences") {
  int rows = 0;
  for (const vm::Builtin& row : stdlib::builtins()) {
    if (row.lobe >= 0) continue;
    CAPTURE(row.signature);
    const auto numbers = number_row(row);
    CHECK(numbers.has_value() == !row.derivative.empty());
    if (!numbers) continue;
    ++rows;
    const Tally t = check_rules(row, *numbers);
    INFO(t.first);
    CHECK(t.wrong == 0);
    // White noise has no derivative anywhere: its rule 0 is a convention.
    if (row.signature.find(" hash(") == row.signature.npos) CHECK(t.compared >= 100);
  }
  CHECK(rows > 90);
}

/// Opcodes of reals as the language writes them; their counterparts over spectra share the code.
const std::map<std::string_view, std::string> kOperators = {
    {"AddR", "a + b"}, {"SubR", "a - b"}, {"MulR", "a * b"},    {"DivR", "a / b"},
    {"ModR", "a % b"}, {"NegR", "-a"},    {"FmaR", "a * b + c"}};

TEST_CASE("every opcode that gives reals states its derivative") {
  for (const vm::OpInfo& op : vm::kOps) {
    CAPTURE(op.name);
    const bool real = op.pushes.find_first_of("rs") != op.pushes.npos;
    if (real) CHECK(!op.derivative.empty());
    if (op.pushes == "i" || op.pushes == "l") CHECK(op.derivative.empty());
    const auto found = kOperators.find(op.name);
    const bool arithmetic = real && op.pops.find_first_not_of('r') == op.pops.npos &&
                            op.pops.size() <= 3 && op.pushes == "r";
    CHECK((found != kOperators.end()) == arithmetic);
  }
}

TEST_CASE("derivatives of opcodes, and what their table states, agree with differences") {
  const std::vector<Formal> formals(3);
  for (const auto& [name, expression] : kOperators) {
    CAPTURE(name);
    std::vector<Source> used;
    const std::string call = call_of("f", formals, used);
    const Tally t = check_height(call, used, false, "real f(real a, b, c) = " + expression + ";\n");
    INFO(t.first);
    CHECK(t.wrong == 0);
    CHECK(t.compared >= 100);
    std::string_view rest = std::find_if(std::begin(vm::kOps), std::end(vm::kOps), [&](auto& op) {
                              return op.name == name;
                            })->derivative;
    // The table's own text against the gradient of the expression, bit for bit up to rounding.
    for (int k = 0; !rest.empty(); ++k) {
      const std::string_view rule = rest.substr(0, rest.find(';'));
      rest = rest.size() == rule.size() ? "" : rest.substr(rule.size() + 1);
      const Compiled c = compile(
          fmt::format("real f(real a, b, c) = {};\nreal g(real a, b, c) = {};\n"
                      "surface s height = f($position[0], $position[1], $position[2]); end\n"
                      "const real stated = g($position[0], $position[1], $position[2]);\n",
                      expression, rule));
      INFO(c.text_of_errors());
      REQUIRE(c.linked);
      const vm::Program& p = c.linked->program;
      const vm::Executable executable(p);
      auto in = points<double>(64);
      for (int i = 0; i < 64; ++i)
        for (int axis = 0; axis < 3; ++axis)
          in.lanes(vm::Variable::Tangent, axis)[i] = axis == k ? 1 : 0;
      const vm::Descriptor& d = p.descriptors.at(0);
      const Run stated = run(p, executable, p.exports.at(0).function, in, 64);
      Run gradient;
      if (d.shade.function) gradient = run(p, executable, *d.shade.function, in, 64);
      for (std::size_t i = 1; i < 64; ++i) {
        const double g = value_of(p, d.shade.gradient[0], gradient, i, d.shade);
        CHECK(stated.values[0][i] == doctest::Approx(g).epsilon(1e-14));
      }
    }
  }
}

}  // namespace
}  // namespace mms::golden
