// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The oracle: one lane, the stack machine as opcodes.def describes it, written as plainly as it
/// can be. Arithmetic goes through wider types and the standard library, not through our kernels.
/// The machine is a template over the domain that its values are of: `Plain<float>` and
/// `Plain<double>` here; tests/property/bounded.h has numbers with bounds of their error.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "vm/limits.h"
#include "vm/program.h"

namespace mms::vm::test {

#if __LDBL_MANT_DIG__ >= 106
using Quad = long double;
#else
__extension__ using Quad = __float128;
#endif

/// A type wide enough that rounding an exact sum, product or quotient through it to T is the same
/// as rounding once: at least 2 p + 2 bits (Figueroa 1995).
template <class T>
struct Wider;
template <>
struct Wider<float> {
  using type = long double;
};
template <>
struct Wider<double> {
  using type = Quad;
};

template <class T>
struct Cell {
  std::array<T, kWavelengths> r{};  ///< a real is element 0
  std::int32_t i = 0;
};

template <class T>
T arithmetic(Op op, T a, T b, T c) {
  using W = typename Wider<T>::type;
  switch (op) {
    case Op::AddR:
    case Op::AddS:
      return T(W(a) + W(b));
    case Op::SubR:
    case Op::SubS:
      return T(W(a) - W(b));
    case Op::MulR:
    case Op::MulS:
      return T(W(a) * W(b));
    case Op::DivR:
    case Op::DivS:
      return T(W(a) / W(b));
    case Op::ModR:
      return std::fma(-b, std::floor(T(W(a) / W(b))), a);
    case Op::NegR:
    case Op::NegS:
      return std::copysign(a, std::signbit(a) ? T(1) : T(-1));
    case Op::FmaR:
    case Op::FmaS:
      return std::fma(a, b, c);
    default:
      throw std::logic_error("no oracle for this instruction");
  }
}

inline std::int32_t wrap(std::int64_t x) { return std::int32_t(std::uint32_t(std::uint64_t(x))); }

inline std::int32_t floored_mod(std::int64_t a, std::int64_t b) {
  if (b == 0) return 0;
  const std::int64_t r = a % b;
  return std::int32_t(r != 0 && (r < 0) != (b < 0) ? r + b : r);
}

template <class T>
std::int32_t truncated(T x) {
  if (std::isnan(x)) return 0;
  const long double t = std::trunc(static_cast<long double>(x));
  if (t >= 2147483647.0L) return std::numeric_limits<std::int32_t>::max();
  if (t <= -2147483648.0L) return std::numeric_limits<std::int32_t>::min();
  return std::int32_t(t);
}

/// The result of an instruction without operand on its operands.
template <class T>
Cell<T> apply(Op op, const Cell<T>& a, const Cell<T>& b, const Cell<T>& c) {
  Cell<T> d;
  const std::int64_t i = a.i, j = b.i;
  const T x = a.r[0], y = b.r[0];
  switch (op) {
    case Op::Splat:
      d.r.fill(x);
      break;
    case Op::AddI:
      d.i = wrap(i + j);
      break;
    case Op::SubI:
      d.i = wrap(i - j);
      break;
    case Op::MulI:
      d.i = wrap(i * j);
      break;
    case Op::ModI:
      d.i = floored_mod(i, j);
      break;
    case Op::NegI:
      d.i = wrap(-i);
      break;
    case Op::RealOfInt:
      d.r[0] = T(static_cast<long double>(i));
      break;
    case Op::IntOfReal:
      d.i = truncated(x);
      break;
    case Op::LtR:
      d.i = std::isless(x, y);
      break;
    case Op::LeR:
      d.i = std::islessequal(x, y);
      break;
    case Op::EqR:
      d.i = !std::isunordered(x, y) && !std::islessgreater(x, y);
      break;
    case Op::NeR:
      d.i = std::isunordered(x, y) || std::islessgreater(x, y);
      break;
    case Op::LtI:
      d.i = i - j < 0;
      break;
    case Op::LeI:
      d.i = i - j <= 0;
      break;
    case Op::EqI:
      d.i = i - j == 0;
      break;
    case Op::NeI:
      d.i = i - j != 0;
      break;
    case Op::And:
      d.i = i == 1 && j == 1;
      break;
    case Op::Or:
      d.i = i == 1 || j == 1;
      break;
    case Op::Not:
      d.i = i == 0;
      break;
    case Op::SelectR:
    case Op::SelectI:
    case Op::SelectL:
    case Op::SelectS:
      d = a.i ? b : c;
      break;
    default:
      for (int k = 0; k < kWavelengths; ++k) d.r[k] = arithmetic(op, a.r[k], b.r[k], c.r[k]);
  }
  return d;
}

/// Numbers as either machine has them.
template <class T>
struct Plain {
  using Cell = test::Cell<T>;

  static Cell constant(const Constant& c) {
    Cell cell;
    cell.r[0] = sizeof(T) == 4 ? T(c.f32) : T(c.f64);
    cell.i = c.integer;
    return cell;
  }

  static bool truth(const Cell& c) { return c.i; }

  static Cell apply(Op op, const Cell& a, const Cell& b, const Cell& c) {
    return test::apply(op, a, b, c);
  }

  /// All arguments are real.
  static std::vector<Cell> builtin(const Builtin& row, const std::vector<SlotType>&,
                                   const std::vector<SlotType>& types,
                                   const std::vector<Cell>& args) {
    alignas(64) T in[8][kLaneMultiple], out[8][kLaneMultiple];
    const void* ins[8];
    void* outs[8];
    for (int j = 0; j < 8; ++j) ins[j] = in[j], outs[j] = out[j];
    for (std::size_t j = 0; j < args.size(); ++j) std::fill_n(in[j], kLaneMultiple, args[j].r[0]);
    (sizeof(T) == 4 ? row.f32 : row.f64)(ins, outs, kLaneMultiple);
    std::vector<Cell> results(types.size());
    for (std::size_t j = 0; j < types.size(); ++j) {
      if (types[j] == SlotType::Real)
        results[j].r[0] = out[j][0];
      else
        std::memcpy(&results[j].i, out[j], sizeof(std::int32_t));
    }
    return results;
  }
};

/// Runs one lane of a verified program. A domain is like Plain: its `Cell` has the members of
/// test::Cell.
template <class Domain>
class Machine {
 public:
  using Cell = typename Domain::Cell;
  using Values = std::vector<Cell>;
  struct GivenUp {
    bool depth;
    SourceLine line;
  };

  /// `inputs`: a cell for each machine input.
  Machine(const Program& program, Values inputs) : p_(program), inputs_(std::move(inputs)) {
    const std::size_t n = p_.functions.size();
    reaches_.assign(n, std::vector<bool>(n));
    for (std::size_t f = 0; f < n; ++f) mark(f, f);
  }

  /// Throws GivenUp where the machine gives the lane up, and what the domain throws.
  Values run(std::uint32_t function) {
    spent_ = 0;
    return run(function, {}, 0);
  }

 private:
  void mark(std::size_t from, std::size_t at) {
    for (const Instruction& i : p_.functions[at].code)
      if (i.op == Op::Call && !reaches_[from][i.a]) {
        reaches_[from][i.a] = true;
        mark(from, i.a);
      }
  }

  void spend(SourceLine line) {
    if (++spent_ > limits::kBackEdges) throw GivenUp{false, line};
  }

  static Values pop(Values& stack, std::size_t n) {
    Values top(stack.end() - std::ptrdiff_t(n), stack.end());
    stack.erase(stack.end() - std::ptrdiff_t(n), stack.end());
    return top;
  }

  /// From an If or Else to behind the Else or End of the same nesting.
  static std::size_t skip(const Function& f, std::size_t pc) {
    for (int depth = 0;;) {
      const Op op = f.code[++pc].op;
      if (depth == 0 && (op == Op::Else || op == Op::End)) return pc + 1;
      depth += (op == Op::If) - (op == Op::End);
    }
  }

  Values builtin(std::uint32_t k, const Values& args) {
    return Domain::builtin(*p_.builtins[k], p_.builtin_params[k], p_.builtin_results[k], args);
  }

  Values run(std::uint32_t function, Values locals, int depth);

  const Program& p_;
  Values inputs_;
  std::vector<std::vector<bool>> reaches_;
  int spent_ = 0;
};

template <class T>
using Reference = Machine<Plain<T>>;

template <class Domain>
typename Machine<Domain>::Values Machine<Domain>::run(std::uint32_t function, Values locals,
                                                      int depth) {
  const Function& f = p_.functions[function];
  Values stack;
  locals.resize(f.locals.size());
  for (std::size_t pc = 0;;) {
    const Instruction i = f.code[pc];
    switch (i.op) {
      case Op::PushConst:
        stack.push_back(Domain::constant(p_.constants[i.a]));
        break;
      case Op::PushInput:
        stack.push_back(inputs_[i.a]);
        break;
      case Op::LoadLocal:
        stack.push_back(locals[i.a]);
        break;
      case Op::StoreLocal:
        locals[i.a] = pop(stack, 1)[0];
        break;
      case Op::If:
        if (!Domain::truth(pop(stack, 1)[0])) {
          pc = skip(f, pc);
          continue;
        }
        break;
      case Op::Else:
        pc = skip(f, pc);
        continue;
      case Op::End:
        break;
      case Op::Call: {
        Values args = pop(stack, p_.functions[i.a].params.size());
        if (reaches_[i.a][i.a]) spend(f.lines[pc]);
        if (depth >= limits::kCallDepth) throw GivenUp{true, f.lines[pc]};
        const Values results = run(i.a, std::move(args), depth + 1);
        stack.insert(stack.end(), results.begin(), results.end());
        break;
      }
      case Op::CallBuiltin: {
        const Values results = builtin(i.a, pop(stack, p_.builtin_params[i.a].size()));
        stack.insert(stack.end(), results.begin(), results.end());
        break;
      }
      case Op::Component: {
        Cell value;
        value.r[0] = pop(stack, 1)[0].r[i.a];
        stack.push_back(value);
        break;
      }
      case Op::Pack: {
        const Values in = pop(stack, kWavelengths);
        Cell spectrum;
        for (int k = 0; k < kWavelengths; ++k) spectrum.r[k] = in[std::size_t(k)].r[0];
        stack.push_back(spectrum);
        break;
      }
      case Op::CallSpectral: {
        const Values args = pop(stack, p_.builtin_params[i.a].size());
        Cell result;
        for (int k = 0; k < kWavelengths; ++k) {
          Values at(args.size());
          for (std::size_t j = 0; j < args.size(); ++j)
            at[j].r[0] = args[j].r[i.b >> j & 1 ? k : 0];
          result.r[k] = builtin(i.a, at)[0].r[0];
        }
        stack.push_back(result);
        break;
      }
      case Op::TailCall:
        locals = pop(stack, f.params.size());
        locals.resize(f.locals.size());
        spend(f.lines[pc]);
        pc = 0;
        continue;
      case Op::Return:
        return pop(stack, f.results.size());
      default: {
        Values in = pop(stack, info(i.op).pops.size());
        in.resize(3);
        stack.push_back(Domain::apply(i.op, in[0], in[1], in[2]));
      }
    }
    ++pc;
  }
}

}  // namespace mms::vm::test
