// SPDX-License-Identifier: Apache-2.0
#include "lang/resolve.h"

#include <algorithm>

namespace mms::lang {

void NameCheck::name(const Path& path, Diag id) {
  // What a path leads to inside a local name is for the types to say.
  const bool local = std::find(inside_.begin(), inside_.end(), path[0].text) != inside_.end();
  if (local || outside_(path)) return;
  if (path.size() > 1 && outside_(Path(path.begin(), path.end() - 1))) return;  // an enumerator
  unknown_(path, id, inside_);
}

/// Generics and dimension variables that a formal's type brings.
void NameCheck::introduce(TypeHandle h) {
  const TypeExpr& t = graph_[h];
  if (t.form == TypeExpr::Form::Generic) declare(t.path[0].text);
  for (const TypeExpr::Dim& d : t.dims)
    if (d.path.size() == 1) declare(d.path[0].text);
  if (t.element) introduce(t.element);
  for (TypeHandle f : t.formals) introduce(f);
}

void NameCheck::type(TypeHandle h) {
  const TypeExpr& t = graph_[h];
  if (t.form == TypeExpr::Form::Named) name(t.path, Diag::UnknownType);
  for (const TypeExpr::Dim& d : t.dims)
    if (!d.path.empty()) name(d.path, Diag::UnknownName);
  if (t.element) type(t.element);
  for (TypeHandle f : t.formals) type(f);
}

void NameCheck::formals(const std::vector<Formal>& formals) {
  for (const Formal& f : formals)
    if (f.type) introduce(f.type);
  for (const Formal& f : formals) {
    if (f.type) type(f.type);
    if (f.default_value) expr(f.default_value);
    declare(f.name.text);
  }
}

void NameCheck::function(const Function& f) {
  const std::size_t before = inside_.size();
  formals(f.formals);
  type(f.result);
  body(f.body);
  if (f.value) expr(f.value);
  inside_.resize(before);
}

void NameCheck::body(const Body& b) {
  for (std::size_t i = 0; i < b.items.size(); ++i) {
    const Item item = b.items[i];
    switch (item.form) {
      case Item::Form::Assignment: {
        const Assignment& a = b.assignments[item.index];
        if (a.type) type(a.type);
        expr(a.value);
        declare(a.name.text);
        break;
      }
      case Item::Form::Constant:
        declare(b.constants[item.index].name.text);
        expr(b.constants[item.index].value);
        break;
      case Item::Form::Type:
        declare(b.types[item.index].name.text);
        break;
      case Item::Form::Function: {
        // Adjacent ones may call each other.
        std::size_t end = i;
        for (; end < b.items.size() && b.items[end].form == Item::Form::Function; ++end)
          declare(graph_[b.functions[b.items[end].index]].name.text);
        for (; i < end; ++i) function(graph_[b.functions[b.items[i].index]]);
        --i;
        break;
      }
    }
  }
}

void NameCheck::expr(ExprHandle h) {
  const Expr& e = graph_[h];
  const std::size_t before = inside_.size();
  std::size_t first = 0;
  switch (e.form) {
    case Expr::Form::Name:
      name(e.path, Diag::UnknownName);
      break;
    case Expr::Form::FunctionValue:
      if (!e.path.empty()) name(e.path, Diag::UnknownFunction);
      break;
    case Expr::Form::Call: {
      const Expr& callee = graph_[e.args[0]];
      if (callee.form == Expr::Form::Name && !callee.parenthesised) {
        first = 1;
        name(callee.path, Diag::UnknownFunction);
      }
      break;
    }
    case Expr::Form::Lambda:
      formals(e.rare->formals);
      break;
    default:
      break;
  }
  for (std::size_t k = first; k < e.args.size(); ++k) expr(e.args[k]);
  for (const Argument& a : e.arguments) expr(a.value);
  inside_.resize(before);
}

}  // namespace mms::lang
