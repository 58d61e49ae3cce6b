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
  int scalars = 1;
  bool integer = false;
};

/// The formals of a row of reals, arrays of reals and integers; nothing if it has others.
std::optional<std::vector<Formal>> real_formals(const vm::Builtin& row) {
  lang::Diagnostics diagnostics;
  const lang::Graph g =
      lang::parse_signature(lang::make_source("row", std::string(row.signature)), diagnostics);
  std::vector<Formal> all;
  auto one = [&](lang::TypeHandle h) -> std::optional<Formal> {
    const lang::TypeExpr& t = g[h];
    if (t.form == lang::TypeExpr::Form::Array && t.dims.size() == 1 &&
        g[t.element].basic == lang::BasicType::Real)
      return Formal{static_cast<int>(t.dims[0].value), false};
    if (t.form != lang::TypeExpr::Form::Basic) return std::nullopt;
    if (t.basic == lang::BasicType::Real) return Formal{1, false};
    if (t.basic == lang::BasicType::Integer) return Formal{1, true};
    return std::nullopt;
  };
  const lang::Function& f = g.functions[0];
  const lang::TypeExpr& result = g[f.result];
  if (result.form != lang::TypeExpr::Form::Basic || result.basic != lang::BasicType::Real)
    return std::nullopt;
  for (const lang::Formal& formal : f.formals) {
    const auto k = one(formal.type);
    if (!k) return std::nullopt;
    all.push_back(*k);
  }
  return all;
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
Tally check_rules(const vm::Builtin& row, const std::vector<Formal>& formals) {
  constexpr int kLanes = 64;
  constexpr double kTolerance = 1e-5;
  const std::vector<Source> sources = moving_scalars();
  const std::string name(row.signature.substr(0, row.signature.find('(')));
  std::string call = name.substr(name.rfind(' ') + 1) + "(";
  std::vector<Source> used;
  for (std::size_t k = 0; k < formals.size(); ++k) {
    if (k) call += ", ";
    if (formals[k].integer) {
      call += "integer(1 + 3 * $time)";
      continue;
    }
    if (formals[k].scalars > 1) call += "[";
    for (int c = 0; c < formals[k].scalars; ++c) {
      used.push_back(sources.at(used.size()));
      call += (c ? ", " : "") + used.back().text;
    }
    if (formals[k].scalars > 1) call += "]";
  }
  call += ")";
  const Compiled c = compile("surface s\n height = " + call + ";\nend\n");
  INFO(c.text_of_errors());
  REQUIRE(c.linked);
  const vm::Program& p = c.linked->program;
  const vm::Descriptor& d = p.descriptors.at(0);
  const vm::Executable executable(p);
  Tally tally;
  std::mt19937 random(5);
  // Wavelengths are metres: rows of optics want arguments of that size first.
  const bool optics = row.signature.find("wavelength") != row.signature.npos;
  for (int round = 0; round < 6; ++round) {
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
        const double unit_of = std::fabs(at(here)) + std::fabs(fine) * size + 1e-30;
        if (!std::isfinite(coarse) || !std::isfinite(fine)) continue;
        if (std::fabs(coarse - fine) * size > 0.5 * kTolerance * unit_of) continue;
        ++tally.compared;
        if (std::fabs(found - fine) * size <= kTolerance * unit_of) continue;
        if (tally.wrong++ == 0)
          tally.first = fmt::format("{}: partial {} at {} is {}, differences give {}", call, k, x,
                                    found, fine);
      }
    }
  }
  return tally;
}

TEST_CASE("derivative rules agree with central differences") {
  int rows = 0;
  for (const vm::Builtin& row : stdlib::builtins()) {
    if (row.derivative.empty()) continue;
    const auto formals = real_formals(row);
    if (!formals) continue;  // rules of complex rows are not used yet
    CAPTURE(row.signature);
    ++rows;
    const Tally t = check_rules(row, *formals);
    INFO(t.first);
    CHECK(t.wrong == 0);
    // White noise has no derivative anywhere: its rule 0 is a convention.
    if (row.signature.find(" hash(") == row.signature.npos) CHECK(t.compared >= 100);
  }
  CHECK(rows > 40);
}

}  // namespace
}  // namespace mms::golden
