// SPDX-License-Identifier: Apache-2.0
/// \file
/// Calls: overloads, builtins, function values.

#include <algorithm>

#include "lang/conservation.h"
#include "lang/elaborator.h"
#include "lang/parser.h"
#include "vm/limits.h"
#include "vm/outputs.h"

namespace mms::lang {
namespace {

using vm::Op;

}  // namespace

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
    if (t != kMaterial) slot_types(t, s->params);
    s->all_real = s->all_real && t == kReal;
  }
  s->result = resolve_type(c, f.result, nullptr);
  s->all_real = s->all_real && s->result == kReal && !f.formals.empty();
  if (s->result != kMaterial) slot_types(s->result, s->results);
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

/// An output's name, such as `gradient`, may be a library function's too, which is still meant
/// where it is called.
bool Elaborator::hides_library_function(const Path& path) const {
  auto it = library_scope_->names.find(path[0].text);
  const bool function = path.size() == 1 && it != library_scope_->names.end() &&
                        it->second.form == Binding::Form::Functions;
  for (std::size_t o = 0; function && o < vm::kOutputCount; ++o)
    for (const auto form : {vm::DescriptorForm::Surface, vm::DescriptorForm::Volume})
      if (vm::output_name(form, static_cast<vm::Output>(o)) == path[0].text) return true;
  return false;
}

Value Elaborator::call_named(Context c, const Path& path, std::vector<BoundArgument> args,
                             Span span) {
  if (c.scope->library && path.size() == 2 && path[0].text == "intrinsic")
    return call_intrinsic(path[1].text, args);
  Binding* b = find(c, path);
  if (!b) {
    unknown_name(c, path, Diag::UnknownFunction);
    return {};
  }
  if (b->form == Binding::Form::Type) return construct(type_of(*b), args, span);
  if (b->form == Binding::Form::Value && types_.is_function(b->value.type))
    return call_function_value(b->value, std::move(args), span);
  if (b->form == Binding::Form::Constant) {
    const Value f = evaluate_constant(*b);
    if (f.poison()) return {};
    if (types_.is_function(f.type)) return call_function_value(f, std::move(args), span);
  }
  if (b->form != Binding::Form::Functions && !hides_library_function(path)) {
    if (b->form != Binding::Form::Value || !b->value.poison())
      diagnostics_.add(Diag::NotCallable, span, path.back().text)
          .note(b->span, "defined here")
          .help("multiplication is written with `*`");
    return {};
  }
  return call_candidates(candidates(c, path, *b), path.back().text, args, span);
}

/// The functions that `path`, which names `b`, may mean: those of the innermost scope first.
std::vector<std::vector<Elaborator::Candidate>> Elaborator::candidates(Context c, const Path& path,
                                                                       const Binding& b) {
  std::vector<std::vector<Candidate>> levels;
  auto add = [&](const Binding& f) {
    for (FunctionDecl* d : f.functions) levels.back().push_back({d, nullptr});
    for (const vm::Builtin* r : f.rows) levels.back().push_back({nullptr, r});
  };
  if (path.size() > 1) {
    levels.emplace_back();
    add(b);
    return levels;
  }
  for (Scope* s = c.scope; s; s = s->parent) {
    levels.emplace_back();
    for (const Binding* f : bindings_in(s, path[0].text))
      if (f->form == Binding::Form::Functions) add(*f);
    if (levels.back().empty()) levels.pop_back();
  }
  return levels;
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
  if (!s.source) return k.decl->function().name.text;
  return std::string(text_of(s));
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
    const Candidate* rival = nullptr;
    for (const Candidate& k : level) {
      Match m = match(k, args);
      if (m.cost < 0) {
        why = m.why;
        seen.push_back(describe(k));
        continue;
      }
      if (winner && m.cost == best.cost) rival = &k;
      if (winner && m.cost < best.cost) rival = nullptr;
      if (!winner || m.cost < best.cost) {
        best = std::move(m);
        winner = &k;
      }
    }
    if (!winner) continue;
    if (rival) {
      Diagnostic& d = diagnostics_.add(Diag::Ambiguous, span, name);
      for (const Candidate* k : {winner, rival})
        if (k->decl) d.note(k->decl->function().header, "this one fits");
    }
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
bool Elaborator::bind_formals(const std::vector<Formal>& formals,
                              const std::vector<BoundArgument>& args, std::vector<int>& argument,
                              std::string& why) {
  argument.assign(formals.size(), -1);
  for (std::size_t i = 0; i < args.size(); ++i) {
    std::size_t k = i;
    if (args[i].name) {
      k = 0;
      while (k < formals.size() && formals[k].name.text != args[i].name->text) ++k;
      if (k == formals.size()) {
        why = fmt::format("it has no argument `{}`", args[i].name->text);
        return false;
      }
    }
    if (k >= formals.size()) {
      why = fmt::format("it takes {} argument{}, found {}", formals.size(),
                        formals.size() == 1 ? "" : "s", args.size());
      return false;
    }
    if (argument[k] >= 0) {
      why = fmt::format("its argument `{}` is given twice", formals[k].name.text);
      return false;
    }
    argument[k] = static_cast<int>(i);
  }
  for (std::size_t k = 0; k < formals.size(); ++k)
    if (argument[k] < 0 && !formals[k].default_value) {
      why = fmt::format("its argument `{}` is missing", formals[k].name.text);
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
  if (!bind_formals(f.formals, args, m.argument, m.why)) return m;
  for (const Formal& formal : f.formals) collect_generics(c, formal.type, m.generics);
  int cost = 0;
  for (std::size_t i = 0; i < f.formals.size(); ++i) {
    if (m.argument[i] < 0) continue;
    const TypeId type = args[static_cast<std::size_t>(m.argument[i])].value.type;
    if (s && s->all_real && type == kSpectrum) {
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
    if (s.all_real && v.type == kSpectrum) {
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
    if (values[k].type == kSpectrum) mask |= 1u << k;
  }
  return scalar(kSpectrum, node(Op::CallSpectral, std::move(refs),
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
    if (v.type == kMaterial) {
      tree->children.push_back(v.material);
      continue;
    }
    flatten(v, tree->params);
    slot_types(v.type, tree->types);
  }
  Value v;
  v.type = kMaterial;
  v.material = sole_part(module, *tree);
  if (!v.material) v.material = std::move(tree);
  return v;
}

/// A structure or an enumeration is made by its name.
Value Elaborator::construct(TypeId type, std::vector<BoundArgument>& args, Span span) {
  const Type t = types_[type];
  for (const BoundArgument& a : args)
    if (a.value.poison()) return {};
  if (type == kPoison) return {};
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
      if (!args[i].name) continue;
      diagnostics_.add(Diag::NoOverload, span, "function", spell(args[i].value))
          .labelled(fmt::format("it has no argument `{}`", args[i].name->text))
          .help("the formals of a function type have no names: give its arguments by position");
      return {};
    }
  }
  const FunctionValue& fn = *f.function;
  if (fn.opaque) return stated ? unknown_value(type.parts.back()) : Value{};
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
  if (args.size() != e.rare->formals.size()) {
    diagnostics_.add(Diag::ArgumentCount, span, "the function", e.rare->formals.size(), args.size())
        .note(e.span, "defined here");
    return {};
  }
  if (frames_.size() >= static_cast<std::size_t>(vm::limits::kInlineDepth)) {
    diagnostics_.add(Diag::TooDeep, span, vm::limits::kInlineDepth);
    return {};
  }
  std::vector<int> order;
  std::string why;
  if (!bind_formals(e.rare->formals, args, order, why)) {
    std::vector<TypeId> types;
    for (const BoundArgument& a : args) types.push_back(a.value.type);
    diagnostics_.add(Diag::NoOverload, span, "function", types_.spell(types))
        .labelled(why)
        .note(e.span, "defined here");
    return {};
  }
  Scope* scope = new_scope(f.scope);
  for (std::size_t i = 0; i < args.size(); ++i) {
    const BoundArgument& given = args[static_cast<std::size_t>(order[i])];
    Binding b;
    b.value = given.value;
    if (e.rare->formals[i].type)
      b.value = convert(b.value, resolve_type({f.graph, scope}, e.rare->formals[i].type, nullptr),
                        given.span);
    declare(scope, e.rare->formals[i].name, std::move(b));
  }
  frames_.push_back({nullptr, dynamic_, false, inlined_});
  diagnostics_.enter_call(span, "function");
  const Value v = expr({f.graph, scope}, e.args[0]);
  diagnostics_.leave_call();
  frames_.pop_back();
  return v;
}

/// The arguments of a call and, for formals without one, their defaults: these see the formals
/// before them.
std::vector<Value> Elaborator::with_defaults(FunctionDecl* d, const Match& m,
                                             std::vector<BoundArgument>& args) {
  const Function& f = d->function();
  const Context outside{d->graph, d->scope};
  const bool defaults = std::find(m.argument.begin(), m.argument.end(), -1) != m.argument.end();
  const Context inside{d->graph, defaults ? new_scope(d->scope, d->library) : nullptr};
  if (defaults) declare_generics(inside.scope, f, m.generics);
  std::vector<Value> formals;
  for (std::size_t i = 0; i < f.formals.size(); ++i) {
    const int k = m.argument[i];
    formals.push_back(k >= 0 ? std::move(args[static_cast<std::size_t>(k)].value)
                             : expr(inside, f.formals[i].default_value));
    if (formals.back().poison()) return {};
    if (!defaults) continue;
    Binding b;
    b.value = formals.back();
    if (ready(outside, f.formals[i].type, m.generics))
      b.value = convert(b.value, resolve_type(outside, f.formals[i].type, &m.generics),
                        k >= 0 ? args[static_cast<std::size_t>(k)].span
                               : (*d->graph)[f.formals[i].default_value].span);
    declare(inside.scope, f.formals[i].name, std::move(b));
  }
  return formals;
}

Value Elaborator::call_script(FunctionDecl* d, const Match& m, std::vector<BoundArgument>& args,
                              Span span) {
  const Function& f = d->function();
  const Context c{d->graph, d->scope};
  const Span outer = user_span_;
  const bool in_library = !frames_.empty() && frames_.back().decl && frames_.back().decl->library;
  if (!in_library) user_span_ = span;
  std::vector<Span> spans;
  for (int k : m.argument)
    spans.push_back(k < 0 || in_library ? user_span_ : args[static_cast<std::size_t>(k)].span);
  Generics g = m.generics;
  std::vector<Value> formals = with_defaults(d, m, args);
  if (formals.size() != f.formals.size() || !infer_results(c, f, formals, spans, g)) return {};
  for (const std::string& name : g.names)
    if (!g.types.count(name)) {
      if (!unknown_arguments_)
        diagnostics_.add(Diag::GenericHere, user_span_, name)
            .help("nothing says what the function gives: give it a stated type");
      return {};
    }
  Generics sizes = g;  // the size of a result may be an integer formal that is known at link
  for (std::size_t i = 0; i < f.formals.size(); ++i) {
    const TypeId type = formal_type(c, f.formals[i].type, formals[i].type, g);
    formals[i] = convert(formals[i], type, span, (*d->graph)[f.formals[i].type].span);
    if (formals[i].poison()) return {};
    if (formals[i].type != kInteger) continue;
    const auto n = known_integer(formals[i]);
    sizes.dims.emplace(f.formals[i].name.text, n ? static_cast<int>(*n) : kUnknownSize);
  }
  const TypeId result = resolve_type(c, f.result, &sizes);
  if (result == kPoison) return {};
  line_ = line_of(span);
  const Value v = invoke(d, formals, g, result, span);
  user_span_ = outer;
  return v;
}

}  // namespace mms::lang
