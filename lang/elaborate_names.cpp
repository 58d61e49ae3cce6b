// SPDX-License-Identifier: Apache-2.0
/// \file
/// Scopes, name lookup and types of the elaborator.

#include <algorithm>

#include "lang/elaborator.h"
#include "vm/limits.h"

namespace mms::lang {

Scope* Elaborator::new_scope(Scope* parent, bool library) {
  Scope& scope = scopes_.emplace_back();
  scope.parent = parent;
  scope.library = library || (parent && parent->library && parent != library_scope_);
  return &scopes_.back();
}

Binding* Elaborator::declare(Scope* scope, const Name& name, Binding binding) {
  binding.span = name.span;
  binding.library = scope->library;
  auto it = scope->names.find(name.text);
  Binding* taken = it != scope->names.end() ? &it->second : nullptr;
  if (!taken && !scope->imports.empty())
    for (Binding* b : bindings_in(scope, name.text))
      if (b->form != Binding::Form::Functions || binding.form != Binding::Form::Functions)
        taken = b;
  if (taken) {
    Binding& old = *taken;
    if (old.form == Binding::Form::Functions && binding.form == Binding::Form::Functions) {
      old.functions.insert(old.functions.end(), binding.functions.begin(), binding.functions.end());
      return &old;
    }
    diagnostics_.add(Diag::Redefined, name.span, name.text)
        .note(old.span, "first defined here")
        .help("names are given once: choose another name");
    return &old;
  }
  if (!scope->library)
    for (Scope* s = scope->parent; s; s = s->parent) {
      auto outer = s->library ? s->names.end() : s->names.find(name.text);
      if (s->library || outer == s->names.end()) continue;
      diagnostics_.add(Diag::Shadowed, name.span, name.text)
          .note(outer->second.span, "the outer one is here")
          .help("a script's own names may not hide each other: choose another name");
      break;
    }
  return &scope->names.emplace(name.text, std::move(binding)).first->second;
}

void Elaborator::declare_function(Context c, FunctionHandle h) {
  if (passes(c.scope)) ++kept_;
  decls_.push_back({c.graph, h, c.scope, c.scope->library, false});
  Binding b;
  b.form = Binding::Form::Functions;
  b.functions = {&decls_.back()};
  declare(c.scope, (*c.graph)[h].name, std::move(b));
}

void Elaborator::declare_type(Context c, const TypeDefinition& t) {
  Binding b;
  b.form = Binding::Form::Type;
  b.definition = &t;
  b.graph = c.graph;
  b.scope = c.scope;
  declare(c.scope, t.name, std::move(b));
}

/// The type a name stands for; definitions may come in any order, but not in a circle.
TypeId Elaborator::type_of(Binding& b) {
  if (!b.definition) return b.type;
  if (b.busy) {
    diagnostics_.add(Diag::DefinedByItself, b.span)
        .help("a value has a size that is known at link: a type cannot contain itself");
    return kPoison;
  }
  const Deeper deeper(depth_);
  if (too_deep(b.span)) return kPoison;
  b.busy = true;
  const TypeId type = define({b.graph, b.scope}, *b.definition);
  b.busy = false;
  b.definition = nullptr;
  return b.type = type;
}

TypeId Elaborator::define(Context c, const TypeDefinition& t) {
  if (t.form == TypeDefinition::Form::Alias) return resolve_type(c, t.type, nullptr);
  if (t.form == TypeDefinition::Form::Enum) {
    Type e{Type::Form::Enum, 0, {}, t.name.text, {}};
    for (const Name& n : t.enumerators) {
      if (std::find(e.members.begin(), e.members.end(), n.text) != e.members.end())
        diagnostics_.add(Diag::Redefined, n.span, n.text);
      e.members.push_back(n.text);
    }
    return types_.intern(std::move(e));
  }
  Type s{Type::Form::Struct, 0, {}, t.name.text, {}};
  for (const TypeDefinition::Field& f : t.fields) {
    if (std::find(s.members.begin(), s.members.end(), f.name.text) != s.members.end())
      diagnostics_.add(Diag::Redefined, f.name.span, f.name.text);
    s.parts.push_back(resolve_type(c, f.type, nullptr));
    s.members.push_back(f.name.text);
    if (s.parts.back() == kPoison) return kPoison;
  }
  const TypeId type = types_.intern(std::move(s));
  return too_large(type, t.name.span) ? kPoison : type;
}

void Elaborator::declare_constant(Context c, const Constant& k) {
  Binding b;
  b.form = Binding::Form::Constant;
  b.graph = c.graph;
  b.scope = c.scope;
  b.stated = k.type;
  b.stated_in = c.graph;
  b.expr = k.value;
  declare(c.scope, k.name, std::move(b));
}

std::vector<Binding*> Elaborator::bindings_in(Scope* scope, std::string_view name) {
  std::vector<Binding*> found;
  auto it = scope->names.find(name);
  if (it != scope->names.end()) found.push_back(&it->second);
  if (scope->imports.empty()) return found;
  std::set<Scope*> seen{scope};
  std::vector<Scope*> pending(scope->imports.rbegin(), scope->imports.rend());
  while (!pending.empty()) {
    Scope* s = pending.back();
    pending.pop_back();
    if (!seen.insert(s).second) continue;
    it = s->names.find(name);
    if (it != s->names.end()) found.push_back(&it->second);
    pending.insert(pending.end(), s->imports.rbegin(), s->imports.rend());
  }
  return found;
}

Binding* Elaborator::find(Scope* scope, std::string_view name) {
  for (Scope* s = scope; s; s = s->parent) {
    auto it = s->names.find(name);
    if (it != s->names.end()) return &it->second;
    if (s->imports.empty()) continue;
    const std::vector<Binding*> found = bindings_in(s, name);
    if (!found.empty()) return found[0];
  }
  return nullptr;
}

/// Two imports may both have the name: then it is no one's.
void Elaborator::check_ambiguity(Scope* scope, const Name& name) {
  for (Scope* s = scope; s; s = s->parent) {
    if (s->names.count(name.text)) return;
    if (s->imports.empty()) continue;
    const std::vector<Binding*> found = bindings_in(s, name.text);
    const bool functions = std::all_of(found.begin(), found.end(), [](const Binding* b) {
      return b->form == Binding::Form::Functions;
    });
    if (found.size() > 1 && !functions)
      diagnostics_.add(Diag::AmbiguousImport, name.span, name.text)
          .note(found[0]->span, "one is here")
          .note(found[1]->span, "another is here")
          .help(fmt::format("import one file with a name: `import \"...\" as a;`, then `a::{}`",
                            name.text));
    if (!found.empty()) return;
  }
}

Binding* Elaborator::find(Context c, const Path& path) {
  Binding* b = find(c.scope, path[0].text);
  if (b && !b->library) check_ambiguity(c.scope, path[0]);
  for (std::size_t i = 1; b && i < path.size(); ++i) {
    if (b->form != Binding::Form::Namespace) return nullptr;
    const std::vector<Binding*> found = bindings_in(b->scope, path[i].text);
    b = found.empty() ? nullptr : found[0];
  }
  return b;
}

std::vector<std::string> Elaborator::visible_names(Scope* scope) {
  std::vector<std::string> names;
  auto add = [&](Scope* s) {
    for (const auto& [name, binding] : s->names) names.push_back(name);
  };
  for (Scope* s = scope; s; s = s->parent) {
    add(s);
    for (Scope* i : s->imports) add(i);
  }
  return names;
}

void Elaborator::unknown_name(Context c, const Path& path, Diag id,
                              const std::vector<std::string>& inside) {
  const Binding* space = find(c.scope, path[0].text);
  const bool missing = space && space->form == Binding::Form::Namespace && space->scope->missing &&
                       diagnostics_.has_errors();
  if (missing) return;  // its import was reported
  std::string spelled = path[0].text;
  for (std::size_t i = 1; i < path.size(); ++i) spelled += "::" + path[i].text;
  const bool full = diagnostics_.error_count() >= kMaxErrors;
  Diagnostic& d = diagnostics_.add(id, join(path.front().span, path.back().span), spelled);
  if (full) return;  // to look for the nearest of many names takes its time
  std::vector<std::string> names = visible_names(c.scope);
  names.insert(names.begin(), inside.begin(), inside.end());
  const std::string near = nearest(path.back().text, names);
  if (!near.empty()) d.help(fmt::format("did you mean `{}`?", near));
  const bool variable =
      std::any_of(vm::kVariables.begin(), vm::kVariables.end(),
                  [&](const vm::VariableInfo& v) { return v.name == path.back().text; });
  if (variable)
    d.help(fmt::format("what the renderer knows of the hit is written `${}`", path.back().text));
}

/// A size that a formal brought: -1, and said so, where it is no size.
int Elaborator::known_size(int size) {
  if (size >= 1 && size <= vm::limits::kAggregate) return size;
  if (size != kUnknownSize)
    diagnostics_.add(Diag::ArraySize, user_span_, size, vm::limits::kAggregate);
  else if (!unknown_arguments_)
    diagnostics_.add(Diag::NeedsConstant, user_span_, "the size of an array");
  return -1;
}

int Elaborator::resolve_dim(Context c, const TypeExpr::Dim& d, const Generics* generics) {
  using Form = TypeExpr::Dim::Form;
  if (d.form == Form::Open) {
    diagnostics_.add(Diag::OpenArray, d.span).help("state the size, for example `real[3]`");
    return -1;
  }
  std::int64_t size = d.value;
  if (d.form != Form::Integer) {
    if (generics && d.path.size() == 1) {
      auto it = generics->dims.find(d.path[0].text);
      if (it != generics->dims.end()) return known_size(it->second);
    }
    Binding* b = find(c, d.path);
    if (!b) {
      unknown_name(c, d.path, Diag::UnknownName);
      return -1;
    }
    const Value v = b->form == Binding::Form::Constant ? evaluate_constant(*b) : b->value;
    const auto n = known_integer(v);
    if (!n && unknown_arguments_) return -1;
    if (!n) {
      diagnostics_.add(Diag::NeedsConstant, d.span, "the size of an array");
      return -1;
    }
    size = *n;
  }
  if (size < 1 || size > vm::limits::kAggregate) {
    diagnostics_.add(Diag::ArraySize, d.span, size, vm::limits::kAggregate);
    return -1;
  }
  return static_cast<int>(size);
}

/// All levels of an array or structure together are no more than kAggregate elements.
bool Elaborator::too_large(TypeId type, Span span) {
  const std::int64_t elements = types_.elements(type);
  if (elements <= vm::limits::kAggregate) return false;
  diagnostics_.add(Diag::ArraySize, span, elements, vm::limits::kAggregate);
  return true;
}

TypeId Elaborator::resolve_type(Context c, TypeHandle h, const Generics* generics) {
  const TypeExpr& t = (*c.graph)[h];
  switch (t.form) {
    case TypeExpr::Form::Basic:
      return types_.basic(t.basic);
    case TypeExpr::Form::Generic:
    case TypeExpr::Form::Named: {
      if (generics && t.path.size() == 1) {
        auto it = generics->types.find(t.path[0].text);
        if (it != generics->types.end()) return it->second;
      }
      if (t.form == TypeExpr::Form::Generic) {
        diagnostics_.add(Diag::GenericHere, t.span, t.path[0].text);
        return kPoison;
      }
      Binding* b = find(c, t.path);
      if (!b) {
        unknown_name(c, t.path, Diag::UnknownType);
        return kPoison;
      }
      if (b->form != Binding::Form::Type) {
        diagnostics_.add(Diag::NotAType, t.span, t.path.back().text).note(b->span, "defined here");
        return kPoison;
      }
      return type_of(*b);
    }
    case TypeExpr::Form::Array: {
      TypeId type = resolve_type(c, t.element, generics);
      for (std::size_t i = t.dims.size(); i-- > 0;) {
        const int size = resolve_dim(c, t.dims[i], generics);
        if (size < 0 || type == kPoison) return kPoison;
        type = types_.array(type, size);
        if (too_large(type, t.span)) return kPoison;
      }
      if (types_.rank(type) > 2) {
        diagnostics_.add(Diag::ArrayRank, t.span);
        return kPoison;
      }
      return type;
    }
    case TypeExpr::Form::Function: {
      std::vector<TypeId> formals;
      for (TypeHandle f : t.formals) formals.push_back(resolve_type(c, f, generics));
      return types_.function(std::move(formals), resolve_type(c, t.element, generics));
    }
  }
  return kPoison;
}

bool Elaborator::unify_dim(Context c, const TypeExpr::Dim& d, int size, Generics& g) {
  using Form = TypeExpr::Dim::Form;
  if (d.form == Form::Open) return true;
  if (d.form == Form::Integer) return d.value == size;
  const std::string& name = d.path[0].text;
  auto it = g.dims.find(name);
  if (it != g.dims.end()) return it->second == size;
  if (d.form == Form::Named) {
    Binding* b = find(c, d.path);
    if (b && (b->form == Binding::Form::Constant || b->form == Binding::Form::Value)) {
      const auto n =
          known_integer(b->form == Binding::Form::Constant ? evaluate_constant(*b) : b->value);
      return n && *n == size;
    }
  }
  g.dims[name] = size;
  return true;
}

/// A generic may be used before the formal that introduces it: `T[n] xs, function(generic T) ...`.
void Elaborator::collect_generics(Context c, TypeHandle h, Generics& g) {
  const TypeExpr& t = (*c.graph)[h];
  if (t.form == TypeExpr::Form::Generic) g.names.insert(t.path[0].text);
  if (t.form == TypeExpr::Form::Array || t.form == TypeExpr::Form::Function)
    collect_generics(c, t.element, g);
  for (TypeHandle f : t.formals) collect_generics(c, f, g);
}

/// Fits `actual` to a formal's type, binding generics and dimension variables on the way.
bool Elaborator::unify(Context c, TypeHandle pattern, TypeId actual, Generics& g, int& cost) {
  constexpr int kGenericCost = 10;  // an exact overload beats a generic one
  if (actual == kPoison) return true;
  const TypeExpr& t = (*c.graph)[pattern];
  const bool introduced = t.path.size() == 1 && g.names.count(t.path[0].text) > 0;
  if (t.form == TypeExpr::Form::Generic || (t.form == TypeExpr::Form::Named && introduced)) {
    cost += kGenericCost;
    auto [it, is_new] = g.types.try_emplace(t.path[0].text, actual);
    if (is_new) return true;
    const TypeId joined = types_.join(it->second, actual);
    if (joined == kPoison) return false;
    it->second = joined;
    return true;
  }
  if (t.form == TypeExpr::Form::Array) {
    TypeId element = actual;
    for (const TypeExpr::Dim& d : t.dims) {
      if (!types_.is_array(element) || !unify_dim(c, d, types_[element].size, g)) return false;
      element = types_[element].parts[0];
    }
    return unify(c, t.element, element, g, cost);
  }
  if (t.form == TypeExpr::Form::Function) {
    if (actual == kClosure) return true;
    const Type& f = types_[actual];
    if (f.form != Type::Form::Function || f.parts.size() != t.formals.size() + 1) return false;
    for (std::size_t i = 0; i < t.formals.size(); ++i)
      if (!unify(c, t.formals[i], f.parts[i], g, cost)) return false;
    return unify(c, t.element, f.parts.back(), g, cost);
  }
  const TypeId wanted = resolve_type(c, pattern, &g);
  const int steps = types_.widening(actual, wanted);
  if (steps < 0) return false;
  cost += steps;
  return true;
}

}  // namespace mms::lang
