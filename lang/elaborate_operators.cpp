// SPDX-License-Identifier: Apache-2.0
/// \file
/// Operators of the elaborator: what they take, and the nodes they become.

#include "lang/conservation.h"
#include "lang/elaborator.h"

namespace mms::lang {
namespace {

using vm::Op;
using vm::SlotType;

/// The instruction of an arithmetic operator on one slot type.
std::optional<Op> machine_op(Operator op, TypeId type) {
  const bool s = type == kSpectrum, i = type == kInteger;
  switch (op) {
    case Operator::Add:
      return s ? Op::AddS : i ? Op::AddI : Op::AddR;
    case Operator::Sub:
      return s ? Op::SubS : i ? Op::SubI : Op::SubR;
    case Operator::Mul:
      return s ? Op::MulS : i ? Op::MulI : Op::MulR;
    case Operator::Div:
      return s ? Op::DivS : Op::DivR;
    case Operator::Mod:
      if (s) return std::nullopt;
      return i ? Op::ModI : Op::ModR;
    default:
      return std::nullopt;
  }
}

}  // namespace

Value Elaborator::bad_operands(Operator op, const Value& a, const Value& b, Span span) {
  if (a.poison() || b.poison()) return {};
  Diagnostic& d = diagnostics_.add(Diag::BadOperands, span, spelling(op), spell(a), spell(b));
  if (types_.is_array(a.type) && types_.is_array(b.type) &&
      types_[a.type].size != types_[b.type].size)
    d.help("arrays combine element by element: their sizes must agree");
  if (a.type == kLogic || b.type == kLogic)
    d.help("logic values combine with `and`, `or`, `not` and `select`");
  if (types_.is_function(a.type) || types_.is_function(b.type)) d.help("call the function first");
  return {};
}

Value Elaborator::binary(Operator op, const Value& a, const Value& b, Span span) {
  switch (op) {
    case Operator::And:
    case Operator::Or:
      return logical(op, a, b);
    case Operator::Eq:
    case Operator::Ne:
    case Operator::Lt:
    case Operator::Gt:
    case Operator::Le:
    case Operator::Ge:
      return compare(op, a, b, span);
    default:
      return arithmetic(op, a, b, span);
  }
}

Value Elaborator::arithmetic(Operator op, const Value& a, const Value& b, Span span) {
  if (a.poison() || b.poison()) return {};
  // Arrays combine element-wise; scalars broadcast.
  if (types_.is_array(a.type) || types_.is_array(b.type)) {
    const Value& array = types_.is_array(a.type) ? a : b;
    const bool both = types_.is_array(a.type) && types_.is_array(b.type);
    if (both && a.parts.size() != b.parts.size()) return bad_operands(op, a, b, span);
    std::vector<Value> parts;
    for (std::size_t i = 0; i < array.parts.size(); ++i) {
      parts.push_back(arithmetic(op, types_.is_array(a.type) ? a.parts[i] : a,
                                 types_.is_array(b.type) ? b.parts[i] : b, span));
      if (parts.back().poison()) return {};
    }
    return array_of(std::move(parts), {});
  }
  if (a.type == kMaterial || b.type == kMaterial) {
    if (op == Operator::Add && a.type == b.type) return call_library("add", {a, b}, span);
    if (op == Operator::Mul && a.type != b.type &&
        TypeTable::is_number(a.type == kMaterial ? b.type : a.type))
      return call_library("scale", {a.type == kMaterial ? a : b, a.type == kMaterial ? b : a},
                          span);
    return bad_operands(op, a, b, span);
  }
  if (!TypeTable::is_number(a.type) || !TypeTable::is_number(b.type))
    return bad_operands(op, a, b, span);
  if (op == Operator::Pow) return power(a, b, span);
  if (op == Operator::Div && b.refs.size() == 1 && known_number(module, b.refs[0]) == 0.0)
    diagnostics_.add(Diag::DivisionByZero, span);
  TypeId type = types_.join(a.type, b.type);
  if (type == kPoison) return bad_operands(op, a, b, span);
  if (type == kInteger && op == Operator::Div) {
    type = kReal;
  }
  const Value x = widen(a, type), y = widen(b, type);
  if (type == kComplex) return complex_arithmetic(op, x, y, span);
  const std::optional<Op> instruction = machine_op(op, type);
  if (!instruction) return bad_operands(op, a, b, span);
  return scalar(type, node(*instruction, {x.refs[0], y.refs[0]}));
}

Value Elaborator::complex_arithmetic(Operator op, const Value& a, const Value& b, Span span) {
  const Ref ar = a.refs[0], ai = a.refs[1], br = b.refs[0], bi = b.refs[1];
  auto make = [&](Ref re, Ref im) { return Value{kComplex, {re, im}, {}, {}, {}, {}}; };
  switch (op) {
    case Operator::Add:
      return make(node(Op::AddR, {ar, br}), node(Op::AddR, {ai, bi}));
    case Operator::Sub:
      return make(node(Op::SubR, {ar, br}), node(Op::SubR, {ai, bi}));
    case Operator::Mul:
      return make(node(Op::SubR, {node(Op::MulR, {ar, br}), node(Op::MulR, {ai, bi})}),
                  node(Op::AddR, {node(Op::MulR, {ar, bi}), node(Op::MulR, {ai, br})}));
    case Operator::Div:
      return call_library("complex_divide", {a, b}, span);
    default:
      return bad_operands(op, a, b, span);
  }
}

/// a^n, n >= 1, by repeated squaring, lowest bit of n first.
Value Elaborator::repeated_square(const Value& a, std::int64_t n, Span span) {
  std::optional<Value> product;
  for (Value square = a.type == kInteger ? widen(a, kReal) : a;;
       square = arithmetic(Operator::Mul, square, square, span)) {
    if (n & 1) product = product ? arithmetic(Operator::Mul, *product, square, span) : square;
    n >>= 1;
    if (n == 0) return *product;
  }
}

Value Elaborator::power(const Value& a, const Value& b, Span span) {
  if (a.type == kComplex || b.type == kComplex)
    return call_library("pow", {widen(a, kComplex), widen(b, kComplex)}, span);
  if (b.type == kInteger && a.type != kSpectrum)
    return call_library("powi", {a.type == kInteger ? widen(a, kReal) : a, b}, span);
  if (a.type == kInteger || b.type == kInteger)
    return power(a.type == kInteger ? widen(a, kReal) : a, b.type == kInteger ? widen(b, kReal) : b,
                 span);
  return call_library("pow", {a, b}, span);
}

Value Elaborator::equal(const Value& a, const Value& b) {
  std::vector<Ref> ra, rb;
  flatten(a, ra);
  flatten(b, rb);
  std::optional<Ref> all;
  for (std::size_t i = 0; i < ra.size(); ++i) {
    Ref one;
    switch (slot_type(ra[i])) {
      case SlotType::Integer:
        one = node(Op::EqI, {ra[i], rb[i]});
        break;
      case SlotType::Logic:
        one = node(Op::SelectL, {ra[i], rb[i], node(Op::Not, {rb[i]})});
        break;
      default:
        one = node(Op::EqR, {ra[i], rb[i]});
        break;
    }
    all = all ? node(Op::And, {*all, one}) : one;
  }
  return scalar(kLogic, all ? *all : logic(true));
}

Value Elaborator::compare(Operator op, const Value& a, const Value& b, Span span) {
  if (a.poison() || b.poison()) return {};
  const TypeId type = types_.join(a.type, b.type);
  if (type == kPoison || !types_.is_numeric(type) || types_.scalar(type) == kSpectrum)
    return bad_operands(op, a, b, span);
  const Value x = widen(a, type), y = widen(b, type);
  if (op == Operator::Eq || op == Operator::Ne) {
    const Value eq = equal(x, y);
    return op == Operator::Eq ? eq : scalar(kLogic, node(Op::Not, {eq.refs[0]}));
  }
  if (type != kInteger && type != kReal) return bad_operands(op, a, b, span);
  const bool swap = op == Operator::Gt || op == Operator::Ge;
  const bool strict = op == Operator::Lt || op == Operator::Gt;
  const Ref l = swap ? y.refs[0] : x.refs[0], r = swap ? x.refs[0] : y.refs[0];
  const Op instruction =
      type == kInteger ? (strict ? Op::LtI : Op::LeI) : (strict ? Op::LtR : Op::LeR);
  return scalar(kLogic, node(instruction, {l, r}));
}

Value Elaborator::logical(Operator op, const Value& a, const Value& b) {
  if (a.poison() || b.poison()) return {};
  return scalar(kLogic, node(op == Operator::And ? Op::And : Op::Or, {a.refs[0], b.refs[0]}));
}

Value Elaborator::negate(const Value& a, Span span) {
  if (a.poison()) return {};
  if (types_.is_array(a.type)) {
    Value r;
    r.type = a.type;
    for (const Value& p : a.parts) r.parts.push_back(negate(p, span));
    return r;
  }
  switch (a.type) {
    case kInteger:
      return scalar(kInteger, node(Op::NegI, {a.refs[0]}));
    case kReal:
      return scalar(kReal, node(Op::NegR, {a.refs[0]}));
    case kSpectrum:
      return scalar(kSpectrum, node(Op::NegS, {a.refs[0]}));
    case kComplex:
      return {kComplex, {node(Op::NegR, {a.refs[0]}), node(Op::NegR, {a.refs[1]})}, {}, {}, {}, {}};
    default:
      diagnostics_.add(Diag::BadOperand, span, "-", spell(a));
      return {};
  }
}

/// `a b + c` can be one fused operation: every element of it is a real or a spectrum.
bool Elaborator::can_fuse(const Value& a, const Value& b, const Value& c) const {
  bool real_or_spectrum = false;
  for (const Value* v : {&a, &b, &c}) {
    const TypeId s = types_.scalar(v->type);
    if (s != kInteger && s != kReal && s != kSpectrum) return false;
    real_or_spectrum = real_or_spectrum || s != kInteger;
  }
  const TypeId product_a = types_.scalar(a.type), product_b = types_.scalar(b.type);
  // An integer product is formed as integers, which is another value.
  return real_or_spectrum && !(product_a == kInteger && product_b == kInteger);
}

Value Elaborator::fused(const Value& a, const Value& b, const Value& c, Span span) {
  if (types_.is_array(a.type) || types_.is_array(b.type) || types_.is_array(c.type)) {
    std::size_t size = 0;
    for (const Value* v : {&a, &b, &c}) {
      if (!types_.is_array(v->type)) continue;
      if (size && v->parts.size() != size)
        return bad_operands(Operator::Add, arithmetic(Operator::Mul, a, b, span), c, span);
      size = v->parts.size();
    }
    std::vector<Value> parts;
    auto part = [&](const Value& v, std::size_t i) {
      return types_.is_array(v.type) ? v.parts[i] : v;
    };
    for (std::size_t i = 0; i < size; ++i) {
      parts.push_back(fused(part(a, i), part(b, i), part(c, i), span));
      if (parts.back().poison()) return {};
    }
    return array_of(std::move(parts), {});
  }
  const TypeId type =
      types_.join(types_.join(a.type, b.type), c.type) == kSpectrum ? kSpectrum : kReal;
  // A real product added to a spectrum is formed once, as a real.
  if (type == kSpectrum && types_.join(a.type, b.type) != kSpectrum)
    return arithmetic(Operator::Add, arithmetic(Operator::Mul, a, b, span), c, span);
  return scalar(type,
                node(type == kSpectrum ? Op::FmaS : Op::FmaR,
                     {widen(a, type).refs[0], widen(b, type).refs[0], widen(c, type).refs[0]}));
}

}  // namespace mms::lang
