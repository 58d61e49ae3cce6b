// SPDX-License-Identifier: Apache-2.0
/// \file
/// Calls: overloads, generics, builtins, function values.

#include <algorithm>

#include "lang/conservation.h"
#include "lang/elaborator.h"
#include "lang/parser.h"
#include "vm/limits.h"

namespace mms::lang {
namespace {

using vm::Op;
using vm::SlotType;

}  // namespace

/// The header of a builtin row, parsed by the language's own parser.
struct Elaborator::Signature {
  Graph graph;
  std::vector<SlotType> params, results;
  TypeId result = TypeTable::kPoison;
  bool all_real = true;  ///< then a spectrum may stand for any argument
  const Function& function() const { return graph.functions[0]; }
};

Elaborator::Elaborator(const Library& library, const LinkOptions& options, Diagnostics& diagnostics)
    : library_(library), options_(options), diagnostics_(diagnostics) {}
Elaborator::~Elaborator() = default;

const Elaborator::Signature& Elaborator::signature(const vm::Builtin* row) {
  std::unique_ptr<Signature>& s = signatures_[row];
  if (s) return *s;
  s = std::make_unique<Signature>();
  s->graph = parse_signature(make_source("<library>", std::string(row->signature)), diagnostics_);
  const Function& f = s->function();
  const Context c{&s->graph, library_scope_};
  for (const Formal& formal : f.formals) {
    const TypeId t = resolve_type(c, formal.type, nullptr);
    if (t != TypeTable::kMaterial) slot_types(t, s->params);
    s->all_real = s->all_real && t == TypeTable::kReal;
  }
  s->result = resolve_type(c, f.result, nullptr);
  s->all_real = s->all_real && s->result == TypeTable::kReal && !f.formals.empty();
  if (s->result != TypeTable::kMaterial) slot_types(s->result, s->results);
  return *s;
}

std::vector<BoundArgument> Elaborator::arguments(Context c, const Expr& e) {
  std::vector<BoundArgument> args;
  for (const Argument& a : e.arguments)
    args.push_back({a.name, expr(c, a.value), (*c.graph)[a.value].span});
  return args;
}

Value Elaborator::expr_call(Context c, const Expr& e) {
  const Expr& callee = (*c.graph)[e.args[0]];
  if (callee.form == Expr::Form::Name && !callee.parenthesised) {
    std::vector<BoundArgument> args = arguments(c, e);
    return call_named(c, callee.path, std::move(args), e.span);
  }
  const Value f = expr(c, e.args[0]);
  if (f.poison()) return {};
  if (!types_.is_function(f.type)) {
    diagnostics_.add(Diag::NotCallable, callee.span, spell(f))
        .help("multiplication is written with `*`");
    return {};
  }
  return call_function_value(f, arguments(c, e), e.span);
}

Value Elaborator::call_named(Context c, const Path& path, std::vector<BoundArgument> args,
                             Span span) {
  Binding* b = find(c, path);
  if (!b) {
    // Named in the language's design, not made yet: said so rather than called unknown.
    static constexpr std::string_view kLater[] = {"spectral", "gradient", "image"};
    if (std::find(std::begin(kLater), std::end(kLater), path[0].text) != std::end(kLater))
      diagnostics_.add(Diag::NotYet, span, path[0].text);
    else
      unknown_name(c, path, Diag::UnknownFunction);
    return {};
  }
  if (b->form == Binding::Form::Type) return construct(b->type, args, span);
  if (b->form == Binding::Form::Value && types_.is_function(b->value.type))
    return call_function_value(b->value, std::move(args), span);
  if (b->form == Binding::Form::Constant) {
    const Value f = evaluate_constant(*b);
    if (f.poison()) return {};
    if (types_.is_function(f.type)) return call_function_value(f, std::move(args), span);
  }
  if (b->form != Binding::Form::Functions) {
    if (b->form != Binding::Form::Value || !b->value.poison())
      diagnostics_.add(Diag::NotCallable, span, path.back().text)
          .note(b->span, "defined here")
          .help("multiplication is written with `*`");
    return {};
  }
  std::vector<std::vector<Candidate>> levels;
  auto level = [&](const Binding& f) {
    levels.emplace_back();
    for (FunctionDecl* d : f.functions) levels.back().push_back({d, nullptr});
    for (const vm::Builtin* r : f.rows) levels.back().push_back({nullptr, r});
  };
  if (path.size() > 1) {
    level(*b);
  } else {
    for (Scope* s = c.scope; s; s = s->parent) {
      auto add = [&](Scope* from) {
        auto it = from->names.find(path[0].text);
        if (it != from->names.end() && it->second.form == Binding::Form::Functions)
          level(it->second);
      };
      add(s);
      for (Scope* i : s->imports) add(i);
    }
  }
  return call_candidates(levels, path.back().text, args, span);
}

Value Elaborator::call_library(std::string_view name, std::vector<Value> values, Span span) {
  for (const Value& v : values)
    if (v.poison()) return {};
  std::vector<BoundArgument> args;
  for (Value& v : values) args.push_back({std::nullopt, std::move(v), span});
  std::vector<std::vector<Candidate>> levels(1);
  auto it = library_scope_->names.find(name);
  if (it != library_scope_->names.end()) {
    for (FunctionDecl* d : it->second.functions) levels[0].push_back({d, nullptr});
    for (const vm::Builtin* r : it->second.rows) levels[0].push_back({nullptr, r});
  }
  return call_candidates(levels, name, args, span);
}

std::string Elaborator::describe(const Candidate& k) {
  if (k.row) return std::string(k.row->signature);
  const Span s = k.decl->function().header;
  return s.source ? s.source->text.substr(s.begin, s.end - s.begin) : k.decl->function().name.text;
}

Value Elaborator::call_candidates(const std::vector<std::vector<Candidate>>& levels,
                                  std::string_view name, std::vector<BoundArgument>& args,
                                  Span span) {
  for (const BoundArgument& a : args)
    if (a.value.poison()) return {};
  std::string why;
  std::vector<std::string> seen;
  for (const std::vector<Candidate>& level : levels) {
    Match best;
    const Candidate* winner = nullptr;
    bool tie = false;
    for (const Candidate& k : level) {
      Match m = match(k, args);
      if (m.cost < 0) {
        why = m.why;
        seen.push_back(describe(k));
        continue;
      }
      tie = winner && m.cost == best.cost;
      if (!winner || m.cost < best.cost) {
        best = std::move(m);
        winner = &k;
      }
    }
    if (!winner) continue;
    if (tie) diagnostics_.add(Diag::Ambiguous, span, name);
    return winner->row ? call_builtin(winner->row, best, args, span)
                       : call_script(winner->decl, best, args, span);
  }
  std::vector<TypeId> types;
  for (const BoundArgument& a : args) types.push_back(a.value.type);
  Diagnostic& d = diagnostics_.add(Diag::NoOverload, span, name, types_.spell(types));
  if (seen.size() == 1 && !why.empty()) d.labelled(why);
  for (std::size_t i = 0; i < seen.size() && i < 8; ++i) d.help("there is `" + seen[i] + "`");
  return {};
}

/// Gives each formal its argument: by position first, then by name.
bool Elaborator::bind_formals(const Function& f, const std::vector<BoundArgument>& args, Match& m) {
  m.argument.assign(f.formals.size(), -1);
  for (std::size_t i = 0; i < args.size(); ++i) {
    std::size_t k = i;
    if (args[i].name) {
      k = 0;
      while (k < f.formals.size() && f.formals[k].name.text != args[i].name->text) ++k;
      if (k == f.formals.size()) {
        m.why = fmt::format("it has no argument `{}`", args[i].name->text);
        return false;
      }
    }
    if (k >= f.formals.size()) {
      m.why = fmt::format("it takes {} argument{}, found {}", f.formals.size(),
                          f.formals.size() == 1 ? "" : "s", args.size());
      return false;
    }
    if (m.argument[k] >= 0) {
      m.why = fmt::format("its argument `{}` is given twice", f.formals[k].name.text);
      return false;
    }
    m.argument[k] = static_cast<int>(i);
  }
  for (std::size_t k = 0; k < f.formals.size(); ++k)
    if (m.argument[k] < 0 && !f.formals[k].default_value) {
      m.why = fmt::format("its argument `{}` is missing", f.formals[k].name.text);
      return false;
    }
  return true;
}

Elaborator::Match Elaborator::match(const Candidate& k, const std::vector<BoundArgument>& args) {
  constexpr int kLiftCost = 4;  // a spectrum for a real: after every plain widening
  Match m;
  const Signature* s = k.row ? &signature(k.row) : nullptr;
  const Function& f = s ? s->function() : k.decl->function();
  const Context c = s ? Context{&s->graph, library_scope_} : Context{k.decl->graph, k.decl->scope};
  if (!bind_formals(f, args, m)) return m;
  for (const Formal& formal : f.formals) collect_generics(c, formal.type, m.generics);
  int cost = 0;
  for (std::size_t i = 0; i < f.formals.size(); ++i) {
    if (m.argument[i] < 0) continue;
    const TypeId type = args[static_cast<std::size_t>(m.argument[i])].value.type;
    if (s && s->all_real && type == TypeTable::kSpectrum) {
      cost += kLiftCost;
    } else if (!unify(c, f.formals[i].type, type, m.generics, cost)) {
      m.why = fmt::format("its argument `{}` does not take `{}`", f.formals[i].name.text,
                          types_.spell(type));
      return m;
    }
  }
  m.cost = cost;
  return m;
}

Value Elaborator::call_builtin(const vm::Builtin* row, const Match& m,
                               std::vector<BoundArgument>& args, Span span) {
  const Signature& s = signature(row);
  const Function& f = s.function();
  const Context c{&s.graph, library_scope_};
  std::vector<Value> values;
  bool lifted = false;
  for (std::size_t i = 0; i < f.formals.size(); ++i) {
    const int k = m.argument[i];
    Value v = k >= 0 ? std::move(args[static_cast<std::size_t>(k)].value)
                     : expr(c, f.formals[i].default_value);
    if (s.all_real && v.type == TypeTable::kSpectrum) {
      lifted = true;
    } else {
      v = convert(v, resolve_type(c, f.formals[i].type, &m.generics), span);
    }
    if (v.poison()) return {};
    values.push_back(std::move(v));
  }
  line_ = line_of(span);
  if (row->lobe >= 0) {
    check_factor(f, values, span);
    return make_material(row, values);
  }
  if (lifted) return call_spectral(row, values, span);
  std::vector<Ref> refs;
  for (const Value& v : values) flatten(v, refs);
  const Ref r = node(Op::CallBuiltin, std::move(refs), module.builtin(row, s.params, s.results), 0,
                     s.results);
  std::vector<Ref> results;
  for (std::size_t k = 0; k < s.results.size(); ++k)
    results.push_back({r.node, static_cast<std::uint16_t>(k), r.function});
  std::size_t next = 0;
  return unflatten(s.result, results, next);
}

Value Elaborator::call_spectral(const vm::Builtin* row, const std::vector<Value>& values, Span) {
  const Signature& s = signature(row);
  std::vector<Ref> refs;
  std::uint32_t mask = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    refs.push_back(values[k].refs[0]);
    if (values[k].type == TypeTable::kSpectrum) mask |= 1u << k;
  }
  return scalar(TypeTable::kSpectrum, node(Op::CallSpectral, std::move(refs),
                                           module.builtin(row, s.params, s.results), mask));
}

/// The factor `t` of a combiner is a part of the whole.
void Elaborator::check_factor(const Function& f, const std::vector<Value>& values, Span span) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (f.formals[i].name.text != "t" || values[i].refs.empty()) continue;
    const std::optional<double> t = known_number(module, values[i].refs[0]);
    if (t && !(*t >= 0 && *t <= 1)) diagnostics_.add(Diag::MixFactor, span, *t);
  }
}

Value Elaborator::make_material(const vm::Builtin* row, const std::vector<Value>& values) {
  auto tree = std::make_shared<MaterialTree>();
  tree->row = row;
  for (const Value& v : values) {
    if (v.type == TypeTable::kMaterial) {
      tree->children.push_back(v.material);
      continue;
    }
    flatten(v, tree->params);
    slot_types(v.type, tree->types);
  }
  Value v;
  v.type = TypeTable::kMaterial;
  v.material = std::move(tree);
  return v;
}

/// A structure or an enumeration is made by its name.
Value Elaborator::construct(TypeId type, std::vector<BoundArgument>& args, Span span) {
  const Type t = types_[type];
  for (const BoundArgument& a : args)
    if (a.value.poison()) return {};
  if (t.form != Type::Form::Struct) {
    diagnostics_.add(Diag::NotCallable, span, types_.spell(type));
    return {};
  }
  std::vector<std::optional<Value>> fields(t.parts.size());
  for (std::size_t i = 0; i < args.size(); ++i) {
    std::size_t k = i;
    if (args[i].name)
      k = static_cast<std::size_t>(
          std::find(t.members.begin(), t.members.end(), args[i].name->text) - t.members.begin());
    if (k >= fields.size() || fields[k]) {
      diagnostics_.add(Diag::StructArguments, span, t.name, t.members.size());
      return {};
    }
    fields[k] = convert(args[i].value, t.parts[k], args[i].span);
  }
  Value v;
  v.type = type;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (!fields[k]) {
      diagnostics_.add(Diag::StructArguments, span, t.name, t.members.size())
          .help(fmt::format("its field `{}` is missing", t.members[k]));
      return {};
    }
    v.parts.push_back(std::move(*fields[k]));
  }
  return v;
}

Value Elaborator::call_function_value(const Value& f, std::vector<BoundArgument> args, Span span) {
  for (const BoundArgument& a : args)
    if (a.value.poison()) return {};
  const Type type = types_[f.type];
  const bool stated = type.form == Type::Form::Function;
  if (stated) {
    if (type.parts.size() != args.size() + 1) {
      diagnostics_.add(Diag::ArgumentCount, span, spell(f), type.parts.size() - 1, args.size());
      return {};
    }
    for (std::size_t i = 0; i < args.size(); ++i) {
      args[i].value = convert(args[i].value, type.parts[i], args[i].span);
      if (args[i].value.poison()) return {};
    }
  }
  const FunctionValue& fn = *f.function;
  Value v;
  if (fn.op) {
    if (args.size() == 1 && (*fn.op == Operator::Sub || *fn.op == Operator::Neg)) {
      v = negate(args[0].value, span);
    } else if (args.size() == 2) {
      v = binary(*fn.op, args[0].value, args[1].value, span);
    } else {
      diagnostics_.add(Diag::ArgumentCount, span, std::string("#") + std::string(spelling(*fn.op)),
                       2, args.size());
      return {};
    }
  } else if (!fn.path.empty()) {
    v = call_named({fn.graph, fn.scope}, fn.path, std::move(args), span);
  } else {
    v = call_lambda(fn, args, span);
  }
  return stated ? convert(v, type.parts.back(), span) : v;
}

Value Elaborator::call_lambda(const FunctionValue& f, std::vector<BoundArgument>& args, Span span) {
  const Expr& e = (*f.graph)[f.lambda];
  if (args.size() != e.formals.size()) {
    diagnostics_.add(Diag::ArgumentCount, span, "the function", e.formals.size(), args.size())
        .note(e.span, "defined here");
    return {};
  }
  if (frames_.size() >= static_cast<std::size_t>(vm::limits::kInlineDepth)) {
    diagnostics_.add(Diag::TooDeep, span, vm::limits::kInlineDepth);
    return {};
  }
  Scope* scope = new_scope(f.scope);
  for (std::size_t i = 0; i < args.size(); ++i) {
    Binding b;
    b.value = args[i].value;
    if (e.formals[i].type)
      b.value = convert(b.value, resolve_type({f.graph, scope}, e.formals[i].type, nullptr),
                        args[i].span);
    declare(scope, e.formals[i].name, std::move(b));
  }
  frames_.push_back({nullptr, dynamic_, false, inlined_});
  diagnostics_.enter_call(span, "function");
  const Value v = expr({f.graph, scope}, e.args[0]);
  diagnostics_.leave_call();
  frames_.pop_back();
  return v;
}

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

/// Generic results of function arguments are found by trying the function on its argument types.
void Elaborator::infer_results(Context c, const Function& f, const std::vector<Value>& formals,
                               Generics& g) {
  for (std::size_t i = 0; i < f.formals.size(); ++i) {
    const TypeExpr& t = (*c.graph)[f.formals[i].type];
    if (t.form != TypeExpr::Form::Function || formals[i].type != TypeTable::kClosure) continue;
    const TypeExpr& result = (*c.graph)[t.element];
    const bool named =
        result.form == TypeExpr::Form::Generic || result.form == TypeExpr::Form::Named;
    if (!named || result.path.size() != 1 || g.types.count(result.path[0].text)) continue;
    if (result.form == TypeExpr::Form::Named && find(c.scope, result.path[0].text)) continue;
    std::vector<BoundArgument> args;
    for (TypeHandle p : t.formals) {
      const TypeId type = resolve_type(c, p, &g);
      std::vector<SlotType> slots;
      slot_types(type, slots);
      std::vector<Ref> refs;
      // Values nobody knows: the type alone must decide.
      for (SlotType s : slots) refs.push_back(node(Op::LoadLocal, {}, 0, 0, {s}));
      std::size_t next = 0;
      args.push_back({std::nullopt, unflatten(type, refs, next), {}});
    }
    g.types[result.path[0].text] =
        call_function_value(formals[i], std::move(args), f.formals[i].name.span).type;
  }
}

Value Elaborator::call_script(FunctionDecl* d, const Match& m, std::vector<BoundArgument>& args,
                              Span span) {
  const Function& f = d->function();
  const Context c{d->graph, d->scope};
  Generics g = m.generics;
  std::vector<Value> formals;
  for (std::size_t i = 0; i < f.formals.size(); ++i) {
    const int k = m.argument[i];
    formals.push_back(k >= 0 ? std::move(args[static_cast<std::size_t>(k)].value)
                             : expr(c, f.formals[i].default_value));
    if (formals.back().poison()) return {};
  }
  infer_results(c, f, formals, g);
  for (std::size_t i = 0; i < f.formals.size(); ++i) {
    const TypeId type = formal_type(c, f.formals[i].type, formals[i].type, g);
    formals[i] = convert(formals[i], type, span, (*d->graph)[f.formals[i].type].span);
    if (formals[i].poison()) return {};
  }
  const TypeId result = resolve_type(c, f.result, &g);
  if (result == TypeTable::kPoison) return {};
  line_ = line_of(span);
  return invoke(d, formals, g, result, span);
}

}  // namespace mms::lang
