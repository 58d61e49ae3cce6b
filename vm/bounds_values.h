// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The values of an enclosure while it is computed: what each can be, what made it, and what is
/// taken for granted of it. Internal to vm/bounds.cpp.

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "vm/interval.h"
#include "vm/polynomial.h"
#include "vm/program.h"

namespace mms::vm {

using ValueIndex = std::uint32_t;

/// A value that the program computed: single assignment, so that a value has one index for as long
/// as its function runs, and equal indices are equal values.
struct ValueNode {
  Interval value;
  Op op = Op::PushConst;  ///< what made it: an input, constant, parameter or join says PushConst
  static constexpr ValueIndex kNone = ~ValueIndex(0);
  ValueIndex a = kNone, b = kNone, c = kNone;
  ValueIndex cubic = kNone;  ///< where it is a polynomial of an earlier value
};

/// A value as a polynomial of one earlier value.
struct CubicValue {
  ValueIndex of;
  Polynomial polynomial;
};

/// The table of them. Inputs come first, then the program's constants, then what is computed.
struct ValueTable {
  using Index = ValueIndex;
  static constexpr Index kNone = ~Index(0);

  explicit ValueTable(const Program& p) : program(p) {}

  /// Forgets everything but inputs and constants.
  void start(std::span<const Interval> inputs) {
    nodes.clear();
    cubics.clear();
    undo.clear();
    for (const Interval& i : inputs) make(i);
    for (const Constant& c : program.constants) make(interval_of(c));
  }

  const Interval& value(Index n) const { return nodes[n].value; }
  Index make(const Interval& v, Op op = Op::PushConst, Index a = kNone, Index b = kNone,
             Index c = kNone) {
    nodes.push_back({v, op, a, b, c, kNone});
    return static_cast<Index>(nodes.size() - 1);
  }
  void forget(std::size_t mark) {
    while (nodes.size() > mark) {
      if (nodes.back().cubic != kNone) cubics.pop_back();
      nodes.pop_back();
    }
  }
  void narrow_to(Index n, const Interval& v) {
    if (nodes[n].value == v) return;
    undo.emplace_back(n, nodes[n].value);
    nodes[n].value = v;
  }
  void undo_to(std::size_t mark) {
    for (; undo.size() > mark; undo.pop_back()) nodes[undo.back().first].value = undo.back().second;
  }

  /// Takes for granted that a logic value is `outcome`; whether that can be.
  bool assume(Index n, bool outcome) {
    const ValueNode node = nodes[n];
    if (!(outcome ? can_be_true(node.value) : can_be_false(node.value))) return false;
    narrow_to(n, Interval::point(outcome));
    switch (node.op) {
      case Op::Not:
        return assume(node.a, !outcome);
      case Op::And:
        return !outcome || (assume(node.a, true) && assume(node.b, true));
      case Op::Or:
        return outcome || (assume(node.a, false) && assume(node.b, false));
      case Op::LtR:
      case Op::LtI:
        return assume_order(Comparison::Less, outcome, node);
      case Op::LeR:
      case Op::LeI:
        return assume_order(Comparison::LessEqual, outcome, node);
      case Op::EqR:
      case Op::EqI:
        return assume_order(Comparison::Equal, outcome, node);
      case Op::NeR:
      case Op::NeI:
        return assume_order(Comparison::NotEqual, outcome, node);
      default:
        return true;
    }
  }
  bool assume_order(Comparison c, bool outcome, const ValueNode& node) {
    if (node.a == node.b) return true;
    Interval a = value(node.a), b = value(node.b);
    const bool integers = node.op == Op::LtI || node.op == Op::LeI;
    narrow(c, outcome, integers, a, b);
    if (a.is_empty() || b.is_empty()) return false;
    narrow_to(node.a, a);
    narrow_to(node.b, b);
    return true;
  }

  // Instructions

  Interval unary(Op op, const Interval& a) const {
    switch (op) {
      case Op::NegI:
        return neg_integer(a);
      case Op::RealOfInt:
        return real_of_integer(a);
      case Op::IntOfReal:
        return integer_of_real(a);
      case Op::Not:
        return {1 - a.hi, 1 - a.lo, false};
      case Op::NegR:
      case Op::NegS:
        return neg(a);
      default:
        return Interval::whole();
    }
  }

  Interval binary(Op op, Index m, Index n) const {
    const Interval &a = value(m), &b = value(n);
    const bool same = m == n;
    switch (op) {
      case Op::AddR:
      case Op::AddS:
        return add(a, b);
      case Op::SubR:
      case Op::SubS:
        return same && a.has_number() ? Interval{0, 0, a.nan || a.contains_infinity()} : sub(a, b);
      case Op::MulR:
      case Op::MulS:
        return same ? square(a) : mul(a, b);
      case Op::DivR:
      case Op::DivS:
        return same && a.has_number()
                   ? Interval{1, 1, a.nan || a.contains(0) || a.contains_infinity()}
                   : div(a, b);
      case Op::ModR:
        return mod(a, b);
      case Op::AddI:
        return add_integers(a, b);
      case Op::SubI:
        return same ? Interval::point(0) : sub_integers(a, b);
      case Op::MulI:
        return mul_integers(a, b);
      case Op::ModI:
        return mod_integers(a, b);
      case Op::LtR:
      case Op::LtI:
        return same ? logic(true, false) : compare(Comparison::Less, a, b);
      case Op::LeR:
      case Op::LeI:
        return same ? logic(a.nan, a.has_number()) : compare(Comparison::LessEqual, a, b);
      case Op::EqR:
      case Op::EqI:
        return same ? logic(a.nan, a.has_number()) : compare(Comparison::Equal, a, b);
      case Op::NeR:
      case Op::NeI:
        return same ? logic(a.has_number(), a.nan) : compare(Comparison::NotEqual, a, b);
      case Op::And:
        return {std::min(a.lo, b.lo), std::min(a.hi, b.hi), false};
      default:  // Or
        return {std::max(a.lo, b.lo), std::max(a.hi, b.hi), false};
    }
  }

  Interval fused(Index a, Index b, Index c) const {
    if (a == b) return square_fma(value(a), value(c));
    const auto is_difference = [&](Index d) {
      return (nodes[d].op == Op::SubR || nodes[d].op == Op::SubS) && nodes[d].b == c;
    };
    if (is_difference(a)) return blend(value(c), value(nodes[a].a), value(a), value(b));
    if (is_difference(b)) return blend(value(c), value(nodes[b].a), value(b), value(a));
    const Interval plain = fma(value(a), value(b), value(c));
    const std::optional<Interval> colour = reflectance(a, b, c);
    return colour ? meet(plain, *colour) : plain;
  }

  /// The other factor where one is the input `v`.
  static Index factor_of(Variable v, Index a, Index b) {
    const auto input = static_cast<Index>(input_index(v));
    return a == input ? b : b == input ? a : kNone;
  }
  /// `base + k`, which is what `k` was made from where it is a difference from `base`.
  Interval corner(Index base, Index k) const {
    const bool difference = nodes[k].op == Op::SubR || nodes[k].op == Op::SubS;
    return difference && nodes[k].b == base ? value(nodes[k].a) : add(value(base), value(k));
  }
  /// base + p $rgb_red + q $rgb_green (`rgb`, thesis Table 6.1): at every wavelength the two curves
  /// are not negative and at most 1 together, so it stays in the hull of base, base + p, base + q.
  std::optional<Interval> reflectance(Index a, Index b, Index c) const {
    const Index q = factor_of(Variable::RgbGreen, a, b);
    const ValueNode& inner = nodes[c];
    if (q == kNone || (inner.op != Op::FmaS && inner.op != Op::FmaR)) return std::nullopt;
    const Index p = factor_of(Variable::RgbRed, inner.a, inner.b), base = inner.c;
    if (p == kNone) return std::nullopt;
    Interval hull = join(value(base), join(corner(base, p), corner(base, q)));
    if (hull.contains_infinity() || !hull.has_number()) return std::nullopt;
    // Differences, curves and sums are each rounded once.
    const double slack =
        0x1p-21 * (hull.magnitude() + value(p).magnitude() + value(q).magnitude()) + 0x1p-149;
    return reals(hull.lo - slack, hull.hi + slack, true);
  }

  /// Operations before a choice that are looked at again under its condition.
  static constexpr int kRefreshed = 32;

  /// The value of `n` computed again, as far as operators go, from what its operands now can be.
  Interval refreshed(Index n, int& budget) {
    const ValueNode node = nodes[n];
    const bool operation = node.a != kNone && node.value.has_number();
    if (!operation || --budget < 0) return node.value;
    for (const Index operand : {node.a, node.b, node.c})
      if (operand != kNone) refreshed(operand, budget);
    const Interval again = node.c != kNone   ? fused(node.a, node.b, node.c)
                           : node.b != kNone ? binary(node.op, node.a, node.b)
                                             : unary(node.op, value(node.a));
    Interval r = meet(node.value, again);
    if (r.is_empty()) r = node.value;
    narrow_to(n, r);
    return r;
  }

  Index select(Index condition, Index yes, Index no) {
    const std::size_t mark = undo.size();
    std::optional<Interval> a, b;
    int budget = kRefreshed;
    if (assume(condition, true)) a = refreshed(yes, budget);
    undo_to(mark);
    budget = kRefreshed;
    if (assume(condition, false)) b = refreshed(no, budget);
    undo_to(mark);
    if (a && b) return yes == no ? yes : make(join(*a, *b));
    return a ? yes : no;
  }

  // Polynomials

  bool is_constant(Index n) const { return n >= first_constant() && n < first_value(); }
  static Index first_constant() { return static_cast<Index>(input_count()); }
  Index first_value() const {
    return first_constant() + static_cast<Index>(program.constants.size());
  }
  /// The value that `n` is a polynomial of; itself if of no other.
  Index root(Index n) const { return nodes[n].cubic == kNone ? n : cubics[nodes[n].cubic].of; }

  /// `n` as a polynomial of `of`, if it is one.
  std::optional<Polynomial> polynomial(Index n, Index of) const {
    if (is_constant(n) && !value(n).contains_infinity() && !value(n).nan)
      return Polynomial::constant(value(n));
    if (n == of) return Polynomial::identity();
    if (nodes[n].cubic == kNone || cubics[nodes[n].cubic].of != of) return std::nullopt;
    return cubics[nodes[n].cubic].polynomial;
  }

  std::optional<Polynomial> polynomial(Op op, std::span<const Index> operands, Index of) const {
    const double size = value(of).magnitude();
    std::optional<Polynomial> p[3];
    for (std::size_t k = 0; k < operands.size(); ++k)
      if (!(p[k] = polynomial(operands[k], of))) return std::nullopt;
    const auto fits = [&] { return p[0]->degree() + p[1]->degree() < Polynomial::kTerms; };
    switch (op) {
      case Op::NegR:
      case Op::NegS:
        return negative(*p[0]);
      case Op::AddR:
      case Op::AddS:
        return vm::sum(*p[0], *p[1], size);
      case Op::SubR:
      case Op::SubS:
        return vm::sum(*p[0], negative(*p[1]), size);
      case Op::MulR:
      case Op::MulS:
        return fits() ? std::optional(vm::product(*p[0], *p[1], size)) : std::nullopt;
      case Op::FmaR:
      case Op::FmaS:
        return fits() ? std::optional(vm::sum(vm::product(*p[0], *p[1], size), *p[2], size))
                      : std::nullopt;
      default:
        return std::nullopt;
    }
  }

  /// Where result `n` is a polynomial of a value that occurs in it more than once, what that says.
  Index tightened(Index n, std::initializer_list<Index> operands) {
    const std::span<const Index> all(operands.begin(), operands.size());
    for (const Index operand : all) {
      if (is_constant(operand)) continue;
      for (const Index of : {root(operand), operand}) {
        const Interval& x = value(of);
        if (!x.has_number() || !(x.magnitude() < 1e9)) continue;
        const std::optional<Polynomial> p = polynomial(nodes[n].op, all, of);
        if (!p) continue;
        nodes[n].cubic = static_cast<Index>(cubics.size());
        cubics.push_back({of, *p});
        if (p->degree() > 1) {
          const bool nan = nodes[n].value.nan;
          nodes[n].value = meet(nodes[n].value, p->range(x));
          nodes[n].value.nan = nan;
        }
        return n;
      }
    }
    return n;
  }

  const Program& program;
  std::vector<ValueNode> nodes;
  std::vector<CubicValue> cubics;
  std::vector<std::pair<Index, Interval>> undo;  ///< what was narrowed, with what it was
};

}  // namespace mms::vm
