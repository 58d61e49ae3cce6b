// SPDX-License-Identifier: Apache-2.0
/// \file
/// The type of an expression from its text alone: nothing is computed, no function is entered, so
/// it ends even where the expression would not. It says kPoison where that is not enough, and never
/// a wrong type.

#include <algorithm>

#include "lang/elaborator.h"

namespace mms::lang {
namespace {

/// Constants and lambdas that are looked into from one another.
constexpr int kDeepestPeek = 16;

}  // namespace

TypeId Elaborator::arithmetic_type(Operator op, TypeId a, TypeId b) {
  if (a == kPoison || b == kPoison) return kPoison;
  if (types_.is_array(a) || types_.is_array(b)) {
    const TypeId array = types_.is_array(a) ? a : b;
    const int size = types_[array].size;
    if (types_.is_array(a) && types_.is_array(b) && types_[b].size != size) return kPoison;
    const TypeId element = arithmetic_type(op, types_.is_array(a) ? types_[a].parts[0] : a,
                                           types_.is_array(b) ? types_[b].parts[0] : b);
    return element == kPoison ? kPoison : types_.array(element, size);
  }
  if (a == kMaterial || b == kMaterial)
    return op == Operator::Add || op == Operator::Mul ? kMaterial : kPoison;
  if (!TypeTable::is_number(a) || !TypeTable::is_number(b)) return kPoison;
  const TypeId type = types_.join(a, b);
  const bool real = op == Operator::Div || op == Operator::Pow;
  return type == kInteger && real ? kReal : type;
}

TypeId Elaborator::operator_type(Operator op, TypeId a, TypeId b) {
  switch (op) {
    case Operator::Add:
    case Operator::Sub:
    case Operator::Mul:
    case Operator::Div:
    case Operator::Mod:
    case Operator::Pow:
      return arithmetic_type(op, a, b);
    case Operator::Neg:
      return a;
    default:
      return kLogic;
  }
}

TypeId Elaborator::peek_joined(Context c, const std::vector<ExprHandle>& values) {
  TypeId type = kPoison;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const TypeId t = peek(c, values[k]);
    type = k == 0 ? t : types_.join(type, t);
    if (type == kPoison) return kPoison;
  }
  return type;
}

TypeId Elaborator::peek_name(Context c, const Path& path) {
  if (path.size() >= 2) {
    Binding* owner = find(c, Path(path.begin(), path.end() - 1));
    if (owner && owner->form == Binding::Form::Type) return type_of(*owner);
  }
  Binding* b = find(c, path);
  if (!b) return kPoison;
  if (b->form == Binding::Form::Value) return b->value.type;
  if (b->form == Binding::Form::Functions) return peek_call(c, path, {});
  if (b->form != Binding::Form::Constant) return kPoison;
  if (b->stated) return resolve_type({b->stated_in, b->scope}, b->stated, nullptr);
  if (peeking_ >= kDeepestPeek) return kPoison;
  ++peeking_;
  const TypeId type = peek({b->graph, b->scope}, b->expr);
  --peeking_;
  return type;
}

TypeId Elaborator::peek_candidates(const std::vector<std::vector<Candidate>>& levels,
                                   const std::vector<BoundArgument>& args) {
  for (const std::vector<Candidate>& level : levels) {
    Match best;
    const Candidate* winner = nullptr;
    for (const Candidate& k : level) {
      Match m = match(k, args);
      if (m.cost < 0 || (winner && m.cost >= best.cost)) continue;
      best = std::move(m);
      winner = &k;
    }
    if (!winner) continue;
    if (winner->row) {
      const bool lifted = std::any_of(args.begin(), args.end(), [](const BoundArgument& a) {
        return a.value.type == kSpectrum;
      });
      return lifted && signature(winner->row).all_real ? kSpectrum : signature(winner->row).result;
    }
    const Context c{winner->decl->graph, winner->decl->scope};
    const TypeHandle result = winner->decl->function().result;
    for (const Formal& f : winner->decl->function().formals)  // a function may decide a generic
      if ((*c.graph)[f.type].form == TypeExpr::Form::Function && !best.generics.names.empty())
        return kPoison;
    return ready(c, result, best.generics) ? resolve_type(c, result, &best.generics) : kPoison;
  }
  return kPoison;
}

TypeId Elaborator::peek_call(Context c, const Path& path, const std::vector<BoundArgument>& args) {
  Binding* b = find(c, path);
  if (!b) return kPoison;
  if (b->form == Binding::Form::Type) return types_.is_struct(type_of(*b)) ? b->type : kPoison;
  if (b->form == Binding::Form::Value) return peek_call(b->value, args);
  return b->form == Binding::Form::Functions ? peek_candidates(candidates(c, path, *b), args)
                                             : kPoison;
}

TypeId Elaborator::peek_call(const Value& f, const std::vector<BoundArgument>& args) {
  if (types_[f.type].form == Type::Form::Function) return types_[f.type].parts.back();
  if (f.type != kClosure || !f.function) return kPoison;
  const FunctionValue& fn = *f.function;
  if (fn.op) {
    const TypeId b = args.size() == 2 ? args[1].value.type : kPoison;
    return args.size() == 1 ? args[0].value.type : operator_type(*fn.op, args[0].value.type, b);
  }
  if (!fn.path.empty()) return peek_call(Context{fn.graph, fn.scope}, fn.path, args);
  if (!fn.lambda || peeking_ >= kDeepestPeek) return kPoison;
  const Expr& e = (*fn.graph)[fn.lambda];
  if (e.rare->formals.size() != args.size()) return kPoison;
  Scope inside;
  inside.parent = fn.scope;
  inside.library = fn.scope->library;
  const Context c{fn.graph, &inside};
  for (std::size_t k = 0; k < args.size(); ++k) {
    Binding b;
    if (args[k].name) return kPoison;
    b.value.type = e.rare->formals[k].type ? resolve_type(c, e.rare->formals[k].type, nullptr)
                                           : args[k].value.type;
    inside.names.emplace(e.rare->formals[k].name.text, std::move(b));
  }
  ++peeking_;
  const TypeId type = peek(c, e.args[0]);
  --peeking_;
  return type;
}

TypeId Elaborator::peek_call(Context c, const Expr& e) {
  std::vector<BoundArgument> args;
  for (const Argument& a : e.arguments) {
    Value v;
    v.type = peek(c, a.value);
    if (v.poison()) return kPoison;
    args.push_back({a.name, std::move(v), {}});
  }
  const Expr& callee = (*c.graph)[e.args[0]];
  if (callee.form == Expr::Form::Name && !callee.parenthesised)
    return peek_call(c, callee.path, args);
  const TypeId f = peek(c, e.args[0]);
  return types_[f].form == Type::Form::Function ? types_[f].parts.back() : kPoison;
}

TypeId Elaborator::peek(Context c, ExprHandle h) {
  const Expr& e = (*c.graph)[h];
  switch (e.form) {
    case Expr::Form::Integer:
      return kInteger;
    case Expr::Form::Real:
      return kReal;
    case Expr::Form::Imaginary:
      return kComplex;
    case Expr::Form::String:
      return kString;
    case Expr::Form::Logic:
    case Expr::Form::Chain:
      return kLogic;
    case Expr::Form::Name:
      return peek_name(c, e.path);
    case Expr::Form::Variable:
      return expr_variable(c, e).type;
    case Expr::Form::FunctionValue:
    case Expr::Form::Lambda:
      return kClosure;
    case Expr::Form::Unary:
      return e.op == Operator::Neg ? peek(c, e.args[0]) : kLogic;
    case Expr::Form::Binary: {
      const TypeId a = peek(c, e.args[0]), b = peek(c, e.args[1]);
      return operator_type(e.op, a, b);
    }
    case Expr::Form::Call:
      return peek_call(c, e);
    case Expr::Form::Convert:
      return types_.basic(e.basic);
    case Expr::Form::Index: {
      TypeId t = peek(c, e.args[0]);
      for (std::size_t k = 1; k < e.args.size(); ++k)
        t = types_.is_array(t) ? types_[t].parts[0] : kPoison;
      return t;
    }
    case Expr::Form::Field: {
      const TypeId t = peek(c, e.args[0]);
      if (types_.is_array(t)) return types_[t].parts[0];
      if (t == kComplex) return kReal;
      const auto& members = types_[t].members;
      const auto it = std::find(members.begin(), members.end(), e.path[0].text);
      return types_.is_struct(t) && it != members.end()
                 ? types_[t].parts[static_cast<std::size_t>(it - members.begin())]
                 : kPoison;
    }
    case Expr::Form::Select: {
      std::vector<ExprHandle> values;
      for (std::size_t k = 0; k < e.args.size(); k += 2) values.push_back(e.args[k]);
      return peek_joined(c, values);
    }
    case Expr::Form::Array: {
      const TypeId t = peek_joined(c, e.args);
      const int rows = static_cast<int>(std::max<std::uint32_t>(e.rows, 1));
      if (t == kPoison) return kPoison;
      const TypeId row = types_.array(t, static_cast<int>(e.args.size()) / rows);
      return rows == 1 ? row : types_.array(row, rows);
    }
    case Expr::Form::Error:
      break;
  }
  return kPoison;
}

}  // namespace mms::lang
