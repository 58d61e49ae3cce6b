// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Random scripts that must link: every type of a machine slot and what is built from them (arrays
/// of one and two dimensions, structures, enumerations), calls with named and default arguments,
/// lambdas and function values, generics of types and dimensions, choices, recursion that ends (in
/// tail position or not, mutual, unrolled or not), params, every row of the library, materials.
/// What varies over a batch is read through functions v0, v1, ... and w, so that a script can also
/// be given constants.

#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/property/library_rows.h"
#include "vm/variables.h"

namespace mms::property {

/// What the functions v0, v1, ... of a script read.
struct VariableRead {
  vm::Variable variable;
  int component;
  const char* text;
};
inline constexpr VariableRead kReads[] = {
    {vm::Variable::Position, 0, "$position[0]"},
    {vm::Variable::Position, 1, "$position.y"},
    {vm::Variable::Position, 2, "$position[2]"},
    {vm::Variable::ObjectPosition, 0, "$object_position[0]"},
    {vm::Variable::ObjectPosition, 1, "$object_position[1]"},
    {vm::Variable::Uv, 0, "$uv[0]"},
    {vm::Variable::Uv, 1, "$uv.y"},
    {vm::Variable::Normal, 2, "$normal.z"},
    {vm::Variable::Distance, 0, "$distance"},
    {vm::Variable::Footprint, 0, "$footprint[0, 0]"},
    {vm::Variable::Time, 0, "$time"},
};
inline constexpr int kVariables = static_cast<int>(std::size(kReads));

/// The definitions of v0, v1, ...: components of variables, or numbers.
inline std::string variables(const std::vector<float>& numbers) {
  std::string text;
  for (std::size_t k = 0; k < std::size(kReads); ++k)
    text += numbers.empty() ? fmt::format("real v{}() = {};\n", k, kReads[k].text)
                            : fmt::format("real v{}() = {:.9f};\n", k, numbers[k]);
  return text;
}

/// What every script begins with: definitions that the random ones use.
inline constexpr const char* kPrelude =
    "pair typeid struct real a; integer b; end;\n"
    "finish typeid enum raw, oiled, waxed;\n"
    "param real p0 = 1.5 in [0, 2], label = \"P\";\n"
    "param integer p1 = 3;\n"
    "generic T pick(logic c, generic T p, T q) = select p, if c; q otherwise end;\n"
    "generic T twice(function(generic T) -> generic T f, generic T x) = f(f(x));\n"
    "real apply(function(real) -> real f, real x) = f(x) + f(2 * x);\n"
    "real combine(function(real, real) -> real f, real x, y = 0.5) = f(x, y);\n"
    "real named(real x, y = 2 * 0.25, integer n = 3) = x - y * n;\n"
    "real total(real[n] xs)\n"
    "    real sum(integer k, real s) = select s, if k >= n; sum(k + 1, s + xs[k]) otherwise end;\n"
    "    return sum(0, 0.0);\n"
    "real trace(real[n, n] xs)\n"
    "    real sum(integer k, real s) = select s, if k >= n; sum(k + 1, s + xs[k, k]) otherwise "
    "end;\n"
    "    return sum(0, 0.0);\n"
    "finish choose(real x) = select finish::raw, if x < 0; finish::oiled, if x < 1; finish::waxed "
    "otherwise end;\n"
    "real parity(integer n, real x)\n"
    "    real even(integer k, real t) = select t, if k <= 0; odd(k - 1, t * 0.5) otherwise end;\n"
    "    real odd(integer k, real t) = select -t, if k <= 0; even(k - 1, t + 1) otherwise end;\n"
    "    return even(n, x);\n"
    "material coat(material under, real gloss = 40) = fresnel_mix(under, glossy(1, gloss), 1.5);\n";

class Generator {
 public:
  explicit Generator(std::uint32_t seed) : random_(seed) {}

  /// Everything but the definitions of v0, v1, ..., which are functions `real v0() = ...;`.
  std::string script() {
    text_ = kPrelude;
    const int functions = 2 + below(4);
    for (int k = 0; k < functions; ++k) function(k);
    for (char type : kTypes) {
      locals_.clear();
      text_ += fmt::format("{} out_{}() = {};\n", spelled(type), type, expr(type, 4));
    }
    locals_.clear();
    text_ += fmt::format(
        "surface s\n  bsdf = {};\n  scattering = {};\n  height = {};\n  gradient = [{}, {}];\n"
        "  emission = {};\nend\n",
        material(3), expr('S', 3), expr('R', 3), expr('R', 2), expr('R', 2), expr('S', 2));
    text_ += fmt::format(
        "volume v\n  phase = mix(isotropic(), henyey_greenstein({}), {});\n  scattering = {};\n"
        "  absorption = {};\n  emission = {};\n  bound = {};\nend\n",
        expr('R', 2), expr('S', 2), expr('S', 2), expr('S', 2), expr('S', 2), expr('R', 2));
    return text_;
  }

 private:
  /// Logic, Integer, Real, Complex, Spectrum, Vector of three reals, Pair, Matrix of 2 by 2 reals,
  /// Enumeration.
  static constexpr std::string_view kTypes = "LIRCSVPME";
  struct Named {
    std::string name;
    char type;
  };
  struct Signature {
    std::string name, formals;
    char result;
    bool counts;  ///< the first argument says how often it calls itself
  };

  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  bool chance(int percent) { return below(100) < percent; }
  char any_type() {
    return kTypes[static_cast<std::size_t>(below(static_cast<int>(kTypes.size())))];
  }
  std::string fresh() { return fmt::format("n{}", names_++); }

  static std::string spelled(char type) {
    switch (type) {
      case 'L':
        return "logic";
      case 'I':
        return "integer";
      case 'R':
        return "real";
      case 'C':
        return "complex";
      case 'S':
        return "spectrum";
      case 'V':
        return "real[3]";
      case 'M':
        return "real[2, 2]";
      case 'E':
        return "finish";
      default:
        return "pair";
    }
  }

  /// A function with two or three arguments and a few definitions; it may call earlier ones.
  void function(int k) {
    Signature f{fmt::format("f{}", k), {}, any_type(), chance(60)};
    locals_.clear();
    std::string head = spelled(f.result) + " " + f.name + "(";
    if (f.counts) head += "integer left, ";
    // What a recursion hands on and gives has one type.
    f.formals = f.counts ? std::string(1, f.result) : std::string(1, any_type());
    f.formals += any_type();
    for (std::size_t i = 0; i < f.formals.size(); ++i) {
      locals_.push_back({fresh(), f.formals[i]});
      head += fmt::format("{}{} {}", i ? ", " : "", spelled(f.formals[i]), locals_.back().name);
    }
    text_ += head + ")\n";
    const std::string first = locals_[0].name;
    for (int n = below(3); n > 0; --n) {
      const char type = any_type();
      const std::string value = expr(type, 3), name = fresh();
      text_ += fmt::format("    {}{} = {};\n", chance(50) ? spelled(type) + " " : "", name, value);
      locals_.push_back({name, type});
    }
    if (f.counts) {
      std::string again =
          fmt::format("{}(left - 1, {}, {})", f.name, expr(f.result, 2), expr(f.formals[1], 2));
      if (chance(40)) {  // not in tail position
        const std::string hidden = fresh();
        text_ += fmt::format("    {} last({} {}) = {};\n", spelled(f.result), spelled(f.result),
                             hidden, with(hidden, f.result, 2));
        again = "last(" + again + ")";
      }
      text_ += fmt::format("    return select {}, if left <= 0; {} otherwise end;\n", first, again);
    } else {
      text_ += fmt::format("    return {};\n", expr(f.result, 4));
    }
    functions_.push_back(f);
  }

  /// An expression of `type` that may use one more name.
  std::string with(const std::string& name, char type, int depth) {
    locals_.push_back({name, type});
    const std::string e = expr(type, depth);
    locals_.pop_back();
    return e;
  }

  std::string call(const Signature& f, int depth) {
    std::string s = f.name + "(";
    if (f.counts)
      s +=
          chance(50) ? fmt::format("{}, ", below(4)) : fmt::format("integer(3 * {}), ", variable());
    for (std::size_t i = 0; i < f.formals.size(); ++i)
      s += (i ? ", " : "") + expr(f.formals[i], depth - 1);
    return s + ")";
  }

  /// A call of a row of the library; empty where none has that result.
  std::string library_call(char result, int depth) {
    static const std::vector<LibraryRow> rows = library_rows();
    std::vector<const LibraryRow*> fit;
    for (const LibraryRow& row : rows)
      if (row.result == result) fit.push_back(&row);
    if (fit.empty()) return {};
    const LibraryRow& row = *fit[static_cast<std::size_t>(below(static_cast<int>(fit.size())))];
    std::string s = row.name + "(";
    for (std::size_t i = 0; i < row.formals.size(); ++i) {
      if (i) s += ", ";
      const char type = row.formals[i];
      if (type != '2' && type != '4') {
        s += expr(type, depth - 1);
        continue;
      }
      for (int k = 0; k < type - '0'; ++k) s += (k ? ", " : "[") + expr('R', depth - 1);
      s += "]";
    }
    return s + ")";
  }

  std::string material(int depth) {
    if (depth <= 0) switch (below(6)) {
        case 0:
          return fmt::format("matte({})", expr('S', 2));
        case 1:
          return fmt::format("glossy({}, gloss = {})", expr('S', 1), expr('R', 2));
        case 2:
          return fmt::format("dielectric({}, {})", expr('S', 1), expr('R', 1));
        case 3:
          return fmt::format("microfacet({}, {}, {})", expr('S', 1), expr('R', 1), expr('R', 1));
        case 4:
          return fmt::format("mirror({})", expr('S', 1));
        default:
          return fmt::format("gold({})", expr('R', 1));
      }
    const int d = depth - 1;
    switch (below(6)) {
      case 0:
        return fmt::format("mix({}, {}, {})", material(d), material(d), expr('S', 1));
      case 1:
        return fmt::format("select {}, if {}; {} otherwise end", material(d), expr('L', 2),
                           material(d));
      case 2:
        return fmt::format("pick({}, {}, {})", expr('L', 1), material(d), material(d));
      case 3:
        return fmt::format("coat({})", material(d));
      case 4:
        return fmt::format("({} * {} + {})", expr('S', 1), material(d), material(0));
      default:
        return material(d);
    }
  }

  std::string variable() { return fmt::format("v{}", below(kVariables)); }

  std::string leaf(char type) {
    std::vector<std::string> all;
    for (const Named& n : locals_)
      if (n.type == type) all.push_back(n.name);
    if (!all.empty() && chance(60))
      return all[static_cast<std::size_t>(below(static_cast<int>(all.size())))];
    switch (type) {
      case 'L':
        return chance(50)   ? fmt::format("({} < {})", variable(), variable())
               : chance(50) ? "true"
                            : "false";
      case 'I':
        return chance(50)   ? fmt::format("{}", below(7))
               : chance(10) ? "p1"
                            : fmt::format("integer(4 * {})", variable());
      case 'R':
        return chance(40)   ? fmt::format("{}.{}", below(3), below(100))
               : chance(10) ? "p0"
                            : variable();
      case 'C':
        return chance(50) ? fmt::format("({} + {}i)", variable(), below(4))
                          : fmt::format("{}.5i", below(3));
      case 'S':
        return chance(50) ? "($wavelength * 1e6)" : fmt::format("spectrum({})", variable());
      case 'V':
        return fmt::format("[{}, {}, 0.5]", variable(), variable());
      case 'M':
        return fmt::format("[{}, 0.25; 2, {}]", variable(), variable());
      case 'E':
        return chance(50) ? "finish::oiled" : fmt::format("choose({})", variable());
      default:
        return fmt::format("pair({}, {})", variable(), below(5));
    }
  }

  std::string one_of(std::initializer_list<const char*> all) {
    return *(all.begin() + below(static_cast<int>(all.size())));
  }

  std::string expr(char type, int depth) {
    if (depth <= 0 || chance(10)) return leaf(type);
    const int d = depth - 1;
    auto e = [&](char t) { return expr(t, d); };
    // What every type has.
    switch (below(12)) {
      case 0: {
        const std::string c = e('L'), a = e(type);
        return fmt::format("(select {}, if {}; {} otherwise end)", a, c, e(type));
      }
      case 1: {
        for (const Signature& f : functions_)
          if (f.result == type && chance(60)) return call(f, std::min(d, 2));
        break;
      }
      case 2:
        return fmt::format("pick({}, {}, {})", e('L'), e(type), e(type));
      case 3: {
        const std::string x = fresh(), argument = e('R');
        locals_.push_back({x, 'R'});
        const std::string inside = e(type);
        locals_.pop_back();
        return fmt::format("(function(real {}) -> {})({})", x, inside, argument);
      }
      case 4: {
        const std::string x = fresh();
        return fmt::format("twice(function({}) -> {}, {})", x, with(x, type, std::min(d, 2)),
                           e(type));
      }
      case 5: {
        const std::string s = library_call(type, d);
        if (!s.empty()) return s;
        break;
      }
      default:
        break;
    }
    switch (type) {
      case 'L':
        return logic(d);
      case 'I':
        return integer(d);
      case 'R':
        return real(d);
      case 'C':
        return complex(d);
      case 'S':
        return spectrum(d);
      case 'V':
        return vector(d);
      case 'M':
        return matrix(d);
      case 'E':
        return fmt::format("choose({})", e('R'));
      default:
        return chance(50) ? fmt::format("pair({}, {})", e('R'), e('I'))
                          : fmt::format("pair(b = {}, a = {})", e('I'), e('R'));
    }
  }

  std::string logic(int d) {
    auto e = [&](char t) { return expr(t, d); };
    switch (below(7)) {
      case 6:
        return fmt::format("({} {} {})", e('E'), one_of({"==", "!="}), e('E'));
      case 0:
        return fmt::format("({} {} {})", e('L'), one_of({"and", "or", "==", "!="}), e('L'));
      case 1:
        return fmt::format("(not {})", e('L'));
      case 2:
        return fmt::format("({} {} {} {} {})", e('R'), one_of({"<", ">="}), e('I'),
                           one_of({"<=", ">"}), e('R'));
      case 3:
        return fmt::format("({} {} {})", e('V'), one_of({"==", "!="}), e('V'));
      case 4:
        return fmt::format("({} == {})", e('C'), e('C'));
      default:
        return fmt::format("({} {} {})", e('I'), one_of({"<", "==", "!=", ">="}), e('I'));
    }
  }

  std::string integer(int d) {
    auto e = [&](char t) { return expr(t, d); };
    switch (below(6)) {
      case 0:
        return fmt::format("(-{})", e('I'));
      case 1:
        return fmt::format("integer({})", e(chance(50) ? 'R' : 'L'));
      case 2:
        return fmt::format("{}.b", e('P'));
      case 3:
        return fmt::format("max({}, {})", e('I'), e('I'));
      default:
        return fmt::format("({} {} {})", e('I'), one_of({"+", "-", "*", "%"}), e('I'));
    }
  }

  std::string real(int d) {
    auto e = [&](char t) { return expr(t, d); };
    switch (below(23)) {
      case 16:
        return fmt::format("combine({}, {})",
                           one_of({"#+", "#*", "#/", "#-", "#%", "#atan2", "#min", "#hypot"}),
                           e('R'));
      case 17:
        return chance(50) ? fmt::format("named(y = {}, x = {})", e('R'), e('R'))
                          : fmt::format("named({}, n = {})", e('R'), e('I'));
      case 18:
        return chance(50) ? fmt::format("trace({})", e('M'))
                          : fmt::format("total([{}, {}, {}, 1])", e('R'), e('R'), e('I'));
      case 19:
        return fmt::format("parity({}, {})",
                           chance(50) ? std::to_string(below(5)) : "(" + e('I') + " % 5)", e('R'));
      case 20:
        return fmt::format("apply({}, {})", one_of({"#sin", "#abs", "#floor", "#cos", "#saturate"}),
                           e('R'));
      case 21:
        return fmt::format("{}[{}, {}]", e('M'), below(2),
                           chance(50) ? std::to_string(below(2)) : "clamp(" + e('I') + ", 0, 1)");
      case 22:
        return fmt::format("{}.a", e('P'));
      case 0:
        return fmt::format("(-{})", e('R'));
      case 1:
        return fmt::format("{}({})",
                           one_of({"sin", "floor", "abs", "sqrt", "fract", "exp", "sign"}), e('R'));
      case 2:
        return fmt::format("{}({}, {})", one_of({"min", "max", "atan2", "step", "hypot"}), e('R'),
                           e('R'));
      case 3:
        return fmt::format("clamp({}, {}, {})", e('R'), e('R'), e('R'));
      case 4:
        return fmt::format("perlin({})", e('V'));
      case 5:
        return fmt::format("dot({}, {})", e('V'), e('V'));
      case 6:
        return fmt::format("{}[{}]", e('V'),
                           chance(50) ? std::to_string(below(3)) : "clamp(" + e('I') + ", 0, 2)");
      case 7:
        return fmt::format("{}.{}", e('V'), one_of({"x", "y", "z"}));
      case 8:
        return fmt::format("{}({})", one_of({"re", "im", "abs"}), e('C'));
      case 9:
        return fmt::format("real({})", e(chance(50) ? 'I' : 'L'));
      case 10: {
        const std::string x = fresh();
        return fmt::format("apply(function({}) -> {}, {})", x, with(x, 'R', std::min(d, 2)),
                           e('R'));
      }
      case 11:
        return fmt::format("({} * {} {} {})", e('R'), e('R'), one_of({"+", "-"}), e('R'));
      case 12:
        return fmt::format("({} {} {} * {})", e('R'), one_of({"+", "-"}), e('I'), e('R'));
      case 13:  // `^` multiplies out where the exponent is known, so it would not fold to the same
                // bits
        return chance(50) ? fmt::format("({} ^ {})", e('R'), below(5))
                          : fmt::format("powi({}, {})", e('R'), e('I'));
      default:
        return fmt::format("({} {} {})", e('R'), one_of({"+", "-", "*", "/", "%"}),
                           e(chance(80) ? 'R' : 'I'));
    }
  }

  std::string complex(int d) {
    auto e = [&](char t) { return expr(t, d); };
    switch (below(5)) {
      case 0:
        return fmt::format("complex({}, {})", e('R'), e('R'));
      case 1:
        return fmt::format("{}({})", one_of({"conj", "exp", "sqrt"}), e('C'));
      case 2:
        return fmt::format("({} ^ 3)", e('C'));
      default:
        return fmt::format("({} {} {})", e('C'), one_of({"+", "-", "*", "/"}),
                           e(chance(70) ? 'C' : 'R'));
    }
  }

  std::string spectrum(int d) {
    auto e = [&](char t) { return expr(t, d); };
    switch (below(7)) {
      case 0:
        return fmt::format("rgb({}, {}, {})", e('R'), e('R'), e('R'));
      case 1:
        return fmt::format("{}({})", one_of({"sin", "abs", "exp", "fract"}), e('S'));
      case 2:
        return fmt::format("max({}, {})", e('S'), e('R'));
      case 3:
        return fmt::format("(-{})", e('S'));
      case 4:
        return fmt::format("({} * {} + {})", e('S'), e('R'), e('S'));
      default:
        return fmt::format("({} {} {})", e('S'), one_of({"+", "-", "*", "/"}),
                           e(chance(50) ? 'S' : 'R'));
    }
  }

  std::string vector(int d) {
    auto e = [&](char t) { return expr(t, d); };
    switch (below(6)) {
      case 0:
        return fmt::format("[{}, {}, {}]", e('R'), e('R'), e('I'));
      case 1:
        return fmt::format("cross({}, {})", e('V'), e('V'));
      case 2:
        return fmt::format("(-{})", e('V'));
      case 3:
        return fmt::format("({} * {} + {})", e('V'), e('R'), e('V'));
      default:
        return fmt::format("({} {} {})", e('V'), one_of({"+", "-", "*"}),
                           e(chance(60) ? 'V' : 'R'));
    }
  }

  std::string matrix(int d) {
    auto e = [&](char t) { return expr(t, d); };
    switch (below(4)) {
      case 0:
        return fmt::format("[{}, {}; {}, {}]", e('R'), e('I'), e('R'), e('R'));
      case 1:
        return fmt::format("(-{})", e('M'));
      default:
        return fmt::format("({} {} {})", e('M'), one_of({"+", "-", "*"}),
                           e(chance(60) ? 'M' : 'R'));
    }
  }

  std::mt19937 random_;
  std::string text_;
  std::vector<Named> locals_;
  std::vector<Signature> functions_;
  int names_ = 0;
};

}  // namespace mms::property
