// SPDX-License-Identifier: Apache-2.0
/// \file
/// Expressions of the elaborator.

#include <algorithm>

#include "lang/elaborator.h"
#include "vm/limits.h"

namespace mms::lang {
namespace {

using vm::Op;
using vm::SlotType;

/// `x ^ 3` with a small literal is multiplied out, whatever x is; any other power is a call. The
/// text decides, not what is known at link, so that the value never depends on that.
std::optional<std::int64_t> literal_power(const Expr& exponent) {
  constexpr std::int64_t kLargest = 16;
  const bool small =
      exponent.form == Expr::Form::Integer && 1 <= exponent.integer && exponent.integer <= kLargest;
  return small ? std::optional(exponent.integer) : std::nullopt;
}

}  // namespace

/// Bounds what the walk over expressions takes of the stack: a message once, then nothing more.
bool Elaborator::too_deep(Span span) {
  if (depth_ > vm::limits::kExpressionDepth && !full_) {
    full_ = true;
    diagnostics_.add(Diag::TooDeepToLink, span, vm::limits::kExpressionDepth);
  }
  return full_;
}

Value Elaborator::expr(Context c, ExprHandle h) {
  const Expr& e = (*c.graph)[h];
  const Deeper deeper(depth_);
  if (too_deep(e.span)) return {};
  const vm::SourceLine outer = line_;
  line_ = line_of(e.span);
  Value v;
  switch (e.form) {
    case Expr::Form::Integer:
      v = scalar(kInteger, integer(e.integer));
      break;
    case Expr::Form::Real:
      v = scalar(kReal, real(e.real));
      break;
    case Expr::Form::Imaginary:
      v = {kComplex, {real(0), real(e.real)}, {}, {}, {}, {}};
      break;
    case Expr::Form::Logic:
      v = scalar(kLogic, logic(e.integer != 0));
      break;
    case Expr::Form::String:
      v.type = kString;
      v.text = e.rare->text;
      break;
    case Expr::Form::Name:
      v = expr_name(c, e);
      break;
    case Expr::Form::Variable:
      v = expr_variable(c, e);
      break;
    case Expr::Form::FunctionValue:
    case Expr::Form::Lambda: {
      auto f = std::make_shared<FunctionValue>();
      *f = {c.graph, h, c.scope, e.path, std::nullopt, e.span, false};
      if (e.form == Expr::Form::FunctionValue && e.path.empty()) f->op = e.op;
      if (!e.path.empty()) {
        Binding* b = find(c, e.path);
        if (!b) {
          unknown_name(c, e.path, Diag::UnknownFunction);
          break;
        }
        if (b->form == Binding::Form::Value && types_.is_function(b->value.type)) {
          v = b->value;
          break;
        }
        if (b->form == Binding::Form::Constant) {
          const Value k = evaluate_constant(*b);
          if (types_.is_function(k.type) || k.poison()) {
            v = k;
            break;
          }
        }
        if (b->form != Binding::Form::Functions) {
          diagnostics_.add(Diag::NotCallable, e.span, e.path.back().text);
          break;
        }
      }
      v.type = kClosure;
      v.function = std::move(f);
      break;
    }
    case Expr::Form::Unary: {
      const Value x = expr(c, e.args[0]);
      if (e.op == Operator::Neg) {
        v = negate(x, e.span);
      } else if (!x.poison() && x.type != kLogic) {
        diagnostics_.add(Diag::BadOperand, e.span, "not", spell(x));
      } else if (!x.poison()) {
        v = scalar(kLogic, node(Op::Not, {x.refs[0]}));
      }
      break;
    }
    case Expr::Form::Binary:
      v = expr_binary(c, e);
      break;
    case Expr::Form::Chain:
      v = expr_chain(c, e);
      break;
    case Expr::Form::Call:
      v = expr_call(c, e);
      break;
    case Expr::Form::Convert:
      v = expr_convert(c, e);
      break;
    case Expr::Form::Index:
      v = expr_index(c, e);
      break;
    case Expr::Form::Field:
      v = expr_field(c, e);
      break;
    case Expr::Form::Select:
      v = expr_select(c, e, 0);
      break;
    case Expr::Form::Array:
      v = expr_array(c, e);
      break;
    case Expr::Form::Error:
      break;
  }
  line_ = outer;
  return v;
}

std::optional<Value> Elaborator::carried(Value v) {
  if (v.material) return std::nullopt;
  for (Ref& r : v.refs) {
    if (!known(r)) return std::nullopt;
    r = localise(r);
  }
  for (Value& part : v.parts) {
    std::optional<Value> here = carried(std::move(part));
    if (!here) return std::nullopt;
    part = std::move(*here);
  }
  return v;
}

Value Elaborator::evaluate_constant(Binding& b) {
  auto cached = b.cache.find(function_);
  if (cached != b.cache.end()) return cached->second;
  if (!b.cache.empty())
    if (std::optional<Value> known = carried(b.cache.begin()->second)) {
      carried_.push_back(&b);
      return b.cache[function_] = std::move(*known);
    }
  if (b.circular) return {};
  if (b.busy) {
    report_circle(b);
    return {};
  }
  struct Evaluating {  // left by an exception too: a recursion that is given to the machine
    std::vector<Binding*>& open;
    Evaluating(std::vector<Binding*>& o, Binding& k) : open(o) {
      k.busy = true;
      open.push_back(&k);
    }
    ~Evaluating() {
      open.back()->busy = false;
      open.pop_back();
    }
  } evaluating(evaluating_, b);
  Value v = expr({b.graph, b.scope}, b.expr);
  if (b.stated) {
    const TypeId type = resolve_type({b.stated_in, b.scope}, b.stated, nullptr);
    v = convert(v, type, (*b.graph)[b.expr].span, (*b.stated_in)[b.stated].span);
  }
  if (!passes(b.scope)) ++kept_;
  return b.cache[function_] = v;
}

/// One message for all the constants that ask for each other.
void Elaborator::report_circle(Binding& b) {
  Diagnostic& d = diagnostics_.add(Diag::DefinedByItself, b.span);
  auto first = std::find(evaluating_.begin(), evaluating_.end(), &b);
  for (auto k = first; k != evaluating_.end(); ++k) {
    (*k)->circular = true;
    if (k != first) d.note((*k)->span, "by way of this");
  }
}

Value Elaborator::expr_name(Context c, const Expr& e) {
  // An enumerator: `finish::oiled`.
  if (e.path.size() >= 2) {
    Path owner(e.path.begin(), e.path.end() - 1);
    Binding* t = find(c, owner);
    if (t && t->form == Binding::Form::Type && types_[type_of(*t)].form == Type::Form::Enum) {
      const std::vector<std::string>& members = types_[type_of(*t)].members;
      const auto it = std::find(members.begin(), members.end(), e.path.back().text);
      if (it == members.end()) {
        Diagnostic& d = diagnostics_.add(Diag::NoField, e.path.back().span,
                                         types_[type_of(*t)].name, e.path.back().text);
        const std::string near = nearest(e.path.back().text, members);
        if (!near.empty()) d.help(fmt::format("did you mean `{}`?", near));
        return {};
      }
      return scalar(t->type, integer(it - members.begin()));
    }
  }
  Binding* b = find(c, e.path);
  if (!b) {
    unknown_name(c, e.path, Diag::UnknownName);
    return {};
  }
  switch (b->form) {
    case Binding::Form::Value:
      return b->value;
    case Binding::Form::Constant:
      return evaluate_constant(*b);
    case Binding::Form::Functions: {
      const bool has_plain =
          std::any_of(b->functions.begin(), b->functions.end(),
                      [](FunctionDecl* d) { return d->function().formals.empty(); }) ||
          std::any_of(b->rows.begin(), b->rows.end(),
                      [](const vm::Builtin* r) { return r->signature.ends_with("()"); });
      if (has_plain) return call_named(c, e.path, {}, e.span);
      diagnostics_.add(Diag::FunctionNotValue, e.span, e.path.back().text)
          .help(fmt::format("call it, `{0}(...)`, or write `#{0}` for the function itself",
                            e.path.back().text));
      return {};
    }
    case Binding::Form::Type:
    case Binding::Form::Namespace:
      diagnostics_.add(Diag::NotAValue, e.span, e.path.back().text);
      return {};
  }
  return {};
}

Value Elaborator::expr_variable(Context c, const Expr& e) {
  const std::string& name = e.path[0].text;
  for (const vm::VariableInfo& v : vm::kVariables) {
    if (v.name != name || (v.visibility == vm::Visibility::Hidden && !c.scope->library)) continue;
    const int first = vm::input_index(v.variable);
    if (v.slot_type() == SlotType::Spectrum) return scalar(kSpectrum, input(first));
    if (v.components() == 1) return scalar(kReal, input(first));
    auto row = [&](int begin, int size) {
      Value r;
      for (int i = 0; i < size; ++i) r.parts.push_back(scalar(kReal, input(first + begin + i)));
      r.type = types_.array(kReal, size);
      return r;
    };
    if (v.components() != 4) return row(0, v.components());
    Value m;
    m.parts = {row(0, 2), row(2, 2)};
    m.type = types_.array(types_.array(kReal, 2), 2);
    return m;
  }
  std::vector<std::string> names;
  for (const vm::VariableInfo& v : vm::kVariables)
    if (v.visibility == vm::Visibility::Public) names.emplace_back(v.name);
  Diagnostic& d = diagnostics_.add(Diag::UnknownVariable, e.span, name);
  const std::string near = nearest(name, names);
  if (!near.empty()) {
    d.help(fmt::format("did you mean `${}`?", near));
  } else {
    std::string all;
    for (const std::string& n : names) all += (all.empty() ? "$" : ", $") + n;
    d.help("there are " + all);
  }
  return {};
}

/// A sum with a product as an operand is one fused operation: the left product where both are.
Value Elaborator::expr_binary(Context c, const Expr& e) {
  if (e.op == Operator::And || e.op == Operator::Or) return expr_lazy(c, e);
  if (e.op == Operator::Add || e.op == Operator::Sub) {
    for (std::size_t side = 0; side < 2; ++side) {
      const Expr& product = (*c.graph)[e.args[side]];
      if (product.form != Expr::Form::Binary || product.op != Operator::Mul) continue;
      Value x, y, z;
      if (side == 1) z = expr(c, e.args[0]);
      x = expr(c, product.args[0]);
      y = expr(c, product.args[1]);
      if (side == 0) z = expr(c, e.args[1]);
      if (x.poison() || y.poison() || z.poison()) return {};
      if (can_fuse(x, y, z)) {
        if (e.op == Operator::Sub && side == 0) z = negate(z, e.span);
        if (e.op == Operator::Sub && side == 1) x = negate(x, e.span);
        return fused(x, y, z, e.span);
      }
      const Value p = binary(Operator::Mul, x, y, product.span);
      return side == 0 ? binary(e.op, p, z, e.span) : binary(e.op, z, p, e.span);
    }
  }
  const Value a = expr(c, e.args[0]);
  if (const auto n = e.op == Operator::Pow ? literal_power((*c.graph)[e.args[1]]) : std::nullopt)
    if (TypeTable::is_number(a.type) || types_.scalar(a.type) == kReal)
      return repeated_square(a, *n, e.span);
  const Value b = expr(c, e.args[1]);
  return binary(e.op, a, b, e.span);
}

/// `and` and `or` do not look at their right side where the left one decides; that shows only
/// where the right side may not end, so only then it is a choice.
Value Elaborator::expr_lazy(Context c, const Expr& e) {
  const bool is_and = e.op == Operator::And;
  const Value a = expr(c, e.args[0]);
  const std::optional<bool> decided = a.type == kLogic ? known_logic(a) : std::nullopt;
  if (decided && *decided != is_and) return a;
  const std::size_t before = module.functions[function_].nodes.size();
  dynamic_ += decided ? 0 : 1;
  const Value b = expr(c, e.args[1]);
  dynamic_ -= decided ? 0 : 1;
  if (a.poison() || b.poison()) return {};
  if (a.type != kLogic || b.type != kLogic) return bad_operands(e.op, a, b, e.span);
  if (decided) return b;
  const std::vector<Node>& nodes = module.functions[function_].nodes;
  const bool calls = std::any_of(nodes.begin() + static_cast<std::ptrdiff_t>(before), nodes.end(),
                                 [](const Node& n) { return n.op == Op::Call; });
  if (!calls) return logical(e.op, a, b);
  const Value other = scalar(kLogic, logic(!is_and));
  return is_and ? choose(a.refs[0], b, other, e.span) : choose(a.refs[0], other, b, e.span);
}

Value Elaborator::expr_chain(Context c, const Expr& e) {
  Value all;
  Value left = expr(c, e.args[0]);
  for (std::size_t i = 0; i < e.rare->ops.size(); ++i) {
    Value right = expr(c, e.args[i + 1]);
    const Value one = compare(e.rare->ops[i], left, right, e.span);
    all = i == 0 ? one : logical(Operator::And, all, one);
    left = std::move(right);
  }
  return all;
}

/// An arm's value as the type it shares with the arms that are out.
Value Elaborator::join_arms(Context c, const Expr& e, ExprHandle value, const Value& v,
                            TypeId other) {
  const TypeId type = types_.join(v.type, other);
  if (type != kPoison) return widen(v, type);
  diagnostics_.add(Diag::ArmsDiffer, e.span, spell(v), types_.spell(other))
      .note((*c.graph)[value].span, "an arm is here");
  return {};
}

Value Elaborator::expr_select(Context c, const Expr& e, std::size_t arm) {
  const Deeper deeper(depth_);
  if (too_deep(e.span)) return {};
  if (2 * arm + 1 >= e.args.size()) return expr(c, e.args[2 * arm]);
  const ExprHandle value = e.args[2 * arm], condition = e.args[2 * arm + 1];
  const Value cond = expr(c, condition);
  if (!cond.poison() && cond.type != kLogic) {
    diagnostics_.add(Diag::TypeMismatch, (*c.graph)[condition].span, "logic", spell(cond))
        .labelled("a condition is `logic`");
    return {};
  }
  if (const auto decided = cond.poison() ? std::nullopt : known_logic(cond)) {
    const Value v = *decided ? expr(c, value) : expr_select(c, e, arm + 1);
    std::vector<ExprHandle> out;  // the arms that are out: the type is that of all of them
    for (std::size_t k = arm; k < e.args.size() / 2 + 1; ++k)
      if (*decided ? k > arm : k == arm) out.push_back(e.args[2 * k]);
    const TypeId other = peek_joined(c, out);
    return v.poison() || other == kPoison || other == v.type ? v : join_arms(c, e, value, v, other);
  }
  ++dynamic_;
  Value a = expr(c, value);
  Value b = expr_select(c, e, arm + 1);
  --dynamic_;
  if (cond.poison() || a.poison() || b.poison()) return {};
  const TypeId type = types_.join(a.type, b.type);
  if (type == kPoison) {
    diagnostics_.add(Diag::ArmsDiffer, e.span, spell(a), spell(b))
        .note((*c.graph)[value].span, fmt::format("this is `{}`", spell(a)));
    return {};
  }
  line_ = line_of(e.span);
  return choose(cond.refs[0], widen(a, type), widen(b, type), e.span);
}

Value Elaborator::expr_convert(Context c, const Expr& e) {
  std::vector<BoundArgument> args = arguments(c, e);
  const TypeId to = types_.basic(e.basic);
  for (const BoundArgument& a : args)
    if (a.value.poison()) return {};
  if (to == kComplex && args.size() == 2) {
    const Value re = convert(args[0].value, kReal, args[0].span),
                im = convert(args[1].value, kReal, args[1].span);
    if (re.poison() || im.poison()) return {};
    return {kComplex, {re.refs[0], im.refs[0]}, {}, {}, {}, {}};
  }
  if (args.size() != 1 || args[0].name) {
    diagnostics_.add(Diag::ConversionArguments, e.span, types_.spell(to));
    return {};
  }
  const Value& v = args[0].value;
  if (types_.widening(v.type, to) >= 0) return widen(v, to);
  const bool enumerated = types_[v.type].form == Type::Form::Enum;
  if (to == kInteger && enumerated) return scalar(kInteger, v.refs[0]);
  if (to == kReal && enumerated) return scalar(kReal, node(Op::RealOfInt, {v.refs[0]}));
  if (to == kInteger && v.type == kReal) return scalar(kInteger, node(Op::IntOfReal, {v.refs[0]}));
  if (v.type == kLogic && (to == kInteger || to == kReal)) {
    const Value one = scalar(to, to == kInteger ? integer(1) : real(1)),
                none = scalar(to, to == kInteger ? integer(0) : real(0));
    return scalar(to, node(to == kInteger ? Op::SelectI : Op::SelectR,
                           {v.refs[0], one.refs[0], none.refs[0]}));
  }
  diagnostics_.add(Diag::NoConversion, e.span, spell(v), types_.spell(to));
  return {};
}

}  // namespace mms::lang
