// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Programs written by hand in the tests.

#include <cmath>
#include <cstring>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "vm/interpreter.h"
#include "vm/program.h"
#include "vm/verify.h"

namespace mms::vm::test {

inline constexpr SlotType R = SlotType::Real, I = SlotType::Integer, L = SlotType::Logic,
                          S = SlotType::Spectrum;

// Toy builtins. Machine inputs are real, so integers and logics come in through the first two.

/// The integer whose bits a float has, or that a double is equal to.
template <class T>
struct Bits {
  static std::int32_t eval(T x) {
    if constexpr (sizeof(T) == 4) {
      std::int32_t i;
      std::memcpy(&i, &x, sizeof i);
      return i;
    } else {
      return std::int32_t(x);
    }
  }
};
template <class T>
struct IsNonzero {
  static std::int32_t eval(T x) { return x != 0; }
};
template <class T>
struct SumAndDifference {
  static std::array<T, 2> eval(T a, T b) { return {a + b, a - b}; }
};
template <class T>
struct ScaleAndShift {
  static T eval(T a, T b, T c) { return a * b - c; }
};
template <class T>
struct Floor {
  static T eval(T x) { return std::floor(x); }
};
template <class T>
struct Abs {
  static T eval(T x) { return std::fabs(x); }
};
template <class T>
struct Sqrt {
  static T eval(T x) { return std::sqrt(x); }
};

inline constexpr Builtin kToys[] = {
    builtin<Bits>({.signature = "integer bits(real x)"}),
    builtin<IsNonzero>({.signature = "logic is_nonzero(real x)"}),
    builtin<SumAndDifference>({.signature = "real[2] sum_and_difference(real a, b)"}),
    builtin<ScaleAndShift>({.signature = "real scale_and_shift(real a, b, c)"}),
    builtin<Floor>({.signature = "real floor(real x)", .instruction = LoweredOp::FloorR}),
    builtin<Abs>({.signature = "real abs(real x)", .instruction = LoweredOp::AbsR}),
    builtin<Sqrt>({.signature = "real sqrt(real x)", .instruction = LoweredOp::SqrtR}),
};
enum Toy : std::uint32_t {
  kBits,
  kIsNonzero,
  kSumAndDifference,
  kScaleAndShift,
  kFloor,
  kAbs,
  kSqrt
};

/// Builds a program. Source lines count instructions from 1 in each function, in source 0.
class Assembler {
 public:
  Assembler() {
    program.sources = {"test"};
    for (const Builtin& b : kToys) program.builtins.push_back(&b);
    program.builtin_params = {{R}, {R}, {R, R}, {R, R, R}, {R}, {R}, {R}};
    program.builtin_results = {{I}, {L}, {R, R}, {R}, {R}, {R}, {R}};
  }

  /// Starts a function; `locals` are those that are no parameters.
  Assembler& function(std::string name, std::vector<SlotType> params, std::vector<SlotType> results,
                      std::vector<SlotType> locals = {}) {
    Function f;
    f.name = std::move(name);
    f.params = f.locals = std::move(params);
    f.locals.insert(f.locals.end(), locals.begin(), locals.end());
    f.results = std::move(results);
    program.functions.push_back(std::move(f));
    return *this;
  }

  Assembler& op(Op o, std::uint32_t a = 0, std::uint32_t b = 0) {
    Function& f = program.functions.back();
    f.code.push_back({o, a, b});
    f.lines.push_back({0, std::uint32_t(f.code.size())});
    return *this;
  }
  Assembler& ops(std::initializer_list<Op> list) {
    for (const Op o : list) op(o);
    return *this;
  }
  Assembler& real(double x) { return constant({R, float(x), x, 0}); }
  Assembler& integer(std::int32_t x) { return constant({I, 0, 0, x}); }
  Assembler& logic(bool x) { return constant({L, 0, 0, x}); }
  Assembler& input(Variable v, int c = 0) {
    return op(Op::PushInput, std::uint32_t(input_index(v, c)));
  }
  Assembler& load(std::uint32_t local) { return op(Op::LoadLocal, local); }
  Assembler& store(std::uint32_t local) { return op(Op::StoreLocal, local); }
  Assembler& call(std::uint32_t function) { return op(Op::Call, function); }
  Assembler& begin(std::vector<SlotType> results = {}) {
    program.block_types.push_back(std::move(results));
    return op(Op::If, std::uint32_t(program.block_types.size() - 1));
  }
  Assembler& other() { return op(Op::Else); }
  Assembler& end() { return op(Op::End); }
  Assembler& ret() { return op(Op::Return); }
  Assembler& again() { return op(Op::TailCall); }

  Program program;

 private:
  Assembler& constant(Constant c) {
    program.constants.push_back(c);
    return op(Op::PushConst, std::uint32_t(program.constants.size() - 1));
  }
};

/// What is wrong with the program, with its place; empty if nothing is.
inline std::string fault_text(const Program& p) {
  const auto fault = verify(p);
  if (!fault) return "";
  return fault->function + ":" + std::to_string(fault->instruction) + ": " + fault->what;
}

/// Same bits, or both NaN.
template <class T>
bool same(T a, T b) {
  return (a != a && b != b) || std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace mms::vm::test
