// SPDX-License-Identifier: Apache-2.0
/// \file
/// Sources, imports, params and descriptors of the elaborator.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "lang/elaborator.h"
#include "lang/parser.h"
#include "vm/limits.h"
#include "vm/outputs.h"

namespace mms::lang {
namespace {

using vm::Output;
using vm::SlotType;

using vm::OutputRow;

constexpr vm::DescriptorForm form_of(Descriptor::Form form) {
  return form == Descriptor::Form::Surface ? vm::DescriptorForm::Surface
                                           : vm::DescriptorForm::Volume;
}

std::string_view row_name(std::string_view signature) {
  const std::size_t end = signature.find('(');
  std::size_t begin = end;
  while (begin > 0 && signature[begin - 1] != ' ') --begin;
  return signature.substr(begin, end - begin);
}

std::optional<std::string> read_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace

std::uint16_t Elaborator::new_function(std::string name) {
  module.functions.push_back({std::move(name), {}, {}, {}, false});
  return static_cast<std::uint16_t>(module.functions.size() - 1);
}

std::uint32_t Elaborator::source_index(const Source* s) {
  auto [it, is_new] = source_index_.try_emplace(s, static_cast<std::uint32_t>(sources.size()));
  if (is_new) sources.push_back(s->name);
  return it->second;
}

vm::SourceLine Elaborator::line_of(Span s) {
  if (!s.source) return line_;
  const Position at = position_at(*s.source, s.begin);
  return {source_index(s.source), at.line, at.column};
}

void Elaborator::load_library() {
  library_scope_ = new_scope(nullptr, true);
  auto add_row = [](Scope* scope, const vm::Builtin& row) {
    Binding& b = scope->names[std::string(row_name(row.signature))];
    b.form = Binding::Form::Functions;
    b.library = true;
    b.rows.push_back(&row);
  };
  for (const vm::Builtin& row : library_.builtins) {
    add_row(library_scope_, row);
    Scope*& m = modules_[std::string(row.module)];
    if (!m) m = new_scope(nullptr, true);
    add_row(m, row);
  }
  for (const Library::Module& m : library_.modules) load_module(m);
}

void Elaborator::load_module(const Library::Module& m) {
  graphs_.push_back(
      parse(make_source(fmt::format("<{}>", m.name), std::string(m.text)), diagnostics_));
  const Graph& graph = graphs_.back();
  declare_items(graph, library_scope_);
  Scope*& scope = modules_[std::string(m.name)];
  if (!scope) scope = new_scope(nullptr, true);
  auto copy = [&](const std::string& name) { scope->names[name] = library_scope_->names[name]; };
  for (FunctionHandle h : graph.top_functions) copy(graph[h].name.text);
  for (const Constant& k : graph.constants) copy(k.name.text);
  for (const TypeDefinition& t : graph.type_definitions) copy(t.name.text);
}

void Elaborator::declare_items(const Graph& graph, Scope* scope) {
  const Context c{&graph, scope};
  for (const Constant& k : graph.constants) declare_constant(c, k);
  for (const TypeDefinition& t : graph.type_definitions) declare_type(c, t);
  for (FunctionHandle h : graph.top_functions) declare_function(c, h);
}

void Elaborator::import(const Graph& from, const Import& i, Scope* scope) {
  auto name_it = [&](Scope* space) {
    if (!i.as) return;
    Binding b;
    b.form = Binding::Form::Namespace;
    b.scope = space;
    declare(scope, *i.as, std::move(b));
  };
  namespace fs = std::filesystem;
  std::vector<fs::path> places{fs::path(from.source->name).parent_path() / i.file};
  for (const std::string& dir : options_.import_path) places.push_back(fs::path(dir) / i.file);
  for (const fs::path& place : places) {
    const std::string key = fs::weakly_canonical(place).string();
    auto known_file = imported_.find(key);
    if (known_file != imported_.end()) {
      if (!i.as && known_file->second != scope) scope->imports.push_back(known_file->second);
      return name_it(known_file->second);
    }
    std::optional<std::string> text = read_file(place);
    if (!text) continue;
    dependencies.push_back(place.string());
    graphs_.push_back(parse(make_source(place.string(), std::move(*text)), diagnostics_));
    Scope* space = i.as ? new_scope(library_scope_) : scope;
    imported_[key] = space;
    add_graph(graphs_.back(), space);
    return name_it(space);
  }
  auto library_module = modules_.find(i.file);
  if (library_module != modules_.end()) return name_it(library_module->second);
  Diagnostic& d = diagnostics_.add(Diag::ImportNotFound, i.span, i.file);
  std::vector<std::string> modules;
  for (const auto& [name, unused] : modules_) modules.push_back(name);
  const std::string near = nearest(i.file, modules);
  d.help(near.empty() ? "files are looked for beside the script, then in each `-I` folder"
                      : fmt::format("did you mean the library's `{}`?", near));
}

void Elaborator::add_graph(const Graph& graph, Scope* scope) {
  for (const Import& i : graph.imports) import(graph, i, scope);
  add_params(graph, scope);
  declare_items(graph, scope);
  add_aliases(graph, scope);
}

/// A param is a constant whose value the command line may replace.
void Elaborator::add_params(const Graph& graph, Scope* scope) {
  for (const Param& p : graph.params) {
    Binding b;
    b.form = Binding::Form::Constant;
    b.graph = &graph;
    b.scope = scope;
    b.expr = p.value;
    b.type =
        resolve_type({&graph, scope}, p.type, nullptr);  // a replaced value is in another graph
    for (const auto& [name, text] : options_.params) {
      if (name != p.name.text) continue;
      graphs_.push_back(parse_expression(make_source("--param " + name, text), diagnostics_));
      if (graphs_.back().exprs.empty()) continue;
      b.graph = &graphs_.back();
      b.expr = {static_cast<std::uint32_t>(graphs_.back().exprs.size() - 1)};
    }
    declare(scope, p.name, std::move(b));
    describe_param(graph, p, scope);
  }
}

void Elaborator::describe_param(const Graph& graph, const Param& p, Scope* scope) {
  const Context c{&graph, scope};
  Binding* b = find(scope, p.name.text);
  const Span value_span = (*b->graph)[b->expr].span;
  const Value v = evaluate_constant(*b);
  ParamInfo info{p.name.text, types_.spell(b->type), p.doc, {}, {}, {}, {}, {}};
  std::vector<Ref> refs;
  flatten(v, refs);
  for (Ref r : refs) {
    const vm::Constant* k = known(r);
    if (k) info.value.push_back(k->type == SlotType::Real ? k->f64 : k->integer);
  }
  auto number = [&](ExprHandle h) -> std::optional<double> {
    const Value n = convert(expr(c, h), TypeTable::kReal, graph[h].span);
    const vm::Constant* k = n.poison() ? nullptr : known(n.refs[0]);
    return k ? std::optional<double>(k->f64) : std::nullopt;
  };
  if (p.lower && p.upper) {
    const auto lo = number(p.lower), hi = number(p.upper);
    if (lo && hi) info.range = {*lo, *hi};
    for (double x : info.value)
      if (lo && hi && !(*lo <= x && x <= *hi))
        diagnostics_.add(Diag::ParamRange, value_span, p.name.text, x, *lo, *hi);
  }
  for (const Param::Meta& m : p.meta) {
    const Value text = expr(c, m.value);
    std::string* slot = m.key.text == "label"  ? &info.label
                        : m.key.text == "unit" ? &info.unit
                        : m.key.text == "page" ? &info.page
                                               : nullptr;
    if (!slot) {
      diagnostics_.add(Diag::UnknownMeta, m.key.span, m.key.text)
          .help("there are `label`, `unit` and `page`");
      continue;
    }
    *slot = convert(text, TypeTable::kString, graph[m.value].span).text;
  }
  params.push_back(std::move(info));
}

void Elaborator::add_aliases(const Graph& graph, Scope* scope) {
  for (const Alias& a : graph.aliases) {
    Binding* b = find({&graph, scope}, a.inside);
    if (!b) {
      const bool is_descriptor =
          std::any_of(graph.descriptors.begin(), graph.descriptors.end(),
                      [&](const Descriptor& d) { return d.name.text == a.inside[0].text; });
      if (!is_descriptor) unknown_name({&graph, scope}, a.inside, Diag::UnknownName);
      continue;
    }
    Binding copy = *b;
    declare(scope, a.outside, std::move(copy));
  }
}

/// Checks a function that nothing may have called yet, with arguments that nobody knows.
void Elaborator::check_function(FunctionDecl* d) {
  const Function& f = d->function();
  const Context c{d->graph, d->scope};
  std::vector<TypeId> types;
  for (const Formal& formal : f.formals) {
    const std::vector<TypeExpr>& all = d->graph->types;
    // Generic functions and open arrays are checked where they are called.
    std::vector<TypeHandle> pending{formal.type};
    while (!pending.empty()) {
      const TypeExpr& t = all[pending.back().index];
      pending.pop_back();
      if (t.form == TypeExpr::Form::Generic || t.form == TypeExpr::Form::Function) return;
      if (t.form == TypeExpr::Form::Named && !find(c, t.path)) {
        const bool earlier = std::any_of(all.begin(), all.end(), [&](const TypeExpr& g) {
          return g.form == TypeExpr::Form::Generic && g.path[0].text == t.path[0].text;
        });
        if (earlier) return;
      }
      for (const TypeExpr::Dim& dim : t.dims)
        if (dim.form == TypeExpr::Dim::Form::Open || dim.form == TypeExpr::Dim::Form::Generic ||
            (dim.form == TypeExpr::Dim::Form::Named && !find(c, dim.path)))
          return;
      if (t.form == TypeExpr::Form::Array) pending.push_back(t.element);
    }
    types.push_back(resolve_type(c, formal.type, nullptr));
    if (!types_.is_numeric(types.back())) return;
  }
  function_ = new_function("check " + f.name.text);
  std::vector<Value> formals;
  for (TypeId type : types) {
    std::vector<SlotType> slots;
    slot_types(type, slots);
    std::vector<Ref> refs;
    for (SlotType s : slots) refs.push_back(node(vm::Op::LoadLocal, {}, 0, 0, {s}));
    std::size_t next = 0;
    formals.push_back(unflatten(type, refs, next));
  }
  const TypeId result = resolve_type(c, f.result, nullptr);
  if (result == TypeTable::kPoison) return;
  unknown_arguments_ = !formals.empty();
  const Value v = invoke(d, formals, {}, result, f.header);
  unknown_arguments_ = false;
  if (f.formals.empty() && !d->library) export_value(f.name.text, v);
}

void Elaborator::check_constant(const Graph& graph, const Constant& k, Scope* scope) {
  function_ = new_function("const " + k.name.text);
  Binding* b = find(scope, k.name.text);
  if (b && b->form == Binding::Form::Constant && b->graph == &graph)
    export_value(k.name.text, evaluate_constant(*b));
}

/// Makes the current function, whose value is `v`, visible from outside.
void Elaborator::export_value(const std::string& name, const Value& v) {
  if (v.poison() || !types_.is_numeric(v.type)) return;
  std::vector<Ref> refs;
  flatten(v, refs);
  for (Ref& r : refs) r = localise(r);
  module.functions[function_].results = refs;
  exports.push_back({name, types_.spell(v.type), function_});
}

void Elaborator::descriptor(const Graph& graph, const Descriptor& d, Scope* scope) {
  for (const ElaboratedDescriptor& other : descriptors)
    if (other.syntax->form == d.form && other.syntax->name.text == d.name.text)
      diagnostics_.add(Diag::Redefined, d.name.span, d.name.text)
          .note(other.syntax->name.span, "first defined here");
  function_ =
      new_function((d.form == Descriptor::Form::Surface ? "surface " : "volume ") + d.name.text);
  ElaboratedDescriptor e;
  e.syntax = &d;
  e.graph = &graph;
  e.function = function_;
  line_ = line_of(d.name.span);
  Scope* inner = new_scope(scope);
  body({&graph, inner}, d.body);
  outputs(e, inner);
  descriptors.push_back(std::move(e));
}

void Elaborator::outputs(ElaboratedDescriptor& e, Scope* scope) {
  const Descriptor& d = *e.syntax;
  const bool surface = d.form == Descriptor::Form::Surface;
  auto assignment = [&](std::string_view name) -> const Assignment* {
    for (const Assignment& a : d.body.assignments)
      if (a.name.text == name) return &a;
    return nullptr;
  };
  auto default_value = [&](Output o) -> Value {
    switch (vm::kOutputs[static_cast<std::size_t>(o)].shape) {
      case OutputRow::Shape::Material:
        return call_library(surface ? "matte" : "isotropic", {}, d.name.span);
      case OutputRow::Shape::Spectrum:
        return widen(scalar(TypeTable::kReal, real(surface && o == Output::Scattering ? 1 : 0)),
                     TypeTable::kSpectrum);
      case OutputRow::Shape::Real:
        return scalar(TypeTable::kReal, real(0));
      case OutputRow::Shape::Real2:
        break;
    }
    Value zero;
    zero.type = types_.array(TypeTable::kReal, 2);
    zero.parts = {scalar(TypeTable::kReal, real(0)), scalar(TypeTable::kReal, real(0))};
    return zero;
  };
  for (std::size_t o = 0; o < vm::kOutputCount; ++o) {
    const std::string_view name = vm::output_name(form_of(d.form), static_cast<Output>(o));
    const Assignment* a = name.empty() ? nullptr : assignment(name);
    e.outputs[o] = default_value(static_cast<Output>(o));
    if (!a) continue;
    const TypeId type = e.outputs[o].type;
    e.stated[o] = true;
    const Value v = convert(scope->names[std::string(name)].value, type, (*e.graph)[a->value].span);
    if (v.poison()) continue;
    e.outputs[o] = v;
    if (v.material && v.material->size() > vm::limits::kLobes)
      diagnostics_.add(Diag::TooManyLobes, a->name.span, v.material->size(), vm::limits::kLobes);
  }
  const std::size_t height = static_cast<std::size_t>(Output::Height),
                    gradient = static_cast<std::size_t>(Output::Gradient);
  if (e.stated[height] && !e.stated[gradient] && !diagnostics_.has_errors()) {
    e.outputs[gradient] = derive_gradient(e.outputs[height], assignment("height")->name.span);
    e.stated[gradient] = true;
  }
}

void Elaborator::run(std::span<const Graph> graphs) {
  load_library();
  program_scope_ = new_scope(library_scope_);
  function_ = new_function("params");
  for (const Graph& g : graphs)  // an import of one of these is no other file
    imported_[std::filesystem::weakly_canonical(g.source->name).string()] = program_scope_;
  for (const Graph& g : graphs) add_graph(g, program_scope_);
  for (const auto& [name, text] : options_.params) {
    const bool there = std::any_of(params.begin(), params.end(),
                                   [&](const ParamInfo& p) { return p.name == name; });
    if (there) continue;
    std::vector<std::string> names;
    for (const ParamInfo& p : params) names.push_back(p.name);
    Diagnostic& d = diagnostics_.add(Diag::UnknownParam, Span{}, name);
    const std::string near = nearest(name, names);
    if (!near.empty()) d.help(fmt::format("did you mean `{}`?", near));
  }
  for (const Graph& g : graphs) {
    for (const Constant& k : g.constants) check_constant(g, k, program_scope_);
    for (const Descriptor& d : g.descriptors) descriptor(g, d, program_scope_);
  }
  for (std::size_t i = 0; i < decls_.size(); ++i) {  // checking may add nested ones
    FunctionDecl& d = decls_[i];
    if (!d.library && d.scope == program_scope_) check_function(&d);
  }
}

}  // namespace mms::lang
