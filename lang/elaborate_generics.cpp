// SPDX-License-Identifier: Apache-2.0
/// \file
/// Generics and dimension variables of the elaborator: what a call makes of them.

#include "lang/elaborator.h"

namespace mms::lang {

/// The type a formal has in this call: its own, with open dimensions taken from the argument.
TypeId Elaborator::formal_type(Context c, TypeHandle h, TypeId actual, const Generics& g) {
  const TypeExpr& t = (*c.graph)[h];
  if (t.form == TypeExpr::Form::Array && types_.is_array(actual)) {
    std::vector<int> sizes;
    TypeId element = actual;
    for (std::size_t i = 0; i < t.dims.size() && types_.is_array(element); ++i) {
      sizes.push_back(types_[element].size);
      element = types_[element].parts[0];
    }
    TypeId type = formal_type(c, t.element, element, g);
    for (std::size_t i = sizes.size(); i-- > 0;) type = types_.array(type, sizes[i]);
    return type;
  }
  return resolve_type(c, h, &g);
}

/// All generics and dimension variables that the type names are bound.
bool Elaborator::ready(Context c, TypeHandle h, const Generics& g) {
  const TypeExpr& t = (*c.graph)[h];
  const bool variable = t.path.size() == 1 &&
                        (t.form == TypeExpr::Form::Generic || g.names.count(t.path[0].text) > 0);
  if (variable) return g.types.count(t.path[0].text) > 0;
  for (const TypeExpr::Dim& d : t.dims) {
    const bool named = !d.path.empty() && !g.dims.count(d.path[0].text);
    if (d.form == TypeExpr::Dim::Form::Open || (named && !find(c, d.path))) return false;
  }
  for (TypeHandle f : t.formals)
    if (!ready(c, f, g)) return false;
  const bool inner = t.form == TypeExpr::Form::Array || t.form == TypeExpr::Form::Function;
  return !inner || ready(c, t.element, g);
}

/// The type of what `f` gives for arguments of those types: from its text where that says it, else
/// by trying it on values nobody knows.
TypeId Elaborator::result_of(const Value& f, const std::vector<TypeId>& types, Span span) {
  std::vector<BoundArgument> args;
  for (TypeId t : types) {
    Value v;
    v.type = t;
    args.push_back({std::nullopt, std::move(v), span});
  }
  const TypeId stated = peek_call(f, args);
  if (stated != kPoison) return stated;
  for (BoundArgument& a : args) a.value = unknown_value(a.value.type);
  const bool outer = unknown_arguments_;
  unknown_arguments_ = true;
  const TypeId type = call_function_value(f, std::move(args), span).type;
  unknown_arguments_ = outer;
  return type;
}

/// Generics that function arguments decide: their results join what the other arguments say, over
/// and over, as in `fold(#+, 0, reals)`, whose integer 0 becomes a real.
bool Elaborator::infer_results(Context c, const Function& f, const std::vector<Value>& formals,
                               const std::vector<Span>& spans, Generics& g) {
  constexpr int kRounds = 4;  // longer than any chain of widening
  for (int round = 0; round < kRounds; ++round) {
    const std::map<std::string, TypeId> before = g.types;
    for (std::size_t i = 0; i < f.formals.size(); ++i) {
      const TypeExpr& t = (*c.graph)[f.formals[i].type];
      if (t.form != TypeExpr::Form::Function || formals[i].type != kClosure) continue;
      if (!mentions_generic(c, t.element, g)) continue;
      std::vector<TypeId> types;
      bool known_types = true;
      for (TypeHandle p : t.formals) {
        known_types = known_types && ready(c, p, g);
        if (known_types) types.push_back(resolve_type(c, p, &g));
      }
      if (!known_types) continue;
      const std::size_t errors = diagnostics_.error_count();
      const TypeId type = result_of(formals[i], types, spans[i]);
      if (diagnostics_.error_count() > errors || (type == kPoison && diagnostics_.has_errors()))
        return false;  // told, now or before
      int cost = 0;
      if (type != kPoison) unify(c, t.element, type, g, cost);
    }
    if (g.types == before) break;
  }
  return true;
}

bool Elaborator::mentions_generic(Context c, TypeHandle h, const Generics& g) {
  const TypeExpr& t = (*c.graph)[h];
  if (t.path.size() == 1 && g.names.count(t.path[0].text)) return true;
  return t.form == TypeExpr::Form::Array && mentions_generic(c, t.element, g);
}
}  // namespace mms::lang
